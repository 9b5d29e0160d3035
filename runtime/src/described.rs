//! Tasks with more conditions than joints, for a mechanism whose description has rounded numbers ([`Facts::within`]).
//!
//! The ideal mechanism determines the solutions. Among the candidates for the target, the nearest one defines a target that the ideal mechanism reaches. If
//! both targets agree [within](Facts::within) the tolerance, all solutions of the second one are used. Each is then moved, by least squares, to where the
//! mechanism as described is nearest to the requested target.

use crate::angles::angle;
use crate::conditions::conform;
use crate::effort::{LEAPS, MOST_STEPS};
use crate::exactly::solve_ideal;
use crate::joints::place;
use crate::limits::{Aim, strides_within, turned_within};
use crate::mechanism::{
    Candidates, Equations, Facts, Found, Inputs, Joint, Joints, Mechanism, Parameters, Places, Reached, Sizes, elected,
};
use crate::nearest::{Best, Search};
use crate::number::{Guard, Number, With};
use crate::problem::{End, Fit, Problem};
use crate::solution::{Error, Solution};
use crate::steps::{Steps, settle};
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, POLISHING};

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

/// The target computed from the values that the equations compare.
pub(crate) fn read_off<M: Mechanism>(facts: &Facts<'_>, tip: &Equations<M>, q: &Joints<M>) -> Inputs<M> {
    Array::by(facts.inputs, |i| match facts.reached[i] {
        Reached::Value(value) => tip.as_ref()[value],
        Reached::Angle([cosine, sine]) => angle(tip.as_ref()[cosine], tip.as_ref()[sine]),
        Reached::Joint(joint) => q.as_ref()[joint],
    })
}

/// The target that the mechanism as described reaches with these joint values.
pub(crate) fn reached<M: Mechanism>(mechanism: &M, q: &Joints<M>) -> Inputs<M> {
    let facts = mechanism.facts();
    let target: Inputs<M> = Array::by(facts.inputs, |_| 0.0);
    let mut nothing = mechanism.parameters(&target);
    nothing.as_mut().fill(0.0);
    read_off::<M>(&facts, &mechanism.described(&nothing, &place::<M>(&facts, q, None)), q)
}

/// Candidates for a target that the joints may not reach exactly, passed on until `take` returns true.
struct Proposals<'a, F> {
    facts: Facts<'a>,
    take: F,
    is_done: bool,
    candidates: usize,
    /// The joints that at least one candidate frees.
    free: u32,
    open: Option<usize>,
}

impl<M: Mechanism, F: FnMut(&Found, Joints<M>) -> bool> Candidates<f64, M> for Proposals<'_, F> {
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
        self.free |= found.free;
        if self.is_done {
            return;
        }
        let joints = self.facts.joints;
        let q: Joints<M> = Array::by(joints.len(), |i| match joints[i] {
            Joint::Angle([c, s]) => angle(at.as_ref()[c], at.as_ref()[s]),
            Joint::Length(place) => at.as_ref()[place],
        });
        // Next to a stratum formulas may divide zero by zero.
        self.is_done = q.as_ref().iter().all(|value| value.is_finite()) && (self.take)(&found, q);
    }
}

/// Passes on the candidates for a target until `take` returns true. Returns the joints that at least one candidate frees.
fn propose<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    take: impl FnMut(&Found, Joints<M>) -> bool,
) -> Result<u32, Error> {
    let facts = mechanism.facts();
    let mut proposals = Proposals { facts, take, is_done: false, candidates: 0, free: 0, open: None };
    mechanism.walk(p, &mut proposals);
    proposals.open.map_or(Ok(proposals.free), |number| Err(Error::OpenStratum(number)))
}

/// The joint values with which the ideal mechanism is nearest to a target, if there are candidates, and the joints that at least one of these frees.
fn closest<M: Mechanism>(mechanism: &M, p: &Parameters<M>, steps: &mut Steps) -> Result<(Option<End<M>>, u32), Error> {
    let (mut problem, mut best) = (Problem::new(mechanism, p, steps), None::<End<M>>);
    let free = propose(mechanism, p, |_, q| {
        // On a stratum a joint may only appear free, because the remaining equations determine it.
        let end = problem.fitted(q, 0, LEAPS[0]);
        let is_nearer = best.as_ref().is_none_or(|(_, fit)| end.1.relative < fit.relative);
        if is_nearer {
            best = Some(end);
        }
        best.as_ref().is_some_and(|(_, fit)| fit.relative <= POLISHING.done)
    })?;
    Ok((best, free))
}

/// A member of a self-motion of the ideal mechanism that reaches the target within the tolerance, if a candidate leads to one.
fn find_member<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    within: f64,
    steps: &mut Steps,
) -> Result<Option<Joints<M>>, Error> {
    let (mut problem, mut member) = (Problem::new(mechanism, p, steps), None);
    propose(mechanism, p, |found, q| {
        if found.free != 0 {
            member = onto_self_motion(&mut problem, q, found.free, within);
        }
        member.is_some()
    })?;
    Ok(member)
}

/// Joint values next to `q` at which the ideal mechanism has a self-motion of the joints `free` and reaches the target within the tolerance.
fn onto_self_motion<M: Mechanism>(
    problem: &mut Problem<'_, M>,
    q: Joints<M>,
    free: u32,
    within: f64,
) -> Option<Joints<M>> {
    let is_within = |fit: Fit| fit.relative <= within;
    let (q, fit) = problem.fitted(q, free, LEAPS[0]);
    let q = if is_within(fit) { problem.freed(q, free) } else { None }?;
    let p = ideal_parameters(problem.mechanism, &q)?;
    let is_near = is_within(problem.measure(&q));
    let mut ideal = Problem::new(problem.mechanism, &p, problem.steps);
    (is_near && ideal.is_on_self_motion(&q, free, ACCEPTANCE.rounding)).then_some(q)
}

/// Adds joint values with which the ideal mechanism also reaches the target within the tolerance, and which are far from all solutions of the nearby target.
/// Such solutions exist at singular poses, where solutions part by as much as the target deviates, and near the boundary of the workspace, where two solutions
/// merge. Joint values are skipped if they belong to a self-motion at the nearby target, which `q` reaches.
fn add_others<M: Mechanism>(
    mechanism: &M,
    (p, within): (&Parameters<M>, f64),
    q: &Joints<M>,
    (out, count): (&mut [Solution<M>], usize),
    steps: &mut Steps,
) -> Result<usize, Error> {
    let (facts, mut problem, mut count) = (mechanism.facts(), Problem::new(mechanism, p, steps), count);
    let free = out[..count].iter().fold(0, |free, answer| free | answer.free);
    let ideal = if free == 0 { None } else { ideal_parameters(mechanism, q) };
    let is_member = |q: &Joints<M>, steps: &mut Steps| {
        ideal.as_ref().is_some_and(|p| Problem::new(mechanism, p, steps).has_member(q, free))
    };
    propose(mechanism, p, |found, q| {
        let is_far = |q: &Joints<M>| {
            let is_close = |other: &Solution<M>| facts.is_close(other.q.as_ref(), q.as_ref(), other.free, MERGING.blur);
            !out[..count].iter().any(is_close)
        };
        if count == out.len() || found.free == 0 && !is_far(&q) {
            return false;
        }
        let (q, fit) = problem.fitted(q, 0, LEAPS[0]);
        // On a stratum a joint may only appear free, because the remaining equations determine it: then no other joint values nearby are within the tolerance.
        let mut is_alone = || found.free == 0 || problem.regularity(&q) * MERGING.blur > within;
        if fit.relative <= within && is_far(&q) && is_alone() && !is_member(&q, problem.steps) {
            let Fit { residual, relative, .. } = fit;
            out[count] = Solution { q, residual, relative, branch: found.branch, ..Solution::empty(mechanism) };
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

/// All solutions of a target that fulfils its conditions. If there is none, the joint values with which the mechanism is nearest to it.
#[inline(never)]
pub(crate) fn solve_described<M: Mechanism>(
    mechanism: &M,
    target: &Inputs<M>,
    within: f64,
    out: &mut [Solution<M>],
    steps: &mut Steps,
) -> Result<(usize, Option<Solution<M>>), Error> {
    let p = mechanism.parameters(target);
    let described = Described(mechanism);
    let (Some((q, fit)), free) = closest(mechanism, &p, steps)? else { return Ok((0, None)) };
    let within = f64::max(within, ACCEPTANCE.residual);
    let is_reached = fit.relative <= within;
    if !is_reached {
        let mut nearest = Solution::empty(mechanism);
        nearest.q = q;
        fit_to(&mut Problem::new(&described, &p, steps), &mut nearest);
        return Ok((settle::<M>(steps, &mut [])?, Some(nearest)));
    }
    let member = if free == 0 { None } else { find_member(mechanism, &p, within, steps)? };
    let q = member.unwrap_or(q);
    let count = solve_ideal(mechanism, &ideal_target(mechanism, &q), out, steps)?;
    let count = add_others(mechanism, (&p, within), &q, (&mut *out, count), steps)?;
    let count = fit_all(&mut Problem::new(&described, &p, steps), &mut out[..count]);
    Ok((settle(steps, &mut out[..count])?, None))
}

/// The target that the ideal mechanism reaches.
fn ideal_target<M: Mechanism>(mechanism: &M, q: &Joints<M>) -> Inputs<M> {
    let facts = mechanism.facts();
    read_off::<M>(&facts, &mechanism.tip(&place::<M>(&facts, q, None)), q)
}

/// The parameters of that target.
fn ideal_parameters<M: Mechanism>(mechanism: &M, q: &Joints<M>) -> Option<Parameters<M>> {
    let mut target = ideal_target(mechanism, q);
    conform(mechanism.facts().conditions, target.as_mut()).ok()?;
    Some(mechanism.parameters(&target))
}

/// Moves a solution of the ideal mechanism to where the mechanism as described is nearest to the target.
fn fit_to<M: Mechanism>(problem: &mut Problem<'_, Described<'_, M>>, answer: &mut Solution<M>) {
    let (q, fit) = problem.fitted(answer.q.clone(), answer.free, MERGING.blur);
    (answer.q, answer.residual, answer.relative) = (q, fit.residual, fit.relative);
}

/// Moves all solutions in this manner, keeps those that are distinct and returns their number. A solution that would coincide with another one is not moved:
/// the ideal mechanism distinguishes them.
fn fit_all<M: Mechanism>(problem: &mut Problem<'_, Described<'_, M>>, out: &mut [Solution<M>]) -> usize {
    let facts = problem.facts();
    let mut kept = 0;
    for k in 0..out.len() {
        let is_new = |answer: &Solution<M>, before: &[Solution<M>]| {
            let is_same =
                |a: &Solution<M>| facts.is_close(a.q.as_ref(), answer.q.as_ref(), a.free | answer.free, MERGING.joints);
            !before.iter().any(is_same)
        };
        let mut answer = out[k].clone();
        fit_to(problem, &mut answer);
        if !is_new(&answer, &out[..kept]) {
            answer = out[k].clone();
            let Fit { residual, relative, .. } = problem.measure(&answer.q);
            (answer.residual, answer.relative) = (residual, relative);
        }
        if is_new(&answer, &out[..kept]) {
            out[kept] = answer;
            kept += 1;
        }
    }
    kept
}

/// Same as [`crate::Solve::solve_within`], for one solution. A member of a self-motion is moved along that of the ideal mechanism.
pub(crate) fn within_limits<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    answer: &Solution<M>,
    limits: &Joints<M, [f64; 2]>,
) -> Option<(Joints<M>, f64)> {
    let mut steps = Steps::at_most(MOST_STEPS);
    let strides = |steps: &mut Steps| {
        let within = f64::max(mechanism.facts().within?, ACCEPTANCE.residual);
        let mut own = Problem::new(mechanism, p, steps);
        let q =
            if answer.free == 0 { None } else { onto_self_motion(&mut own, answer.q.clone(), answer.free, within) }?;
        let ideal = ideal_parameters(mechanism, &q)?;
        let member = Solution { q, ..answer.clone() };
        let turned = turned_within::<M>(&mechanism.facts(), &member.q, limits);
        turned.or_else(|| Some(strides_within(&mut Problem::new(mechanism, &ideal, own.steps), &member, limits)?.0))
    };
    let q = turned_within::<M>(&mechanism.facts(), &answer.q, limits).or_else(|| strides(&mut steps))?;
    let described = Described(mechanism);
    let residual = Problem::new(&described, p, &mut steps).measure(&q).residual;
    Some((q, residual))
}

/// Same as [`crate::Solve::nearest_to`] along the self-motions of the ideal mechanism. The result is then moved to where the mechanism as described is nearest
/// to the target.
pub(crate) fn along_ideal<M: Mechanism>(
    mechanism: &M,
    p: &Parameters<M>,
    list: &[Solution<M>],
    (aim, listed): (&Aim<'_, M>, Option<Best<M>>),
    steps: &mut Steps,
) -> Option<Best<M>> {
    let (facts, described, mut best) = (mechanism.facts(), Described(mechanism), listed);
    let within = f64::max(facts.within?, ACCEPTANCE.residual);
    for (number, answer) in list.iter().enumerate().filter(|(_, answer)| answer.free != 0) {
        let mut own = Problem::new(mechanism, p, steps);
        let Some(q) = onto_self_motion(&mut own, answer.q.clone(), answer.free, within) else { continue };
        let Some(ideal) = ideal_parameters(mechanism, &q) else { continue };
        let problem = Problem::new(mechanism, &ideal, own.steps);
        let mut search = Search { problem, aim, best: best.take() };
        search.follow(&Solution { q, ..answer.clone() }, number);
        best = search.best;
        if let Some(found) = best.as_mut().filter(|found| found.is_of(number)) {
            let mut problem = Problem::new(&described, p, steps);
            let q = Array::by(facts.joints.len(), |i| facts.wrapped(i, found.q().as_ref()[i]));
            let (q, fit) = problem.fitted(q, answer.free, MERGING.blur);
            let turned = aim.turned(&facts, &q);
            if turned.excess == 0.0 {
                found.move_to(turned, (fit.residual, fit.relative));
            }
        }
    }
    best
}
