//! Continuation along curves on which the target is nearly reached, as next to a self-motion ([`Walk`]).
//!
//! Next to a self-motion, the isolated solutions of a target may be anywhere on the curve that remains of the self-motion. Newton steps find none of them,
//! because the Jacobian has rank five within a small error. A walk keeps the five equations that the joints influence, and follows the tangent. The residual of
//! the sixth equation changes its sign at each solution. (Steps along the tangent: E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter
//! 3.)

use core::array::from_fn;
use core::f64::consts::TAU;

use super::answers::{ROOM, Search, distance};
use super::chain::Chain;
use super::polish::EXACT;
use super::rigid::Rigid;
use super::section::Place;
use super::vector::product;
use crate::arithmetic::Arithmetic;
use crate::tolerances::SELF_MOTIONS;

/// Maximal number of steps across the curve from the start of a walk.
const ROUNDS: usize = 12;
/// Maximal number of steps across the curve from the end of a step along it.
const FEW: usize = 5;
/// Length of a step along the curve.
const STRIDE: f64 = 0.1;
/// Least length of a step, relative to `STRIDE`.
const SHORT: f64 = 0.015;
/// Maximal number of steps of a walk in one direction.
const PACES: usize = 400;
/// A curve with a residual of at most this factor times [`Chain::within`] may lead to solutions of the robot of interest.
const BESIDE: f64 = 30.0;
/// Iterations of false position between two steps.
const NARROWED: usize = 16;

/// A walk along all curves found from given joint vectors.
pub(super) struct Walk<'a> {
    chain: &'a Chain,
    target: &'a Rigid,
    /// Starts of walks; those that another walk has passed are removed.
    starts: [Option<Place>; ROOM],
    count: usize,
}

impl<'a> Walk<'a> {
    /// A walk without starts.
    pub fn new(chain: &'a Chain, target: &'a Rigid) -> Self {
        Walk { chain, target, starts: [None; ROOM], count: 0 }
    }

    /// Adds a start at `q` if there is a curve next to it.
    pub fn begin(&mut self, q: [f64; 6]) {
        if self.count < ROOM
            && let Some(place) = self.chain.settled(q, self.target, ROUNDS)
        {
            self.starts[self.count] = Some(place);
            self.count += 1;
        }
    }

    /// Follows the curves, in both directions if they are not closed, and adds solutions where the sixth equation changes its sign. If its residual is zero all
    /// along, the curve is a self-motion, and one member is added.
    pub fn run(mut self, search: &mut Search) {
        for index in 0..self.count {
            let Some(start) = self.starts[index].take() else { continue };
            let mut level = [start.section.value.abs(); 2];
            for delta in [1.0, -1.0] {
                let mut first = start;
                first.section.along = first.section.along.map(|entry| delta * entry);
                if self.leads_home(first, search, &mut level) {
                    break;
                }
            }
            if level[1] <= SELF_MOTIONS.member {
                search.find(self.chain, start.q, self.target);
            } else if self.chain.within > 0.0 && level[0] <= BESIDE * self.chain.within {
                search.meeting.remember(start.q);
            }
        }
    }

    /// Follows the curve from `home` until it closes or ends. Returns whether it closed. `level` receives the least and the largest residual.
    fn leads_home(&mut self, home: Place, search: &mut Search, level: &mut [f64; 2]) -> bool {
        let slides = &self.chain.slides;
        let (mut before, mut at, mut stride, mut is_away) = (home, home, STRIDE, false);
        for _ in 0..PACES {
            let Some(next) = self.pace(&at, &mut stride) else { return false };
            let missed = next.section.value.abs();
            *level = [f64::min(level[0], missed), f64::max(level[1], missed)];
            self.change(&at, &next, search);
            self.dip([&before, &at, &next], search);
            for start in &mut self.starts[..self.count] {
                *start = start.filter(|start| distance(&start.q, &next.q, slides) > STRIDE);
            }
            (before, at) = (at, next);
            let delta = distance(&at.q, &home.q, slides);
            is_away |= delta > 3.0 * STRIDE;
            if is_away && delta <= STRIDE && product(&at.section.along, &home.section.along) > 0.5 {
                let section = home.section.aligned(&at.section);
                self.change(&at, &Place { q: beside(&home.q, &at.q, slides), section }, search);
                return true;
            }
        }
        false
    }

    /// A step along the curve, shorter where it bends. `None` where the curve ends.
    fn pace(&self, at: &Place, stride: &mut f64) -> Option<Place> {
        while *stride >= SHORT * STRIDE {
            let ahead = between(&at.q, &at.section.along, *stride);
            if let Some(next) = self.chain.settled(ahead, self.target, FEW)
                && product(&next.section.along, &at.section.along).abs() > 0.9
                && distance(&next.q, &at.q, &self.chain.slides) <= 2.0 * *stride
            {
                *stride = f64::min(2.0 * *stride, STRIDE);
                return Some(Place { section: next.section.aligned(&at.section), ..next });
            }
            *stride *= 0.5;
        }
        None
    }

    /// Adds the solution between two places where the sixth equation has different signs, by false position (the Illinois rule: M. Dowell and P. Jarratt, BIT
    /// 11 (1971) 168-174).
    fn change(&self, a: &Place, b: &Place, search: &mut Search) {
        let (mut low, mut high) = (a.section.value, b.section.value);
        if (low <= 0.0) == (high <= 0.0) || f64::max(low.abs(), high.abs()) <= SELF_MOTIONS.member {
            return;
        }
        let (mut near, mut far, mut side) = (*a, *b, 0.0);
        for _ in 0..NARROWED {
            let delta: [f64; 6] = from_fn(|joint| far.q[joint] - near.q[joint]);
            let middle = between(&near.q, &delta, low / (low - high));
            let Some(place) = self.chain.settled(middle, self.target, FEW) else { break };
            let section = place.section.aligned(&a.section);
            if (section.value <= 0.0) == (low <= 0.0) {
                near = Place { section, ..place };
                high = if side < 0.0 { 0.5 * high } else { far.section.value };
                (low, side) = (section.value, -1.0);
            } else {
                far = Place { section, ..place };
                low = if side > 0.0 { 0.5 * low } else { near.section.value };
                (high, side) = (section.value, 1.0);
            }
            if section.value.abs() <= EXACT {
                break;
            }
        }
        let best = if near.section.value.abs() <= far.section.value.abs() { near } else { far };
        search.find(self.chain, best.q, self.target);
    }

    /// Searches for two solutions, or a double one, where the sixth equation has an extremum near zero.
    fn dip(&self, [a, b, c]: [&Place; 3], search: &mut Search) {
        let [low, least, high] = [a, b, c].map(|place| place.section.value);
        let is_dip = least.abs() < low.abs() && least.abs() < high.abs() && least.abs() > SELF_MOTIONS.member;
        if !is_dip || (low <= 0.0) != (least <= 0.0) || (high <= 0.0) != (least <= 0.0) {
            return;
        }
        let share = 0.5 * (low - high) / (low - least - least + high);
        let end = if share < 0.0 { a } else { c };
        let delta: [f64; 6] = from_fn(|joint| end.q[joint] - b.q[joint]);
        if let Some(place) = self.chain.settled(between(&b.q, &delta, share.abs()), self.target, FEW) {
            let vertex = Place { section: place.section.aligned(&b.section), ..place };
            self.change(b, &vertex, search);
            self.change(&vertex, end, search);
            search.find(self.chain, vertex.q, self.target);
        }
    }
}

/// `q` displaced by a share of `delta`.
fn between(q: &[f64; 6], delta: &[f64; 6], share: f64) -> [f64; 6] {
    from_fn(|joint| q[joint] + share * delta[joint])
}

/// `q` with its angles shifted by whole turns to be nearest to `other`.
fn beside(q: &[f64; 6], other: &[f64; 6], slides: &[bool; 6]) -> [f64; 6] {
    from_fn(|joint| {
        let delta = other[joint] - q[joint];
        let turns = if slides[joint] { 0.0 } else { Arithmetic::round(delta / TAU) };
        q[joint] + TAU * turns
    })
}
