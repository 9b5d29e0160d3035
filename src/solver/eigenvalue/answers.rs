//! Answers at a target, and candidates that led to none. Main types: [`Answer`], [`Answers`].

use std::f64::consts::TAU;

use super::polish::{Links, Rigid};
use groebot_runtime::trigonometry::wrap;

/// The most answers that are kept while formulations are united.
pub const ROOM: usize = 32;
/// Answers whose joints all differ by no more than this (rad) are one.
pub(super) const MERGE: f64 = 1e-7;
/// The largest residual of an answer, as a share of the length scale or in radians.
pub(super) const ACCEPT: f64 = 1e-12;
/// Candidates that are no farther than this from one that is known are not remembered again.
pub(super) const ALIKE: f64 = 1e-2;
/// An answer on a curve that is no farther than this from one that is known is that one.
pub(super) const APART: f64 = 1e-4;

/// A joint vector that reaches the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The joint angles, in (-pi, pi] \[rad\]; ways in the unit of lengths.
    pub q: [f64; 6],
    /// By joint: whether others make up for it, to first order. They may be free here: one member of a self-motion.
    pub free: [bool; 6],
    /// The largest coordinate of what is missed: a share of the length scale, or radians.
    pub residual: f64,
}

/// The answers at one target.
#[derive(Clone, Debug)]
pub struct Answers {
    pub(super) list: [Answer; ROOM],
    pub(super) count: usize,
    pub(super) lost: [[f64; 6]; ROOM],
    pub(super) lost_count: usize,
    pub(super) far: [[f64; 6]; ROOM],
    pub(super) far_count: usize,
    /// How many formulations were run.
    pub runs: usize,
    /// Whether the last of them could be trusted.
    pub is_trusted: bool,
    /// The largest residual of a candidate before it was polished.
    pub start: f64,
}

impl Answers {
    /// None yet.
    pub(super) fn none() -> Self {
        let none = Answer { q: [0.0; 6], free: [false; 6], residual: 0.0 };
        let (lost, far) = ([[0.0; 6]; ROOM], [[0.0; 6]; ROOM]);
        let list = [none; ROOM];
        let (is_trusted, start) = (false, 0.0);
        Answers { list, count: 0, lost, lost_count: 0, far, far_count: 0, runs: 0, is_trusted, start }
    }

    /// The answers.
    pub fn as_slice(&self) -> &[Answer] {
        &self.list[..self.count]
    }

    /// Candidates that polishing led nowhere, at most [`ROOM`], where the runs could not be trusted: next to a self-motion some
    /// isolated answer may be near them.
    pub fn lost(&self) -> &[[f64; 6]] {
        if self.is_trusted { &[] } else { &self.lost[..self.lost_count] }
    }

    /// Remembers a candidate that polishing led nowhere.
    pub(super) fn lose(&mut self, q: [f64; 6]) {
        let is_new = !is_among(&q, &self.lost[..self.lost_count]);
        if self.lost_count < ROOM && is_new && q.iter().all(|value| value.is_finite()) {
            self.lost[self.lost_count] = q;
            self.lost_count += 1;
        }
    }

    /// Remembers a candidate off the real line, or one that led to no answer, at a target aside: a curve may be next to it.
    pub(super) fn remember(&mut self, q: [f64; 6]) {
        if self.far_count < ROOM && !is_among(&q, &self.far[..self.far_count]) {
            self.far[self.far_count] = q;
            self.far_count += 1;
        }
    }

    /// Polishes joints that a walk along a curve has led to, and keeps them if they are an answer that is not known.
    pub(super) fn find(&mut self, links: &Links, mut q: [f64; 6], target: &Rigid) {
        let residual = links.polish(&mut q, target).1;
        let q = wrapped(&q, &links.slides);
        let is_known = self.as_slice().iter().any(|known| distance(&known.q, &q, &links.slides) <= APART);
        if residual <= ACCEPT && !is_known {
            self.keep(Answer { q, free: [false; 6], residual }, &links.slides);
        }
    }

    /// Adds an answer, in place of a worse equal one.
    pub(super) fn keep(&mut self, answer: Answer, slides: &[bool; 6]) {
        for known in &mut self.list[..self.count] {
            if distance(&known.q, &answer.q, slides) <= MERGE {
                if answer.residual < known.residual {
                    *known = answer;
                }
                return;
            }
        }
        if self.count < ROOM {
            self.list[self.count] = answer;
            self.count += 1;
        }
    }
}

/// The largest difference of two joint vectors, of angles by the shorter way round.
pub(super) fn distance(a: &[f64; 6], b: &[f64; 6], slides: &[bool; 6]) -> f64 {
    let mut most = 0.0_f64;
    for joint in 0..6 {
        let way = a[joint] - b[joint];
        let turns = if slides[joint] { 0.0 } else { (way / TAU).round() };
        most = most.max((way - TAU * turns).abs());
    }
    most
}

/// Whether one of the joint vectors known is nearly `q`, turns counted.
fn is_among(q: &[f64; 6], known: &[[f64; 6]]) -> bool {
    known.iter().any(|other| distance(other, q, &[true; 6]) <= ALIKE)
}

/// The joints with angles in (-pi, pi].
pub(super) fn wrapped(q: &[f64; 6], slides: &[bool; 6]) -> [f64; 6] {
    std::array::from_fn(|joint| if slides[joint] { q[joint] } else { wrap(q[joint]) })
}
