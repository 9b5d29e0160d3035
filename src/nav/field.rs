//! How long it takes from each place of a map to a goal. Main type: [`Field`].

use nalgebra::Point2;

use super::grid::Grid;
use super::map::Map;
use super::{marching, waves};
use crate::{Error, ErrorKind, Result, Watch};

/// How a field is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The thesis' modified fast marching, RH0 (4-17): `T = min(T_nb + G / F)` over four neighbours. It is the distance along rows and columns.
    M3r,
    /// Fast marching, RH0 (4-15), by differences of this order, 1 or 2, in upwind direction.
    FastMarching(u8),
}

/// The time of arrival T, RH0 (4-8), by cell: from its middle to the nearest goal, where one gets on with the map's speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    method: Method,
    columns: usize,
    goals: Vec<usize>,
    times: Vec<f64>,
}

impl Field {
    /// That of a map with goals \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no goals, a goal that is not free ([`Map::free_cell_at`]), another order than 1 and 2; [`Watch::check`].
    pub fn new(map: &Map, goals: &[Point2<f64>], method: Method, watch: &Watch) -> Result<Self> {
        let bad = |text: &str| Err(Error::new(ErrorKind::BadValue, text));
        let goals: Vec<usize> = goals.iter().map(|goal| map.free_cell_at(goal)).collect::<Result<_>>()?;
        if goals.is_empty() {
            return bad("a field has at least one goal");
        }
        let grid = Grid::new(map);
        let times = match method {
            Method::M3r => waves::arrivals(&grid, &goals, watch)?,
            Method::FastMarching(order @ 1..=2) => marching::arrivals(&grid, &goals, order == 2, watch)?,
            Method::FastMarching(_) => return bad("fast marching has order 1 or 2"),
        };
        Ok(Field { method, columns: map.columns(), goals, times: grid.without_border(&times) })
    }

    /// How it was made.
    pub fn method(&self) -> Method {
        self.method
    }

    /// The cells of the goals.
    pub fn goals(&self) -> &[usize] {
        &self.goals
    }

    /// T by cell \[s, or m where no speeds are told\], infinite where no way leads to a goal.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// How many cells a row has.
    pub fn columns(&self) -> usize {
        self.columns
    }
}
