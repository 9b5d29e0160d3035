//! The list of solutions: equal ones are merged when they are added.

use crate::answers::Answers;
use crate::counters::Phase;
use crate::mechanism::{Found, Joints, Mechanism};
use crate::problem::{End, Fit, Problem};
use crate::rejected::IsolatedSolutions;
use crate::solution::Solution;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS};

/// Maximal number of solutions of a target.
const MOST: usize = 4096;
const WORD: usize = u64::BITS as usize;

impl<M: Mechanism> Answers<'_, M> {
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
    pub fn retain(&mut self, stays: impl Fn(usize) -> bool) {
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
