//! Maps as JSON and CSV: [`ReachMap::to_json`], [`ReachMap::from_json`], [`ReachMap::to_csv`].

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use super::grid::{Axis, Grid};
use super::map::{Entry, ReachMap};
use super::poses::MOST;
use super::request::Measure;
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::JsonFormat;

const FORMAT: JsonFormat =
    JsonFormat { what: "map of a reach", oldest: 1, number: 1, renew: "`groebot reach` makes a new one" };

#[derive(Serialize, Deserialize)]
struct Written {
    format: u32,
    solver: String,
    task: String,
    unit: String,
    x: Axis,
    y: Axis,
    z: Axis,
    orientations: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    seed: Option<u64>,
    measure: String,
    limited: bool,
    reached: Vec<u32>,
    answers: Vec<u32>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    open: Vec<u32>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    best: Vec<f32>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    mean: Vec<f32>,
}

impl ReachMap {
    /// The map as JSON, with the keys `format` (1), `solver`, `task`, `unit`, `x`, `y` and `z` (axes: from, to, count), `orientations`, `seed`, `measure`,
    /// `limited`. By place, with z changing fastest: `reached`, `answers`, `open` if there are any, and `best` and `mean` if manipulability was measured.
    pub fn to_json(&self) -> String {
        let [x, y, z] = *self.grid.axes();
        let numbers = |number: fn(&Entry) -> f32| match self.measure {
            Measure::Manipulability => self.entries.iter().map(number).collect(),
            _ => Vec::new(),
        };
        let written = Written {
            format: FORMAT.number,
            solver: self.solver.clone(),
            task: self.task.clone(),
            unit: self.unit.clone(),
            x,
            y,
            z,
            orientations: self.orientations,
            seed: self.seed,
            measure: self.measure.name().to_owned(),
            limited: self.limited,
            reached: self.entries.iter().map(|entry| entry.reached).collect(),
            answers: self.entries.iter().map(|entry| entry.answers).collect(),
            open: if self.open() > 0 { self.entries.iter().map(|entry| entry.open).collect() } else { Vec::new() },
            best: numbers(|entry| entry.best),
            mean: numbers(|entry| entry.mean),
        };
        // The map contains only numbers and strings, which are always valid JSON.
        serde_json::to_string(&written).unwrap_or_default() + "\n"
    }

    /// Reads the output of [`ReachMap::to_json`].
    ///
    /// # Errors
    /// - [`ErrorKind::Syntax`] with the line number.
    /// - [`ErrorKind::Unsupported`] for another format.
    /// - [`ErrorKind::UnknownName`] for another measure.
    /// - [`ErrorKind::BadValue`] for invalid axes, columns whose length is not that of the grid, counts that exceed the orientations, and negative numbers.
    pub fn from_json(text: &str) -> Result<Self> {
        let Written {
            solver,
            task,
            unit,
            x,
            y,
            z,
            orientations,
            seed,
            measure,
            limited,
            open,
            reached,
            answers,
            best,
            mean,
            ..
        } = FORMAT.read(text)?;
        let grid = Grid::new([x, y, z])?;
        let (places, measure) = (grid.places(), Measure::of(&measure)?);
        let is_measured = measure == Measure::Manipulability;
        let lengths = [
            ("reached", reached.len(), true),
            ("answers", answers.len(), true),
            ("open", open.len(), !open.is_empty()),
            ("best", best.len(), is_measured),
            ("mean", mean.len(), is_measured),
        ];
        for (name, length, is_wanted) in lengths {
            let wanted = if is_wanted { places } else { 0 };
            if length != wanted {
                let measure = measure.name();
                let text =
                    format!("`{name}` has {length} numbers; the {places} places of a map by {measure} have {wanted}");
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        let number = |column: &[f32], place: usize| column.get(place).copied().unwrap_or(0.0);
        let entry = |place: usize| Entry {
            reached: reached[place],
            answers: answers[place],
            open: open.get(place).copied().unwrap_or(0),
            best: number(&best, place),
            mean: number(&mean, place),
        };
        let entries: Vec<Entry> = (0..places).map(entry).collect();
        if !(1..=MOST).contains(&orientations) {
            let text = format!("`orientations` is {orientations}; 1 to {MOST} are allowed");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let is_whole = |entry: &Entry| {
            u64::from(entry.reached) + u64::from(entry.open) <= orientations as u64
                && entry.reached <= entry.answers
                && [entry.best, entry.mean].iter().all(|number| *number >= 0.0)
        };
        if let Some(place) = entries.iter().position(|entry| !is_whole(entry)) {
            let text = format!("place {place}: {:?} cannot be counted of {orientations} orientations", entries[place]);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(ReachMap { solver, task, unit, grid, orientations, seed, measure, limited, entries })
    }

    /// The map as CSV with a header: `x`, `y`, `z`, `reached`, `answers`, `open`, and `best` and `mean` if manipulability was measured. There is one line per
    /// place, with z changing fastest.
    pub fn to_csv(&self) -> String {
        let is_measured = self.measure == Measure::Manipulability;
        let mut text = String::from("x,y,z,reached,answers,open");
        text += if is_measured { ",best,mean\n" } else { "\n" };
        for (place, entry) in self.entries.iter().enumerate() {
            let ([x, y, z], Entry { reached, answers, open, best, mean }) = (self.grid.at(place), entry);
            // Writing to a string cannot fail.
            let _ = write!(text, "{x},{y},{z},{reached},{answers},{open}");
            let _ = if is_measured { writeln!(text, ",{best},{mean}") } else { writeln!(text) };
        }
        text
    }
}
