//! Arrival times from each cell of a map to a goal. Main type: [`Field`].

use nalgebra::Point2;

use super::front::{Along, Eikonal, march};
use super::grid::{Grid, Window};
use super::map::Map;
use super::{marching, waves};
use crate::{Error, ErrorKind, Result, Watch};

/// The method that computes a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The thesis' modified fast marching, RH0 (4-17): `T = min(T_nb + G / F)` over four neighbours. It is the distance
    /// along rows and columns.
    M3r,
    /// Fast marching, RH0 (4-15), with upwind differences of this order, 1 or 2. Of two neighbours on one axis only the
    /// nearer counts, where (4-15) adds both.
    FastMarching(u8),
}

/// The arrival time T, RH0 (4-8), by cell: from the cell's middle to the nearest goal, with the map's speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub(super) method: Method,
    pub(super) columns: usize,
    pub(super) goals: Vec<usize>,
    pub(super) times: Vec<f64>,
}

impl Field {
    /// Computes the field of a map with goals \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no goals, a goal that is not free ([`Map::free_cell_at`]), or an order other than 1
    /// and 2; [`Watch::check`].
    pub fn new<'w>(
        map: &Map,
        goals: &[Point2<f64>],
        method: Method,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let goals: Vec<usize> = goals.iter().map(|goal| map.free_cell_at(goal)).collect::<Result<_>>()?;
        let bad = |text: &str| Err(Error::new(ErrorKind::BadValue, text));
        if goals.is_empty() {
            return bad("a field has at least one goal");
        }
        let times = match method {
            Method::M3r if map.speeds().is_none() => waves::arrivals(map, &goals, map.resolution(), watch)?,
            Method::M3r | Method::FastMarching(1 | 2) => marched(map, &goals, method, watch)?,
            Method::FastMarching(_) => return bad("fast marching has order 1 or 2"),
        };
        Ok(Field { method, columns: map.columns(), goals, times })
    }

    /// Checks that a map has as many cells.
    pub(super) fn check_of(&self, map: &Map) -> Result<()> {
        let rows = self.times.len() / self.columns;
        if (map.columns(), map.rows()) == (self.columns, rows) {
            return Ok(());
        }
        let text = format!(
            "the map has {} x {} cells, the field {} x {rows}; both must be equal",
            map.columns(),
            map.rows(),
            self.columns
        );
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The method that computed it.
    pub fn method(&self) -> Method {
        self.method
    }

    /// The cells of the goals.
    pub fn goals(&self) -> &[usize] {
        &self.goals
    }

    /// T by cell \[s, or m where the map has no speeds\]; infinite where no path leads to a goal.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The number of cells in a row.
    pub fn columns(&self) -> usize {
        self.columns
    }
}

/// T by cell, by a marching front.
fn marched(map: &Map, goals: &[usize], method: Method, watch: &Watch) -> Result<Vec<f64>> {
    let grid = Grid::new(map, Window::of(map));
    let mut times = grid.untouched(map);
    let places: Vec<usize> = goals.iter().map(|goal| grid.place(*goal)).collect();
    places.iter().for_each(|place| times[*place] = 0.0);
    match method {
        Method::M3r => march(&grid, &Along, &mut times, &places, watch).map(drop)?,
        Method::FastMarching(1) => march(&grid, &Eikonal, &mut times, &places, watch).map(drop)?,
        Method::FastMarching(_) => times = marching::arrivals(&grid, times, &places, watch)?,
    }
    Ok(grid.without_border(times))
}
