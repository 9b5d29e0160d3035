//! groebot's own JSON formats, which have an integer `format`.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::{Error, ErrorKind, Result};

/// A JSON format with its version number.
pub struct JsonFormat {
    /// Its name, such as `certificate`.
    pub what: &'static str,
    /// The `format` that is written and accepted.
    pub number: u32,
    /// Advice to convert an old version.
    pub renew: &'static str,
}

/// The field with the version. Before formats had numbers, it was the crate's version.
#[derive(Deserialize)]
struct Head {
    format: Option<u32>,
    #[serde(alias = "groebot")]
    version: Option<String>,
}

impl JsonFormat {
    /// Reads `text`.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not JSON of this format, with the line; [`ErrorKind::Unsupported`] for
    /// another version, with advice to convert it.
    pub fn read<T: DeserializeOwned>(&self, text: &str) -> Result<T> {
        let syntax = |error: serde_json::Error| {
            Error::new(ErrorKind::Syntax, format!("this is no {} in JSON: {error}", self.what))
                .at_line(error.line().max(1))
        };
        let Head { format, version } = serde_json::from_str(text).map_err(syntax)?;
        if format != Some(self.number) {
            let format = format.map_or("no `format`".to_owned(), |format| format!("`format` {format}"));
            let version =
                version.map_or(String::new(), |version| format!(", written by groebot {}", super::shown(&version)));
            let JsonFormat { what, number, renew } = self;
            let text = format!("this {what} has {format}{version}; {number} is read: {renew}");
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        serde_json::from_str(text).map_err(syntax)
    }
}
