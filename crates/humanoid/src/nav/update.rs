//! Incremental updates of arrival-time fields: in a window around the robot, and after the map has changed. Main type:
//! [`UpdatedField`].
//!
//! Cells are raised and lowered as in A. Stentz, The focussed D* algorithm for real-time replanning (1995). Here a cell
//! counts as raised as soon as its equation does not hold.

use std::collections::VecDeque;

use super::field::{Field, Method};
use super::front::{Along, Eikonal, Held, Rule, march};
use super::grid::{Grid, Window};
use super::map::Map;
use crate::{Error, ErrorKind, Result, Watch};

/// The relative tolerance of a cell's equation.
const ROUNDING: f64 = 1e-14;

/// A field after the map has changed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct UpdatedField {
    /// The field of the changed map.
    pub field: Field,
    /// The number of cells that were computed again; a cell that was computed twice counts twice.
    pub marched: usize,
}

impl Field {
    /// Updates the field to a map with other obstacles or speeds. All cells are checked once. Those whose equation no
    /// longer holds, and those that depend on them, are computed again. Except for rounding, the result is the field
    /// that [`Field::new`] makes. A field of the second order is computed anew.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a map of another size, or a goal that is no longer free; [`Watch::check`].
    pub fn after<'w>(self, map: &Map, watch: impl Into<Option<&'w Watch>>) -> Result<UpdatedField> {
        let watch = Watch::or_none(watch);
        self.check(map)?;
        match self.method {
            Method::M3r => self.updated(map, &Along, watch),
            Method::FastMarching(1) => self.updated(map, &Eikonal, watch),
            Method::FastMarching(_) => {
                let goals: Vec<_> = self.goals.iter().map(|goal| map.centre(*goal)).collect();
                let field = Field::new(map, &goals, self.method, watch)?;
                let marched = field.times.iter().filter(|time| time.is_finite()).count();
                Ok(UpdatedField { field, marched })
            }
        }
    }

    /// Same as [`Field::after`], but computes only a window, on a map that may have changed inside it. It starts from
    /// goals inside the window and from the cells next to it; all cells outside keep their times. The cost depends on
    /// the window only.
    ///
    /// # Errors
    /// As [`Field::after`]; [`ErrorKind::BadValue`] for a window outside the map, and for the second order.
    pub fn within<'w>(self, map: &Map, window: &Window, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        self.check(map)?;
        window.check(map)?;
        match self.method {
            Method::M3r => self.inside(map, window, Along, watch),
            Method::FastMarching(1) => self.inside(map, window, Eikonal, watch),
            Method::FastMarching(_) => {
                let text = "a window needs M3R or fast marching of the first order; compute a new field";
                Err(Error::new(ErrorKind::BadValue, text))
            }
        }
    }

    fn check(&self, map: &Map) -> Result<()> {
        self.check_of(map)?;
        self.goals.iter().try_for_each(|goal| map.free_cell_at(&map.centre(*goal)).map(drop))
    }

    fn inside(mut self, map: &Map, window: &Window, rule: impl Rule, watch: &Watch) -> Result<Self> {
        let grid = Grid::new(map, window.clone());
        let (mut times, mut is_held) = (grid.untouched(map), vec![false; grid.places()]);
        for cell in window.beside(map).filter(|cell| map.is_free(*cell)) {
            times[grid.place(cell)] = self.times[cell];
        }
        grid.border().for_each(|place| is_held[place] = true);
        let rim: Vec<usize> = window.rim().map(|(column, row)| grid.place(row * self.columns + column)).collect();
        let goals: Vec<usize> =
            self.goals.iter().filter(|goal| window.holds(map, **goal)).map(|goal| grid.place(*goal)).collect();
        let mut from = first_of(&grid, &rule, &mut times, &rim);
        goals.iter().for_each(|place| times[*place] = 0.0);
        from.extend(goals);
        march(&grid, &Held { rule, is_held }, &mut times, &from, watch)?;
        for cell in grid.cells() {
            let time = times[grid.place(cell)];
            self.times[cell] = if time.is_nan() { f64::INFINITY } else { time };
        }
        Ok(self)
    }

    fn updated(mut self, map: &Map, rule: &impl Rule, watch: &Watch) -> Result<UpdatedField> {
        let grid = Grid::new(map, Window::of(map));
        let mut times = grid.untouched(map);
        grid.fill(&mut times, &self.times);
        watch.check()?;
        let Wrong { late, early } = wrong(&grid, rule, &times);
        let mut open = raise(&grid, rule, &mut times, early);
        watch.check()?;
        open.extend(late);
        let known = |place: &usize| times[*place].is_finite();
        let mut from: Vec<usize> = open.iter().flat_map(|place| grid.beside(*place)).filter(known).collect();
        from.sort_unstable();
        from.dedup();
        let marched = march(&grid, rule, &mut times, &from, watch)?;
        self.times = grid.without_border(times);
        Ok(UpdatedField { field: self, marched })
    }
}

/// Computes the times of cells that have not been reached, from their neighbours. Returns the cells that now have a
/// time.
fn first_of(grid: &Grid, rule: &impl Rule, times: &mut [f64], places: &[usize]) -> Vec<usize> {
    let open = places.iter().copied().filter(|place| times[*place] == f64::INFINITY);
    let arrivals: Vec<(usize, f64)> = open.map(|place| (place, rule.arrival(grid, times, place))).collect();
    let reached = arrivals.into_iter().filter(|(_, time)| time.is_finite());
    reached.map(|(place, time)| (times[place] = time, place).1).collect()
}

/// Cells whose equation does not hold.
struct Wrong {
    /// Cells whose times are greater than their neighbours give.
    late: Vec<usize>,
    /// Cells whose times are less than their neighbours give.
    early: VecDeque<usize>,
}

fn wrong(grid: &Grid, rule: &impl Rule, times: &[f64]) -> Wrong {
    let (mut late, mut early) = (Vec::new(), VecDeque::new());
    for place in grid.rows().flatten() {
        let time = times[place];
        // Goals and cells that are not free have no equation.
        if time > 0.0 {
            let arrival = rule.arrival(grid, times, place);
            if arrival < time * (1.0 - ROUNDING) {
                late.push(place);
            } else if arrival > time * (1.0 + ROUNDING) {
                early.push_back(place);
            }
        }
    }
    Wrong { late, early }
}

/// Removes times that are less than the neighbours give, and those that depend on them. Returns these cells.
fn raise(grid: &Grid, rule: &impl Rule, times: &mut [f64], mut early: VecDeque<usize>) -> Vec<usize> {
    let mut raised = Vec::new();
    while let Some(place) = early.pop_front() {
        let time = times[place];
        if time.is_infinite() || time == 0.0 || rule.arrival(grid, times, place) <= time * (1.0 + ROUNDING) {
            continue;
        }
        times[place] = f64::INFINITY;
        raised.push(place);
        early.extend(
            grid.beside(place).into_iter().filter(|beside| times[*beside] > time && times[*beside].is_finite()),
        );
    }
    raised
}
