//! What differs between the languages in equations of motion. Main type: [`Language`].

use super::function::Function;
use crate::codegen::language::Expressions;
use crate::codegen::printer::INDENT;
use groebot_robot::dynamics::Equations;

/// A table of the robot: by body, the base first.
pub(super) enum Table {
    /// Counts.
    Places(&'static str, Vec<usize>),
    /// Rows of numbers.
    Numbers(&'static str, Vec<Vec<f64>>),
}

/// What differs between the languages.
pub(super) trait Language {
    fn expressions(&self) -> &dyn Expressions;
    /// What is done with the results: statements, and an expression at last.
    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String);
    /// The list of parameters.
    fn parameters(&self, function: Function, equations: &Equations) -> String;
    /// The results of a recursive function, nought at first, and what is returned.
    fn start(&self, function: Function) -> Vec<String>;
    /// As told.
    fn finish(&self, function: Function) -> String;
    /// The entry of a matrix of results.
    fn entry(&self, matrix: &str, row: &str, column: &str) -> String;
    /// New numbers, nought at first: so many of each body.
    fn zeros(&self, name: &str, count: usize) -> String;
    /// So many alone.
    fn zero_row(&self, name: &str, count: usize) -> String;
    /// A place in a table that does not change.
    fn index(&self, name: &str, value: &str) -> String;
    /// The head of a loop through the bodies: `i`.
    fn bodies(&self, inward: bool) -> &'static str;
    /// What begins with a body and goes on while there is one: `j`.
    fn climb(&self) -> [&'static str; 2];
    /// The head of a block.
    fn when(&self, condition: &str) -> String;
    /// Tables of a file.
    fn tables(&self, tables: &[Table]) -> Vec<String>;
}

/// The rows of a table as text.
pub(super) fn rows(table: &Table, brackets: [&str; 2], literal: impl Fn(f64) -> String) -> String {
    match table {
        Table::Places(_, places) => places.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
        Table::Numbers(_, rows) => {
            let row = |row: &Vec<f64>| {
                let numbers: Vec<String> = row.iter().map(|number| literal(*number)).collect();
                format!("\n{INDENT}{}{}{}", brackets[0], numbers.join(", "), brackets[1])
            };
            rows.iter().map(row).collect::<Vec<_>>().join(",")
        }
    }
}

/// The results of a function by name, and whether they are matrices.
pub(super) fn results(function: Function) -> (&'static [&'static str], bool) {
    match function {
        Function::Derivatives => (&["by_q", "by_v"], true),
        Function::Inertia | Function::Coriolis => (&["out"], true),
        _ => (&["out"], false),
    }
}
