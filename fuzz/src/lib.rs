//! What each fuzz target does with its bytes. The targets of `fuzz_targets/` and the tests of the main package (`tests/fuzz`) call the same functions.
//!
//! A reader has to answer or refuse. An answer that has a writer is written and read again. The words of a refusal have to be fit to be shown.
//! Nothing is left out because it fails; what is left out because it takes long (the drawing of a large map) is bounded by a named constant.

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
    /// Its name: that of its file in `fuzz_targets/`, and of its folder in `seeds/`.
    pub name: &'static str,
    /// What it reads.
    pub about: &'static str,
    /// What it does with its bytes. It panics where a reader does not keep its promise.
    pub run: fn(&[u8]),
    /// So many damaged seeds are tried by the tests: fewer where one takes long.
    pub damaged: usize,
}

/// All targets, by theme.
pub const TARGETS: [&[Target]; 6] = [
    &algebra::TARGETS,
    &mechanisms::TARGETS,
    &derived::TARGETS,
    &motions::TARGETS,
    &floors::TARGETS,
    &commands::TARGETS,
];

/// Gives `bytes` to the target called `name`.
///
/// # Panics
/// When there is no such target, or it does not hold what it should.
pub fn run(name: &str, bytes: &[u8]) {
    let target = TARGETS.into_iter().flatten().find(|target| target.name == name);
    (target.expect("a target has the name of its file").run)(bytes);
}

/// The bytes as text. What is not UTF-8 in them is replaced: readers of files refuse it before their grammar comes.
fn text(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes)
}

/// What was read; a refusal is looked at by [`check_refusal`].
fn read<T>(result: Result<T>) -> Option<T> {
    result.map_err(|error| check_refusal(&error)).ok()
}

/// Fails for a refusal without words, or with characters that act on the text around them.
fn check_refusal(error: &Error) {
    let words = error.to_string();
    assert!(!error.message().trim().is_empty(), "{:?} without words", error.kind());
    check_shown(&words);
}

/// Fails for a text that is not fit to be shown.
fn check_shown(text: &str) {
    let hidden = text.chars().find(|c| is_hidden(*c) && *c != '\n' && *c != '\t');
    assert_eq!(hidden, None, "{text:?}");
}
