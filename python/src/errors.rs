//! Conversion of groebot's errors to Python exceptions: `groebot.GroebotError` and its subclasses, each with the kind
//! of the error.

use groebot::{Error, ErrorKind};
use pyo3::prelude::*;

/// Converts an error to the exception of its kind. `groebot._errors` has the classes.
pub fn raised(error: &Error) -> PyErr {
    let place = error.place();
    let file = place.file.as_ref().map(|file| file.display().to_string());
    exception(kind_name(error.kind()), error.message(), file, place.line)
}

/// A `BadValueError` with this message.
pub fn bad_value(text: impl Into<String>) -> PyErr {
    raised(&Error::new(ErrorKind::BadValue, text))
}

/// An error of the kind `unsupported` with this message.
pub fn unsupported(text: impl Into<String>) -> PyErr {
    raised(&Error::new(ErrorKind::Unsupported, text))
}

fn exception(kind: &str, message: &str, file: Option<String>, line: Option<usize>) -> PyErr {
    Python::attach(|py| {
        let made = py.import("groebot._errors").and_then(|module| {
            let exception = module.getattr("of_kind")?.call1((kind, message, file, line))?;
            Ok(PyErr::from_value(exception))
        });
        made.unwrap_or_else(|error| error)
    })
}

/// The kind's name in `GroebotError.kind`.
fn kind_name(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::Io => "io",
        ErrorKind::Syntax => "syntax",
        ErrorKind::UnknownKey => "unknown_key",
        ErrorKind::MissingKey => "missing_key",
        ErrorKind::BadValue => "bad_value",
        ErrorKind::DuplicateName => "duplicate_name",
        ErrorKind::UnknownName => "unknown_name",
        ErrorKind::Overflow => "overflow",
        ErrorKind::Inconsistent => "inconsistent",
        ErrorKind::PositiveDimensional => "positive_dimensional",
        ErrorKind::Cancelled => "cancelled",
        ErrorKind::Budget => "budget",
        ErrorKind::Unsupported => "unsupported",
        ErrorKind::Certificate => "certificate",
        _ => "other",
    }
}
