//! Printing a [`Program`] as a stand-alone solver: [`rust::emit`], [`c99::emit`] and [`ikfast::emit`].
//!
//! The printed solver is the algorithm of [`Program::solve`](crate::solver::Program::solve) step by step, without
//! allocation, and holds only what its program needs. A language is an expression printer (`language::Language`) plus
//! the skeleton of a file (`skeleton/`), filled from one `outline::Outline`.

pub mod c99;
pub mod ikfast;
pub mod rust;

mod about;
mod batch;
mod blocks;
mod body;
mod code;
mod demand;
mod forward;
mod joined;
mod lanes;
mod language;
mod mirror;
mod names;
mod needs;
mod outline;
mod printer;
mod quartic;
mod samples;
mod single;
mod six_axes;
mod steps;
mod tolerances;

pub use names::is_word;

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
    environment.add_filter("number", printer::number);
    environment.add_filter("packed", printer::packed_lines);
    for (name, part) in quartic::PARTS {
        environment.add_template(name, part).expect("the skeletons' parts are templates");
    }
    let text = environment.render_str(skeleton, outline).expect("the outline has every value that the skeleton names");
    text.replace("\n\n\n", "\n\n")
}
