//! Refinement of candidates that are not solutions yet, and of solutions close to each other.

use crate::answers::Answers;
use crate::approach::Approach;
use crate::arithmetic::Arithmetic;
use crate::counters::Phase;
use crate::effort::{APART, FARTHER, FARTHEST, LEVER, MILD, STEEP, TWIN, TWIN_AT, TWIN_WITHIN};
use crate::joints::{differences, moved, shifted};
use crate::mechanism::{Found, Joints, Mechanism};
use crate::newton::Triangle;
use crate::problem::{End, Fit, Problem};
use crate::rejected::IsolatedSolutions;
use crate::solution::Solution;
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, NEARBY_ROBOTS, PIVOTS, STRATA};

/// Maximal number of solutions of a target.
const MOST: usize = 4096;
const WORD: usize = u64::BITS as usize;

impl<M: Mechanism> Answers<'_, M> {
    /// Polishes a candidate with its number, and keeps the result if it solves the equations. Where two solutions almost meet, further starts around it are
    /// tried.
    #[cold]
    #[inline(never)]
    pub fn refine(&mut self, number: usize, found: &Found, q: Joints<M>) {
        let _phase = Phase::Polish.begin();
        if found.free != 0 {
            self.unsound = number;
            return self.refine_member(found, q);
        }
        let start = self.problem.measured(q.clone());
        let missed = start.1.relative;
        let end = self.problem.polish(start, 0);
        let miss = end.1.relative;
        let delta = self.problem.facts().farthest(q.as_ref(), end.0.as_ref());
        let is_nearby = self.problem.facts().nearby.is_some();
        let is_beside =
            (ACCEPTANCE.rounding..=if is_nearby { NEARBY_ROBOTS.off } else { STRATA.near }).contains(&missed);
        let holds = missed < ACCEPTANCE.rounding || miss < ACCEPTANCE.rounding && delta <= MERGING.joints;
        if !(end.1.accepted && holds) {
            self.unsound = number;
        }
        if found.close {
            self.doubted = number;
        }
        let triangle = (is_nearby && is_beside).then(|| self.problem.triangle(&end.0, 0.0, 0));
        let regularity = triangle.as_ref().map_or(1.0, Triangle::regularity);
        if triangle.is_some() && self.keep_moving(found, &end, regularity) {
            return;
        }
        if is_nearby && self.leads_to_curve(found, (&q, is_beside), &end, regularity) {
            return self.miss(end);
        }
        if (ACCEPTANCE.rounding..=STRATA.near).contains(&miss) {
            self.around(found, &end, miss);
        } else if is_beside && delta > LEVER * Arithmetic::sqrt(missed) {
            if !is_nearby || regularity <= PIVOTS.isolated {
                self.around(found, &end, missed);
            }
            // Such a candidate is between two solutions: starts again from the other side.
            let delta = differences::<M>(&self.problem.facts(), &q, &end.0);
            let start = shifted::<M>(&self.problem.facts(), &q, &delta);
            let start = self.problem.polished(start, 0);
            self.keep(found, start);
        }
        if let Some(triangle) = triangle {
            self.twin(found, &end.0, triangle, missed);
        }
        self.keep(found, end);
    }

    /// Searches for curves next to the end of the steps from a candidate, and next to the candidate if that is far away. Returns whether the steps ended on a
    /// curve.
    fn leads_to_curve(
        &mut self,
        found: &Found,
        (q, is_beside): (&Joints<M>, bool),
        end: &End<M>,
        regularity: f64,
    ) -> bool {
        if is_beside && self.is_curve(found, end, regularity) && end.1.relative >= ACCEPTANCE.rounding {
            return true;
        }
        if self.problem.facts().farthest(q.as_ref(), end.0.as_ref()) > MERGING.blur {
            self.begin_curve(found, q);
        }
        false
    }

    /// Keeps the end of the Newton steps from the candidate with this number. If the equations are ill-conditioned, searches for a second solution.
    pub fn arrive(&mut self, number: usize, found: &Found, approach: Approach<M>) {
        let Approach { end, fit, missed, pivot } = approach;
        let is_steep = pivot < missed * if found.close { STEEP } else { MILD };
        if !is_steep {
            return self.keep(found, (end, fit));
        }
        self.unsound = number;
        let triangle = self.problem.triangle(&end, 0.0, 0);
        let regularity = triangle.regularity();
        if regularity <= PIVOTS.regular {
            if self.keep_moving(found, &(end.clone(), fit), regularity) {
                return;
            }
            self.begin_curve(found, &end);
        }
        self.keep(found, (end.clone(), fit));
        self.twin(found, &end, triangle, missed);
    }

    /// Keeps a solution that is a member of a self-motion of one joint that a case frees. The formulas of a nearby mechanism do not distinguish these from
    /// isolated solutions. Returns whether it is one.
    fn keep_moving(&mut self, found: &Found, end: &End<M>, regularity: f64) -> bool {
        let may_move = end.1.relative <= ACCEPTANCE.rounding && regularity <= PIVOTS.regular;
        let joint = if may_move { self.problem.joint_on_long_self_motion(&end.0) } else { None };
        if let Some(free) = joint {
            self.keep(&Found { free, ..*found }, end.clone());
        }
        joint.is_some()
    }

    /// Whether a curve goes through a solution of a nearby mechanism, or through the end of the steps from one. Such a curve is followed.
    fn is_curve(&mut self, found: &Found, (q, fit): &End<M>, regularity: f64) -> bool {
        let is_singular =
            (ACCEPTANCE.rounding..=STRATA.near).contains(&fit.relative) || fit.accepted && regularity <= PIVOTS.regular;
        is_singular && self.begin_curve(found, q)
    }

    /// Searches for a second solution next to one whose candidate was a double root. Their distance is about the square root of the candidate's residual. The
    /// second one is in the direction in which the equations change least: a parabola through the first one has its second root there.
    fn twin(&mut self, found: &Found, end: &Joints<M>, triangle: Triangle<M>, missed: f64) {
        let _phase = Phase::Twin.begin();
        let nearby = Arithmetic::sqrt(missed);
        let Some((delta, share)) = self.problem.stillest(triangle) else { return };
        if share > TWIN * nearby {
            return;
        }
        let Some(distance) = self.problem.second_root(end, &delta, TWIN_AT * nearby) else { return };
        if distance.abs() > TWIN_WITHIN * nearby {
            return;
        }
        let step: Joints<M> = Array::by(self.problem.joints(), |i| distance * delta.as_ref()[i]);
        let start = shifted::<M>(&self.problem.facts(), end, &step);
        let at = self.problem.place(&start);
        let end = match self.problem.approached(&at, &start) {
            Some(Approach { end, fit, .. }) => (end, fit),
            None => self.problem.polished(start, 0),
        };
        self.keep(found, end);
    }

    /// Polishes again from points on either side of a candidate. Their distance is the square root of the residual, for a double root or an angle with little
    /// influence. If none of these leads to a solution, starts are farther away.
    pub fn around(&mut self, found: &Found, end: &End<M>, missed: f64) {
        let _phase = Phase::Around.begin();
        let weights = self.problem.weights(&end.0);
        let mut is_found = end.1.accepted;
        let mut farther = 1.0;
        while farther <= FARTHEST && !self.problem.steps.are_spent() {
            for i in 0..self.problem.joints() {
                for sign in [-1.0, 1.0] {
                    let weight = if end.1.accepted { 1.0 } else { weights.as_ref()[i] };
                    let delta = f64::min(farther * Arithmetic::sqrt(missed / weight), APART);
                    let start = moved::<M>(&self.problem.facts(), &end.0, i, 2.0 * sign * delta);
                    let start = self.problem.polished(start, 0);
                    is_found |= start.1.accepted;
                    self.keep(found, start);
                }
            }
            if is_found {
                return;
            }
            farther *= FARTHER;
        }
    }

    /// Stores a candidate that is not a solution if its residual is the least so far.
    pub fn miss(&mut self, end: End<M>) {
        let is_nearer = self.nearest.as_ref().is_none_or(|nearest| end.1.relative < nearest.1.relative);
        if !end.1.accepted && end.1.relative.is_finite() && is_nearer {
            self.nearest = Some(end);
        }
    }

    /// Keeps a solution if the equations hold. Of equal solutions, the branch of the first and the joints of the best are kept. A second root of a double one
    /// gets the next free number below `last`.
    pub fn keep(&mut self, found: &Found, (q, fit): End<M>) {
        if !(fit.accepted || self.may_stay(&q, &fit)) {
            return self.miss((q, fit));
        }
        let is_apart = |other: &Solution<M>| {
            let is_near = self.problem.facts().is_within(other.q.as_ref(), q.as_ref(), MERGING.blur);
            other.branch != found.branch && other.is_isolated() && !is_near
        };
        let is_first = found.free == 0 && self.out[..self.count].iter().all(is_apart);
        if is_first && self.count < self.out.len() {
            return self.write(found, q, &fit);
        }
        self.keep_one(found, q, &fit);
    }

    /// Whether a candidate that could not be polished, because no steps are left, is near enough to a solution.
    fn may_stay(&self, q: &Joints<M>, fit: &Fit) -> bool {
        let are_finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let is_whole = are_finite(q.as_ref()) && self.problem.extras.as_ref().is_none_or(|at| are_finite(at.as_ref()));
        self.problem.steps.are_spent() && fit.relative <= ACCEPTANCE.unsettled && is_whole
    }

    /// Same as [`Answers::keep`], where other solutions are near.
    #[cold]
    #[inline(never)]
    fn keep_one(&mut self, found: &Found, q: Joints<M>, fit: &Fit) {
        let _phase = Phase::Compare.begin();
        let Found { branch, last, free, .. } = *found;
        let next = if free == 0 { last } else { branch };
        let is_taken = |branch: usize| self.out[..self.count].iter().any(|answer| answer.branch == branch);
        let branch = (branch..next).find(|branch| !is_taken(*branch)).unwrap_or(branch);
        let Fit { residual, relative, .. } = *fit;
        let mut answer = Solution { q, residual, relative, branch, chosen: false, free, settled: true };
        let mut doubles = [0_u64; MOST / WORD];
        let mut first = None;
        for i in 0..self.count.min(MOST) {
            if self.is_one(i, &answer) {
                let other = &self.out[i];
                if holds_against(other, &answer) {
                    self.remember_merged(i, answer.relative, found);
                    return;
                }
                doubles[i / WORD] |= 1 << (i % WORD);
                first = first.or(Some(other.branch));
            }
        }
        if free == 0 {
            answer.branch = first.unwrap_or(branch);
        }
        self.retain(|i| doubles[i / WORD] >> (i % WORD) & 1 == 0);
        self.push(answer);
    }

    /// Drops the solutions for whose index `stays` is false.
    fn retain(&mut self, stays: impl Fn(usize) -> bool) {
        let mut kept = 0;
        for i in 0..self.count {
            if stays(i) {
                self.out.swap(kept, i);
                kept += 1;
            }
        }
        self.count = kept;
    }

    /// Adds a solution. If there are too many, the worst is dropped.
    fn push(&mut self, answer: Solution<M>) {
        if self.count == self.out.len() {
            let mut worst = None;
            for (i, other) in self.out.iter().enumerate() {
                if worst.is_none_or(|(_, most)| other.relative >= most) {
                    worst = Some((i, other.relative));
                }
            }
            match worst {
                Some((worst, most)) if answer.relative < most => self.retain(|i| i != worst),
                _ => return,
            }
        }
        self.out[self.count] = answer;
        self.count += 1;
    }

    /// Merges the nearest two isolated solutions while there are more than a target can have: at a singular configuration rounding makes several of one. The
    /// better one is kept.
    pub fn unite(&mut self) {
        let Some(most) = self.problem.facts().isolated else { return };
        while self.count > most && self.out[..self.count].iter().filter(|answer| answer.is_isolated()).count() > most {
            let (mut least, mut worse) = (f64::INFINITY, 0);
            for second in 0..self.count {
                for first in 0..second {
                    let (a, b) = (&self.out[first], &self.out[second]);
                    let distance = self.problem.facts().farthest(a.q.as_ref(), b.q.as_ref());
                    if a.is_isolated() && b.is_isolated() && distance < least {
                        (least, worse) = (distance, if a.relative > b.relative { first } else { second });
                    }
                }
            }
            self.retain(|i| i != worse);
        }
    }

    /// Insertion sort by branch.
    pub fn sort(&mut self) {
        for end in 1..self.count {
            for place in (1..=end).rev() {
                if self.out[place - 1].branch <= self.out[place].branch {
                    break;
                }
                self.out.swap(place - 1, place);
            }
        }
    }

    /// Marks the solutions that the source would select.
    pub fn mark_choice(&mut self) {
        let Some(preference) = self.problem.facts().preference else { return };
        let sign = if preference.greatest { -1.0 } else { 1.0 };
        let value = |answer: &Solution<M>| sign * self.problem.place(&answer.q).as_ref()[preference.place];
        let answers = &mut self.out[..self.count];
        let least = answers.iter().map(value).fold(f64::INFINITY, f64::min);
        for answer in answers {
            answer.chosen = value(answer) <= least + MERGING.joints;
        }
    }

    /// Whether two solutions are one: members of one self-motion, one singular configuration, or within `MERGING.joints` without the joints that are free in
    /// either.
    fn is_one(&mut self, index: usize, b: &Solution<M>) -> bool {
        let Answers { problem, out, is_another, suffices, known_isolated, .. } = self;
        let a = &out[index];
        if problem.facts().is_close(a.q.as_ref(), b.q.as_ref(), a.free | b.free, MERGING.joints) {
            return true;
        }
        if problem.steps.are_spent() {
            return are_alike(problem, a, b);
        }
        match (a.is_isolated(), b.is_isolated()) {
            (true, true) => problem.are_blurred((&a.q, a.relative), (&b.q, b.relative)),
            (false, false) => {
                let are_apart = *is_another && a.relative <= ACCEPTANCE.rounding && a.branch == b.branch;
                let is_alike = a.free == b.free && !are_apart;
                is_alike && (are_by_branch(problem, a, b) || problem.leads_to(&a.q, &b.q, a.free))
            }
            (true, false) => is_on(problem, known_isolated, b, a, *suffices),
            (false, true) => is_on(problem, known_isolated, a, b, *suffices),
        }
    }
}

impl<M: Mechanism> Problem<'_, M> {
    /// Whether two close solutions are one at a singular configuration, where the equations determine the joints less exactly than `MERGING.joints`. Half-way
    /// between them the residual is then no larger than at the worse of the two.
    pub fn are_blurred(&mut self, (a, of_a): (&Joints<M>, f64), (b, of_b): (&Joints<M>, f64)) -> bool {
        let bound = f64::max(f64::max(of_a, of_b), MERGING.halfway);
        let is_near = self.facts().farthest(a.as_ref(), b.as_ref()) <= MERGING.blur;
        if bound <= ACCEPTANCE.rounding && is_near && self.regularity(b) > PIVOTS.isolated {
            return false;
        }
        self.are_joined(a, b, bound, 0)
    }
}

/// Whether an isolated solution belongs to the self-motion of a member that holds within rounding. If the cases before have lost no solution, the residual of
/// the self-motion may be larger.
fn is_on<M: Mechanism>(
    problem: &mut Problem<'_, M>,
    known_isolated: &mut IsolatedSolutions<M>,
    member: &Solution<M>,
    isolated: &Solution<M>,
    suffices: bool,
) -> bool {
    let free = member.free;
    if member.relative > ACCEPTANCE.rounding || known_isolated.contains(&isolated.q, free) {
        return false;
    }
    if !problem.is_on_self_motion(&isolated.q, free, ACCEPTANCE.rounding) {
        known_isolated.remember(&isolated.q, free);
        return false;
    }
    !suffices || problem.leads_to(&member.q, &isolated.q, free)
}

/// Whether members of one branch count as one self-motion: where it is not a curve, or its residual exceeds rounding.
fn are_by_branch<M: Mechanism>(problem: &mut Problem<'_, M>, a: &Solution<M>, b: &Solution<M>) -> bool {
    let are_sharp = f64::max(a.relative, b.relative) <= ACCEPTANCE.rounding;
    a.branch == b.branch && !(are_sharp && problem.tangent(&b.q, b.free).is_some())
}

/// Whether two solutions count as one when no steps are left to distinguish them: members of one branch, or solutions that polishing might have merged.
fn are_alike<M: Mechanism>(problem: &Problem<'_, M>, a: &Solution<M>, b: &Solution<M>) -> bool {
    match (a.is_isolated(), b.is_isolated()) {
        (true, true) => {
            let is_loose = f64::max(a.relative, b.relative) > ACCEPTANCE.residual;
            is_loose && problem.facts().farthest(a.q.as_ref(), b.q.as_ref()) <= MERGING.blur
        }
        _ => (a.branch, a.free) == (b.branch, b.free),
    }
}

/// Whether `a` is kept when `b` is equal to it: the better one is kept. However, a self-motion within rounding is preferred to its isolated members, and its
/// first member to the later ones.
fn holds_against<M: Mechanism>(a: &Solution<M>, b: &Solution<M>) -> bool {
    match (a.is_isolated(), b.is_isolated()) {
        (true, false) if b.relative <= ACCEPTANCE.rounding => false,
        (false, _) if a.relative <= ACCEPTANCE.rounding => true,
        _ => a.relative <= b.relative,
    }
}
