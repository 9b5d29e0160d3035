//! The one error type: a kind to match on, a place to look at, a message that says what is allowed.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::escape;

/// What went wrong, coarsely; match on it with a wildcard arm.
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
    /// A value outside what is allowed (a zero axis, NaN, inverted limits ...).
    BadValue,
    /// A name that is declared twice or means two things.
    DuplicateName,
    /// A name that nothing declares.
    UnknownName,
    /// An exponent or degree beyond what a monomial can hold.
    Overflow,
    /// The equations have no solution for generic parameters: the unit ideal.
    Inconsistent,
    /// Some unknowns stay free: more joints than independent equations.
    PositiveDimensional,
    /// The caller asked for an end.
    Cancelled,
    /// The time or memory budget is used up.
    Budget,
    /// A well-formed request that this version does not solve.
    Unsupported,
    /// A certificate that does not prove what it claims.
    Certificate,
}

/// Where a mistake stands: a file, a line of it (from 1), or both.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file, when the text came from one.
    pub file: Option<PathBuf>,
    /// The line, counted from 1.
    pub line: Option<usize>,
}

/// The error of every fallible function of this crate.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Error {
    kind: ErrorKind,
    place: Place,
    message: String,
}

/// Shorthand for results of this crate.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An error of `kind`; the message says what was wrong and what is allowed.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Error { kind, place: Place::default(), message: message.into() }
    }

    /// The same error, standing at `line` (from 1) unless it already has one.
    #[must_use]
    pub fn at_line(mut self, line: usize) -> Self {
        self.place.line.get_or_insert(line);
        self
    }

    /// The same error, standing in `file` unless it already has one. The file `-` is standard input.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        let file = if file == Path::new("-") { Path::new("<stdin>") } else { file };
        self.place.file.get_or_insert_with(|| file.to_owned());
        self
    }

    /// The same error with `context` in front of its message.
    #[must_use]
    pub fn with_context(mut self, context: impl fmt::Display) -> Self {
        self.message = format!("{context}: {}", self.message);
        self
    }

    /// The same error with `advice` after its message.
    #[must_use]
    pub fn with_advice(mut self, advice: impl fmt::Display) -> Self {
        self.message = format!("{}; {advice}", self.message);
        self
    }

    /// What went wrong.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// Where it went wrong.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// The message without its place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// An [`ErrorKind::Io`] error about `path`.
    pub fn io(path: &Path, error: &std::io::Error) -> Self {
        Error::new(ErrorKind::Io, error.to_string()).in_file(path)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.place.file {
            write!(f, "{}: ", escape::line(&file.to_string_lossy()))?;
        }
        if let Some(line) = self.place.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&escape::message(&self.message))
    }
}
