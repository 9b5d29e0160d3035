//! What a check finds of one file. Main type: [`Finding`].

use std::path::Path;

use crate::{Error, ErrorKind};

/// One thing that was looked at, a file or what it describes, and what was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What was looked at.
    pub what: String,
    /// What was found.
    pub verdict: Verdict,
}

/// What was found of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It holds; how that is known.
    Holds(String),
    /// It is damaged, forged, missing, or nothing proves it.
    Fails(Error),
    /// It is not groebot's; why.
    NotChecked(String),
}

impl Finding {
    /// Something holds.
    pub fn holds(what: &str, text: impl Into<String>) -> Self {
        Finding { what: what.to_owned(), verdict: Verdict::Holds(text.into()) }
    }

    /// The file `what` of `folder` fails.
    pub fn fails(folder: &Path, what: &str, error: Error) -> Self {
        Finding { what: what.to_owned(), verdict: Verdict::Fails(error.in_file(&folder.join(what))) }
    }

    /// The file `what` of `folder` fails with an error of kind [`ErrorKind::Certificate`].
    pub fn refused(folder: &Path, what: &str, text: impl Into<String>) -> Self {
        Finding::fails(folder, what, Error::new(ErrorKind::Certificate, text.into()))
    }

    /// Something is not groebot's.
    pub fn not_checked(what: &str, text: &str) -> Self {
        Finding { what: what.to_owned(), verdict: Verdict::NotChecked(text.to_owned()) }
    }

    /// The error, where it fails.
    pub fn error(&self) -> Option<&Error> {
        match &self.verdict {
            Verdict::Fails(error) => Some(error),
            Verdict::Holds(_) | Verdict::NotChecked(_) => None,
        }
    }
}
