//! Paths to a goal, and the proof when none exists. Main types: [`Path`], [`Enclosure`].

use nalgebra::Point2;

use super::field::Field;
use super::map::Map;
use crate::{Error, ErrorKind, Result};

/// A path over the floor, from its start to its goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Its corners \[m\].
    pub points: Vec<Point2<f64>>,
}

impl Path {
    /// Replaces the ends by points in its first and last cell \[m\].
    #[must_use]
    pub fn between(mut self, start: &Point2<f64>, goal: &Point2<f64>) -> Self {
        self.points.insert(0, *start);
        self.points.push(*goal);
        self
    }

    /// Its length \[m\].
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// A set of cells that no path leaves: it contains all free neighbours of its cells.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Enclosure {
    /// The cells, in order.
    pub cells: Vec<usize>,
}

impl Enclosure {
    /// Checks the proof: `inside` is one of the cells, `outside` is not, and no free neighbour is missing. It visits
    /// each cell once.
    pub fn parts(&self, map: &Map, inside: usize, outside: usize) -> bool {
        let mut is_in = vec![false; map.cells().len()];
        for cell in &self.cells {
            match is_in.get_mut(*cell) {
                Some(own) => *own = true,
                None => return false,
            }
        }
        let is_closed = |cell: &usize| map.beside(*cell).all(|other| is_in[other] || !map.is_free(other));
        is_in.get(inside) == Some(&true) && is_in.get(outside) == Some(&false) && self.cells.iter().all(is_closed)
    }
}

impl Map {
    /// The neighbours of a cell on the map: left, right, below, above.
    pub fn beside(&self, cell: usize) -> impl Iterator<Item = usize> {
        let (columns, count) = (self.columns(), self.cells().len());
        let column = cell % columns;
        let places = [
            (column > 0).then(|| cell - 1),
            (column + 1 < columns).then(|| cell + 1),
            cell.checked_sub(columns),
            Some(cell + columns).filter(|above| *above < count),
        ];
        places.into_iter().flatten()
    }
}

impl Field {
    /// Descends the field from a place, RH0 4.3.6, over the middles of cells. Each move is to the one of eight
    /// neighbours with the steepest slope of T, or of four where a diagonal would cut a corner. Where no path exists,
    /// returns the cells that enclose start or goals.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`]; [`ErrorKind::BadValue`] for a map with another number of cells, and where a field that
    /// was computed in a window ([`Field::within`]) does not descend further.
    pub fn descend(&self, map: &Map, start: &Point2<f64>) -> Result<std::result::Result<Path, Enclosure>> {
        self.check_of(map)?;
        let mut cell = map.free_cell_at(start)?;
        let times = self.times();
        if times[cell].is_infinite() {
            return Ok(Err(self.enclosure(map, cell)));
        }
        let mut points = vec![map.centre(cell)];
        while times[cell] > 0.0 {
            let fall = |(next, distance): &(usize, f64)| (times[cell] - times[*next]) / distance;
            let steepest = around(map, cell).max_by(|a, b| fall(a).total_cmp(&fall(b)).then(b.0.cmp(&a.0)));
            let Some((next, _)) = steepest.filter(|step| fall(step) > 0.0) else {
                let at = map.centre(cell);
                let text = format!(
                    "the field has no descent at ({:.3}, {:.3}), which is no goal; compute it anew",
                    at.x, at.y
                );
                return Err(Error::new(ErrorKind::BadValue, text));
            };
            cell = next;
            points.push(map.centre(cell));
        }
        Ok(Ok(Path { points }))
    }

    /// The cells that enclose the start, or the goals, whichever are fewer.
    fn enclosure(&self, map: &Map, start: usize) -> Enclosure {
        let reached = |time: &(usize, &f64)| time.1.is_finite();
        let goals: Vec<usize> = self.times().iter().enumerate().filter(reached).map(|(cell, _)| cell).collect();
        let mut is_in = vec![false; map.cells().len()];
        is_in[start] = true;
        let mut cells = vec![start];
        let mut next = 0;
        while next < cells.len() && cells.len() <= goals.len() {
            for other in map.beside(cells[next]) {
                if map.is_free(other) && !std::mem::replace(&mut is_in[other], true) {
                    cells.push(other);
                }
            }
            next += 1;
        }
        if next < cells.len() {
            return Enclosure { cells: goals };
        }
        cells.sort_unstable();
        Enclosure { cells }
    }
}

/// The neighbours of a cell that a straight move reaches without cutting a corner, with their distances.
pub(super) fn around(map: &Map, cell: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
    let (columns, rows) = (map.columns() as isize, map.rows() as isize);
    let (column, row) = (cell as isize % columns, cell as isize / columns);
    let free = move |x: isize, y: isize| {
        let is_on = (0..columns).contains(&x) && (0..rows).contains(&y);
        is_on.then(|| (y * columns + x) as usize).filter(|cell| map.is_free(*cell))
    };
    let steps = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (x, y))).filter(|step| *step != (0, 0));
    steps.filter_map(move |(x, y)| {
        let next = free(column + x, row + y)?;
        free(column + x, row)?;
        free(column, row + y)?;
        Some((next, f64::from((x * x + y * y) as i32).sqrt()))
    })
}
