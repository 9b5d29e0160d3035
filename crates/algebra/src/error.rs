//! The one error type: a kind to match on, the location of the error, and a message with the allowed values.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::escape;

/// Kind of an error. Match on it with a wildcard arm.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// A file could not be read or written.
    Io,
    /// Text that does not follow its grammar (TOML, an expression, JSON).
    Syntax,
    /// A key that the format does not know.
    UnknownKey,
    /// A key that the format requires is absent.
    MissingKey,
    /// A value outside the allowed range (a zero axis, NaN, inverted limits ...).
    BadValue,
    /// A name that is declared twice or has two meanings.
    DuplicateName,
    /// A name that nothing declares.
    UnknownName,
    /// An exponent or degree that does not fit into a monomial.
    Overflow,
    /// The equations have no solution for generic parameters: the unit ideal.
    Inconsistent,
    /// The ideal is positive-dimensional: some unknowns stay free, for example with more joints than independent
    /// equations.
    PositiveDimensional,
    /// The caller cancelled the work.
    Cancelled,
    /// The time or memory budget is used up.
    Budget,
    /// A well-formed request that this version does not solve.
    Unsupported,
    /// A certificate that does not prove what it claims.
    Certificate,
}

/// Location of an error: a file, a line of it (counted from 1), or both.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file, when the text was read from one.
    pub file: Option<PathBuf>,
    /// The line, counted from 1.
    pub line: Option<usize>,
}

/// The error type of every fallible function of groebot's crates.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Error {
    // In a box, so that a `Result` is small.
    content: Box<Content>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Content {
    kind: ErrorKind,
    place: Place,
    message: String,
}

/// Shorthand for a result with [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// Builds an error of `kind`. The message describes the error and the allowed values.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Error { content: Box::new(Content { kind, place: Place::default(), message: message.into() }) }
    }

    /// Adds the line number (from 1), unless the error already has one.
    #[must_use]
    pub fn at_line(mut self, line: usize) -> Self {
        self.content.place.line.get_or_insert(line);
        self
    }

    /// Adds the file, unless the error already has one. The file `-` is standard input.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        let file = if file == Path::new("-") { Path::new("<stdin>") } else { file };
        self.content.place.file.get_or_insert_with(|| file.to_owned());
        self
    }

    /// Puts `context` before the message.
    #[must_use]
    pub fn with_context(mut self, context: impl fmt::Display) -> Self {
        self.content.message = format!("{context}: {}", self.content.message);
        self
    }

    /// Puts `advice` after the message.
    #[must_use]
    pub fn with_advice(mut self, advice: impl fmt::Display) -> Self {
        self.content.message = format!("{}; {advice}", self.content.message);
        self
    }

    /// The kind of the error.
    pub fn kind(&self) -> ErrorKind {
        self.content.kind
    }

    /// The location of the error.
    pub fn place(&self) -> &Place {
        &self.content.place
    }

    /// The message without the location.
    pub fn message(&self) -> &str {
        &self.content.message
    }

    /// Builds an [`ErrorKind::Io`] error about `path`.
    pub fn io(path: &Path, error: &std::io::Error) -> Self {
        Error::new(ErrorKind::Io, error.to_string()).in_file(path)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.content.place.file {
            write!(f, "{}: ", escape::line(&file.to_string_lossy()))?;
        }
        if let Some(line) = self.content.place.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&escape::message(&self.content.message))
    }
}
