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
    Candidates, Equations, Facts, Found, Inputs, Joint, Joints, Mechanism, Parameters, Places, Reached, Sizes, elected,
};
use crate::number::{Guard, Number, With};
use crate::problem::{End, Fit, Problem};
use crate::solution::{Error, Solution};
use crate::storage::Array;
use crate::tolerances::{ACCEPT, BLUR, LEAPS, MERGE, POLISHED};

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

/// Candidates for a target, which the joints may miss, each brought nearest to it on the ideal mechanism and handed on until that is enough.
struct Fitting<'a, M: Mechanism, F: FnMut(&Found, End<M>) -> bool> {
    problem: Problem<'a, M>,
    take: F,
    is_done: bool,
    candidates: usize,
    open: Option<usize>,
}

impl<M: Mechanism, F: FnMut(&Found, End<M>) -> bool> Candidates<f64, M> for Fitting<'_, M, F> {
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
        elected(claims.iter().copied())
    }

    fn take(&mut self, found: Found, at: &Places<M>) {
        self.candidates += 1;
        if self.is_done {
            return;
        }
        let joints = self.problem.facts().joints;
        let q = Array::by(joints.len(), |i| match joints[i] {
            Joint::Angle([c, s]) => angle(at.as_ref()[c], at.as_ref()[s]),
            Joint::Length(place) => at.as_ref()[place],
        });
        // On a stratum joints only seem to be free where the other equations tell them.
        let end = self.problem.fitted(q, 0, LEAPS[0]);
        self.is_done = end.1.residual.is_finite() && (self.take)(&found, end);
    }
}

/// Hands on the candidates for a target.
fn fit_all<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    take: impl FnMut(&Found, End<M>) -> bool,
) -> Result<(), Error> {
    let problem = Problem::new(mechanism, p);
    let mut fitting = Fitting { problem, take, is_done: false, candidates: 0, open: None };
    mechanism.walk(p, &mut fitting);
    fitting.open.map_or(Ok(()), |number| Err(Error::OpenStratum(number)))
}

/// The joints with which the ideal mechanism is nearest to a target, if there are any candidates.
fn closest<M: Mechanism>(mechanism: &M, p: &Parameters<M>) -> Result<Option<End<M>>, Error> {
    let mut best: Option<End<M>> = None;
    fit_all(mechanism, p, |_, end| {
        if best.as_ref().is_none_or(|(_, fit)| end.1.relative < fit.relative) {
            best = Some(end);
        }
        best.as_ref().is_some_and(|(_, fit)| fit.relative <= POLISHED)
    })?;
    Ok(best)
}

/// Adds joints with which the ideal mechanism comes within the tolerance of the target, too, and that are far from all answers to the target next to it: where it
/// reaches one pose in more ways than most, these part by as much as the target is off.
fn add_others<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    within: f64,
    (out, count): (&mut [Solution<M>], usize),
) -> Result<usize, Error> {
    let (facts, problem, mut count) = (mechanism.facts(), Problem::new(mechanism, p), count);
    fit_all(mechanism, p, |found, (q, fit)| {
        let is_far = |other: &Solution<M>| !facts.is_close(other.q.as_ref(), q.as_ref(), other.free, BLUR);
        let is_other = found.free == 0 && fit.relative <= within && out[..count].iter().all(is_far);
        if is_other && count < out.len() && problem.is_settled(&q) {
            let Fit { residual, relative, .. } = fit;
            out[count] = Solution { q, residual, relative, branch: found.branch, chosen: false, free: 0 };
            count += 1;
        }
        false
    })?;
    for end in 1..count {
        for place in (1..=end).rev() {
            if out[place - 1].branch <= out[place].branch {
                break;
            }
            out.swap(place - 1, place);
        }
    }
    Ok(count)
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
    let within = f64::max(within, ACCEPT);
    let is_reached = fit.relative <= within;
    if !is_reached {
        let mut nearest = Solution::empty(mechanism);
        nearest.q = q;
        fit_to(&problem, &mut nearest);
        return Ok((0, Some(nearest)));
    }
    let count = solve_ideal(mechanism, &ideal_target(mechanism, &q), out)?;
    let count = add_others(mechanism, &p, within, (&mut *out, count))?;
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
    let (q, fit) = problem.fitted(answer.q.clone(), answer.free, BLUR);
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
