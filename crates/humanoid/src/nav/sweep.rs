//! Minkowski growth: obstacles grown by an outline of fixed heading.
//!
//! T. Lozano-Perez, Spatial Planning: A Configuration Space Approach, IEEE Transactions on Computers 32 (1983): the
//! slice of the configuration space at one heading.

use nalgebra::{Point2, Vector2};

use super::map::{Cell, Map};
use super::shape::Shape;
use crate::Result;

/// Row, first and last column of the cells that an outline touches, relative to the cell of its origin.
type Runs = Vec<(isize, isize, isize)>;

impl Map {
    /// The configuration space of an outline \[m\] at a fixed anticlockwise rotation \[rad\]. A cell is occupied if the
    /// outline, with its origin in the middle of the cell, touches an occupied cell. The outside of the map counts as
    /// an obstacle. A robot of constant heading is a point on the result.
    ///
    /// # Errors
    /// As [`Shape::check`].
    pub fn grown_by(&self, outline: &Shape, yaw: f64) -> Result<Self> {
        outline.check()?;
        let runs = self.runs(outline, yaw);
        let (columns, rows) = (self.columns() as isize, self.rows() as isize);
        let before = self.counts();
        let is_hit = |x: isize, y: isize| {
            runs.iter().any(|(row, from, to)| {
                let (row, from, to) = (y + row, x + from, x + to);
                let is_off = row < 0 || row >= rows || from < 0 || to >= columns;
                // Prefix sums of the occupied cells of each row.
                is_off || {
                    let line = &before[row as usize * (columns as usize + 1)..];
                    line[to as usize + 1] > line[from as usize]
                }
            })
        };
        let mut map = self.clone();
        for (place, cell) in map.cells_mut().iter_mut().enumerate() {
            if *cell != Cell::Occupied && is_hit(place as isize % columns, place as isize / columns) {
                *cell = Cell::Occupied;
            }
        }
        Ok(map)
    }

    /// The number of occupied cells before each cell of its row, and in the whole row.
    fn counts(&self) -> Vec<u32> {
        let line = |cells: &[Cell]| {
            let mut count = 0;
            let after = cells.iter().map(move |cell| {
                count += u32::from(*cell == Cell::Occupied);
                count
            });
            [0].into_iter().chain(after).collect::<Vec<_>>()
        };
        self.cells().chunks_exact(self.columns()).flat_map(line).collect()
    }

    /// The runs of cells that an outline touches.
    fn runs(&self, outline: &Shape, yaw: f64) -> Runs {
        let (sine, cosine) = (yaw - self.yaw()).sin_cos();
        let scale = 1.0 / self.resolution();
        let placed = outline.moved(
            &|at| {
                let turned = Vector2::new(cosine * at.x - sine * at.y, sine * at.x + cosine * at.y);
                Point2::new(0.5, 0.5) + turned * scale
            },
            scale,
        );
        let (low, high) = placed.bounds();
        let mut runs: Runs = Vec::new();
        for y in low.y.floor() as isize..=high.y.floor() as isize {
            for x in low.x.floor() as isize..=high.x.floor() as isize {
                if !placed.touches(&Point2::new(x as f64, y as f64)) {
                    continue;
                }
                match runs.last_mut() {
                    Some((row, _, to)) if *row == y && *to + 1 == x => *to = x,
                    _ => runs.push((y, x, x)),
                }
            }
        }
        runs
    }
}
