//! Tasks that ask for more than the joints can do, of a mechanism that a description tells in rounded numbers ([`Facts::within`]).
//!
//! The ideal mechanism decides which answers there are: of the candidates for the target the one that comes nearest tells a target that the ideal mechanism
//! reaches, and if the two are the same [within](Facts::within) the tolerance, the answers are all that reach it. Each is then brought, in the sense of least
//! squares, to where the mechanism as described is nearest to the target itself.

use crate::angles::angle;
use crate::conditions::conform;
use crate::exactly::solve_ideal;
use crate::joints::place;
use crate::limits::{strides_within, turned_within};
use crate::mechanism::{
    Candidates, Equations, Facts, Found, Inputs, Joint, Joints, Mechanism, Parameters, Places, Reached, Sizes,
};
use crate::number::{Guard, Number, With};
use crate::problem::{End, Problem};
use crate::solution::{Error, Solution};
use crate::storage::Array;
use crate::tolerances::{ACCEPT, MERGE, POLISHED};

/// A mechanism as described.
pub(crate) struct Described<'a, M>(pub &'a M);

impl<M: Mechanism> Mechanism for Described<'_, M> {
    type Storage = M::Storage;

    fn facts(&self) -> Facts<'_> {
        Facts { within: None, ..self.0.facts() }
    }

    fn parameters<N: Number>(&self, target: &Inputs<Self, N>) -> Parameters<Self, N>
    where
        f64: With<N>,
    {
        self.0.parameters(target)
    }

    fn walk<N: Number, C: Candidates<N, Self>>(&self, _: &Parameters<Self, N>, _: &mut C)
    where
        f64: With<N>,
    {
    }

    fn values<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Equations<Self, N>
    where
        f64: With<N>,
    {
        self.0.described(p, at)
    }

    fn sizes<N: Number>(&self, p: &Parameters<Self, N>, at: &Places<Self, N>) -> Sizes<Self, N>
    where
        f64: With<N>,
    {
        self.0.sizes(p, at)
    }
}

/// The target that is read off what the equations compare.
pub(crate) fn read_off<M: Mechanism>(facts: &Facts<'_>, tip: &Equations<M>, q: &Joints<M>) -> Inputs<M> {
    Array::by(facts.inputs, |i| match facts.reached[i] {
        Reached::Value(value) => tip.as_ref()[value],
        Reached::Angle([cosine, sine]) => angle(tip.as_ref()[cosine], tip.as_ref()[sine]),
        Reached::Joint(joint) => q.as_ref()[joint],
    })
}

/// The target that joint values reach as described.
pub(crate) fn reached<M: Mechanism>(mechanism: &M, q: &Joints<M>) -> Inputs<M> {
    let facts = mechanism.facts();
    let target: Inputs<M> = Array::by(facts.inputs, |_| 0.0);
    let mut nothing = mechanism.parameters(&target);
    nothing.as_mut().fill(0.0);
    read_off::<M>(&facts, &mechanism.described(&nothing, &place::<M>(&facts, q, None)), q)
}

/// The candidate that comes nearest to a target, which the joints may miss.
struct Closest<'a, M: Mechanism> {
    problem: Problem<'a, M>,
    best: Option<End<M>>,
    candidates: usize,
    open: Option<usize>,
}

impl<M: Mechanism> Candidates<f64, M> for Closest<'_, M> {
    fn is_usual(&mut self, guard: Guard<f64>) -> bool {
        guard.here
    }

    fn is_rare(&mut self, guard: Guard<f64>) -> bool {
        guard.here
    }

    fn is_due(&mut self, _: usize, guard: Guard<f64>) -> bool {
        guard.here
    }

    fn count(&self) -> usize {
        self.candidates
    }

    fn is_open(&mut self, number: usize, guard: Guard<f64>) {
        if guard.here {
            self.open = self.open.or(Some(number));
        }
    }

    fn elect(&mut self, claims: &[f64]) -> usize {
        let (mut most, mut place) = (-1.0, claims.len());
        for (i, &claim) in claims.iter().enumerate() {
            if claim > most {
                (most, place) = (claim, i);
            }
        }
        place
    }

    fn take(&mut self, found: Found, at: &Places<M>) {
        self.candidates += 1;
        if self.best.as_ref().is_some_and(|(_, fit)| fit.relative <= POLISHED) {
            return;
        }
        let joints = self.problem.facts().joints;
        let q = Array::by(joints.len(), |i| match joints[i] {
            Joint::Angle([c, s]) => angle(at.as_ref()[c], at.as_ref()[s]),
            Joint::Length(place) => at.as_ref()[place],
        });
        let end = self.problem.fitted(q, found.free);
        let is_nearer = self.best.as_ref().is_none_or(|(_, best)| end.1.relative < best.relative);
        if is_nearer && end.1.residual.is_finite() {
            self.best = Some(end);
        }
    }
}

/// What the candidates for a target come to: the joints with which the ideal mechanism is nearest to it, if there are any.
fn closest<M: Mechanism>(mechanism: &M, p: &Parameters<M>) -> Result<Option<End<M>>, Error> {
    let mut closest = Closest { problem: Problem::new(mechanism, p), best: None, candidates: 0, open: None };
    mechanism.walk(p, &mut closest);
    closest.open.map_or(Ok(closest.best), |number| Err(Error::OpenStratum(number)))
}

/// All answers to a target that fulfils its conditions; where there is none, where the mechanism comes nearest to it.
#[inline(never)]
pub(crate) fn solve_described<M: Mechanism>(
    mechanism: &M,
    target: &Inputs<M>,
    within: f64,
    out: &mut [Solution<M>],
) -> Result<(usize, Option<Solution<M>>), Error> {
    let p = mechanism.parameters(target);
    let described = Described(mechanism);
    let problem = Problem::new(&described, &p);
    let Some((q, fit)) = closest(mechanism, &p)? else { return Ok((0, None)) };
    let is_reached = fit.relative <= f64::max(within, ACCEPT);
    if !is_reached {
        let mut nearest = Solution::empty(mechanism);
        nearest.q = q;
        fit_to(&problem, &mut nearest);
        return Ok((0, Some(nearest)));
    }
    let count = solve_ideal(mechanism, &ideal_target(mechanism, &q), out)?;
    out[..count].iter_mut().for_each(|answer| fit_to(&problem, answer));
    Ok((distinct(mechanism, out, count), None))
}

/// The target that the ideal mechanism reaches.
fn ideal_target<M: Mechanism>(mechanism: &M, q: &Joints<M>) -> Inputs<M> {
    let facts = mechanism.facts();
    read_off::<M>(&facts, &mechanism.tip(&place::<M>(&facts, q, None)), q)
}

/// Brings an answer of the ideal mechanism to where the described one is nearest to the target.
fn fit_to<M: Mechanism>(problem: &Problem<'_, Described<'_, M>>, answer: &mut Solution<M>) {
    let (q, fit) = problem.fitted(answer.q.clone(), answer.free);
    (answer.q, answer.residual, answer.relative) = (q, fit.residual, fit.relative);
}

/// Keeps the first of answers that have become one; their number.
fn distinct<M: Mechanism>(mechanism: &M, out: &mut [Solution<M>], count: usize) -> usize {
    let facts = mechanism.facts();
    let mut kept = 0;
    for k in 0..count {
        let is_same = |i: usize| facts.is_close(out[i].q.as_ref(), out[k].q.as_ref(), out[i].free | out[k].free, MERGE);
        if !(0..kept).any(is_same) {
            out.swap(kept, k);
            kept += 1;
        }
    }
    kept
}

/// As [`crate::Solve::solve_within`], for one answer: a member of a self-motion is moved along that of the ideal mechanism.
pub(crate) fn within_limits<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    answer: &Solution<M>,
    limits: &Joints<M, [f64; 2]>,
) -> Option<(Joints<M>, f64)> {
    let strides = || {
        let mut target = ideal_target(mechanism, &answer.q);
        conform(mechanism.facts().conditions, target.as_mut()).ok()?;
        let ideal = mechanism.parameters(&target);
        Some(strides_within(&Problem::new(mechanism, &ideal), answer, limits)?.0)
    };
    let q = turned_within::<M>(&mechanism.facts(), &answer.q, limits).or_else(strides)?;
    let described = Described(mechanism);
    let residual = Problem::new(&described, p).measure(&q).residual;
    Some((q, residual))
}
