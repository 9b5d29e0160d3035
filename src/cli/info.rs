//! `groebot info`: a chain or a system in words.

use std::path::PathBuf;

use super::{Outcome, console};
use crate::derive::Source;

/// Prints the chain or the system that a derivation would start from
#[derive(clap::Args)]
pub struct Arguments {
    /// A mechanism's folder, or an input file
    #[arg(value_name = "DIR-or-FILE")]
    input: PathBuf,
}

/// Prints the input.
pub fn run(arguments: &Arguments) -> Outcome {
    let source = Source::read(&arguments.input)?;
    let chain = source.chain.as_ref().map(|chain| format!("{chain}\n\n")).unwrap_or_default();
    console::print(&format!("{chain}{}", source.system))
}
