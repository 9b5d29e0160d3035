//! States of a robot as a CSV table, the input of `groebot dynamics`, `identify` and `track`. Main type:
//! [`StateTable`].

use std::path::Path;

use crate::document::{read_text, shown, unix_lines};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;

/// Maximum size of a table in bytes.
const STATES_LIMIT: u64 = limits::STATES_BYTES;
/// The lists of numbers: configuration, velocity, acceleration, torques.
const LISTS: [&str; 4] = ["q", "v", "a", "tau"];

/// States of a robot, one for each row.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StateTable {
    /// Length of a configuration.
    pub coordinates: usize,
    /// Number of its entries in numbered columns. They are followed by those of the joints in [`StateTable::joints`].
    pub numbered: usize,
    /// The joints in named columns, in the order of each list's last entries.
    pub joints: Vec<String>,
    /// The states; at least one.
    pub rows: Vec<StateRow>,
}

/// A state and other columns of the table: metres, seconds, radians, newtons.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StateRow {
    /// The time, `t`.
    pub time: Option<f64>,
    /// The configuration, `q0`.. and `q:NAME`..
    pub q: Vec<f64>,
    /// The velocity, `v0`.. and `v:NAME`..
    pub velocity: Option<Vec<f64>>,
    /// The acceleration, `a0`.. and `a:NAME`..
    pub acceleration: Option<Vec<f64>>,
    /// Torques, `tau0`.. and `tau:NAME`..
    pub torques: Option<Vec<f64>>,
}

impl StateRow {
    fn lists(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let others = [&mut self.velocity, &mut self.acceleration, &mut self.torques];
        std::iter::once(&mut self.q).chain(others.into_iter().flatten())
    }
}

impl StateTable {
    /// Reads a table from a file.
    ///
    /// # Errors
    /// Those of [`read_text`] and [`StateTable::from_csv`], with the file.
    pub fn read_csv(path: &Path) -> Result<Self> {
        StateTable::from_csv(&read_text(path, STATES_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// Reads a table from `text`: a row of names, in any order, and rows of numbers separated by commas. Empty lines
    /// are ignored.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for unknown or incomplete columns of [`StateRow`], lists with different joints, a wrong
    /// number of cells, and a cell that is not a number or is out of range; [`ErrorKind::MissingKey`] for a table
    /// without rows. With the line.
    pub fn from_csv(text: &str) -> Result<Self> {
        let text = unix_lines(text.trim_start_matches('\u{feff}'));
        let full = |(_, line): &(usize, &str)| !line.trim().is_empty();
        let mut lines = text.lines().enumerate().map(|(place, line)| (place + 1, line)).filter(full);
        let (first, head) = lines.next().unwrap_or((1, ""));
        let syntax = |text: String| Error::new(ErrorKind::Syntax, text);
        let header = Header::read(head).map_err(|text| syntax(text).at_line(first))?;
        let row = |(line, text): (usize, &str)| header.row(text).map_err(|text| syntax(text).at_line(line));
        let rows: Vec<StateRow> = lines.map(row).collect::<Result<_>>()?;
        if rows.is_empty() {
            let text = "the table has a row of names and no row of numbers; give at least one";
            return Err(Error::new(ErrorKind::MissingKey, text).at_line(first));
        }
        let Header { lists, joints, .. } = &header;
        Ok(StateTable {
            coordinates: lists[0].len(),
            numbered: lists[0].len() - joints.len(),
            joints: joints.iter().map(|name| (*name).to_owned()).collect(),
            rows,
        })
    }

    /// Sorts the named joints in this order. A table with numbered columns only is unchanged.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a joint that is not among them, [`ErrorKind::MissingKey`] for one of them that
    /// the table does not name.
    pub fn in_order_of(mut self, joints: &[String]) -> Result<Self> {
        if self.joints.is_empty() {
            return Ok(self);
        }
        let all = || joints.iter().map(|name| shown(name)).collect::<Vec<_>>().join(", ");
        if let Some(name) = self.joints.iter().find(|name| !joints.contains(name)) {
            let text = format!("column `q:{}`: the robot has no such independent joint; it has {}", shown(name), all());
            return Err(Error::new(ErrorKind::UnknownName, text));
        }
        let place = |name: &String| {
            let text = || format!("there is no column `q:{}`; give one for each of {}", shown(name), all());
            let found = self.joints.iter().position(|other| other == name);
            found.ok_or_else(|| Error::new(ErrorKind::MissingKey, text()))
        };
        let places: Vec<usize> = joints.iter().map(place).collect::<Result<_>>()?;
        for list in self.rows.iter_mut().flat_map(StateRow::lists) {
            let named = list.split_off(list.len() - places.len());
            list.extend(places.iter().map(|place| named[*place]));
        }
        self.joints = joints.to_vec();
        Ok(self)
    }
}

/// The contents of a table's columns.
struct Header<'a> {
    names: Vec<&'a str>,
    time: Option<usize>,
    /// The columns of [`LISTS`].
    lists: [Vec<usize>; 4],
    joints: Vec<&'a str>,
}

impl<'a> Header<'a> {
    fn read(head: &'a str) -> std::result::Result<Self, String> {
        let names: Vec<&str> = cells(head).collect();
        limits::check_count("columns", names.len(), limits::COLUMNS).map_err(|error| error.message().to_owned())?;
        let joints: Vec<&str> = names.iter().filter_map(|name| name.strip_prefix("q:")).collect();
        let time = names.iter().position(|name| *name == "t");
        let lists = LISTS.map(|list| columns(&names, list, &joints));
        let known = lists.iter().map(Vec::len).sum::<usize>() + usize::from(time.is_some());
        let repeats = (1..joints.len()).any(|at| joints[..at].contains(&joints[at]));
        if known != names.len() || lists[0].is_empty() || repeats {
            return Err(format!(
                "the first row is `{}`; give the names q0, q1, ..., v0, ..., a0, ... and tau0, ..., each list whole, or q:JOINT, v:JOINT and so on of the same joints, and t for a time",
                shown(head)
            ));
        }
        Ok(Header { names, time, lists, joints })
    }

    fn row(&self, text: &str) -> std::result::Result<StateRow, String> {
        let found: Vec<&str> = cells(text).collect();
        if found.len() != self.names.len() {
            return Err(format!("{} cells are in the row; the first one has {} names", found.len(), self.names.len()));
        }
        let number = |column: usize| {
            limits::number(found[column]).map_err(|fault| format!("column `{}`: {fault}", shown(self.names[column])))
        };
        let list = |columns: &Vec<usize>| {
            columns.iter().map(|column| number(*column)).collect::<std::result::Result<Vec<f64>, String>>()
        };
        let optional = |columns: &Vec<usize>| if columns.is_empty() { Ok(None) } else { list(columns).map(Some) };
        let [q, velocity, acceleration, torques] = &self.lists;
        Ok(StateRow {
            time: self.time.map(number).transpose()?,
            q: list(q)?,
            velocity: optional(velocity)?,
            acceleration: optional(acceleration)?,
            torques: optional(torques)?,
        })
    }
}

fn cells(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(str::trim)
}

/// The columns of a list: those that count from zero, and those of all joints; empty if one of these is missing.
fn columns(names: &[&str], list: &str, joints: &[&str]) -> Vec<usize> {
    let place = |name: String| names.iter().position(|other| *other == name);
    let numbered = (0..).map_while(|index| place(format!("{list}{index}"))).map(Some);
    let named = joints.iter().map(|joint| place(format!("{list}:{joint}")));
    numbered.chain(named).collect::<Option<_>>().unwrap_or_default()
}
