//! From candidates to solutions. Candidates are collected, then measured together, and kept unchanged or [refined](crate::refine). Main type: [`Answers`].

use core::ops::Range;

use crate::angles::FAR_APART;
use crate::approach::{Approaches, LANES};
use crate::effort::{MILD, STEEP};
use crate::measure::{Fits, joints, tell_apart};
use crate::mechanism::{Abreast, Candidates, Facts, Found, Joint, Joints, Mechanism, Parameters, Places, elected};
use crate::number::Guard;
use crate::problem::{End, Fit, Problem};
use crate::rejected::{IsolatedSolutions, KnownMembers, Merged, RejectedKinds};
use crate::solution::{Error, Pairs, Solution};
use crate::starts::Starts;
use crate::storage::Array;
use crate::tolerances::ACCEPTANCE;

/// The solutions found so far.
pub(crate) struct Answers<'a, M: Mechanism> {
    pub problem: Problem<'a, M>,
    pub out: &'a mut [Solution<M>],
    /// The output for pairs, and whether all candidates so far can be written as pairs.
    pairs: Option<&'a mut [Pairs<M>]>,
    usual: bool,
    pub count: usize,
    /// Whether only the usual cases have run.
    is_ordinary: bool,
    /// Number of candidates so far, and that number at the last candidate that needed polishing.
    candidates: usize,
    pub unsound: usize,
    /// Number of candidates at the last one of close roots.
    pub doubted: usize,
    /// Whether, on each stratum so far, the cases before it have lost no solution. Always false with the formulas of a nearby mechanism.
    pub suffices: bool,
    /// Candidates for members of self-motions that were dropped for this reason.
    pub rejected: RejectedKinds,
    /// Solutions that are not members of self-motions.
    pub known_isolated: IsolatedSolutions<M>,
    /// Members of self-motions in the list.
    pub members: KnownMembers<M>,
    /// Whether the member that is being kept is on none of the known self-motions.
    pub is_another: bool,
    /// Members with several free joints that were found to be on a self-motion in the list.
    pub merged: Merged,
    /// Candidates next to which a curve is followed after all candidates are processed.
    pub starts: Option<Starts<M>>,
    /// The first stratum met for which no derivation exists.
    pub open: Option<usize>,
    /// The joint values with the least relative residual that are not a solution.
    pub nearest: Option<End<M>>,
    /// By place: the numbers of the candidates that are waiting, and how each was found.
    at: Places<M, Abreast<M>>,
    found: Abreast<M, Found>,
    waiting: usize,
}

impl<M: Mechanism> Candidates<f64, M> for Answers<'_, M> {
    #[inline(always)]
    fn is_usual(&mut self, guard: Guard<f64>) -> bool {
        if !guard.here {
            self.is_ordinary = false;
        }
        guard.here
    }

    #[inline(always)]
    fn is_rare(&mut self, guard: Guard<f64>) -> bool {
        if guard.here {
            self.is_ordinary = false;
        }
        guard.here
    }

    #[inline(always)]
    fn is_due(&mut self, before: usize, guard: Guard<f64>) -> bool {
        self.is_rare(guard) && {
            let suffices = self.suffice_since(before);
            self.suffices &= suffices;
            // The error of a double root is the square root of the rounding error: the stratum may be nearer than that.
            guard.beside || !suffices || self.doubted > before
        }
    }

    #[inline(always)]
    #[allow(clippy::misnamed_getters)]
    fn count(&self) -> usize {
        self.candidates
    }

    fn is_open(&mut self, number: usize, guard: Guard<f64>) {
        if guard.here {
            self.open = self.open.or(Some(number));
        }
    }

    fn elect(&mut self, claims: &[f64]) -> usize {
        elected(claims.iter().copied())
    }

    #[inline(always)]
    fn take(&mut self, found: Found, at: &Places<M>) {
        let room = self.problem.facts().candidates;
        if self.waiting >= room {
            self.flush();
        }
        let k = self.waiting % room;
        for (row, number) in self.at.as_mut().iter_mut().zip(at.as_ref()) {
            row.as_mut()[k] = *number;
        }
        self.found.as_mut()[k] = found;
        self.waiting = k + 1;
        self.candidates += 1;
    }
}

impl<'a, M: Mechanism> Answers<'a, M> {
    /// An empty list. Solutions go to `out`, or pairs to `pairs` if it is given.
    #[inline(always)]
    pub fn new(problem: Problem<'a, M>, out: &'a mut [Solution<M>], pairs: Option<&'a mut [Pairs<M>]>) -> Self {
        let Facts { places, candidates: room, nearby, .. } = problem.facts();
        Answers {
            problem,
            out,
            pairs,
            usual: true,
            is_ordinary: true,
            count: 0,
            candidates: 0,
            unsound: 0,
            doubted: 0,
            suffices: nearby.is_none(),
            rejected: RejectedKinds::NONE,
            known_isolated: IsolatedSolutions::NONE,
            members: KnownMembers::NONE,
            is_another: false,
            merged: Merged::NONE,
            starts: None,
            open: None,
            nearest: None,
            at: Array::by(places, |_| Array::by(room, |_| 0.0)),
            found: Array::by(room, |_| Found::first(0, 0)),
            waiting: 0,
        }
    }

    /// Whether there were candidates after the first `candidates`, and each was a solution without polishing. Then no solution is lost beside a stratum.
    #[cold]
    fn suffice_since(&mut self, candidates: usize) -> bool {
        self.flush();
        self.candidates > candidates && self.unsound <= candidates
    }

    /// Evaluates the blocks and takes in all candidates. Repeats this where a solution may have been lost.
    #[inline(never)]
    pub fn find(&mut self) -> Result<(), Error> {
        let (mechanism, parameters) = (self.problem.mechanism, self.problem.parameters);
        walk(mechanism, parameters, self);
        self.flush();
        self.walk_curves();
        if self.rejected.are_doubtful() && !self.are_all() && !self.problem.steps.are_spent() {
            self.suffices = false;
            walk(mechanism, parameters, self);
            self.flush();
        }
        self.open.map_or(Ok(()), |number| Err(Error::OpenStratum(number)))
    }

    /// Whether all candidates could be written as pairs.
    pub fn are_all_pairs(&self) -> bool {
        self.usual && self.problem.facts().isolated.is_none_or(|most| self.count <= most)
    }

    /// Whether the waiting candidates are those of an ordinary target.
    #[inline(always)]
    fn are_ordinary(&self) -> bool {
        let Facts { candidates: room, runs, .. } = self.problem.facts();
        !runs.is_empty() && self.is_ordinary && self.waiting == room && self.candidates == room
    }

    /// How many consecutive waiting candidates have equal residuals.
    #[inline(always)]
    fn twins<const W: usize>(&self) -> usize {
        let Facts { candidates, twins, .. } = self.problem.facts();
        if candidates % (W * twins) == 0 && self.are_ordinary() { twins } else { 1 }
    }

    /// Keeps the waiting candidates that solve the equations within rounding, and refines the others.
    #[inline(never)]
    #[allow(unsafe_code)]
    pub fn flush(&mut self) {
        #[cfg(all(target_arch = "x86_64", feature = "std"))]
        {
            let Facts { candidates, nearby, .. } = self.problem.facts();
            let are_led = nearby.is_some() && candidates.is_multiple_of(8);
            if are_led && std::is_x86_feature_detected!("avx512f") {
                // SAFETY: the processor supports the target feature of the function.
                return unsafe { self.flush_by_8() };
            }
            if candidates.is_multiple_of(4) && std::is_x86_feature_detected!("avx2") {
                // SAFETY: as above.
                return unsafe { self.flush_by_4() };
            }
        }
        self.flush_by::<LANES>();
    }

    /// Does not use [`crate::registers`]: in a closure the compiler cannot assume that `self` is not aliased, which costs 7 % of the time.
    #[cfg(all(target_arch = "x86_64", feature = "std"))]
    #[target_feature(enable = "avx2")]
    fn flush_by_4(&mut self) {
        self.flush_by::<4>();
    }

    #[cfg(all(target_arch = "x86_64", feature = "std"))]
    #[target_feature(enable = "avx512f")]
    fn flush_by_8(&mut self) {
        self.flush_by::<8>();
    }

    /// Processes `W` waiting candidates at a time.
    #[inline(always)]
    fn flush_by<const W: usize>(&mut self) {
        if self.pairs.is_some() {
            return self.flush_pairs::<W>();
        }
        let facts = self.problem.facts();
        let joints = joints::<M, W>(&facts, &self.at, self.are_ordinary());
        if self.problem.facts().nearby.is_some() {
            let approaches = Approaches::new::<W>(&self.problem, &self.at, self.found.as_ref(), self.waiting);
            return self.flush_nearby(&joints, &approaches);
        }
        let twins = self.twins::<W>();
        let fits = Fits::new::<W>(&self.problem, &self.at, self.waiting, twins);
        let room = self.problem.facts().candidates;
        let waiting = core::mem::take(&mut self.waiting).min(room);
        let mut usual = self.count == 0;
        for k in 0..waiting {
            let Found { close, free, .. } = self.found.as_ref()[k];
            let q = self.joints_of(&joints, k);
            let (residual, relative) = (fits.residual.as_ref()[k], fits.relative.as_ref()[k]);
            let fit = Fit { residual, relative, accepted: true };
            let holds = free == 0 && !close && relative < ACCEPTANCE.rounding && fits.sound.as_ref()[k] > 0.0;
            // The second of two twins has the same distance to earlier candidates as the first.
            let nearest = if k % twins == 0 { 0 } else { k - 1 };
            if holds && usual && self.write_apart(nearest..k, k, &q, &fit) {
                continue;
            }
            usual = false;
            if holds {
                self.extras_of(k);
                self.keep(&self.found.as_ref()[k].clone(), (q, fit));
            } else {
                self.refine_waiting(k, waiting, q);
            }
        }
    }

    /// Processes candidates of a nearby mechanism's formulas: Newton steps lead them to solutions.
    fn flush_nearby(&mut self, joints: &Joints<M, Abreast<M>>, approaches: &Approaches<M>) {
        let room = self.problem.facts().candidates;
        let waiting = core::mem::take(&mut self.waiting).min(room);
        let mut usual = self.count == 0;
        for k in 0..waiting {
            let found = self.found.as_ref()[k];
            let q = self.joints_of(joints, k);
            let is_short = found.free == 0
                && approaches.sound.as_ref()[k] > 0.0
                && approaches.relative.as_ref()[k] < ACCEPTANCE.rounding;
            let approached = if is_short {
                Some(approaches.approach(&self.problem, k, &q))
            } else if found.free == 0 {
                let at = self.places_of(k);
                self.problem.approached(&at, &q)
            } else {
                None
            };
            let Some(approach) = approached else {
                usual = false;
                self.refine_waiting(k, waiting, q);
                continue;
            };
            let holds = approach.pivot >= approach.missed * if found.close { STEEP } else { MILD };
            if holds && usual && self.write_apart(0..k, k, &approach.end, &approach.fit) {
                continue;
            }
            usual = false;
            self.extras_of(k);
            self.arrive(self.candidates + 1 + k - waiting, &found, approach);
        }
    }

    /// Writes an accepted candidate if there is room and it differs from the others.
    #[inline(always)]
    fn write_apart(&mut self, others: Range<usize>, k: usize, q: &Joints<M>, fit: &Fit) -> bool {
        // A loop, because a closure given to an iterator is not inlined here.
        for other in others {
            if !self.are_apart(k, other) {
                return false;
            }
        }
        let has_room = self.count < self.out.len();
        if has_room {
            self.write(&self.found.as_ref()[k].clone(), q.clone(), fit);
        }
        has_room
    }

    /// Appends a solution.
    #[inline(always)]
    pub fn write(&mut self, found: &Found, q: Joints<M>, fit: &Fit) {
        let Found { branch, free, .. } = *found;
        let Fit { residual, relative, .. } = *fit;
        self.out[self.count] = Solution { q, residual, relative, branch, chosen: false, free, settled: true };
        self.count += 1;
    }

    #[cold]
    #[inline(never)]
    fn refine_waiting(&mut self, k: usize, waiting: usize, q: Joints<M>) {
        self.extras_of(k);
        let found = self.found.as_ref()[k];
        self.refine(self.candidates + 1 + k - waiting, &found, q);
    }

    /// Copies the numbers that follow from no joint from a waiting candidate, so that the equations read them.
    fn extras_of(&mut self, k: usize) {
        if self.problem.facts().has_extras {
            self.problem.extras = Some(self.places_of(k));
        }
    }

    fn places_of(&self, k: usize) -> Places<M> {
        Array::by(self.problem.facts().places, |place| self.at.as_ref()[place].as_ref()[k])
    }

    #[inline(always)]
    fn joints_of(&self, joints: &Joints<M, Abreast<M>>, k: usize) -> Joints<M> {
        Array::by(self.problem.joints(), |i| joints.as_ref()[i].as_ref()[k])
    }

    /// Writes the waiting candidates as pairs, as long as all solve the equations within rounding and differ from each other.
    #[inline(always)]
    fn flush_pairs<const W: usize>(&mut self) {
        let facts = self.problem.facts();
        let fits = Fits::new::<W>(&self.problem, &self.at, self.waiting, self.twins::<W>());
        let waiting = core::mem::take(&mut self.waiting).min(facts.candidates);
        let Some(pairs) = &mut self.pairs else { return };
        self.usual &= facts.nearby.is_none();
        for k in 0..waiting {
            let Found { branch, close, free, .. } = self.found.as_ref()[k];
            let residual = fits.residual.as_ref()[k];
            let holds =
                free == 0 && !close && fits.relative.as_ref()[k] < ACCEPTANCE.rounding && fits.sound.as_ref()[k] > 0.0;
            let joints: Joints<M, [f64; 2]> = Array::by(facts.joints.len(), |i| {
                let number = |place: usize| self.at.as_ref()[place].as_ref()[k] + 0.0;
                match facts.joints[i] {
                    Joint::Angle([c, s]) => [number(c), number(s)],
                    Joint::Length(place) => [self.at.as_ref()[place].as_ref()[k], 0.0],
                }
            });
            self.usual &= holds && self.count < pairs.len();
            for other in &pairs[..self.count] {
                self.usual &= other.branch != branch && tell_apart::<M>(&facts, &joints, &other.joints);
            }
            if !self.usual {
                return;
            }
            pairs[self.count] = Pairs { joints, residual, branch, free, settled: true };
            self.count += 1;
        }
    }

    #[inline(always)]
    fn are_apart(&self, k: usize, other: usize) -> bool {
        are_apart::<M>(&self.problem.facts(), &self.at, k, other)
    }
}

/// Whether two candidates differ in at least one angle.
#[inline(always)]
pub(crate) fn are_apart<M: Mechanism>(facts: &Facts<'_>, at: &Places<M, Abreast<M>>, k: usize, other: usize) -> bool {
    let at = at.as_ref();
    let cosine = |place: usize| at[place].as_ref()[k] * at[place].as_ref()[other];
    for &i in facts.last_first {
        let Joint::Angle([c, s]) = facts.joints[i] else { continue };
        if cosine(c) + cosine(s) < FAR_APART {
            return true;
        }
    }
    false
}

/// A function of its own, so that the compiler knows that the parameters do not change.
#[inline(never)]
fn walk<M: Mechanism>(mechanism: &M, parameters: &Parameters<M>, answers: &mut Answers<'_, M>) {
    mechanism.walk(parameters, answers);
}
