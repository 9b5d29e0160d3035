//! States of a robot as a table in CSV: what `groebot dynamics`, `identify` and `track` read. Main type: [`StateTable`].

use std::path::Path;

use crate::document::{read_text, shown, unix_lines};
use crate::limits;
use crate::{Error, ErrorKind, Result};

/// The longest table, in bytes.
const STATES_LIMIT: u64 = limits::STATES_BYTES;

/// States of a robot, a row each.
#[derive(Clone, Debug, PartialEq)]
pub struct StateTable {
    /// How many numbers a configuration has.
    pub coordinates: usize,
    /// The states.
    pub rows: Vec<StateRow>,
}

/// A state, and what else the table tells of it: metres, seconds, radians, newtons.
#[derive(Clone, Debug, PartialEq)]
pub struct StateRow {
    /// The time, `t`.
    pub time: Option<f64>,
    /// The configuration, `q0`..
    pub q: Vec<f64>,
    /// The velocity, `v0`..
    pub velocity: Option<Vec<f64>>,
    /// What it changes by, `a0`..
    pub acceleration: Option<Vec<f64>>,
    /// Torques, `tau0`..
    pub torques: Option<Vec<f64>>,
}

impl StateTable {
    /// The table of a file.
    ///
    /// # Errors
    /// As [`read_text`] and [`StateTable::from_csv`], with the file.
    pub fn read_csv(path: &Path) -> Result<Self> {
        StateTable::from_csv(&read_text(path, STATES_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// The table that `text` holds: a row of names, in any order, and rows of numbers between commas. Empty lines do not count.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for other names than those of [`StateRow`], each list whole, another count of cells than names, and a cell that is no number. With the line.
    pub fn from_csv(text: &str) -> Result<Self> {
        let text = unix_lines(text.trim_start_matches('\u{feff}'));
        let full = |(_, line): &(usize, &str)| !line.trim().is_empty();
        let mut lines = text.lines().enumerate().map(|(place, line)| (place + 1, line)).filter(full);
        let (first, head) = lines.next().unwrap_or((1, ""));
        let names: Vec<&str> = cells(head).collect();
        let lists = ["q", "v", "a", "tau"].map(|head| columns(&names, head));
        let time = names.iter().position(|name| *name == "t");
        let known = lists.iter().map(Vec::len).sum::<usize>() + usize::from(time.is_some());
        if known != names.len() || lists[0].is_empty() {
            let text = format!(
                "the first row is `{}`; give the names q0, q1, ..., v0, ..., a0, ... and tau0, ..., each list whole, and t for a time",
                shown(head)
            );
            return Err(Error::new(ErrorKind::Syntax, text).at_line(first));
        }
        let row = |(line, text): (usize, &str)| {
            row(text, &names, time, &lists).map_err(|error| Error::new(ErrorKind::Syntax, error).at_line(line))
        };
        Ok(StateTable { coordinates: lists[0].len(), rows: lines.map(row).collect::<Result<_>>()? })
    }
}

fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(str::trim)
}

/// The columns of the names that begin so and count from zero.
fn columns(names: &[&str], head: &str) -> Vec<usize> {
    let column = |index: usize| names.iter().position(|name| *name == format!("{head}{index}"));
    (0..).map_while(column).collect()
}

fn row(
    text: &str,
    names: &[&str],
    time: Option<usize>,
    lists: &[Vec<usize>; 4],
) -> std::result::Result<StateRow, String> {
    let found: Vec<&str> = cells(text).collect();
    if found.len() != names.len() {
        return Err(format!("{} cells stand in the row; the first one has {} names", found.len(), names.len()));
    }
    let number = |column: usize| {
        limits::number(found[column]).map_err(|fault| format!("column `{}`: {fault}", shown(names[column])))
    };
    let list = |columns: &Vec<usize>| {
        columns.iter().map(|column| number(*column)).collect::<std::result::Result<Vec<f64>, String>>()
    };
    let optional = |columns: &Vec<usize>| if columns.is_empty() { Ok(None) } else { list(columns).map(Some) };
    let [q, velocity, acceleration, torques] = lists;
    Ok(StateRow {
        time: time.map(number).transpose()?,
        q: list(q)?,
        velocity: optional(velocity)?,
        acceleration: optional(acceleration)?,
        torques: optional(torques)?,
    })
}
