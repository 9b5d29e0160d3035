//! The command line's readers as functions: arguments, lists of options, and tables of targets, joint values, poses and
//! logs.
//!
//! The commands themselves call them. Tests and the targets of `fuzz/` call them without running a command.

use std::ffi::OsString;
use std::io::BufRead;
use std::path::Path;

use super::columns::Columns;
use super::forms::Forms;
use super::targets::{Reader, STDIN};
use super::{fk, floor, follow, identify, ik};
use crate::Result;
use groebot_algebra::escape;
use groebot_humanoid::gait::Footprint;
use groebot_ik::solver::Program;
use groebot_robot::dynamics::{Equations, Logged};
use groebot_robot::kinematics::{Chain, Target};
use groebot_robot::motion::StateTable;
use groebot_robot::spatial::Pose;

/// Parses a command line, of which the first argument is the program's name. Runs nothing.
///
/// # Errors
/// The text that is shown instead of running a command: help, the version, or an error in the arguments.
pub fn command_line(arguments: impl IntoIterator<Item = OsString>) -> std::result::Result<(), String> {
    super::parsed(arguments).map(drop).map_err(|usage| escape::message(&usage.render().to_string()))
}

/// Reads the targets of a table for `groebot solve`: the inputs of `program`, by row.
///
/// # Errors
/// Those of `solve`, with the line.
pub fn solver_targets(program: &Program, table: impl BufRead, degrees: bool) -> Result<Vec<Vec<f64>>> {
    let forms = Forms::new(program);
    rows(forms.columns(program, degrees), table, |numbers| forms.inputs(numbers))
}

/// Reads the targets of a table for `groebot ik`, each with the values of the given joints, by row.
///
/// # Errors
/// Those of `ik`, with the line.
pub fn chain_targets(chain: &Chain, table: impl BufRead, degrees: bool) -> Result<Vec<(Target, Vec<f64>)>> {
    rows(ik::target::columns(chain, degrees), table, |numbers| ik::target::aim(chain, &numbers, degrees))
}

/// Reads the joint values of a table for `groebot fk`, by row; angles are in degrees if `degrees`, else radians.
///
/// # Errors
/// Those of `fk`, with the line.
pub fn joint_values(chain: &Chain, table: impl BufRead, degrees: bool) -> Result<Vec<Vec<f64>>> {
    rows(fk::columns(chain, Vec::new(), degrees), table, Ok)
}

/// Reads the poses of a table for `groebot follow`, and their times \[s\] if it has a column of them.
///
/// # Errors
/// Those of `follow`, with the line.
pub fn poses(chain: &Chain, table: impl BufRead) -> Result<(Vec<Pose>, Option<Vec<f64>>)> {
    follow::read_from(table, Path::new(STDIN), chain)
}

/// Reads the rows of a log for `groebot identify`.
///
/// # Errors
/// As [`StateTable::from_csv`] and [`StateTable::in_order_of`]; [`crate::ErrorKind::MissingKey`] for a list that is
/// missing.
pub fn log(equations: &Equations, table: &str) -> Result<Vec<Logged>> {
    identify::log(StateTable::from_csv(table)?, equations)
}

/// Reads the target of `groebot ik --target`, with the values of the given joints.
///
/// # Errors
/// Those of `ik`.
pub fn listed_target(chain: &Chain, text: &str, degrees: bool) -> Result<(Target, Vec<f64>)> {
    ik::target::target(chain, text, degrees)
}

/// Computes the target that the joint values of `groebot ik --q` reach, with the values of the given joints.
///
/// # Errors
/// Those of `ik`.
pub fn listed_joints(chain: &Chain, text: &str, degrees: bool) -> Result<(Target, Vec<f64>)> {
    ik::target::reached(chain, text, degrees)
}

/// Reads a `--furniture` option: the piece of furniture, and its new pose \[m, rad\], or its removal.
///
/// # Errors
/// [`crate::ErrorKind::BadValue`] for a text other than `NAME=X,Y[,YAW]` or `NAME=none`.
pub fn furniture(text: &str) -> Result<(&str, Option<Footprint>)> {
    floor::moved(text)
}

fn rows<T>(columns: Columns, table: impl BufRead, take: impl Fn(Vec<f64>) -> Result<T>) -> Result<Vec<T>> {
    let mut reader = Reader::new(columns, table, Path::new(STDIN));
    let mut rows = Vec::new();
    while let Some(row) = reader.next() {
        let row = row?;
        rows.push(take(row.target).map_err(|error| error.at_line(row.line).in_file(Path::new(STDIN)))?);
    }
    Ok(rows)
}
