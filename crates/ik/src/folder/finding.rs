//! Result of the check of one file. Main type: [`Finding`].

use std::path::Path;

use crate::{Error, ErrorKind};

/// The result for one item: a file, or what it describes.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Finding {
    /// The name of the item.
    pub what: String,
    /// The result.
    pub verdict: Verdict,
}

/// The result for one item.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The item is correct; the text gives the proof.
    Holds(String),
    /// The item is damaged, forged, missing, or unproved.
    Fails(Error),
    /// The item was not written by groebot; the text gives the reason.
    NotChecked(String),
}

impl Finding {
    /// The item is correct.
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

    /// The item was not written by groebot.
    pub(crate) fn not_checked(what: &str, text: &str) -> Self {
        Finding { what: what.to_owned(), verdict: Verdict::NotChecked(text.to_owned()) }
    }

    /// The error, if the item fails.
    pub fn error(&self) -> Option<&Error> {
        match &self.verdict {
            Verdict::Fails(error) => Some(error),
            Verdict::Holds(_) | Verdict::NotChecked(_) => None,
        }
    }
}
