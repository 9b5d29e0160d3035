//! The grid of a map in the layout for marching. Main types: [`Grid`], [`Window`].

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
    /// The window of the whole map.
    pub fn of(map: &Map) -> Self {
        Window { columns: 0..map.columns(), rows: 0..map.rows() }
    }

    /// The window of `reach` cells to each side of a cell, clipped to the map.
    pub fn around(map: &Map, cell: usize, reach: usize) -> Self {
        let range = |middle: usize, most: usize| middle.saturating_sub(reach)..(middle + reach + 1).min(most);
        Window { columns: range(cell % map.columns(), map.columns()), rows: range(cell / map.columns(), map.rows()) }
    }

    /// Whether a cell of a map is in the window.
    pub fn holds(&self, map: &Map, cell: usize) -> bool {
        self.columns.contains(&(cell % map.columns())) && self.rows.contains(&(cell / map.columns()))
    }

    /// Its outermost cells, by column and row; those in a corner twice.
    pub(super) fn rim(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let sides = [self.columns.start, self.columns.end - 1];
        let ends = [self.rows.start, self.rows.end - 1];
        let along = self.rows.clone().flat_map(move |row| sides.map(|column| (column, row)));
        along.chain(self.columns.clone().flat_map(move |column| ends.map(|row| (column, row))))
    }

    /// The cells of a map next to the window.
    pub(super) fn beside<'a>(&'a self, map: &'a Map) -> impl Iterator<Item = usize> + 'a {
        let outside = |cell: &usize| !self.holds(map, *cell);
        self.rim().flat_map(|(column, row)| map.beside(row * map.columns() + column)).filter(outside)
    }

    /// Checks that the window is inside a map.
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
    /// The offset from a cell to the one above it.
    pub stride: usize,
    /// The cost of crossing a cell, `G / F`.
    pub costs: Costs,
    columns: usize,
    window: Window,
}

/// The costs of crossing free cells.
pub(super) enum Costs {
    /// Equal everywhere.
    Even(f64),
    /// By place, from the side of a cell and its speed.
    Own {
        /// G, the side.
        side: f64,
        /// F, the speeds.
        speeds: Vec<f32>,
    },
}

impl Costs {
    #[inline]
    pub fn of(&self, place: usize) -> f64 {
        match self {
            Costs::Even(cost) => *cost,
            Costs::Own { side, speeds } => side / f64::from(speeds[place]),
        }
    }

    /// The least and the greatest cost.
    pub fn range(&self) -> (f64, f64) {
        match self {
            Costs::Even(cost) => (*cost, *cost),
            Costs::Own { side, speeds } => {
                let (least, most) = range(speeds);
                (side / f64::from(most), side / f64::from(least))
            }
        }
    }
}

/// The least and the greatest positive number; the loop handles sixteen at a time.
fn range(speeds: &[f32]) -> (f32, f32) {
    let (mut least, mut most) = ([f32::INFINITY; 16], [0.0; 16]);
    let (rows, rest) = speeds.as_chunks::<16>();
    for row in rows.iter().map(|row| &row[..]).chain([rest]) {
        for ((least, most), speed) in least.iter_mut().zip(&mut most).zip(row) {
            // Zero is the value of the border.
            let positive = if *speed > 0.0 { *speed } else { f32::INFINITY };
            *least = if positive < *least { positive } else { *least };
            *most = if *speed > *most { *speed } else { *most };
        }
    }
    (least.into_iter().fold(f32::INFINITY, f32::min), most.into_iter().fold(0.0, f32::max))
}

impl Grid {
    /// The grid of a window of a map.
    pub fn new(map: &Map, window: Window) -> Self {
        let mut grid = Grid {
            stride: window.columns.len() + 2,
            costs: Costs::Even(map.resolution()),
            columns: map.columns(),
            window,
        };
        if let Some(speeds) = map.speeds() {
            let speeds = grid.with_border(speeds, 0.0, |speed| *speed);
            grid.costs = Costs::Own { side: map.resolution(), speeds };
        }
        grid
    }

    /// Initial times: infinite in free cells, NaN in the others.
    pub fn untouched(&self, map: &Map) -> Vec<f64> {
        self.with_border(map.cells(), f64::NAN, |cell| if *cell == Cell::Free { f64::INFINITY } else { f64::NAN })
    }

    /// The values of the map's cells in the layout of the window.
    fn with_border<T, U: Copy>(&self, cells: &[T], border: U, value: impl Fn(&T) -> U) -> Vec<U> {
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

    /// The place of a cell of the map in the grid; it may be in the border.
    pub fn place(&self, cell: usize) -> usize {
        let (column, row) = (cell % self.columns, cell / self.columns);
        (row + 1 - self.window.rows.start) * self.stride + column + 1 - self.window.columns.start
    }

    /// The number of places, including the border.
    pub fn places(&self) -> usize {
        self.stride * (self.window.rows.len() + 2)
    }

    /// The places of each row, without the border.
    pub fn rows(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        (1..=self.window.rows.len()).map(|row| row * self.stride + 1..(row + 1) * self.stride - 1)
    }

    /// The places of the border.
    pub fn border(&self) -> impl Iterator<Item = usize> + '_ {
        let last = self.places() - self.stride;
        let sides = (0..self.places()).step_by(self.stride).flat_map(|first| [first, first + self.stride - 1]);
        sides.chain(0..self.stride).chain(last..last + self.stride)
    }

    /// Sets places that have not been reached to the known times of the whole map.
    pub fn fill(&self, times: &mut [f64], known: &[f64]) {
        for (places, known) in self.rows().zip(known.chunks_exact(self.columns)) {
            let open = times[places].iter_mut().zip(known).filter(|(time, _)| **time == f64::INFINITY);
            open.for_each(|(time, known)| *time = *known);
        }
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

    /// The values of the grid by cell, in the same memory; infinite in cells that are not free.
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
