//! The solver: formulations in turn until one can be trusted ([`Chain::solve`]).

use super::answers::{ACCEPT, Answer, Answers, Distinct, List, Search, wrapped};
use super::candidates::{Candidate, Candidates};
use super::chain::Chain;
use super::curve::Walk;
use super::rigid::{Rigid, aside};
use crate::arithmetic::Arithmetic;

/// The share of a pivot below which another formulation is asked too.
const SOUND: f64 = 1e-11;
/// The share of a pivot below which the pencil is singular: every number is an eigenvalue, and those that are found say nothing.
const SINGULAR: f64 = 1e-13;
/// The share of a pivot at which a target without real eigenvalues is out of reach.
const CLEAR: f64 = 1e-6;
/// A candidate that misses the target by more before polishing shows that the eigenvalues are not accurate.
const ACCURATE: f64 = 1e-6;
/// What stands in for the accuracy of the eigenvalues when it is better than that.
const UNKNOWN: f64 = 1e-11;
/// The square of a complex eigenvalue's depth as a multiple of the eigenvalues' accuracy: below it, it may be a double root.
const OFF: f64 = 1e3;
/// Below it, it is tried.
const FAR_OFF: f64 = 1e7;
/// A complex pair that is farther off the real line is no double root that rounding has parted.
const BLURRED: f64 = 1e-2;
/// More than any eigenvalue is off the real line.
const DEEPEST: f64 = 1.0;
/// By attempt, how far aside the target is put: where solutions share a hidden angle, or a self-motion stands at the same target, the eigenvectors of
/// isolated ones are only found next to it.
const DISTURBANCES: [f64; 10] = [0.0, 0.0, 0.0, 0.0, 1e-4, 1e-4, 1e-3, 1e-3, 1e-2, 1e-2];
/// Targets next to one where complex solutions nearly meet, for a robot that is a little off: how many times as far as that robot is off, in turn to one
/// side and the other.
const MEETINGS: [f64; 4] = [30.0, 30.0, 1e3, 1e3];
/// Stages in which a candidate next to the target is led to it.
const STAGES: usize = 20;

/// A target, and where it is put aside for one attempt.
struct Attempt<'a> {
    chain: &'a Chain,
    number: usize,
    /// How far aside.
    size: f64,
    /// What takes the tip from its place at zero to the target.
    goal: &'a Rigid,
    /// The frame of the last joint at the target.
    target: &'a Rigid,
    /// The same at the target aside.
    near: Rigid,
    /// The joint whose line is used.
    missing: usize,
}

/// What an attempt has come to.
struct Tally {
    /// Its own answers, which are of interest behind the first attempt.
    own: Distinct,
    /// How many candidates led nowhere.
    lost: usize,
    /// The most that a candidate missed the target by before it was polished.
    worst: f64,
}

impl Chain {
    /// All joint values that reach a target: a position, and a rotation matrix by rows.
    #[must_use]
    pub fn solve(&self, target: &[f64; 12]) -> Answers {
        self.attempts(target, &DISTURBANCES)
    }

    /// What the first formulation alone finds.
    #[must_use]
    pub fn attempt(&self, target: &[f64; 12]) -> Answers {
        self.attempts(target, &DISTURBANCES[..1])
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
        // A run that can be trusted at once has seen no self-motion.
        self.told(&search, runs, accuracy)
    }

    /// Runs formulations until one can be trusted: their number, and its [`Answers::accuracy`]. What was lost is forgotten then.
    fn search(&self, goal: &Rigid, target: &Rigid, disturbances: &[f64], search: &mut Search) -> (usize, Option<f64>) {
        // Each formulation once at the target: again it would only confirm itself.
        let is_new = |(number, size): &(usize, &f64)| **size > 0.0 || *number < self.formulations.as_slice().len();
        for (number, &size) in disturbances.iter().enumerate().filter(is_new) {
            // One run aside shows too little of what may be beside it.
            let is_first_aside = size > 0.0 && DISTURBANCES[number - 1] == 0.0;
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

    /// The square of the depth of complex solutions that may be real for a robot that is a little off.
    fn parted(&self) -> f64 {
        f64::max(OFF * self.within, f64::min(FAR_OFF * self.within, BLURRED * BLURRED))
    }

    /// Solves targets next to this one, on both sides: two complex solutions are real there on one. Those that lead to no answer come near one of
    /// the robot that is meant.
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
                let is_found = self.polish(&mut q, &near).1 <= ACCEPT;
                if is_found && self.polish(&mut q, target).1 > ACCEPT {
                    search.meeting.remember(q);
                }
            }
        }
    }

    /// Walks along the curves next to answers, and to candidates that led to none.
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

    /// What was found, in the unit of the target.
    fn told(&self, search: &Search, runs: usize, accuracy: Option<f64>) -> Answers {
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
    /// Adds the answers of one formulation; its [`Answers::accuracy`].
    fn run(&self, displacement: &Rigid, search: &mut Search) -> Option<f64> {
        let known = search.answers.count;
        let blurred = f64::max(BLURRED, Arithmetic::sqrt(OFF * self.chain.within));
        let deepest = if self.size > 0.0 { DEEPEST } else { blurred };
        let candidates = Candidates::new(self.chain, displacement, self.number, deepest)?;
        if candidates.conditioning < SINGULAR {
            return None;
        }
        search.is_meeting |= candidates.conditioning < self.chain.within;
        let mut tally = Tally { own: Distinct::NONE, lost: 0, worst: 0.0 };
        for candidate in candidates.as_slice() {
            self.follow(candidate, search, &mut tally);
        }
        let count = search.answers.count;
        let is_unreachable = candidates.as_slice().is_empty() && candidates.conditioning >= CLEAR;
        let is_clear = tally.lost == 0 && count.is_multiple_of(2) && !candidates.is_crowded;
        let is_clear = is_clear && (count > 0 || is_unreachable);
        let nothing_lost = search.lost.as_slice().is_empty();
        let is_confirmed = self.number > 0 && known == count && tally.own.count == count && nothing_lost;
        let is_sound = tally.worst <= ACCURATE && candidates.conditioning >= SOUND;
        let is_trusted = is_clear && (is_confirmed || is_sound && (self.size == 0.0 || nothing_lost));
        is_trusted.then_some(tally.worst)
    }

    /// Polishes a candidate, and keeps or remembers it.
    fn follow(&self, candidate: &Candidate, search: &mut Search, tally: &mut Tally) {
        let (deep, accuracy) = (candidate.depth * candidate.depth, f64::max(tally.worst, UNKNOWN));
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
        if self.size > 0.0 && (residual > ACCEPT || candidate.depth > 0.0) {
            search.far.remember(first);
        }
        if residual <= ACCEPT {
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

    /// Joints that reach the target aside brought to the target: at once, or in stages; the last ones that were reached, and the residual.
    fn brought(&self, near: [f64; 6]) -> ([f64; 6], [f64; 6], f64) {
        let mut q = near;
        let residual = self.chain.polish(&mut q, self.target).1;
        if residual <= ACCEPT {
            return (q, near, residual);
        }
        q = near;
        let (last, residual) = self.led(&mut q);
        (q, last, residual)
    }

    /// Leads joints that reach the target aside to the target in stages, each a quarter of the way from it that the one before was: next to a
    /// self-motion it is as flat as the target is near, and a step must be no longer. The joints of the last stage that succeeded, and the residual at the
    /// target.
    fn led(&self, q: &mut [f64; 6]) -> ([f64; 6], f64) {
        let (mut last, mut residual, mut size) = (*q, 1.0, self.size);
        for stage in 0..STAGES {
            size = if stage + 1 < STAGES { 0.25 * size } else { 0.0 };
            let target = aside(size, self.number).after(self.goal).after(&self.chain.last);
            residual = self.chain.polish(q, &target).1;
            if residual > ACCEPT {
                break;
            }
            last = *q;
        }
        (last, residual)
    }
}
