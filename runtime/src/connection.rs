//! Tests whether two members are on one self-motion: a continuous motion connects them, during which the equations hold.

use core::f64::consts::TAU;

use crate::effort::{ALONG, LEAPT, PACES, RETURNS};
use crate::joints::{beyond, differences, is_in, stepped};
use crate::mechanism::{Facts, Joints, Mechanism};
use crate::problem::{End, Problem};
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, POLISHING, SELF_MOTIONS};

/// Logarithm to base two of the maximal number of cubic curves between two members, plus one.
const DIVISIONS: usize = 5;

/// A member of a self-motion, with its tangent if that is known.
pub(crate) struct Member<'a, M: Mechanism> {
    pub q: &'a Joints<M>,
    pub tangent: Option<Joints<M>>,
}

/// A knot of the cubic curves on a self-motion: joint values, tangent, and displacement of the free joint.
struct Knot<M: Mechanism> {
    q: Joints<M>,
    tangent: Joints<M>,
    gone: f64,
}

impl<M: Mechanism> Knot<M> {
    /// The midpoint of the cubic curve to another knot.
    fn half_way(&self, facts: &Facts<'_>, other: &Self) -> Joints<M> {
        let (bend, apart) = (0.125 * (other.gone - self.gone), differences::<M>(facts, &other.q, &self.q));
        Array::by(facts.joints.len(), |i| {
            let turned = bend * (self.tangent.as_ref()[i] - other.tangent.as_ref()[i]);
            facts.wrapped(i, self.q.as_ref()[i] + 0.5 * apart.as_ref()[i] + turned)
        })
    }
}

impl<M: Mechanism> Problem<'_, M> {
    /// Whether a continuous motion of the joints, during which the equations hold, connects two members of self-motions with equal free joints. It is a
    /// straight line, or the free joints move straight and the others follow. If the shorter direction of rotation fails, a joint takes the longer one.
    pub fn leads_to(&mut self, a: &Joints<M>, b: &Joints<M>, free: u32) -> bool {
        let member = |q| Member { q, tangent: None };
        self.leads_straight_to(a, b, free) || self.leads_round_to(member(a), member(b), free)
    }

    /// Same as [`Problem::leads_to`] along a straight line, on which one joint may rotate in the longer direction.
    pub fn leads_straight_to(&mut self, a: &Joints<M>, b: &Joints<M>, free: u32) -> bool {
        let short = differences::<M>(&self.facts(), b, a);
        self.is_straight(a, &short) || self.opposite(&short, free).is_some_and(|long| self.is_straight(a, &long))
    }

    /// Same as [`Problem::leads_to`] where the free joints move and the others follow.
    pub fn leads_round_to(&mut self, a: Member<'_, M>, b: Member<'_, M>, free: u32) -> bool {
        let short = differences::<M>(&self.facts(), b.q, a.q);
        let long = self.opposite(&short, free);
        if self.are_joined_by_cubics(&a, &b, free, [Some(&short), long.as_ref()]) {
            return true;
        }
        let arrives = self.leads_along(a.q, b.q, free, &short);
        arrives.or_else(|| self.leads_along(a.q, b.q, free, &long?)).unwrap_or(false)
    }

    /// The displacement in which the free joint rotates in the opposite direction, if it is revolute.
    fn opposite(&self, delta: &Joints<M>, free: u32) -> Option<Joints<M>> {
        let joint = free.trailing_zeros() as usize;
        let turns = free.is_power_of_two() && self.facts().joints[joint].is_angle();
        let mut other = delta.clone();
        if turns {
            other.as_mut()[joint] -= if delta.as_ref()[joint] < 0.0 { -TAU } else { TAU };
        }
        turns.then_some(other)
    }

    /// Whether the equations hold on the straight line along `delta`, as for coincident axes.
    fn is_straight(&mut self, a: &Joints<M>, delta: &Joints<M>) -> bool {
        [0.5, 0.25, 0.75].iter().all(|share| {
            let at = Array::by(self.joints(), |i| a.as_ref()[i] + share * delta.as_ref()[i]);
            self.measure(&at).relative <= ACCEPTANCE.rounding
        })
    }

    /// Whether cubic curves connect two members of a self-motion along one of two displacements of a free joint. Not tried where the displacement is shorter
    /// than the first step of following it.
    fn are_joined_by_cubics(
        &mut self,
        a: &Member<'_, M>,
        b: &Member<'_, M>,
        free: u32,
        deltas: [Option<&Joints<M>>; 2],
    ) -> bool {
        let joint = free.trailing_zeros() as usize;
        let is_far = |delta: &&Joints<M>| free.is_power_of_two() && delta.as_ref()[joint].abs() > ALONG[1];
        if !deltas[0].is_some_and(|delta| is_far(&delta)) {
            return false;
        }
        let mut tangent = |member: &Member<'_, M>| member.tangent.clone().or_else(|| self.tangent(member.q, free));
        let (Some(at_a), Some(at_b)) = (tangent(a), tangent(b)) else { return false };
        deltas.into_iter().flatten().any(|delta| {
            let delta = delta.as_ref()[joint];
            let ends = [(a.q, &at_a, 0.0), (b.q, &at_b, delta)];
            self.is_interpolated(
                ends.map(|(q, tangent, gone)| Knot { q: q.clone(), tangent: tangent.clone(), gone }),
                joint,
            )
        })
    }

    /// Whether cubic Hermite curves approximate the self-motion between two of its places. Half-way along each curve, the correction of the other joints must
    /// be at most `MERGING.apart`. Otherwise the curve is divided there, until it is too short. (The curves have the self-motion's tangents at their ends.
    /// Their error is of fourth order in their length.)
    fn is_interpolated(&mut self, [first, last]: [Knot<M>; 2], joint: usize) -> bool {
        let (facts, free, start) = (self.facts(), 1 << joint, first.q.as_ref()[joint]);
        let (mut at, mut count) = (Some(first), 1);
        let mut ends: [Option<Knot<M>>; DIVISIONS] = [const { None }; DIVISIONS];
        ends[0] = Some(last);
        while count > 0 {
            let (Some(near), Some(far)) = (&at, &ends[count - 1]) else { return false };
            let (mut middle, gone) = (near.half_way(&facts, far), 0.5 * (near.gone + far.gone));
            middle.as_mut()[joint] = facts.wrapped(joint, start + gone);
            let Some((q, _)) = self.corrected(middle.clone(), free) else { return false };
            if facts.farthest(q.as_ref(), middle.as_ref()) <= MERGING.apart {
                count -= 1;
                at = ends[count].take();
            } else if count < DIVISIONS {
                let tangent = self.tangent(&q, free);
                ends[count] = tangent.map(|tangent| Knot { q, tangent, gone });
                count += 1;
            } else {
                return false;
            }
        }
        true
    }

    /// Whether the joints arrive at `b` as the free ones are displaced by `delta` from `a` and the others follow, with step size control. `None` where they do
    /// not follow.
    fn leads_along(&mut self, a: &Joints<M>, b: &Joints<M>, free: u32, delta: &Joints<M>) -> Option<bool> {
        let facts = self.facts();
        let freed: Joints<M> = Array::by(self.joints(), |i| if is_in(free, i) { delta.as_ref()[i] } else { 0.0 });
        let (length, [shortest, first, longest]) = (facts.longest(freed.as_ref()), ALONG);
        let (mut before, mut at) = (a.clone(), a.clone());
        let (mut gone, mut last, mut pace) = (0.0, 1.0, first);
        for _ in 0..PACES {
            if self.steps.are_spent() {
                return None;
            }
            let is_last = pace >= length - gone;
            let (step, share) = if is_last { (length - gone, 1.0) } else { (pace, (gone + pace) / length) };
            let mut ahead = beyond::<M>(&facts, &before, &at, step / last);
            for i in (0..self.joints()).filter(|&i| is_in(free, i)) {
                ahead.as_mut()[i] = facts.wrapped(i, a.as_ref()[i] + share * delta.as_ref()[i]);
            }
            let next = self.followed(ahead, free);
            if let Some(next) = next {
                if is_last {
                    return Some(self.is_there(next, b, free));
                }
                (before, at) = (at, next.0);
                (gone, last, pace) = (gone + step, step, f64::min(2.0 * pace, longest));
            } else if pace > shortest {
                pace *= 0.25;
            } else {
                return None;
            }
        }
        None
    }

    /// The solution for the other joints after the free joints were moved, if it is near: by a few steps.
    fn followed(&mut self, ahead: Joints<M>, free: u32) -> Option<End<M>> {
        let end = self.corrected(ahead.clone(), free)?;
        (self.facts().farthest(end.0.as_ref(), ahead.as_ref()) <= LEAPT).then_some(end)
    }

    /// Same as [`Problem::followed`], however far it is.
    pub fn corrected(&mut self, ahead: Joints<M>, free: u32) -> Option<End<M>> {
        let mut end = self.measured(ahead);
        for _ in 0..RETURNS {
            if end.1.relative <= SELF_MOTIONS.curve || self.steps.are_spent() {
                break;
            }
            let step = self.newton_step(&end.0, POLISHING.dampings[1], free)?;
            end = self.measured(stepped::<M>(&self.facts(), &end.0, &step));
        }
        (end.1.relative <= SELF_MOTIONS.curve).then_some(end)
    }

    /// Whether joint values next to a member of a self-motion are on that self-motion: the equations hold half-way too.
    fn is_there(&mut self, end: End<M>, b: &Joints<M>, free: u32) -> bool {
        let (q, fit) = self.polish(end, free);
        let is_close = fit.accepted && self.facts().is_within(q.as_ref(), b.as_ref(), MERGING.apart);
        is_close && self.are_joined(&q, b, ACCEPTANCE.rounding, free)
    }
}
