//! A map as fields march over it. Main type: [`Grid`].

use super::map::{Cell, Map};

/// A map with a border of obstacles, so that each cell has four neighbours.
pub(super) struct Grid {
    /// From a cell to the one above it.
    pub stride: usize,
    columns: usize,
    /// What it takes to cross a cell, `G / F`; infinite where nobody goes.
    pub costs: Costs,
    /// Where nobody has been yet: infinite, and not a number where nobody goes.
    pub untouched: Vec<f64>,
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
}

impl Grid {
    /// That of a map.
    pub fn new(map: &Map) -> Self {
        let (columns, rows, stride) = (map.columns(), map.rows(), map.columns() + 2);
        let mut untouched = vec![f64::NAN; stride * (rows + 2)];
        for (row, cells) in map.cells().chunks_exact(columns).enumerate() {
            let own = &mut untouched[(row + 1) * stride + 1..][..columns];
            for (time, cell) in own.iter_mut().zip(cells) {
                if *cell == Cell::Free {
                    *time = f64::INFINITY;
                }
            }
        }
        let costs = map.speeds().map_or(Costs::Even(map.resolution()), |speeds| {
            let mut costs = vec![f64::INFINITY; untouched.len()];
            for (row, speeds) in speeds.chunks_exact(columns).enumerate() {
                let own = &mut costs[(row + 1) * stride + 1..][..columns];
                own.iter_mut().zip(speeds).for_each(|(cost, speed)| *cost = map.resolution() / f64::from(*speed));
            }
            Costs::Own(costs)
        });
        Grid { stride, columns, costs, untouched }
    }

    /// Where a cell of the map is in the grid.
    pub fn place(&self, cell: usize) -> usize {
        (cell / self.columns + 1) * self.stride + cell % self.columns + 1
    }

    /// What stands in the grid, cell by cell of the map; infinite where nobody goes.
    pub fn without_border(&self, all: &[f64]) -> Vec<f64> {
        let rows = all.chunks_exact(self.stride).skip(1);
        let rows = rows.take(all.len() / self.stride - 2);
        let known = |time: &f64| if time.is_nan() { f64::INFINITY } else { *time };
        rows.flat_map(|row| row[1..=self.columns].iter().map(known)).collect()
    }
}
