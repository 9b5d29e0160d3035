//! Assertions on errors.

use groebot_algebra::{Error, ErrorKind};

/// Asserts the kind, the line and a word of the message of an error.
#[track_caller]
pub fn assert_error(error: &Error, kind: ErrorKind, line: Option<usize>, word: &str) {
    assert_eq!((error.kind(), error.place().line), (kind, line), "{error}");
    assert!(error.message().contains(word), "`{word}` is not in: {error}");
}
