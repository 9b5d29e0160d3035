//! Reachability map of a solver. Main type: [`ReachMap`].

use super::grid::Grid;
use super::request::{Measure, Request};
use crate::solver::{Program, Unit};

/// The counts at one place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Entry {
    /// Number of orientations with a solution that counts.
    pub reached: u32,
    /// Number of solutions that count. Of a redundant arm without the value of its given joint, it is `reached`.
    pub answers: u32,
    /// Number of orientations on strata for which no derivation exists, and of those of a redundant arm at which a solution may have been missed. They count as
    /// if they had no solutions.
    pub open: u32,
    /// The greatest manipulability of a solution. Zero if it is not measured, or nothing is reached.
    pub best: f32,
    /// The mean, over the reached orientations, of the greatest manipulability at each orientation.
    pub mean: f32,
}

/// Reachability of all places.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReachMap {
    /// The solver's name.
    pub solver: String,
    /// The task of the solver.
    pub task: String,
    /// The unit of the grid: `m`, `mm`, or empty if lengths have no unit.
    pub unit: String,
    /// The places.
    pub grid: Grid,
    /// Number of orientations at each place.
    pub orientations: usize,
    /// The seed of the rotations of the orientations, see [`Request::seed`].
    pub seed: Option<u64>,
    /// The quantities that were counted.
    pub measure: Measure,
    /// Whether only solutions within joint limits were counted.
    pub limited: bool,
    /// One entry per place.
    pub entries: Vec<Entry>,
}

impl ReachMap {
    /// The map of a program with these options, number of orientations, and entries.
    ///
    /// # Panics
    /// If the number of entries is not that of the places.
    pub fn of(program: &Program, request: &Request, orientations: usize, entries: Vec<Entry>) -> Self {
        assert_eq!(entries.len(), request.grid.places(), "an entry for each place");
        let tip = program.tip().filter(|tip| tip.layout().lengths() > 0);
        let unit = tip.map(|tip| program.inputs[tip.first_input].unit);
        ReachMap {
            solver: program.name.clone(),
            task: program.task_text(),
            unit: unit.map_or("", Unit::symbol).to_owned(),
            grid: request.grid,
            orientations,
            seed: request.seed,
            measure: request.measure,
            limited: request.limits.is_some() || request.measure == Measure::Limits,
            entries,
        }
    }

    /// The share of reached orientations at a place (reachability index).
    pub fn index(&self, place: usize) -> f64 {
        f64::from(self.entries[place].reached) / self.orientations as f64
    }

    /// Number of targets with a solution that counts.
    pub fn reached(&self) -> usize {
        self.entries.iter().map(|entry| entry.reached as usize).sum()
    }

    /// Number of targets on strata for which no derivation exists, and of those of a redundant arm at which a solution may have been missed.
    pub fn open(&self) -> usize {
        self.entries.iter().map(|entry| entry.open as usize).sum()
    }
}
