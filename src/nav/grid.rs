//! A map as fields march over it. Main types: [`Grid`], [`Window`].

use std::ops::Range;

use super::map::{Cell, Map};
use crate::{Error, ErrorKind, Result};

/// A rectangle of a map's cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its columns.
    pub columns: Range<usize>,
    /// Its rows.
    pub rows: Range<usize>,
}

impl Window {
    /// All of a map.
    pub fn of(map: &Map) -> Self {
        Window { columns: 0..map.columns(), rows: 0..map.rows() }
    }

    /// So many cells to each side of a cell, as far as they are on the map.
    pub fn around(map: &Map, cell: usize, reach: usize) -> Self {
        let range = |middle: usize, most: usize| middle.saturating_sub(reach)..(middle + reach + 1).min(most);
        Window { columns: range(cell % map.columns(), map.columns()), rows: range(cell / map.columns(), map.rows()) }
    }

    /// Whether it is one of a map.
    pub(super) fn check(&self, map: &Map) -> Result<()> {
        let is_in = |range: &Range<usize>, most: usize| range.start < range.end && range.end <= most;
        if is_in(&self.columns, map.columns()) && is_in(&self.rows, map.rows()) {
            return Ok(());
        }
        let (columns, rows) = (map.columns(), map.rows());
        let text = format!(
            "columns {:?}, rows {:?}: give ranges that are not empty within 0..{columns} and 0..{rows}",
            self.columns, self.rows
        );
        Err(Error::new(ErrorKind::BadValue, text))
    }
}

/// Cells with a border around them, so that each has four neighbours.
pub(super) struct Grid {
    /// From a cell to the one above it.
    pub stride: usize,
    /// What it takes to cross a cell, `G / F`.
    pub costs: Costs,
    columns: usize,
    window: Window,
}

/// What it takes to cross the cells that are free.
pub(super) enum Costs {
    /// The same everywhere.
    Even(f64),
    /// By cell.
    Own(Vec<f64>),
}

impl Costs {
    #[inline]
    pub fn of(&self, cell: usize) -> f64 {
        match self {
            Costs::Even(cost) => *cost,
            Costs::Own(costs) => costs[cell],
        }
    }

    /// The least and the greatest one; nought is no cost.
    pub fn range(&self) -> (f64, f64) {
        match self {
            Costs::Even(cost) => (*cost, *cost),
            Costs::Own(costs) => costs.iter().filter(|cost| **cost > 0.0).fold((f64::INFINITY, 0.0), |(least, most), cost| {
                (cost.min(least), cost.max(most))
            }),
        }
    }
}

impl Grid {
    /// A window of a map.
    pub fn new(map: &Map, window: Window) -> Self {
        let mut grid = Grid {
            stride: window.columns.len() + 2,
            costs: Costs::Even(map.resolution()),
            columns: map.columns(),
            window,
        };
        if let Some(speeds) = map.speeds() {
            let cost = |speed: &f32| map.resolution() / f64::from(*speed);
            grid.costs = Costs::Own(grid.with_border(speeds, 0.0, cost));
        }
        grid
    }

    /// Where nobody has been yet: infinite, and not a number where nobody goes.
    pub fn untouched(&self, map: &Map) -> Vec<f64> {
        self.with_border(map.cells(), f64::NAN, |cell| if *cell == Cell::Free { f64::INFINITY } else { f64::NAN })
    }

    /// What stands in the map's cells, as the window has it.
    fn with_border<T>(&self, cells: &[T], border: f64, value: impl Fn(&T) -> f64) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.stride * (self.window.rows.len() + 2));
        all.resize(self.stride, border);
        for row in self.window.rows.clone() {
            all.push(border);
            all.extend(cells[row * self.columns..][self.window.columns.clone()].iter().map(&value));
            all.push(border);
        }
        all.resize(all.len() + self.stride, border);
        all
    }

    /// Where a cell of the map is in the grid; it may stand in the border.
    pub fn place(&self, cell: usize) -> usize {
        let (column, row) = (cell % self.columns, cell / self.columns);
        (row + 1 - self.window.rows.start) * self.stride + column + 1 - self.window.columns.start
    }

    /// The cells of the map in the window.
    pub fn cells(&self) -> impl Iterator<Item = usize> + '_ {
        let row = move |row: usize| self.window.columns.clone().map(move |column| row * self.columns + column);
        self.window.rows.clone().flat_map(row)
    }

    /// The neighbours of a place.
    #[inline]
    pub fn beside(&self, place: usize) -> [usize; 4] {
        [place - 1, place + 1, place - self.stride, place + self.stride]
    }

    /// What stands in the grid, cell by cell, in the same memory; infinite where nobody goes.
    pub fn without_border(&self, mut all: Vec<f64>) -> Vec<f64> {
        let (columns, rows) = (self.window.columns.len(), self.window.rows.len());
        for row in 0..rows {
            let from = (row + 1) * self.stride + 1;
            all.copy_within(from..from + columns, row * columns);
            let own = &mut all[row * columns..][..columns];
            own.iter_mut().for_each(|time| *time = if time.is_nan() { f64::INFINITY } else { *time });
        }
        all.truncate(columns * rows);
        all
    }
}
