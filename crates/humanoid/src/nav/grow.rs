//! Distance transform: the distance to the nearest obstacle, and obstacles grown by a radius.
//!
//! P. Felzenszwalb and D. Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing 8 (2012). Here
//! the distance is to the nearest point of a cell instead of its middle.

use super::map::{Cell, Map};
use crate::{Error, ErrorKind, Result};

impl Map {
    /// By cell, the distance from its middle to the nearest point of an occupied cell \[m\]. It is zero inside, and
    /// infinite where no cell is occupied.
    pub fn clearances(&self) -> Vec<f64> {
        let (columns, rows) = (self.columns(), self.rows());
        let mut squares = vec![f64::INFINITY; columns * rows];
        for (cells, squares) in self.cells().chunks_exact(columns).zip(squares.chunks_exact_mut(columns)) {
            along_row(cells, squares);
        }
        let mut envelope = Envelope::default();
        let mut column = vec![0.0; rows];
        for x in 0..columns {
            (0..rows).for_each(|y| column[y] = squares[y * columns + x]);
            envelope.build(&column);
            (0..rows).for_each(|y| squares[y * columns + x] = column[y].min(envelope.at(y as f64)));
            envelope.clear();
        }
        squares.iter().map(|square| square.sqrt() * self.resolution()).collect()
    }

    /// The map with obstacles grown by a radius \[m\]: the free cells are those where the centre of a round robot may
    /// be. The outside of the map counts as an obstacle.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a radius that is not finite or below zero.
    pub fn grown(&self, radius: f64) -> Result<Self> {
        self.keeping(&self.clearances(), radius)
    }

    /// Same as [`Map::grown`], but with known clearances.
    ///
    /// # Errors
    /// As [`Map::grown`], and when the number of clearances differs from that of cells.
    pub(crate) fn keeping(&self, clearances: &[f64], radius: f64) -> Result<Self> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if !(radius.is_finite() && radius >= 0.0) {
            return bad(format!("a radius of {radius} m: give a finite number, not below zero"));
        }
        if clearances.len() != self.cells().len() {
            return bad(format!("{} clearances for {} cells: give one each", clearances.len(), self.cells().len()));
        }
        let mut map = self.clone();
        let (columns, rows, least) = (self.columns(), self.rows(), radius / self.resolution());
        let inside = |place: usize, count: usize| (place.min(count - 1 - place) as f64 + 0.5) >= least;
        for (row, (cells, clearances)) in
            map.cells_mut().chunks_exact_mut(columns).zip(clearances.chunks_exact(columns)).enumerate()
        {
            let is_inside = inside(row, rows);
            for (column, (cell, clearance)) in cells.iter_mut().zip(clearances).enumerate() {
                if *clearance < radius || !(is_inside && inside(column, columns)) {
                    *cell = Cell::Occupied;
                }
            }
        }
        Ok(map)
    }
}

/// The squared distance from each cell's middle to the nearest side of an occupied cell in its row, in cells.
fn along_row(cells: &[Cell], squares: &mut [f64]) {
    let mut pass = |places: &mut dyn Iterator<Item = usize>| {
        let mut away = f64::INFINITY;
        for place in places {
            away = if cells[place] == Cell::Occupied { 0.0 } else { away + if away == 0.0 { 0.5 } else { 1.0 } };
            squares[place] = squares[place].min(away * away);
        }
    };
    pass(&mut (0..cells.len()));
    pass(&mut (0..cells.len()).rev());
}

/// The lower envelope of parabolas of one width.
#[derive(Default)]
struct Envelope {
    /// By parabola its apex, its height, and the start of the interval in which it is lowest.
    parabolas: Vec<(f64, f64, f64)>,
    reached: usize,
}

impl Envelope {
    /// Builds the envelope of a column of squared distances. A cell is near to an obstacle in another row by its upper
    /// and its lower side.
    fn build(&mut self, column: &[f64]) {
        let above = |side: usize| column.get(side).copied().unwrap_or(f64::INFINITY);
        for side in 0..=column.len() {
            let height = above(side).min(side.checked_sub(1).map_or(f64::INFINITY, above));
            if height.is_finite() {
                self.add(side as f64 - 0.5, height);
            }
        }
        self.reached = 0;
    }

    fn add(&mut self, apex: f64, height: f64) {
        while let Some(&(other, below, from)) = self.parabolas.last() {
            // The intersection of the two parabolas.
            let meets = ((height + apex * apex) - (below + other * other)) / (2.0 * (apex - other));
            if meets > from {
                return self.parabolas.push((apex, height, meets));
            }
            self.parabolas.pop();
        }
        self.parabolas.push((apex, height, f64::NEG_INFINITY));
    }

    /// The height at a place; calls must have ascending places.
    fn at(&mut self, place: f64) -> f64 {
        while self.parabolas.get(self.reached + 1).is_some_and(|(_, _, from)| *from <= place) {
            self.reached += 1;
        }
        self.parabolas.get(self.reached).map_or(f64::INFINITY, |(apex, height, _)| height + (place - apex).powi(2))
    }

    fn clear(&mut self) {
        self.parabolas.clear();
    }
}
