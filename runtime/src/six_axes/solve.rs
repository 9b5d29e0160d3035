//! The solver: formulations are tried in turn until one is reliable ([`Chain::solve`]).

use super::answers::{Answer, Answers, Distinct, List, Search, wrapped};
use super::candidates::{Candidate, Candidates};
use super::chain::Chain;
use super::curve::Walk;
use super::rigid::{Rigid, aside};
use crate::arithmetic::Arithmetic;
use crate::tolerances::{ACCEPTANCE, EIGENVALUES, PIVOTS};

/// Bound on the squared depth of a complex eigenvalue that may be a double root, relative to the accuracy of the eigenvalues.
const OFF: f64 = 1e3;
/// Bound on the squared depth of a complex eigenvalue that is tried, relative to that accuracy.
const FAR_OFF: f64 = 1e7;
/// An upper bound on the depth of all eigenvalues.
const DEEPEST: f64 = 1.0;
/// Displacements of targets at which complex solutions nearly meet, for a robot within a tolerance. They are relative to that tolerance, alternately in both
/// directions.
const MEETINGS: [f64; 4] = [30.0, 30.0, 1e3, 1e3];
/// Maximal number of stages in which a candidate at a displaced target is moved to the target.
const STAGES: usize = 20;

/// A target, and its displaced copy for one attempt.
struct Attempt<'a> {
    chain: &'a Chain,
    number: usize,
    /// Size of the displacement.
    size: f64,
    /// The rigid motion from the tip's pose at zero to the target.
    goal: &'a Rigid,
    /// The frame of the last joint at the target.
    target: &'a Rigid,
    /// The frame of the last joint at the displaced target.
    near: Rigid,
    /// The joint whose line is used.
    missing: usize,
}

/// The result of an attempt.
struct Tally {
    /// The solutions of this attempt alone, which are needed after the first attempt.
    own: Distinct,
    /// Number of candidates from which polishing failed.
    lost: usize,
    /// The largest residual of a candidate before polishing.
    worst: f64,
}

impl Chain {
    /// All joint values that reach a target: a position, and a rotation matrix by rows.
    #[must_use]
    pub fn solve(&self, target: &[f64; 12]) -> Answers {
        self.attempts(target, &EIGENVALUES.aside)
    }

    /// The solutions that the first formulation alone finds.
    #[must_use]
    pub fn attempt(&self, target: &[f64; 12]) -> Answers {
        self.attempts(target, &EIGENVALUES.aside[..1])
    }

    #[inline(always)]
    fn attempts(&self, target: &[f64; 12], disturbances: &[f64]) -> Answers {
        let goal = self.displacement(target);
        let target = goal.after(&self.last);
        let mut search = Search::NONE;
        let (runs, accuracy) = self.search(&goal, &target, disturbances, &mut search);
        if runs > 1 {
            self.walk(&target, &mut search);
        }
        if search.is_meeting {
            self.meet(&goal, &target, &mut search);
        }
        // The first run shows a reliable result only where there is no self-motion.
        self.collected(&search, runs, accuracy)
    }

    /// Runs formulations until one is reliable. Returns their number and [`Answers::accuracy`] of the last one. Lost candidates are then removed.
    fn search(&self, goal: &Rigid, target: &Rigid, disturbances: &[f64], search: &mut Search) -> (usize, Option<f64>) {
        // Each formulation runs once at the target itself: a repetition would have the same result.
        let is_new = |(number, size): &(usize, &f64)| **size > 0.0 || *number < self.formulations.as_slice().len();
        for (number, &size) in disturbances.iter().enumerate().filter(is_new) {
            // One run at a displaced target shows too few of the solutions nearby.
            let is_first_aside = size > 0.0 && EIGENVALUES.aside[number - 1] == 0.0;
            if is_first_aside {
                search.lost = List::EMPTY;
            }
            let displacement = aside(size, number).after(goal);
            let missing = self.formulations.of(number).joint(3);
            let near = displacement.after(&self.last);
            let attempt = Attempt { chain: self, number, size, goal, target, near, missing };
            let accuracy = attempt.run(&displacement, search).filter(|_| !is_first_aside);
            if accuracy.is_some() {
                search.lost = List::EMPTY;
                return (number + 1, accuracy);
            }
        }
        (disturbances.len(), None)
    }

    /// The squared depth of complex solutions that may be real for a robot within the tolerance.
    fn parted(&self) -> f64 {
        f64::max(OFF * self.within, f64::min(FAR_OFF * self.within, EIGENVALUES.blurred * EIGENVALUES.blurred))
    }

    /// Solves targets next to this one, on both sides: on one of them two complex solutions are real. Those that lead to no solution here are near one of the
    /// robot of interest.
    #[cold]
    fn meet(&self, goal: &Rigid, target: &Rigid, search: &mut Search) {
        for (k, times) in MEETINGS.iter().enumerate() {
            let number = k % 2;
            let displacement = aside(times * self.within, number).after(goal);
            let near = displacement.after(&self.last);
            let missing = self.formulations.of(number).joint(3);
            let Some(candidates) = Candidates::new(self, &displacement, number, 0.0) else { continue };
            for candidate in candidates.as_slice() {
                let mut q = candidate.q;
                q[missing] = self.closing(&q, missing, &near);
                let is_found = self.polish(&mut q, &near).1 <= ACCEPTANCE.residual;
                if is_found && self.polish(&mut q, target).1 > ACCEPTANCE.residual {
                    search.meeting.remember(q);
                }
            }
        }
    }

    /// Follows the curves next to solutions, and next to candidates from which polishing failed.
    fn walk(&self, target: &Rigid, search: &mut Search) {
        let mut walk = Walk::new(self, target);
        for q in search.answers.iter() {
            if self.section(q, target).is_some_and(|section| section.is_near()) {
                walk.begin(*q);
            }
        }
        search.far.as_slice().iter().chain(search.lost.as_slice()).for_each(|q| walk.begin(*q));
        walk.run(search);
    }

    /// The solutions, in the unit of the target.
    fn collected(&self, search: &Search, runs: usize, accuracy: Option<f64>) -> Answers {
        let mut answers = Answers::NONE;
        (answers.runs, answers.accuracy) = (runs, accuracy);
        for q in search.answers.iter() {
            let free = if runs == 1 { [false; 6] } else { self.free(q) };
            answers.push(Answer { q: self.scaled(q, self.length), free, lost: false });
        }
        answers.sort();
        for q in search.lost.as_slice().iter().chain(search.meeting.as_slice()) {
            answers.push(Answer { q: self.scaled(q, self.length), free: [false; 6], lost: true });
        }
        answers
    }
}

impl Attempt<'_> {
    /// Adds the solutions of one formulation. Returns its [`Answers::accuracy`].
    fn run(&self, displacement: &Rigid, search: &mut Search) -> Option<f64> {
        let known = search.answers.count;
        let blurred = f64::max(EIGENVALUES.blurred, Arithmetic::sqrt(OFF * self.chain.within));
        let deepest = if self.size > 0.0 { DEEPEST } else { blurred };
        let candidates = Candidates::new(self.chain, displacement, self.number, deepest)?;
        if candidates.conditioning < PIVOTS.singular {
            return None;
        }
        search.is_meeting |= candidates.conditioning < self.chain.within;
        let mut tally = Tally { own: Distinct::NONE, lost: 0, worst: 0.0 };
        for candidate in candidates.as_slice() {
            self.follow(candidate, search, &mut tally);
        }
        let count = search.answers.count;
        let is_unreachable = candidates.as_slice().is_empty() && candidates.conditioning >= PIVOTS.regular;
        let is_clear = tally.lost == 0 && count.is_multiple_of(2) && !candidates.is_crowded;
        let is_clear = is_clear && (count > 0 || is_unreachable);
        let nothing_lost = search.lost.as_slice().is_empty();
        let is_confirmed = self.number > 0 && known == count && tally.own.count == count && nothing_lost;
        let is_sound = tally.worst <= ACCEPTANCE.unsettled;
        let is_trusted = is_clear && (is_confirmed || is_sound && (self.size == 0.0 || nothing_lost));
        is_trusted.then_some(tally.worst)
    }

    /// Polishes a candidate, and keeps or stores it.
    fn follow(&self, candidate: &Candidate, search: &mut Search, tally: &mut Tally) {
        let (deep, accuracy) = (candidate.depth * candidate.depth, f64::max(tally.worst, EIGENVALUES.accuracy));
        let is_far = deep > FAR_OFF * accuracy;
        search.is_meeting |= self.size <= 0.0 && deep > 0.0 && deep <= self.chain.parted();
        if (is_far && self.size <= 0.0) || self.chain.has_infinite(&candidate.q) {
            return;
        }
        let mut q = candidate.q;
        q[self.missing] = self.chain.closing(&q, self.missing, &self.near);
        let first = q;
        if is_far {
            search.far.remember(first);
            return;
        }
        let (start, mut residual) = self.chain.polish(&mut q, &self.near);
        let mut last = q;
        if self.size > 0.0 {
            (q, last, residual) = self.brought(q);
        }
        if self.size > 0.0 && (residual > ACCEPTANCE.residual || candidate.depth > 0.0) {
            search.far.remember(first);
        }
        if residual <= ACCEPTANCE.residual {
            tally.worst = if candidate.depth == 0.0 { f64::max(tally.worst, start) } else { tally.worst };
            let q = wrapped(&q, &self.chain.slides);
            search.keep(self.chain, q, residual);
            if self.number > 0 {
                tally.own.keep(q, residual, &self.chain.slides);
            }
        } else if deep <= OFF * accuracy {
            tally.lost += 1;
            search.lose(last);
        }
    }

    /// Moves joint values from the displaced target to the target, at once or in stages. Returns the last joint values that were reached, and the residual.
    fn brought(&self, near: [f64; 6]) -> ([f64; 6], [f64; 6], f64) {
        let mut q = near;
        let residual = self.chain.polish(&mut q, self.target).1;
        if residual <= ACCEPTANCE.residual {
            return (q, near, residual);
        }
        q = near;
        let (last, residual) = self.led(&mut q);
        (q, last, residual)
    }

    /// Moves joint values from the displaced target to the target in stages, each at a quarter of the distance of the one before. Next to a self-motion the
    /// curvature grows with the inverse distance from it, and steps must be shorter. Returns the joint values of the last stage that succeeded, and the
    /// residual at the target.
    fn led(&self, q: &mut [f64; 6]) -> ([f64; 6], f64) {
        let (mut last, mut residual, mut size) = (*q, 1.0, self.size);
        for stage in 0..STAGES {
            size = if stage + 1 < STAGES { 0.25 * size } else { 0.0 };
            let target = aside(size, self.number).after(self.goal).after(&self.chain.last);
            residual = self.chain.polish(q, &target).1;
            if residual > ACCEPTANCE.residual {
                break;
            }
            last = *q;
        }
        (last, residual)
    }
}
