//! Errors of groebot as exceptions of Python: `groebot.GroebotError` and its heirs, each with the kind of the error.

use groebot::{Error, ErrorKind};
use pyo3::prelude::*;

/// An error of groebot as the exception of its kind, which `groebot._errors` chooses.
pub fn raised(error: &Error) -> PyErr {
    let place = error.place();
    let file = place.file.as_ref().map(|file| file.display().to_string());
    exception(kind_name(error.kind()), error.message(), file, place.line)
}

/// A value that is wrong, in words.
pub fn bad_value(text: impl Into<String>) -> PyErr {
    raised(&Error::new(ErrorKind::BadValue, text))
}

/// What this solver cannot do, in words.
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

/// The kind as `GroebotError.kind` tells it.
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
