//! A map of what a solver reaches. Main type: [`ReachMap`].

use super::ask::{Ask, Measure};
use super::grid::Grid;
use crate::solver::{Program, Unit};

/// What was found at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Entry {
    /// How many orientations have an answer that counts.
    pub reached: u32,
    /// How many answers count.
    pub answers: u32,
    /// How many orientations lie on strata that could not be derived; they count as if they had no answers.
    pub open: u32,
    /// The greatest manipulability of an answer; nought where it is not measured, or nothing is reached.
    pub best: f32,
    /// The mean, over the orientations that are reached, of the greatest manipulability of each.
    pub mean: f32,
}

/// What a solver reaches, place by place.
#[derive(Clone, Debug, PartialEq)]
pub struct ReachMap {
    /// The solver's name.
    pub solver: String,
    /// What is asked of its tip.
    pub task: String,
    /// The unit of the grid: `m`, `mm`, or nothing where a length has none.
    pub unit: String,
    /// The places.
    pub grid: Grid,
    /// How many orientations there are at each of them.
    pub orientations: usize,
    /// By what they are turned, see [`Ask::seed`].
    pub seed: Option<u64>,
    /// What was counted.
    pub measure: Measure,
    /// Whether only answers within limits were counted.
    pub limited: bool,
    /// One for each place.
    pub entries: Vec<Entry>,
}

impl ReachMap {
    /// What was found of all that is asked of a program, with so many orientations.
    ///
    /// # Panics
    /// For another number of entries than places.
    pub fn of(program: &Program, ask: &Ask, orientations: usize, entries: Vec<Entry>) -> Self {
        assert_eq!(entries.len(), ask.grid.places(), "an entry for each place");
        let tip = program.tip().filter(|tip| tip.layout().lengths() > 0);
        let unit = tip.map(|tip| program.inputs[tip.first_input].unit);
        ReachMap {
            solver: program.name.clone(),
            task: program.asked(),
            unit: unit.map_or("", Unit::symbol).to_owned(),
            grid: ask.grid,
            orientations,
            seed: ask.seed,
            measure: ask.measure,
            limited: ask.limits.is_some() || ask.measure == Measure::Limits,
            entries,
        }
    }

    /// The share of orientations that are reached at a place.
    pub fn index(&self, place: usize) -> f64 {
        f64::from(self.entries[place].reached) / self.orientations as f64
    }

    /// How many targets have an answer that counts.
    pub fn reached(&self) -> usize {
        self.entries.iter().map(|entry| entry.reached as usize).sum()
    }

    /// How many targets lie on strata that could not be derived.
    pub fn open(&self) -> usize {
        self.entries.iter().map(|entry| entry.open as usize).sum()
    }
}
