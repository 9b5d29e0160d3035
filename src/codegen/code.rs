//! Code as text with what it reads ([`Code`]).

use serde::Serialize;

use super::language::Language;
use super::printer::reads_places;

/// Lines of code, values, and what they read.
#[derive(Serialize)]
pub(super) struct Code {
    pub lines: Vec<String>,
    pub values: Vec<String>,
    pub reads_p: bool,
    pub reads_at: bool,
}

impl Code {
    /// The code, and what it reads.
    pub fn new(language: &dyn Language, lines: Vec<String>, values: Vec<String>) -> Self {
        let reads = |what: &str| lines.iter().chain(&values).any(|line| line.contains(what));
        Code {
            reads_p: reads(&language.field("")),
            reads_at: lines.iter().chain(&values).any(|line| reads_places(line)),
            lines,
            values,
        }
    }
}
