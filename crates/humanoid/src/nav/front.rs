//! Fast marching with an untidy priority queue: the first order, RH0 (4-15), and M3R with speeds, (4-17).
//!
//! L. Yatziv, A. Bartesaghi and G. Sapiro, O(N) implementation of the fast marching algorithm, Journal of Computational
//! Physics 212 (2006). Here a cell whose time decreases is queued again, so that the result equals that of an ordered
//! queue except for rounding. No bisection is needed: an update is the root of a quadratic equation.

use super::grid::Grid;
use crate::{Result, Watch};

/// The width of a level of trial values, as a fraction of the least cost.
const WIDTH: f64 = 0.5;
/// The greatest number of levels.
const LEVELS: f64 = 4096.0;

/// The update of a cell from its neighbours.
pub(super) trait Rule {
    /// T at a place. Neighbours that are farther do not change it; NaN counts as infinite.
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64;
}

/// RH0 (4-17): the time of the nearest neighbour plus the cell's own cost.
pub(super) struct Along;

/// RH0 (4-15), with differences of the first order. Of two neighbours on one axis only the nearer counts (E. Rouy and
/// A. Tourin, SIAM Journal on Numerical Analysis 29, 1992), where (4-15) adds both.
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
        // (T - a)^2 + (T - b)^2 = cost^2. Only one neighbour counts where the other is farther than that.
        let apart = lesser((along - across).abs(), cost);
        lesser(along, across) + 0.5 * (apart + (2.0 * cost * cost - apart * apart).sqrt())
    }
}

/// A rule under which some places keep their times.
pub(super) struct Held<R> {
    pub rule: R,
    /// Whether each place keeps its time.
    pub is_held: Vec<bool>,
}

impl<R: Rule> Rule for Held<R> {
    #[inline]
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64 {
        if self.is_held[place] { f64::INFINITY } else { self.rule.arrival(grid, times, place) }
    }
}

/// The nearer neighbour in the row, and the nearer one in the column.
#[inline]
fn nearest(grid: &Grid, times: &[f64], place: usize) -> [f64; 2] {
    let [left, right, below, above] = grid.beside(place).map(|beside| times[beside]);
    [lesser(right, lesser(left, f64::INFINITY)), lesser(above, lesser(below, f64::INFINITY))]
}

/// The lesser number; the second one where the first is NaN.
#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// A trial value.
#[derive(Clone, Copy, Default)]
struct Trial {
    time: f64,
    place: u32,
}

/// Queue of trial values in levels, used in rotation.
struct Levels {
    lists: Vec<Vec<Trial>>,
    per_time: f64,
    level: u64,
    waiting: usize,
    /// The initial values of the front, the nearest last, until their level is current.
    later: Vec<Trial>,
}

impl Levels {
    fn new(grid: &Grid, mut from: Vec<Trial>) -> Self {
        from.sort_unstable_by(|a, b| b.time.total_cmp(&a.time));
        let (least, most) = grid.costs.range();
        let width = (WIDTH * least).max(2.0 * most / LEVELS);
        let count = ((most / width) as usize + 4).next_power_of_two();
        Levels { lists: vec![Vec::new(); count], per_time: width.recip(), level: 0, waiting: 0, later: from }
    }

    /// Adds a value. None exceeds the current level by more than the greatest cost.
    #[inline]
    fn add(&mut self, trial: Trial) {
        let level = self.level_of(trial.time).max(self.level);
        let turn = level as usize & (self.lists.len() - 1);
        self.lists[turn].push(trial);
        self.waiting += 1;
    }

    /// The nearest integer, read from the bits of a sum whose last bit has the value one.
    #[inline]
    fn level_of(&self, time: f64) -> u64 {
        const ONES: f64 = (1u64 << 52) as f64;
        (time * self.per_time + ONES).to_bits() - ONES.to_bits()
    }

    /// Takes all values of the lowest level; returns whether there are any.
    fn take(&mut self, batch: &mut Vec<Trial>) -> bool {
        batch.clear();
        loop {
            let turn = self.level as usize & (self.lists.len() - 1);
            if !self.lists[turn].is_empty() {
                std::mem::swap(batch, &mut self.lists[turn]);
                self.waiting -= batch.len();
                return true;
            }
            if !self.rise() {
                return false;
            }
        }
    }

    /// Moves to the next level, or to that of the initial values where the queue is empty.
    fn rise(&mut self) -> bool {
        let next = self.later.last().map(|trial| self.level_of(trial.time));
        match next {
            None if self.waiting == 0 => return false,
            Some(next) if self.waiting == 0 => self.level = next,
            _ => self.level += 1,
        }
        while let Some(trial) = self.later.pop_if(|trial| trial.time * self.per_time <= self.level as f64 + 0.5) {
            self.add(trial);
        }
        true
    }
}

/// Marches from places whose times are known, and returns the number of updates. It works level by level, with loops
/// that do not branch on data.
pub(super) fn march(grid: &Grid, rule: &impl Rule, times: &mut [f64], from: &[usize], watch: &Watch) -> Result<usize> {
    let trial = |place: &usize| Trial { time: times[*place], place: *place as u32 };
    let mut levels = Levels::new(grid, from.iter().map(trial).collect());
    let (mut batch, mut open, mut nearer) = (Vec::new(), Vec::new(), Vec::new());
    let (mut marched, mut unwatched) = (0, 0);
    while levels.take(&mut batch) {
        unwatched += batch.len();
        if unwatched > 4096 {
            watch.check()?;
            unwatched = 0;
        }
        marched += farther(grid, times, &batch, &mut open);
        approach(grid, rule, times, &open, &mut nearer);
        nearer.iter().for_each(|trial| levels.add(*trial));
    }
    Ok(marched)
}

/// Collects the neighbours of trial places that are farther than those; returns how many trial values are still
/// current.
fn farther(grid: &Grid, times: &[f64], batch: &[Trial], open: &mut Vec<u32>) -> usize {
    open.resize(4 * batch.len(), 0);
    let (mut count, mut length) = (0, 0);
    for Trial { time, place } in batch {
        let is_current = times[*place as usize] == *time;
        count += usize::from(is_current);
        for beside in grid.beside(*place as usize) {
            open[length] = beside as u32;
            // NaN compares false with everything.
            length += usize::from(is_current & (times[beside] > *time));
        }
    }
    open.truncate(length);
    count
}

/// Updates the times of places; collects those whose times decrease.
fn approach(grid: &Grid, rule: &impl Rule, times: &mut [f64], open: &[u32], nearer: &mut Vec<Trial>) {
    nearer.resize(open.len(), Trial::default());
    let mut length = 0;
    for place in open {
        let own = *place as usize;
        let (before, time) = (times[own], rule.arrival(grid, times, own));
        times[own] = lesser(time, before);
        nearer[length] = Trial { time, place: *place };
        length += usize::from(time < before);
    }
    nearer.truncate(length);
}
