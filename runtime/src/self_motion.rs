//! Tests whether solutions are members of a self-motion, and of which: free joints are moved, and the others must follow.

use crate::effort::{ASIDE, DOUBLINGS, NARROWS};
use crate::joints::{beyond, is_in, moved};
use crate::mechanism::{Equations, Joints, Mechanism};
use crate::problem::Problem;
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, PIVOTS};

impl<M: Mechanism> Problem<'_, M> {
    /// Whether the equations also hold, within `bound` or rounding, when the joints `free` are moved and the others follow. One direction suffices, because in
    /// the other one the self-motion may branch. Where `q` is not singular this is false without a trial. A self-motion may cover only a small part of the
    /// circle. Where `q` is singular within rounding, shorter displacements are therefore tried, each an eighth of the one before.
    pub fn is_on_self_motion(&mut self, q: &Joints<M>, free: u32, bound: f64) -> bool {
        let regularity = self.regularity(q);
        self.leads_to_self_motion(q, free, bound, regularity)
    }

    /// Same as [`Problem::is_on_self_motion`] within rounding, without self-motions that cover only a small part of the circle.
    pub fn is_on_long_self_motion(&mut self, q: &Joints<M>, free: u32) -> bool {
        self.regularity(q) <= PIVOTS.regular && self.leads_far_aside(q, free)
    }

    fn leads_far_aside(&mut self, q: &Joints<M>, free: u32) -> bool {
        !self.steps.are_spent()
            && [ASIDE, -ASIDE].iter().any(|delta| self.leads_aside(q, free, *delta, ACCEPTANCE.rounding))
    }

    /// A joint that alone parametrises a self-motion, as a set. Of the joints that some case frees, it is the one found first. If the formulas are those of a
    /// nearby mechanism and free none, it may be any joint.
    pub fn joint_on_self_motion(&mut self, q: &Joints<M>, bound: f64) -> Option<u32> {
        if self.facts().freed.is_empty() && self.facts().nearby.is_none() {
            return None;
        }
        let regularity = self.regularity(q);
        self.joint_that(|problem, free| problem.leads_to_self_motion(q, free, bound, regularity))
    }

    /// Same as [`Problem::joint_on_self_motion`], for long self-motions within rounding and singular joint values.
    pub fn joint_on_long_self_motion(&mut self, q: &Joints<M>) -> Option<u32> {
        self.joint_that(|problem, free| problem.leads_far_aside(q, free))
    }

    fn joint_that(&mut self, moves: impl Fn(&mut Self, u32) -> bool) -> Option<u32> {
        let facts = self.facts();
        let is_any = facts.freed.is_empty() && facts.nearby.is_some();
        let may = |joint: &&usize| is_any || facts.freed.contains(joint);
        facts.last_first.iter().rev().filter(may).map(|joint| 1 << joint).find(|free| moves(self, *free))
    }

    /// Whether joint values next to `q` reach the target and are on a self-motion of one of the joints `free`.
    pub fn has_member(&mut self, q: &Joints<M>, free: u32) -> bool {
        let (q, fit) = self.polished(q.clone(), 0);
        fit.accepted
            && (0..self.joints()).any(|i| is_in(free, i) && self.is_on_self_motion(&q, 1 << i, ACCEPTANCE.rounding))
    }

    fn leads_to_self_motion(&mut self, q: &Joints<M>, free: u32, bound: f64, regularity: f64) -> bool {
        let bound = f64::max(bound, ACCEPTANCE.rounding);
        if regularity > PIVOTS.regular || self.steps.are_spent() {
            return false;
        }
        let narrows = if bound > ACCEPTANCE.rounding || regularity > PIVOTS.singular { 1 } else { NARROWS };
        // If the last displacement but one fails, longer ones fail too.
        let may =
            narrows == 1 || [1.0, -1.0].iter().any(|side| self.sets_out(q, free, side * narrowed(NARROWS - 2), bound));
        may && (0..narrows).any(|narrow| {
            let delta = narrowed(narrow);
            self.leads_aside(q, free, delta, bound) || self.leads_aside(q, free, -delta, bound)
        })
    }

    /// Whether the others follow when the joints `free` are moved by the first stage of a displacement.
    fn sets_out(&mut self, q: &Joints<M>, free: u32, delta: f64, bound: f64) -> bool {
        let start = self.moved_all(q, q, free, delta / FIRST_STAGE);
        self.polished(start, free).1.relative <= bound
    }

    /// The joint values `others`, with those that are `free` displaced from `q`.
    fn moved_all(&self, others: &Joints<M>, q: &Joints<M>, free: u32, delta: f64) -> Joints<M> {
        let mut next = others.clone();
        for i in (0..self.joints()).filter(|&i| is_in(free, i)) {
            next.as_mut()[i] = moved::<M>(&self.facts(), q, i, delta).as_ref()[i];
        }
        next
    }

    /// Whether the others follow in one direction. The displacement is doubled until it has its full length. From a short one the joints must return to `q`:
    /// steps may lead from an isolated solution to a self-motion next to it, but not back.
    fn leads_aside(&mut self, q: &Joints<M>, free: u32, delta: f64, bound: f64) -> bool {
        let (mut before, mut at) = (q.clone(), q.clone());
        let mut share = 1.0 / FIRST_STAGE;
        for stage in 0..DOUBLINGS {
            let ahead = beyond::<M>(&self.facts(), &before, &at, if stage == 1 { 1.0 } else { 2.0 });
            let start = self.moved_all(&ahead, q, free, share * delta);
            let start = self.measured(start);
            let (next, fit) = if start.1.relative <= bound { start } else { self.polish(start, free) };
            if fit.relative > bound || (stage == 1 && !self.leads_back(q, free, &at, &next, bound)) {
                return false;
            }
            (before, at) = (at, next);
            share *= 2.0;
        }
        true
    }

    /// Whether steps return to `q` on the line from `far` through `near`.
    fn leads_back(&mut self, q: &Joints<M>, free: u32, near: &Joints<M>, far: &Joints<M>, bound: f64) -> bool {
        let mut back = beyond::<M>(&self.facts(), far, near, 1.0);
        for i in (0..self.joints()).filter(|&i| is_in(free, i)) {
            back.as_mut()[i] = q.as_ref()[i];
        }
        let (back, fit) = self.polished(back, free);
        fit.accepted && self.are_joined(&back, q, bound, free)
    }

    /// The tangent of the self-motion at `q`: the derivatives of all joints by one free joint. `None` unless the self-motion is a curve there that this joint
    /// parametrises.
    pub fn tangent(&mut self, q: &Joints<M>, free: u32) -> Option<Joints<M>> {
        if !free.is_power_of_two() {
            return None;
        }
        let derivatives = self.derivatives(&self.place(q));
        let joint = free.trailing_zeros() as usize;
        let ahead: Equations<M> = Array::by(self.facts().size_of.len(), |i| derivatives.as_ref()[i].as_ref()[joint]);
        let triangle = self.triangle_of(&derivatives, &ahead, 0.0, free);
        let back = if triangle.regularity() > PIVOTS.regular { triangle.substituted() } else { None }?;
        Some(Array::by(self.joints(), |i| if i == joint { 1.0 } else { -back.as_ref()[i] }))
    }
}

/// Inverse of the share of the first stage in a displacement.
const FIRST_STAGE: f64 = (1 << (DOUBLINGS - 1)) as f64;

/// One of the trial displacements, each an eighth of the one before.
fn narrowed(narrow: usize) -> f64 {
    (0..narrow).fold(ASIDE, |delta, _| delta / 8.0)
}
