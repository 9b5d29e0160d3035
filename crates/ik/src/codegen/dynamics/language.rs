//! The parts of equations of motion that differ between the languages. Main type: [`Language`].

use super::function::Function;
use crate::codegen::language::Expressions;
use crate::codegen::printer::INDENT;
use groebot_robot::dynamics::Equations;

/// A table of the robot: by body, the base first.
pub(super) enum Table {
    /// Integers.
    Places(&'static str, Vec<usize>),
    /// Rows of numbers.
    Numbers(&'static str, Vec<Vec<f64>>),
}

/// The parts that differ between the languages.
pub(super) trait Language {
    fn expressions(&self) -> &dyn Expressions;
    /// The results of a function: statements, and a final expression.
    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String);
    /// The list of parameters.
    fn parameters(&self, function: Function, equations: &Equations) -> String;
    /// The results of a recursive function, zero at first.
    fn start(&self, function: Function) -> Vec<String>;
    /// The return expression.
    fn finish(&self, function: Function) -> String;
    /// The entry of a matrix of results.
    fn entry(&self, matrix: &str, row: &str, column: &str) -> String;
    /// New variables, zero at first: `count` of each body.
    fn zeros(&self, name: &str, count: usize) -> String;
    /// New variables, zero at first: `count` in all.
    fn zero_row(&self, name: &str, count: usize) -> String;
    /// A constant integer.
    fn index(&self, name: &str, value: &str) -> String;
    /// The head of a loop over the bodies with the variable `i`.
    fn bodies(&self, inward: bool) -> &'static str;
    /// Start and continuation of a loop from a body to its ancestors with the variable `j`.
    fn climb(&self) -> [&'static str; 2];
    /// The head of a conditional block.
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
