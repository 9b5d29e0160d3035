//! Answers at a target ([`Answers`]), and what a search for them remembers ([`Search`]).

use core::f64::consts::TAU;

use super::chain::Chain;
use super::rigid::Rigid;
use crate::arithmetic::Arithmetic;
use crate::trigonometry::wrap;

/// The most answers that are kept while formulations are united, and the most candidates that are remembered.
pub const ROOM: usize = 32;
/// Answers whose joints all differ by no more than this (rad) are one.
const MERGE: f64 = 1e-7;
/// The largest residual of an answer, as a share of the length scale or in radians.
pub(super) const ACCEPT: f64 = 1e-12;
/// Candidates that are no farther than this from one that is known are not remembered again.
const ALIKE: f64 = 1e-2;
/// An answer on a curve that is no farther than this from one that is known is that one.
const APART: f64 = 1e-4;

/// A joint vector that reaches the target, or one to start from once more, near an answer that was lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The joint angles, in (-pi, pi] (rad); ways in the unit of the target.
    pub q: [f64; 6],
    /// By joint: whether others make up for it, to first order. They may be free here: one member of a self-motion.
    pub free: [bool; 6],
    /// Whether it is only near an answer.
    pub lost: bool,
}

impl Answer {
    const NONE: Self = Answer { q: [0.0; 6], free: [false; 6], lost: false };
}

/// The answers at one target.
#[derive(Clone, Copy, Debug)]
pub struct Answers {
    list: [Answer; 2 * ROOM],
    count: usize,
    /// How many formulations were run.
    pub runs: usize,
    /// The most that a candidate of the last run missed the target by before it was polished: a share of the length scale, or rad. `None` where that run
    /// cannot be trusted to have found all answers.
    pub accuracy: Option<f64>,
}

impl Answers {
    /// None.
    pub const NONE: Self = Answers { list: [Answer::NONE; 2 * ROOM], count: 0, runs: 0, accuracy: None };

    /// The answers, by ascending joints; then what was lost.
    #[must_use]
    pub fn as_slice(&self) -> &[Answer] {
        &self.list[..self.count]
    }

    /// Adds an answer if there is room.
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

    /// Adds a joint vector if none is nearly the same, turns counted.
    pub fn remember(&mut self, q: [f64; 6]) {
        let is_alike = |other: &[f64; 6]| is_within(other, &q, &[true; 6], ALIKE);
        if self.count < ROOM && !self.as_slice().iter().any(is_alike) {
            self.list[self.count] = q;
            self.count += 1;
        }
    }
}

/// Answers that differ, each with its residual.
pub(super) struct Distinct {
    list: [([f64; 6], f64); ROOM],
    pub count: usize,
}

impl Distinct {
    pub const NONE: Self = Distinct { list: [([0.0; 6], 0.0); ROOM], count: 0 };

    pub fn iter(&self) -> impl Iterator<Item = &[f64; 6]> {
        self.list[..self.count].iter().map(|(q, _)| q)
    }

    /// Adds an answer, in place of a worse equal one.
    pub fn keep(&mut self, q: [f64; 6], residual: f64, slides: &[bool; 6]) {
        let is_same = |known: &&mut ([f64; 6], f64)| is_within(&known.0, &q, slides, MERGE);
        if let Some(known) = self.list[..self.count].iter_mut().find(is_same) {
            if residual < known.1 {
                *known = (q, residual);
            }
        } else if self.count < ROOM {
            self.list[self.count] = (q, residual);
            self.count += 1;
        }
    }

    /// Takes an isolated answer in place of a member of a self-motion.
    #[cold]
    fn displace(&mut self, q: [f64; 6], residual: f64, chain: &Chain) {
        let is_member = |q: &[f64; 6]| chain.free(q).contains(&true);
        if is_member(&q) || self.iter().any(|known| is_within(known, &q, &chain.slides, MERGE)) {
            return;
        }
        if let Some(member) = self.list.iter_mut().find(|(known, _)| is_member(known)) {
            *member = (q, residual);
        }
    }
}

/// What has been found at a target.
pub(super) struct Search {
    pub answers: Distinct,
    /// Where candidates were that polishing led nowhere: next to a self-motion some isolated answer may be near them.
    pub lost: List,
    /// Candidates off the real line, or such that led to no answer, at a target aside: a curve may be next to them.
    pub far: List,
    /// Whether complex solutions nearly meet, for a robot within [`Chain::within`].
    pub is_meeting: bool,
    /// Where such a robot may have answers.
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

    /// Adds an answer; members of self-motions, of which there may be any number, give way to isolated answers.
    pub fn keep(&mut self, chain: &Chain, q: [f64; 6], residual: f64) {
        if self.answers.count < ROOM {
            self.answers.keep(q, residual, &chain.slides);
        } else {
            self.answers.displace(q, residual, chain);
        }
    }

    /// Remembers a candidate that polishing led nowhere.
    pub fn lose(&mut self, q: [f64; 6]) {
        if q.iter().all(|value| value.is_finite()) {
            self.lost.remember(q);
        }
    }

    /// Polishes joints that a walk along a curve has led to, and keeps them if they are an answer that is not known.
    pub fn find(&mut self, chain: &Chain, mut q: [f64; 6], target: &Rigid) {
        let residual = chain.polish(&mut q, target).1;
        let q = wrapped(&q, &chain.slides);
        let is_known = self.answers.iter().any(|known| is_within(known, &q, &chain.slides, APART));
        if residual <= ACCEPT && !is_known {
            self.keep(chain, q, residual);
        }
    }
}

/// The largest difference of two joint vectors, of angles by the shorter way round.
pub(super) fn distance(a: &[f64; 6], b: &[f64; 6], slides: &[bool; 6]) -> f64 {
    (0..6).fold(0.0, |most, joint| f64::max(most, difference(a[joint] - b[joint], slides[joint])))
}

/// Whether no joint differs by more than a limit.
fn is_within(a: &[f64; 6], b: &[f64; 6], slides: &[bool; 6], limit: f64) -> bool {
    !(0..6).any(|joint| difference(a[joint] - b[joint], slides[joint]) > limit)
}

#[inline(always)]
fn difference(way: f64, slides: bool) -> f64 {
    let turns = if slides { 0.0 } else { Arithmetic::round(way / TAU) };
    (way - TAU * turns).abs()
}

/// The joints with angles in (-pi, pi].
pub(super) fn wrapped(q: &[f64; 6], slides: &[bool; 6]) -> [f64; 6] {
    core::array::from_fn(|joint| if slides[joint] { q[joint] } else { wrap(q[joint]) })
}
