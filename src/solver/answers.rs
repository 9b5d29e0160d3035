//! From candidates to answers: each is polished, measured by the equations, and merged with those equal to it.

use serde::Serialize;

use super::angle::{angle, wrap};
use super::approach::{Approach, approached};
use super::frame::Frame;
use super::joint::JointValue;
use super::pairs::{Pairs, UsualPairs};
use super::path::Path;
use super::program::Program;
use super::refine::{self, Fit, Joints, NONE_FREE, difference};
use super::{
    ADRIFT, ALONE, APART, FARTHER, FARTHEST, LEVER, MAX_JOINTS, MERGE, MILD, NEAR, ROUNDING, STEEP, TWIN, TWINS_AT,
};
use crate::kinematics::Solution;

/// A candidate that does not solve the equations.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Nearest {
    /// Joint values in the program's joint order.
    pub q: Vec<f64>,
    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    pub residual: f64,
    /// The largest share of an equation's value in its size.
    pub relative: f64,
}

/// A solution with the largest share of an equation's value in its scale.
pub(super) struct Answer {
    pub(super) solution: Solution,
    pub(super) relative: f64,
}

/// The answers so far.
pub(super) struct Answers<'a> {
    pub(super) program: &'a Program,
    /// Holds what the equations read.
    pub(super) frame: Frame<'a>,
    pub(super) list: Vec<Answer>,
    /// How many candidates there have been.
    pub(super) candidates: usize,
    /// So many there had been with the last one that did not hold where it was found, within [`MERGE`], or was one of a self-motion's.
    unsound: usize,
    /// The candidate that missed the equations by the least share of their size.
    nearest: Option<Nearest>,
    /// The answers so far by cosines and sines, where these are asked for.
    pairs: UsualPairs,
}

impl<'a> Answers<'a> {
    pub fn new(program: &'a Program, frame: Frame<'a>, pairs: UsualPairs) -> Self {
        Answers { program, frame, list: Vec::new(), candidates: 0, unsound: 0, nearest: None, pairs }
    }

    /// The answers by cosines and sines: as they were found, or else of their angles.
    pub fn into_pairs(mut self) -> Vec<Pairs> {
        let (program, usual) = (self.program, std::mem::replace(&mut self.pairs, UsualPairs::unwanted()));
        let of_angles = || self.into_solutions().iter().map(|solution| program.pairs_of(solution)).collect();
        usual.into_list(program).unwrap_or_else(of_angles)
    }

    pub fn into_nearest(self) -> Option<Nearest> {
        self.nearest
    }

    pub fn into_solutions(mut self) -> Vec<Solution> {
        self.unite();
        self.list.into_iter().map(|answer| answer.solution).collect()
    }

    /// Where there are more isolated answers than a target can have, rounding has made several of one at a singular configuration: the
    /// nearest two are one, and the better of them stays, until there are no more than that.
    fn unite(&mut self) {
        let Some(most) = self.program.isolated else { return };
        while self.list.iter().filter(|answer| answer.is_isolated()).count() > most {
            let worse = self.doubled();
            self.list.remove(worse);
        }
    }

    /// Of the two isolated answers nearest to each other the one that holds less well, the later of equals.
    fn doubled(&self) -> usize {
        let (mut least, mut worse) = (f64::INFINITY, 0);
        for (second, b) in self.list.iter().enumerate().filter(|(_, b)| b.is_isolated()) {
            for (first, a) in self.list[..second].iter().enumerate().filter(|(_, a)| a.is_isolated()) {
                let distance = self.way(&a.solution.q, &b.solution.q);
                if distance < least {
                    (least, worse) = (distance, if a.relative > b.relative { first } else { second });
                }
            }
        }
        worse
    }

    /// Turns the unknowns into joints, polishes them, and keeps what solves the equations.
    pub fn propose(&mut self, path: &Path, unknowns: &[f64]) {
        self.frame.unknowns.copy_from_slice(unknowns);
        let mut q = [0.0; MAX_JOINTS];
        for (slot, joint) in q.iter_mut().zip(&self.program.joints) {
            *slot = joint_value(joint.value, unknowns);
        }
        self.candidates += 1;
        if path.free != NONE_FREE {
            self.unsound = self.candidates;
            self.pairs.give_up();
            return self.propose_member(path, q);
        }
        if self.program.nearby {
            if let Some(Approach { end, fit, missed, pivot }) = approached(self.program, &q, &mut self.frame) {
                self.pairs.give_up();
                self.keep(path, &end, &fit);
                if pivot < missed * if path.close { STEEP } else { MILD } {
                    self.unsound = self.candidates;
                    self.twin(path, &end, missed);
                }
                return;
            }
        } else if !path.close {
            let fit = refine::measure_unknowns(self.program, &q, &mut self.frame);
            if fit.accepted && fit.relative < ROUNDING && self.is_round(unknowns) {
                self.pairs.add(self.program, path, fit.residual, unknowns);
                return self.keep(path, &q, &fit);
            }
        }
        self.pairs.give_up();
        self.settle(path, q);
    }

    /// Whether there have been candidates behind so many, and each has held where it was found.
    pub fn suffice_since(&self, candidates: usize) -> bool {
        self.candidates > candidates && self.unsound <= candidates
    }

    /// Whether the cosines and sines of all angles are on the circle.
    fn is_round(&self, unknowns: &[f64]) -> bool {
        self.program.joints.iter().all(|joint| match joint.value {
            JointValue::Angle { cosine, sine } => {
                let (c, s) = (unknowns[cosine], unknowns[sine]);
                (c * c + s * s - 1.0).abs() < ROUNDING
            }
            JointValue::Plain(_) => true,
        })
    }

    /// Polishes a candidate and keeps it. Where two answers all but meet, it ends at one of them or at none: the points around it are
    /// tried as well.
    fn settle(&mut self, path: &Path, q: Joints) {
        let (mut end, mut fit) = (q, refine::measure(self.program, &q, &mut self.frame));
        let missed = fit.relative;
        refine::polish(self.program, &mut end, &mut fit, &NONE_FREE, &mut self.frame);
        if !(fit.accepted && fit.relative < ROUNDING && self.way(&q, &end) <= MERGE) {
            self.unsound = self.candidates;
        }
        if (ROUNDING..=NEAR).contains(&fit.relative) {
            self.around(path, &end, &fit, fit.relative);
        } else if (ROUNDING..=NEAR).contains(&missed) && self.way(&q, &end) > LEVER * missed.sqrt() {
            self.around(path, &end, &fit, missed);
            self.opposite(path, &q, &end);
        }
        if self.program.nearby && (ROUNDING..=NEAR).contains(&missed) {
            self.twin(path, &end, missed);
        }
        self.keep(path, &end, &fit);
    }

    /// The formulas of a nearby mechanism propose one double root where there are two answers next to each other, as far apart as the
    /// square root of what they miss: from beyond both, in the direction in which the equations change least, Newton steps lead to the
    /// nearer one.
    fn twin(&mut self, path: &Path, end: &Joints, missed: f64) {
        let Some((way, share)) = refine::stillest(self.program, end, &mut self.frame) else { return };
        if share > TWIN * missed.sqrt() {
            return;
        }
        for times in TWINS_AT {
            let mut start = refine::moved(self.program, end, &way.map(|way| times * missed.sqrt() * way));
            refine::unknowns_of(self.program, &start, &mut self.frame.unknowns);
            if let Some(Approach { end, fit, .. }) = approached(self.program, &start, &mut self.frame) {
                self.keep(path, &end, &fit);
            } else {
                let fit = refine::polished(self.program, &mut start, &NONE_FREE, &mut self.frame);
                self.keep(path, &start, &fit);
            }
        }
    }

    /// A candidate next to a double root stands between two answers: where one is an `end` of polishing, starts from the other side.
    fn opposite(&mut self, path: &Path, q: &Joints, end: &Joints) {
        let mut start = *q;
        for (index, joint) in self.program.joints.iter().enumerate() {
            let value = q[index] + difference(self.program, index, q, end);
            start[index] = if matches!(joint.value, JointValue::Angle { .. }) { wrap(value) } else { value };
        }
        let fit = refine::polished(self.program, &mut start, &NONE_FREE, &mut self.frame);
        self.keep(path, &start, &fit);
    }

    /// Keeps a member of a self-motion. It is moved along it only where it misses the equations by more than rounding: where the self-motion
    /// goes round a part of the circle, or where there is none and an isolated answer stands near the place.
    fn propose_member(&mut self, path: &Path, mut q: Joints) {
        let free = self.free_joints(path);
        let settles = |a: &Answer| a.is_exact() && a.solution.branch == path.branch && a.solution.free == free;
        if self.list.iter().any(settles) {
            return;
        }
        let mut fit = refine::measure(self.program, &q, &mut self.frame);
        let missed = fit.relative;
        if (ROUNDING..=ADRIFT).contains(&fit.relative) {
            refine::polish(self.program, &mut q, &mut fit, &path.free, &mut self.frame);
        }
        if !self.keep_member(path, &q, &fit) {
            fit = refine::polished(self.program, &mut q, &NONE_FREE, &mut self.frame);
            if !self.keep_member(path, &q, &fit) {
                self.keep_alone(path, &q, &fit, missed);
            }
        }
    }

    /// Keeps what a candidate for a member of a self-motion has led to: a member of another self-motion, of one joint that some case frees, or an
    /// isolated answer. One that has not been found before may have another next to it.
    fn keep_alone(&mut self, path: &Path, q: &Joints, fit: &Fit, missed: f64) {
        if fit.relative > ALONE {
            return self.miss(q, fit);
        }
        let joints = &q[..self.program.joints.len()];
        let is_listed = self.list.iter().any(|a| a.is_isolated() && self.are_near(&a.solution.q, joints, MERGE));
        let joint = if is_listed { None } else { self.joint_on_self_motion(joints, fit.relative) };
        let mut alone = *path;
        alone.free = std::array::from_fn(|other| Some(other) == joint);
        let known = self.list.len();
        self.keep(&alone, q, fit);
        if joint.is_none() && self.list.len() > known && (ROUNDING..=NEAR).contains(&missed) {
            self.around(&alone, q, fit, missed);
        }
    }

    /// Keeps a candidate if it is a member of a self-motion whose free joints are those of `path`; whether it is.
    fn keep_member(&mut self, path: &Path, q: &Joints, fit: &Fit) -> bool {
        let free = self.free_joints(path);
        let is_member = fit.accepted && self.lies_on_self_motion(&q[..self.program.joints.len()], &free, fit.relative);
        if is_member {
            self.keep(path, q, fit);
        }
        is_member
    }

    /// Where a candidate stands at a singular configuration and misses the equations by little, it is a double root that rounding
    /// made of two: starts again from points to either side of it, as far as the square root of the miss leads, and farther where that
    /// leads to no answer. Where it misses by more than an answer may, an angle that matters little, as of a point next to its axis, is
    /// moved farther too.
    fn around(&mut self, path: &Path, q: &Joints, fit: &Fit, missed: f64) {
        let weights = refine::weights(self.program, q, &mut self.frame);
        let mut is_found = fit.accepted;
        let mut farther = 1.0;
        while farther <= FARTHEST {
            for (joint, sign) in (0..self.program.joints.len()).flat_map(|joint| [(joint, -1.0), (joint, 1.0)]) {
                let mut start = *q;
                let weight = if fit.accepted { 1.0 } else { weights[joint] };
                let way = (farther * (missed / weight).sqrt()).min(APART);
                start[joint] = self.displaced(q[joint], joint, 2.0 * sign * way);
                let fit = refine::polished(self.program, &mut start, &NONE_FREE, &mut self.frame);
                is_found |= fit.accepted;
                self.keep(path, &start, &fit);
            }
            if is_found {
                return;
            }
            farther *= FARTHER;
        }
    }

    /// Remembers a candidate that is no answer if it comes nearest so far.
    fn miss(&mut self, q: &Joints, fit: &Fit) {
        let is_nearer = self.nearest.as_ref().is_none_or(|nearest| fit.relative < nearest.relative);
        if !fit.accepted && fit.relative.is_finite() && is_nearer {
            let q = q[..self.program.joints.len()].to_vec();
            self.nearest = Some(Nearest { q, residual: fit.residual, relative: fit.relative });
        }
    }

    /// Adds an answer if the equations hold, in place of a worse equal one.
    fn keep(&mut self, path: &Path, q: &Joints, fit: &Fit) {
        if !fit.accepted {
            return self.miss(q, fit);
        }
        let free = self.free_joints(path);
        let branch = self.free_branch(path, &free);
        let solution = Solution {
            q: q[..self.program.joints.len()].to_vec(),
            residual: fit.residual,
            branch,
            free,
            chosen: false,
        };
        let mut answer = Answer { solution, relative: fit.relative };
        let equal: Vec<usize> = (0..self.list.len()).filter(|&other| self.is_one(other, &answer)).collect();
        if equal.iter().any(|&other| self.list[other].holds_against(&answer)) {
            return;
        }
        if let (Some(&other), true) = (equal.first(), answer.is_isolated()) {
            answer.solution.branch = self.list[other].solution.branch;
        }
        equal.into_iter().rev().for_each(|other| drop(self.list.remove(other)));
        self.push(answer);
    }

    fn free_joints(&self, path: &Path) -> Vec<usize> {
        (0..self.program.joints.len()).filter(|&joint| path.free[joint]).collect()
    }

    /// The branch number of an answer on `path`: a second root of a double one takes the next number that is not taken.
    fn free_branch(&self, path: &Path, free: &[usize]) -> usize {
        let taken = |branch: usize| self.list.iter().any(|answer| answer.solution.branch == branch);
        let next = (path.branch..path.last).find(|&branch| !taken(branch));
        if free.is_empty() { next.unwrap_or(path.branch) } else { path.branch }
    }

    /// Adds an answer; where there are too many, the worst is left out.
    fn push(&mut self, answer: Answer) {
        self.list.push(answer);
        if self.list.len() > self.program.capacity {
            let mut worst = 0;
            for (index, answer) in self.list.iter().enumerate() {
                if answer.relative >= self.list[worst].relative {
                    worst = index;
                }
            }
            self.list.remove(worst);
        }
    }

    /// Whether the answer with this index is the same as a new one: members of one self-motion, or within [`MERGE`] with joints left
    /// out that are free in either, or one singular configuration.
    fn is_one(&mut self, other: usize, answer: &Answer) -> bool {
        let (a, b) = (&self.list[other], answer);
        let are_isolated = (a.is_isolated(), b.is_isolated());
        if self.close(&a.solution, &b.solution, MERGE) {
            return true;
        }
        match are_isolated {
            (true, true) => self.blurred(other, answer),
            (false, false) => {
                a.solution.free == b.solution.free
                    && (a.solution.branch == b.solution.branch || self.leads_to(other, &b.solution))
            }
            (true, false) => {
                b.is_exact() && self.lies_on_self_motion(&a.solution.q.clone(), &b.solution.free, ROUNDING)
            }
            (false, true) => {
                a.is_exact() && self.lies_on_self_motion(&b.solution.q, &a.solution.free.clone(), ROUNDING)
            }
        }
    }
}

impl Answer {
    fn is_isolated(&self) -> bool {
        self.solution.free.is_empty()
    }

    fn is_exact(&self) -> bool {
        self.relative <= ROUNDING
    }

    /// Whether this answer stays where `other` is equal to it: the better one does. But a self-motion that holds within rounding stays
    /// against its members, and its first member against the others.
    fn holds_against(&self, other: &Answer) -> bool {
        match (self.is_isolated(), other.is_isolated()) {
            (true, false) if other.is_exact() => false,
            (false, _) if self.is_exact() => true,
            _ => self.relative <= other.relative,
        }
    }
}

fn joint_value(value: JointValue, unknowns: &[f64]) -> f64 {
    match value {
        JointValue::Angle { cosine, sine } => angle(unknowns[cosine], unknowns[sine]),
        JointValue::Plain(unknown) => unknowns[unknown],
    }
}
