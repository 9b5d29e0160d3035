//! JSON that groebot writes and reads again: it holds an integer `format`.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::{Error, ErrorKind, Result};

/// A kind of JSON, and the number of its form.
pub struct JsonFormat {
    /// What it is, such as `certificate`.
    pub what: &'static str,
    /// The `format` that is written and read.
    pub number: u32,
    /// How to make a new one of an old one.
    pub renew: &'static str,
}

/// What tells the format; before formats had numbers, the crate's version stood there.
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
    /// [`ErrorKind::Syntax`] for text that is no such JSON, with the line; [`ErrorKind::Unsupported`] for that of another format,
    /// with what makes it new.
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
