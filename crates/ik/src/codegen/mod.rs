//! Code generation from a [`Program`]: [`rust::emit`], [`c99::Pair`] and [`ikfast::emit`].
//!
//! A printed file contains the parts that are specific to a robot: its program as straight-line code in nested loops,
//! its equations, and its facts. The rest is in the run time `groebot-runtime`, which
//! [`Program::solver`](crate::solver::Program::solver) uses too; [`single_file`] prints both together. A language has
//! expressions (`language::Expressions`), statements (`dialect::Dialect`), and the skeleton of a file (`skeleton/`),
//! which is filled from an `outline::Outline`.

pub mod c99;
pub mod dynamics;
pub mod ikfast;
pub mod rust;
pub mod single_file;

mod about;
mod body;
mod dialect;
mod joined;
mod language;
mod names;
mod outline;
mod parts;
mod printer;
mod reserved;
mod samples;
mod six_axes;
mod walk;

pub use names::is_word;
pub use reserved::is_run_time;

use minijinja::Value;
use serde::Serialize;

use crate::solver::Program;

/// Whether a step of `program`, or of a part of its redundancy, solves six joints together by an eigenvalue problem.
#[doc(hidden)]
pub fn has_six_axes(program: &Program) -> bool {
    !parts::Parts::new(program).six_axes.is_empty()
}

fn length(value: &Value) -> Result<usize, minijinja::Error> {
    value.len().ok_or_else(|| minijinja::Error::new(minijinja::ErrorKind::InvalidOperation, "the value has no length"))
}

fn joined(values: &[Value], between: &str) -> String {
    values.iter().map(Value::to_string).collect::<Vec<_>>().join(between)
}

/// Fills the skeleton with the outline's values. Both are part of this crate, so that filling cannot fail.
fn fill(skeleton: &str, outline: &impl Serialize) -> String {
    let mut environment = minijinja::Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.set_keep_trailing_newline(true);
    environment.set_undefined_behavior(minijinja::UndefinedBehavior::Strict);
    environment.add_filter("number", language::number);
    environment.add_filter("packed", printer::packed_lines);
    // The only built-in filters and the only test that skeletons use: all of them together are a hundredth of the Python package.
    environment.add_filter("length", length);
    environment.add_filter("join", |values: Vec<Value>, between: &str| joined(&values, between));
    environment.add_filter("upper", |text: String| text.to_uppercase());
    environment.add_filter("max", |values: Vec<Value>| values.into_iter().max());
    environment.add_test("none", |value: Value| value.is_none());
    let text = environment.render_str(skeleton, outline).expect("the outline has every value that the skeleton names");
    text.replace("\n\n\n", "\n\n")
}
