//! Functions of the fuzz targets. The targets of `fuzz_targets/` and the tests of the main package (`tests/fuzz`) call the same functions.
//!
//! A reader must accept or refuse an input. An accepted input that has a writer is written and read again. The text of an error must be printable. No input is
//! skipped because it fails. Slow steps, such as the drawing of a large map, are skipped above a named constant.

mod algebra;
mod commands;
mod derived;
mod floors;
mod given;
mod mechanisms;
mod motions;

use std::borrow::Cow;

use groebot::escape::is_hidden;
use groebot::{Error, Result};

/// A fuzz target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, which is that of its file in `fuzz_targets/` and of its folder in `seeds/`.
    pub name: &'static str,
    /// The input that it reads.
    pub about: &'static str,
    /// Runs the target. It panics if a reader violates its specification.
    pub run: fn(&[u8]),
    /// Number of damaged seeds in the tests; smaller for slow targets.
    pub damaged: usize,
}

/// All targets, by subject.
pub const TARGETS: [&[Target]; 6] = [
    &algebra::TARGETS,
    &mechanisms::TARGETS,
    &derived::TARGETS,
    &motions::TARGETS,
    &floors::TARGETS,
    &commands::TARGETS,
];

/// Runs the target `name` with `bytes`.
///
/// # Panics
/// When there is no such target, or the target fails.
pub fn run(name: &str, bytes: &[u8]) {
    let target = TARGETS.into_iter().flatten().find(|target| target.name == name);
    (target.expect("a target has the name of its file").run)(bytes);
}

/// The bytes as text. Invalid UTF-8 is replaced, because readers of files refuse it before parsing.
fn text(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes)
}

/// The result of a reader. An error is checked by [`check_refusal`].
fn read<T>(result: Result<T>) -> Option<T> {
    result.map_err(|error| check_refusal(&error)).ok()
}

/// Fails for an error without text, or with characters that affect the surrounding text.
fn check_refusal(error: &Error) {
    let words = error.to_string();
    assert!(!error.message().trim().is_empty(), "{:?} without words", error.kind());
    check_shown(&words);
}

/// Fails for a text that is not printable.
fn check_shown(text: &str) {
    let hidden = text.chars().find(|c| is_hidden(*c) && *c != '\n' && *c != '\t');
    assert_eq!(hidden, None, "{text:?}");
}
