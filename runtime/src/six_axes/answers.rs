//! Solutions at a target ([`Answers`]), and the state of the search for them ([`Search`]).

use core::f64::consts::TAU;

use super::chain::Chain;
use super::rigid::Rigid;
use crate::arithmetic::Arithmetic;
use crate::tolerances::{ACCEPTANCE, MERGING};
use crate::trigonometry::wrap;

/// Maximal number of solutions that are kept while formulations are merged, and of candidates that are stored.
pub const ROOM: usize = 32;

/// A joint vector that reaches the target, or a start near a solution that was lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The joint values: angles in (-pi, pi] (rad), displacements in the unit of the target.
    pub q: [f64; 6],
    /// By joint: whether other joints compensate its motion, to first order. It may be free here, in a member of a self-motion.
    pub free: [bool; 6],
    /// Whether it is only near a solution.
    pub lost: bool,
}

impl Answer {
    const NONE: Self = Answer { q: [0.0; 6], free: [false; 6], lost: false };
}

/// The solutions at one target.
#[derive(Clone, Copy, Debug)]
pub struct Answers {
    list: [Answer; 2 * ROOM],
    count: usize,
    /// Number of formulations that were run.
    pub runs: usize,
    /// The largest residual of a candidate of the last run before polishing, relative to the length scale, or rad. `None` where that run may have missed
    /// solutions.
    pub accuracy: Option<f64>,
}

impl Answers {
    /// No solutions.
    pub const NONE: Self = Answers { list: [Answer::NONE; 2 * ROOM], count: 0, runs: 0, accuracy: None };

    /// The solutions, ascending by joint values, then the lost ones.
    #[must_use]
    pub fn as_slice(&self) -> &[Answer] {
        &self.list[..self.count]
    }

    /// Adds a solution if there is room.
    pub(super) fn push(&mut self, answer: Answer) {
        if let Some(place) = self.list.get_mut(self.count) {
            *place = answer;
            self.count += 1;
        }
    }

    pub(super) fn sort(&mut self) {
        for end in 1..self.count {
            for place in (1..=end).rev() {
                if is_sorted(&self.list[place - 1].q, &self.list[place].q) {
                    break;
                }
                self.list.swap(place - 1, place);
            }
        }
    }
}

fn is_sorted(a: &[f64; 6], b: &[f64; 6]) -> bool {
    (0..6).find(|&k| a[k] != b[k]).is_none_or(|k| a[k] < b[k])
}

/// A list of joint vectors.
pub(super) struct List {
    list: [[f64; 6]; ROOM],
    count: usize,
}

impl List {
    pub const EMPTY: Self = List { list: [[0.0; 6]; ROOM], count: 0 };

    pub fn as_slice(&self) -> &[[f64; 6]] {
        &self.list[..self.count]
    }

    /// Adds a joint vector if the list has none close to it. Angles that differ by whole turns are distinct.
    pub fn remember(&mut self, q: [f64; 6]) {
        let is_alike = |other: &[f64; 6]| is_within(other, &q, &[true; 6], MERGING.known);
        if self.count < ROOM && !self.as_slice().iter().any(is_alike) {
            self.list[self.count] = q;
            self.count += 1;
        }
    }
}

/// Distinct solutions, each with its residual.
pub(super) struct Distinct {
    list: [([f64; 6], f64); ROOM],
    pub count: usize,
}

impl Distinct {
    pub const NONE: Self = Distinct { list: [([0.0; 6], 0.0); ROOM], count: 0 };

    pub fn iter(&self) -> impl Iterator<Item = &[f64; 6]> {
        self.list[..self.count].iter().map(|(q, _)| q)
    }

    /// Adds a solution; it replaces an equal one with a larger residual.
    pub fn keep(&mut self, q: [f64; 6], residual: f64, slides: &[bool; 6]) {
        let is_same = |known: &&mut ([f64; 6], f64)| is_within(&known.0, &q, slides, MERGING.joints);
        if let Some(known) = self.list[..self.count].iter_mut().find(is_same) {
            if residual < known.1 {
                *known = (q, residual);
            }
        } else if self.count < ROOM {
            self.list[self.count] = (q, residual);
            self.count += 1;
        }
    }

    /// Replaces a member of a self-motion by an isolated solution.
    #[cold]
    fn displace(&mut self, q: [f64; 6], residual: f64, chain: &Chain) {
        let is_member = |q: &[f64; 6]| chain.free(q).contains(&true);
        if is_member(&q) || self.iter().any(|known| is_within(known, &q, &chain.slides, MERGING.joints)) {
            return;
        }
        if let Some(member) = self.list.iter_mut().find(|(known, _)| is_member(known)) {
            *member = (q, residual);
        }
    }
}

/// The state of the search at a target.
pub(super) struct Search {
    pub answers: Distinct,
    /// Candidates from which polishing failed: next to a self-motion an isolated solution may be near them.
    pub lost: List,
    /// Candidates off the real line, or from which polishing failed at a displaced target: a curve may be next to them.
    pub far: List,
    /// Whether complex solutions nearly meet, for a robot within [`Chain::within`].
    pub is_meeting: bool,
    /// Joint values near which that robot may have solutions.
    pub meeting: List,
}

impl Search {
    pub const NONE: Self = Search {
        answers: Distinct::NONE,
        lost: List::EMPTY,
        far: List::EMPTY,
        meeting: List::EMPTY,
        is_meeting: false,
    };

    /// Adds a solution. Isolated solutions replace members of self-motions, of which there may be any number.
    pub fn keep(&mut self, chain: &Chain, q: [f64; 6], residual: f64) {
        if self.answers.count < ROOM {
            self.answers.keep(q, residual, &chain.slides);
        } else {
            self.answers.displace(q, residual, chain);
        }
    }

    /// Stores a candidate from which polishing failed.
    pub fn lose(&mut self, q: [f64; 6]) {
        if q.iter().all(|value| value.is_finite()) {
            self.lost.remember(q);
        }
    }

    /// Polishes joint values from a walk along a curve, and keeps the result if it is a new solution.
    pub fn find(&mut self, chain: &Chain, mut q: [f64; 6], target: &Rigid) {
        let residual = chain.polish(&mut q, target).1;
        let q = wrapped(&q, &chain.slides);
        let is_known = self.answers.iter().any(|known| is_within(known, &q, &chain.slides, MERGING.apart));
        if residual <= ACCEPTANCE.residual && !is_known {
            self.keep(chain, q, residual);
        }
    }
}

/// The largest difference of two joint vectors; of angles, reduced to (-pi, pi].
pub(super) fn distance(a: &[f64; 6], b: &[f64; 6], slides: &[bool; 6]) -> f64 {
    (0..6).fold(0.0, |most, joint| f64::max(most, difference(a[joint] - b[joint], slides[joint])))
}

/// Whether no joint differs by more than a limit.
fn is_within(a: &[f64; 6], b: &[f64; 6], slides: &[bool; 6], limit: f64) -> bool {
    !(0..6).any(|joint| difference(a[joint] - b[joint], slides[joint]) > limit)
}

#[inline(always)]
fn difference(delta: f64, slides: bool) -> f64 {
    let turns = if slides { 0.0 } else { Arithmetic::round(delta / TAU) };
    (delta - TAU * turns).abs()
}

/// The joints with angles in (-pi, pi].
pub(super) fn wrapped(q: &[f64; 6], slides: &[bool; 6]) -> [f64; 6] {
    core::array::from_fn(|joint| if slides[joint] { q[joint] } else { wrap(q[joint]) })
}
