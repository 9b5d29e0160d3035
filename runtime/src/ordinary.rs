//! Solutions of ordinary targets, without the code for all other ones. Main trait: [`Ordinary`]. It is not part of generated files.

use crate::answers::are_apart;
use crate::approach::LANES;
use crate::batch::Bundle;
use crate::conditions::conform;
use crate::effort::MOST_STEPS;
use crate::measure::{Fits, joints};
use crate::mechanism::{Abreast, Candidates, Facts, Found, Inputs, Joints, Mechanism, Places, elected};
use crate::number::Guard;
use crate::problem::Problem;
use crate::registers::{in_avx2, in_avx512};
use crate::steps::Steps;
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS};

/// A candidate of an ordinary target, which is a solution if it is real.
#[non_exhaustive]
pub struct Candidate<M: Mechanism> {
    /// Joint values, in the order of the joints: rad in (-pi, pi], or the unit of lengths.
    pub q: Joints<M>,
    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    pub residual: f64,
    /// Number of the combination of cases and roots.
    pub branch: usize,
    /// Whether it is a solution.
    pub is_real: bool,
}

/// Receives the results of targets in their order.
pub trait Receiver<M: Mechanism> {
    /// Receives the candidates of an ordinary target, by branch.
    fn take(&mut self, target: usize, candidates: impl ExactSizeIterator<Item = Candidate<M>>);

    /// Receives the index of a target that is not ordinary.
    fn leave(&mut self, target: usize);
}

/// Inverse kinematics at ordinary targets, where all candidates solve the equations within rounding and are distinct, and no case of a stratum applies. Of the
/// random targets of most mechanisms, more than 99.9 % are ordinary. The solutions are bitwise equal to those of [`Solve::solve`](crate::Solve::solve).
///
/// For a mechanism this is a fraction of the code of [`Solve`](crate::Solve). It is for a program with many mechanisms that has one interpreter for all other
/// targets.
pub trait Ordinary: Mechanism {
    /// Passes the candidates of one target to `receiver`.
    fn solve_ordinary(&self, target: &Inputs<Self>, receiver: &mut impl Receiver<Self>) {
        one(self, 0, target, receiver);
    }

    /// Passes the candidates of many targets to `receiver`; the lanes of a vector register process several at once.
    fn solve_ordinary_batch(&self, targets: &[Inputs<Self>], receiver: &mut impl Receiver<Self>) {
        if Self::IS_SINGLE || self.facts().runs.is_empty() {
            return one_by_one(self, targets, receiver);
        }
        let by_8 = in_avx512(
            #[inline(always)]
            || many::<Self, _, 8>(self, targets, receiver),
        );
        let Err(_) = by_8 else { return };
        let by_4 = in_avx2(
            #[inline(always)]
            || many::<Self, _, 4>(self, targets, receiver),
        );
        let Err(_) = by_4 else { return };
        if cfg!(target_arch = "x86_64") {
            one_by_one(self, targets, receiver);
        } else {
            many::<Self, _, 2>(self, targets, receiver);
        }
    }
}

impl<M: Mechanism> Ordinary for M {}

#[inline(always)]
fn many<M: Mechanism, R: Receiver<M>, const W: usize>(mechanism: &M, targets: &[Inputs<M>], receiver: &mut R) {
    let facts = mechanism.facts();
    let mut bundle = Bundle::<M, W>::empty(&facts);
    for (first, targets) in targets.chunks(W).enumerate() {
        bundle.find(mechanism, &facts, targets, true);
        for (lane, numbers) in targets.iter().enumerate() {
            let target = W * first + lane;
            if bundle.doubt.0[lane] == 0 {
                receiver.take(target, candidates(&facts, &bundle, lane));
            } else {
                one(mechanism, target, numbers, receiver);
            }
        }
    }
}

/// The candidates of the ordinary target in a lane.
#[inline(always)]
fn candidates<M: Mechanism, const W: usize>(
    facts: &Facts<'_>,
    bundle: &Bundle<M, W>,
    lane: usize,
) -> impl ExactSizeIterator<Item = Candidate<M>> {
    (0..facts.candidates).map(move |k| {
        let q = bundle.q.as_ref()[k].as_ref();
        Candidate {
            q: Array::by(q.len(), |i| q[i].0[lane]),
            residual: bundle.residual.as_ref()[k].0[lane],
            branch: bundle.branch.as_ref()[k],
            is_real: bundle.dead.as_ref()[k].0[lane] == 0,
        }
    })
}

fn one_by_one<M: Mechanism>(mechanism: &M, targets: &[Inputs<M>], receiver: &mut impl Receiver<M>) {
    targets.iter().enumerate().for_each(|(target, numbers)| one(mechanism, target, numbers, receiver));
}

#[inline(never)]
fn one<M: Mechanism, R: Receiver<M>>(mechanism: &M, index: usize, target: &Inputs<M>, receiver: &mut R) {
    let (mut target, facts) = (target.clone(), mechanism.facts());
    let Facts { nearby, within, preference, has_extras, .. } = facts;
    let is_exact = nearby.is_none() && within.is_none() && preference.is_none() && !has_extras;
    if !is_exact || conform(facts.conditions, target.as_mut()).is_err() {
        return receiver.leave(index);
    }
    let (p, mut steps) = (mechanism.parameters(&target), Steps::at_most(MOST_STEPS));
    let mut single = Single::empty(&facts);
    mechanism.walk(&p, &mut single);
    match single.answers(&mut Problem::new(mechanism, &p, &mut steps)) {
        Some((q, fits)) => receiver.take(
            index,
            (0..single.count).map(|k| Candidate {
                q: joints_of::<M>(&facts, &q, k),
                residual: fits.residual.as_ref()[k],
                branch: single.found.as_ref()[k].branch,
                is_real: true,
            }),
        ),
        None => receiver.leave(index),
    }
}

/// The joint values of a candidate.
#[inline(always)]
fn joints_of<M: Mechanism>(facts: &Facts<'_>, q: &Joints<M, Abreast<M>>, candidate: usize) -> Joints<M> {
    Array::by(facts.joints.len(), |i| q.as_ref()[i].as_ref()[candidate])
}

/// Whether solutions within rounding are distinct: far from each other, or where the equations determine the joints well. As for
/// [`Answers::keep`](crate::answers::Answers::keep).
#[cold]
#[inline(never)]
fn are_distinct<M: Mechanism>(problem: &mut Problem<'_, M>, [a, b]: [Joints<M>; 2]) -> bool {
    let facts = problem.facts();
    if !facts.is_within(a.as_ref(), b.as_ref(), MERGING.blur) {
        return true;
    }
    let is_near = facts.farthest(a.as_ref(), b.as_ref()) <= MERGING.blur;
    let is_one = facts.is_close(a.as_ref(), b.as_ref(), 0, MERGING.joints);
    !is_one && is_near && problem.regularity(&b) > PIVOTS.isolated
}

/// The joint values and the residuals of candidates.
type Measured<M> = (Joints<M, Abreast<M>>, Fits<M>);

/// The candidates of one target.
struct Single<M: Mechanism> {
    /// By place.
    at: Places<M, Abreast<M>>,
    found: Abreast<M, Found>,
    count: usize,
    /// Whether only the usual cases apply.
    is_usual: bool,
    is_ordinary: bool,
}

impl<M: Mechanism> Candidates<f64, M> for Single<M> {
    #[inline(always)]
    fn is_usual(&mut self, guard: Guard<f64>) -> bool {
        self.is_usual &= guard.here;
        guard.here
    }

    #[inline(always)]
    fn is_rare(&mut self, guard: Guard<f64>) -> bool {
        self.is_ordinary &= !guard.here;
        false
    }

    /// The case does not run where the candidates before it lost no solution: there are some, and [`Single::answers`] requires that none needs polishing.
    #[inline(always)]
    fn is_due(&mut self, before: usize, guard: Guard<f64>) -> bool {
        self.is_usual &= !guard.here;
        self.is_ordinary &= !guard.here || (!guard.beside && self.count > before);
        false
    }

    #[inline(always)]
    fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn is_open(&mut self, _: usize, guard: Guard<f64>) {
        self.is_ordinary &= !guard.here;
    }

    #[inline(always)]
    fn elect(&mut self, claims: &[f64]) -> usize {
        elected(claims.iter().copied())
    }

    #[inline(always)]
    fn take(&mut self, found: Found, at: &Places<M>) {
        let room = self.found.as_ref().len();
        self.is_ordinary &= self.count < room && found.free == 0 && !found.close;
        let k = self.count % room;
        for (row, number) in self.at.as_mut().iter_mut().zip(at.as_ref()) {
            row.as_mut()[k] = *number;
        }
        self.found.as_mut()[k] = found;
        self.count = k + 1;
    }
}

impl<M: Mechanism> Single<M> {
    #[inline(always)]
    fn empty(facts: &Facts<'_>) -> Self {
        let room = facts.candidates;
        Single {
            at: Array::by(facts.places, |_| Array::by(room, |_| 0.0)),
            found: Array::by(room, |_| Found::first(0, 0)),
            count: 0,
            is_usual: true,
            is_ordinary: true,
        }
    }

    /// The joint values and residuals of the candidates if the target is ordinary.
    #[inline(always)]
    #[allow(unsafe_code)]
    fn answers(&self, problem: &mut Problem<'_, M>) -> Option<Measured<M>> {
        let facts = problem.facts();
        if !self.is_ordinary || facts.isolated.is_some_and(|most| self.count > most) {
            return None;
        }
        #[cfg(all(target_arch = "x86_64", feature = "std"))]
        if facts.candidates.is_multiple_of(4) && std::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor supports the target feature of the function.
            return unsafe { self.answers_by_4(problem) };
        }
        self.answers_by::<LANES>(problem)
    }

    #[cfg(all(target_arch = "x86_64", feature = "std"))]
    #[target_feature(enable = "avx2")]
    fn answers_by_4(&self, problem: &mut Problem<'_, M>) -> Option<Measured<M>> {
        self.answers_by::<4>(problem)
    }

    #[inline(always)]
    fn answers_by<const W: usize>(&self, problem: &mut Problem<'_, M>) -> Option<Measured<M>> {
        let facts = problem.facts();
        let are_all = self.is_usual && !facts.runs.is_empty() && self.count == facts.candidates;
        let q = joints::<M, W>(&facts, &self.at, are_all);
        let twins = if are_all && facts.candidates.is_multiple_of(W * facts.twins) { facts.twins } else { 1 };
        let fits = Fits::new::<W>(problem, &self.at, self.count, twins);
        for k in 0..self.count {
            let holds = fits.relative.as_ref()[k] < ACCEPTANCE.rounding && fits.sound.as_ref()[k] > 0.0;
            if !holds {
                return None;
            }
            // The second of two twins has the same distance to earlier candidates as the first.
            let nearest = if k % twins == 0 { 0 } else { k - 1 };
            for other in nearest..k {
                let are_apart = are_apart::<M>(&facts, &self.at, k, other);
                if !are_apart && !are_distinct(problem, [other, k].map(|k| joints_of::<M>(&facts, &q, k))) {
                    return None;
                }
            }
        }
        Some((q, fits))
    }
}
