//! A front that marches over cells in an untidy order until nothing changes: fast marching of the first order, RH0 (4-15), and M3R with speeds, (4-17).
//!
//! L. Yatziv, A. Bartesaghi and G. Sapiro, O(N) implementation of the fast marching algorithm, Journal of Computational Physics 212 (2006); here a cell that comes nearer
//! waits once more, so that the front ends where a tidy one does, to rounding. No bisection is needed: an update is the root of a quadratic equation.

use super::grid::Grid;
use crate::{Result, Watch};

/// The share of the least cost that a level of trial values is wide.
const WIDTH: f64 = 0.25;
/// The most levels.
const LEVELS: f64 = 4096.0;

/// T of a cell from its neighbours'.
pub(super) trait Rule {
    /// T there, which no neighbour that is farther changes; not a number counts as infinite.
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64;
}

/// RH0 (4-17): the nearest neighbour's and the cell's own cost.
pub(super) struct Along;

/// RH0 (4-15), by differences of the first order.
pub(super) struct Eikonal;

impl Rule for Along {
    #[inline]
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64 {
        let [along, across] = nearest(grid, times, place);
        lesser(along, across) + grid.costs.of(place)
    }
}

impl Rule for Eikonal {
    #[inline]
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64 {
        let [along, across] = nearest(grid, times, place);
        let cost = grid.costs.of(place);
        // (T - a)^2 + (T - b)^2 = cost^2; with one neighbour alone where the other one is farther than that.
        let apart = lesser((along - across).abs(), cost);
        lesser(along, across) + 0.5 * (apart + (2.0 * cost * cost - apart * apart).sqrt())
    }
}

/// A rule under which some places keep their times.
pub(super) struct Held<R> {
    pub rule: R,
    /// By place.
    pub is_held: Vec<bool>,
}

impl<R: Rule> Rule for Held<R> {
    #[inline]
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64 {
        if self.is_held[place] { f64::INFINITY } else { self.rule.arrival(grid, times, place) }
    }
}

/// The nearer one of the neighbours in the row, and of those in the column.
#[inline]
fn nearest(grid: &Grid, times: &[f64], place: usize) -> [f64; 2] {
    let [left, right, below, above] = grid.beside(place).map(|beside| times[beside]);
    [lesser(right, lesser(left, f64::INFINITY)), lesser(above, lesser(below, f64::INFINITY))]
}

/// The lesser one; the second one where the first is not a number.
#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// A trial value.
#[derive(Clone, Copy)]
struct Trial {
    time: f64,
    place: u32,
}

/// Trial values that wait, in levels that take turns.
struct Levels {
    lists: Vec<Vec<Trial>>,
    per_time: f64,
    level: usize,
    waiting: usize,
}

impl Levels {
    fn new(grid: &Grid, first: f64) -> Self {
        let (least, most) = grid.costs.range();
        let width = (WIDTH * least).max(2.0 * most / LEVELS);
        let count = ((most / width) as usize + 2).next_power_of_two();
        Levels { lists: vec![Vec::new(); count], per_time: width.recip(), level: (first / width) as usize, waiting: 0 }
    }

    /// A value that is too far for all levels waits in the last one.
    #[inline]
    fn add(&mut self, trial: Trial) {
        let count = self.lists.len();
        let level = self.level_of(trial.time).clamp(self.level, self.level + count - 1);
        self.lists[level & (count - 1)].push(trial);
        self.waiting += 1;
    }

    #[inline]
    fn level_of(&self, time: f64) -> usize {
        (time * self.per_time) as usize
    }

    /// One of the lowest.
    #[inline]
    fn next(&mut self) -> Option<Trial> {
        while self.waiting > 0 {
            let own = self.level & (self.lists.len() - 1);
            let Some(trial) = self.lists[own].pop() else {
                self.level += 1;
                continue;
            };
            self.waiting -= 1;
            if self.level_of(trial.time) <= self.level {
                return Some(trial);
            }
            self.add(trial);
        }
        None
    }
}

/// Marches on from places whose times are known, and tells how often a cell was marched.
pub(super) fn march(grid: &Grid, rule: &impl Rule, times: &mut [f64], from: &[usize], watch: &Watch) -> Result<usize> {
    let first = from.iter().map(|place| times[*place]).fold(f64::INFINITY, f64::min);
    let mut levels = Levels::new(grid, first);
    from.iter().for_each(|place| levels.add(Trial { time: times[*place], place: *place as u32 }));
    let mut count = 0usize;
    while let Some(Trial { time, place }) = levels.next() {
        let place = place as usize;
        // It came nearer since.
        if times[place] != time {
            continue;
        }
        count += 1;
        if count.is_multiple_of(4096) {
            watch.check()?;
        }
        for beside in grid.beside(place) {
            // Not a number compares with nothing.
            if times[beside] > time {
                let time = rule.arrival(grid, times, beside);
                if time < times[beside] {
                    times[beside] = time;
                    levels.add(Trial { time, place: beside as u32 });
                }
            }
        }
    }
    Ok(count)
}
