//! groebot's own JSON formats, which have an integer `format`.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::{Error, ErrorKind, Result};

/// The greatest length of a list or an object on one line, in bytes.
const WIDTH: usize = 120;

/// `value` as JSON that ends in a line feed, indented by two spaces. A list or an object of up to 120 bytes is on one line.
///
/// # Panics
/// If JSON cannot represent the value, for example a map whose keys are not text.
pub fn json_text(value: &impl Serialize) -> String {
    let pretty = serde_json::to_string_pretty(value).expect("only types that JSON can represent are written");
    let (mut lines, mut open): (Vec<String>, Vec<usize>) = (Vec::new(), Vec::new());
    for line in pretty.lines() {
        lines.push(line.to_owned());
        if line.ends_with(['[', '{']) {
            open.push(lines.len() - 1);
        } else if line.trim_start().starts_with([']', '}'])
            && let Some(joined) = open.pop().and_then(|start| joined(&lines[start..]).map(|line| (start, line)))
        {
            lines.truncate(joined.0);
            lines.push(joined.1);
        }
    }
    lines.join("\n") + "\n"
}

/// The lines of a list or an object joined to one line; `None` if that is longer than [`WIDTH`].
fn joined(lines: &[String]) -> Option<String> {
    let mut line = lines[0].clone();
    for next in &lines[1..] {
        line += if line.ends_with(',') { " " } else { "" };
        line += next.trim_start();
        if line.len() > WIDTH {
            return None;
        }
    }
    Some(line)
}

/// A JSON format with its version number.
pub struct JsonFormat {
    /// Its name, such as `certificate`.
    pub what: &'static str,
    /// The oldest `format` that is read.
    pub oldest: u32,
    /// The `format` that is written, and the newest that is read.
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
        self.read_version(text).map(|(_, value)| value)
    }

    /// Reads `text`, with the number of its `format`.
    ///
    /// # Errors
    /// As [`JsonFormat::read`].
    pub fn read_version<T: DeserializeOwned>(&self, text: &str) -> Result<(u32, T)> {
        let syntax = |error: serde_json::Error| {
            Error::new(ErrorKind::Syntax, format!("this is no {} in JSON: {error}", self.what))
                .at_line(error.line().max(1))
        };
        let Head { format, version } = serde_json::from_str(text).map_err(syntax)?;
        match format.filter(|format| (self.oldest..=self.number).contains(format)) {
            Some(format) => Ok((format, serde_json::from_str(text).map_err(syntax)?)),
            None => Err(self.refusal(format, version)),
        }
    }

    fn refusal(&self, format: Option<u32>, version: Option<String>) -> Error {
        let format = format.map_or("no `format`".to_owned(), |format| format!("`format` {format}"));
        let version =
            version.map_or(String::new(), |version| format!(", written by groebot {}", super::shown(&version)));
        let JsonFormat { what, oldest, number, renew } = self;
        let read =
            if oldest == number { format!("{number} is read") } else { format!("{oldest} to {number} are read") };
        Error::new(ErrorKind::Unsupported, format!("this {what} has {format}{version}; {read}: {renew}"))
    }
}
