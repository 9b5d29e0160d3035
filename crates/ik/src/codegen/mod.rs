//! Printing a [`Program`] as source code: [`rust::emit`], [`c99::Pair`] and [`ikfast::emit`].
//!
//! A printed file holds what is particular to a robot: its program as straight-line code in nested loops, its equations, and its
//! facts. All else is called from the run time `groebot-runtime`, which [`Program::solver`](crate::solver::Program::solver) calls
//! too; [`single_file`] puts both together. A language prints expressions (`language::Expressions`) and statements (`dialect::Dialect`), and has the skeleton
//! of a file (`skeleton/`), filled from one `outline::Outline`.

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
mod printer;
mod reserved;
mod samples;
mod six_axes;
mod walk;

pub use names::is_word;
pub use reserved::is_run_time;

use serde::Serialize;

use crate::solver::Program;

/// Whether a step of `program` finds six joints together, by an eigenvalue problem.
pub fn has_six_axes(program: &Program) -> bool {
    !six_axes::steps(program).is_empty()
}

/// The skeleton with the outline's values; both come with the crate and fit one another.
fn fill(skeleton: &str, outline: &impl Serialize) -> String {
    let mut environment = minijinja::Environment::new();
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.set_keep_trailing_newline(true);
    environment.set_undefined_behavior(minijinja::UndefinedBehavior::Strict);
    environment.add_filter("number", language::number);
    environment.add_filter("packed", printer::packed_lines);
    let text = environment.render_str(skeleton, outline).expect("the outline has every value that the skeleton names");
    text.replace("\n\n\n", "\n\n")
}
