//! A front that marches over cells in an untidy order until nothing changes: fast marching of the first order, RH0 (4-15), and M3R with speeds, (4-17).
//!
//! L. Yatziv, A. Bartesaghi and G. Sapiro, O(N) implementation of the fast marching algorithm, Journal of Computational Physics 212 (2006); here a cell that comes nearer
//! waits once more, so that the front ends where a tidy one does, to rounding. No bisection is needed: an update is the root of a quadratic equation.

use super::grid::Grid;
use crate::{Result, Watch};

/// The share of the least cost that a level of trial values is wide.
const WIDTH: f64 = 0.5;
/// The most levels.
const LEVELS: f64 = 4096.0;

/// T of a cell from its neighbours'.
pub(super) trait Rule {
    /// T there, which no neighbour that is farther changes; not a number counts as infinite.
    fn arrival(&self, grid: &Grid, times: &[f64], place: usize) -> f64;
}

/// RH0 (4-17): the nearest neighbour's and the cell's own cost.
pub(super) struct Along;

/// RH0 (4-15), by differences of the first order; of two neighbours in line the nearer one counts alone (E. Rouy and A. Tourin, SIAM Journal on Numerical Analysis 29, 1992), where
/// (4-15) adds both.
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
#[derive(Clone, Copy, Default)]
struct Trial {
    time: f64,
    place: u32,
}

/// Trial values that wait, in levels that take turns.
struct Levels {
    lists: Vec<Vec<Trial>>,
    per_time: f64,
    level: u64,
    waiting: usize,
    /// What a front starts from, the nearest last, until its level comes.
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

    /// None is more than the greatest cost beyond the level that is dealt with.
    #[inline]
    fn add(&mut self, trial: Trial) {
        let level = self.level_of(trial.time).max(self.level);
        let turn = level as usize & (self.lists.len() - 1);
        self.lists[turn].push(trial);
        self.waiting += 1;
    }

    /// The nearest whole number, read from the bits of a sum whose last one counts ones.
    #[inline]
    fn level_of(&self, time: f64) -> u64 {
        const ONES: f64 = (1u64 << 52) as f64;
        (time * self.per_time + ONES).to_bits() - ONES.to_bits()
    }

    /// Takes all that wait in the lowest level; whether there is any.
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

    /// To the next level, or to that of what is later where nothing waits.
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

/// Marches on from places whose times are known, and tells how often a cell was marched. Level by level, in steps that do not branch on what they find.
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

/// The neighbours of trial places that are farther than those; how many places did not come nearer since they began to wait.
fn farther(grid: &Grid, times: &[f64], batch: &[Trial], open: &mut Vec<u32>) -> usize {
    open.resize(4 * batch.len(), 0);
    let (mut count, mut length) = (0, 0);
    for Trial { time, place } in batch {
        let is_current = times[*place as usize] == *time;
        count += usize::from(is_current);
        for beside in grid.beside(*place as usize) {
            open[length] = beside as u32;
            // Not a number compares with nothing.
            length += usize::from(is_current & (times[beside] > *time));
        }
    }
    open.truncate(length);
    count
}

/// Brings places nearer; those that come nearer.
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
