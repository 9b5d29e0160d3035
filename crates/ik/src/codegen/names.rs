//! Names of a program as identifiers of a language: unchanged where valid, else changed as little as possible.

use std::collections::HashSet;

use super::language::Expressions;
use crate::solver::Program;
use groebot_robot::document::word;

/// Names that the printed functions use themselves, in addition to `r0`, `i0`, `roots0` and similar ones.
const TAKEN: &str = "p c at all rows tip values value sizes size columns target magnitude memcpy rarely jacobian short parameters walk FACTS Solver \
    INPUTS JOINTS CAPACITY EMPTY INPUT_NAMES JOINT_NAMES LIMITS OPEN_STRATA Solution Pairs Error Solve Candidates Condition Facts Fixed Found Joint \
    Mechanism Number Preference Reached Short With Chain Formulation Formulations Rigid ARM RedundantSolver groebot_runtime";

/// Prefixes of numbered names in the printed functions.
const NUMBERED: [&str; 14] = [
    "r", "i", "roots", "choice", "choices", "found", "before", "claim", "claims", "six", "answer", "answers", "count",
    "block_",
];

/// The identifiers of one program in one language.
pub(super) struct Names {
    /// Identifiers of the parameters.
    pub parameters: Vec<String>,
    /// Identifiers of the unknowns; different from those of the parameters.
    pub unknowns: Vec<String>,
}

impl Names {
    pub fn new(program: &Program, language: &dyn Expressions) -> Self {
        let mut used = HashSet::new();
        let mut name = |text: &str| unique(text, language, &mut used);
        Names {
            parameters: program.parameters.iter().map(|parameter| name(&parameter.name)).collect(),
            unknowns: program.unknowns.iter().map(|unknown| name(unknown)).collect(),
        }
    }
}

fn unique(text: &str, language: &dyn Expressions, used: &mut HashSet<String>) -> String {
    let mut name = word(text);
    while is_taken(&name, language) || used.contains(&name) {
        name.push('_');
        if is_taken(&name, language) {
            name.insert(0, 'x');
        }
    }
    used.insert(name.clone());
    name
}

/// Whether a text is a valid part of a name in every language: a letter, then letters, digits and `_`.
#[doc(hidden)]
pub fn is_word(text: &str) -> bool {
    word(text) == text
}

fn is_taken(name: &str, language: &dyn Expressions) -> bool {
    let is_number = |rest: &str| {
        let (first, last) = (rest.bytes().next(), rest.bytes().last());
        first.zip(last).is_some_and(|(first, last)| first.is_ascii_digit() && last.is_ascii_digit())
    };
    TAKEN.split_whitespace().any(|word| word == name)
        || NUMBERED.iter().any(|letters| name.strip_prefix(letters).is_some_and(is_number))
        || language.is_reserved(name)
}

/// The text for a comment in any language: printable ASCII on one line without comment delimiters.
pub(super) fn remark(text: &str) -> String {
    let printable = |c: char| if c == ' ' || c.is_ascii_graphic() { c } else { '?' };
    let line: String = text.chars().map(printable).collect();
    line.replace('\\', "|").replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
}
