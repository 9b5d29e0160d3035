//! The solution nearest to reference joint values, on the self-motions of a singular target too: [`Search`].
//!
//! Where a self-motion is a curve, it is followed from its listed member by tangents and Newton steps with one joint held (E. L. Allgower and K. Georg,
//! Numerical Continuation Methods, 1990, chapter 3). Golden sections locate each local minimum of the distance (J. Kiefer, Proceedings of the American
//! Mathematical Society 4 (1953) 502-506). On surfaces, and next to the reference, Gauss-Newton steps minimise the distance subject to the equations: this
//! minimum is a local one.

use crate::arithmetic::Arithmetic;
use crate::curve_steps::farthest;
use crate::effort::{DESCENTS, LEAPS, RETURNS};
use crate::joints::{beyond, differences, is_in, shifted, stepped};
use crate::limits::{Aim, Turned};
use crate::mechanism::{Joints, Mechanism};
use crate::problem::{End, Problem};
use crate::solution::Solution;
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS, POLISHING};

/// The shortest, the first and the longest step along a self-motion (rad, or relative to the length scale).
const PACE: [f64; 3] = [1.5e-3, 2.5e-2, 0.2];
/// Maximal number of steps in one direction.
const PACES: usize = 600;
/// A correction must be at most this share of the step before it. Otherwise it may lead to another self-motion.
const STRAIGHT: f64 = 0.25;
/// Number of golden sections. They shorten two steps to less than 1e-10.
const SECTIONS: usize = 48;
/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Between two places on a self-motion the joints move by at most this multiple of their distance.
const LONGER: f64 = 2.0;

/// The nearest solution so far.
pub(crate) struct Best<M: Mechanism> {
    turned: Turned<M>,
    residual: f64,
    relative: f64,
    /// The index of the listed solution on the same self-motion, if it is known.
    member: Option<usize>,
}

/// A place on a self-motion.
struct Spot<M: Mechanism> {
    q: Joints<M>,
    turned: Turned<M>,
}

/// The search along self-motions.
pub(crate) struct Search<'s, 'a, M: Mechanism> {
    pub problem: Problem<'a, M>,
    pub aim: &'s Aim<'s, M>,
    pub best: Option<Best<M>>,
}

impl<M: Mechanism> Best<M> {
    /// The listed solution with this index.
    pub fn listed(turned: Turned<M>, list: &[Solution<M>], member: usize) -> Self {
        Best { turned, residual: list[member].residual, relative: list[member].relative, member: Some(member) }
    }

    /// The index of the listed solution on the same self-motion, if it is known.
    pub fn member(&self) -> Option<usize> {
        self.member
    }

    /// The solution and its distance. What is not known of it is that of the listed solution `like`.
    pub fn solution(self, like: &Solution<M>) -> (Solution<M>, f64) {
        let Best { turned, residual, relative, .. } = self;
        (Solution { q: turned.q, residual, relative, ..like.clone() }, turned.distance)
    }

    /// The joint values, not wrapped.
    pub fn q(&self) -> &Joints<M> {
        &self.turned.q
    }

    /// Whether a listed solution is the nearest.
    pub fn is_of(&self, member: usize) -> bool {
        self.member == Some(member)
    }

    /// Moves the solution to joint values with these residuals.
    pub fn move_to(&mut self, turned: Turned<M>, (residual, relative): (f64, f64)) {
        (self.turned, self.residual, self.relative) = (turned, residual, relative);
    }
}

impl<M: Mechanism> Search<'_, '_, M> {
    /// Searches next to the reference, then along the self-motion of each listed member.
    pub fn all(&mut self, list: &[Solution<M>]) {
        self.descend(self.aim.reference.clone(), None);
        for (number, member) in list.iter().enumerate().filter(|(_, answer)| answer.free != 0) {
            if self.is_reached() {
                break;
            }
            self.follow(member, number);
        }
    }

    /// Searches next to the reference if it is a solution itself. Next to a singular pose rounding moves the listed solution away from it.
    pub fn beside(&mut self) {
        if !self.is_reached() {
            let fit = self.problem.measure(self.aim.reference);
            if fit.relative <= ACCEPTANCE.unsettled {
                self.descend(self.aim.reference.clone(), None);
            }
        }
    }

    /// Whether a listed solution, or one on its self-motion, equals the reference within rounding.
    fn is_reached(&self) -> bool {
        let rounding = ACCEPTANCE.rounding * ACCEPTANCE.rounding;
        self.best.as_ref().is_some_and(|best| best.member.is_some() && best.turned.distance <= rounding)
    }

    /// Keeps joint values if they are a solution within limits and nearer than the others.
    fn consider(&mut self, (q, fit): &End<M>, member: Option<usize>) -> Turned<M> {
        let facts = self.problem.facts();
        let turned = self.aim.turned(&facts, q);
        if !fit.accepted || turned.excess > 0.0 {
            return turned;
        }
        if let Some(best) = &mut self.best
            && best.turned.distance <= turned.distance
        {
            let is_same = best.member.is_none()
                && facts.farthest(best.turned.wrapped(&facts).as_ref(), q.as_ref()) <= MERGING.apart;
            best.member = if is_same { member } else { best.member };
            return turned;
        }
        let (residual, relative) = (fit.residual, fit.relative);
        self.best = Some(Best { turned: turned.clone(), residual, relative, member });
        turned
    }

    /// Follows the self-motion of a member in both directions if it is a curve. Otherwise the distance is minimised from the member.
    pub fn follow(&mut self, member: &Solution<M>, number: usize) {
        let Some(tangent) = self.problem.direction(&member.q, member.free) else {
            self.descend(member.q.clone(), Some(number));
            return;
        };
        let home = self.spot(member.q.clone());
        let opposite = Array::by(self.problem.joints(), |i| -tangent.as_ref()[i]);
        if !self.is_closed(&home, &tangent, number) {
            self.is_closed(&home, &opposite, number);
        }
    }

    fn spot(&self, q: Joints<M>) -> Spot<M> {
        Spot { turned: self.aim.turned(&self.problem.facts(), &q), q }
    }

    /// Follows a curve from home and searches each local minimum on it. Returns whether it leads back home.
    fn is_closed(&mut self, home: &Spot<M>, tangent: &Joints<M>, number: usize) -> bool {
        let opposite = Array::by(self.problem.joints(), |i| -tangent.as_ref()[i]);
        let (mut back, mut pace, mut is_home) = (PACE[1], PACE[1], false);
        let mut before = self.step(&home.q, &opposite, &mut back);
        let (mut at, mut tangent) = (home.clone(), tangent.clone());
        for number_of_steps in 0..PACES {
            let Some(next) = self.step(&at.q, &tangent, &mut pace) else { break };
            if let Some(before) = &before {
                self.bracket([before, &at, &next], number);
            }
            if is_home {
                return true;
            }
            is_home = number_of_steps > 1 && self.passes(home, &at, &next);
            let Some(direction) = self.problem.direction_along(&next.q, &tangent) else { break };
            tangent = direction;
            (before, at) = (Some(at), next);
        }
        let end = self.problem.polished(at.q.clone(), 1 << farthest(tangent.as_ref()));
        self.consider(&end, Some(number));
        false
    }

    /// Whether the step from `at` to `next` passes home.
    fn passes(&self, home: &Spot<M>, at: &Spot<M>, next: &Spot<M>) -> bool {
        let facts = self.problem.facts();
        let (step, delta) = (differences::<M>(&facts, &next.q, &at.q), differences::<M>(&facts, &home.q, &at.q));
        let (mut along, mut square) = (0.0, 0.0);
        for (step, delta) in step.as_ref().iter().zip(delta.as_ref()) {
            along += step * delta;
            square += step * step;
        }
        let foot = beyond::<M>(&facts, &at.q, &next.q, along / square - 1.0);
        let length = facts.longest(step.as_ref());
        along >= 0.0 && along <= square && facts.farthest(foot.as_ref(), home.q.as_ref()) <= STRAIGHT * length
    }

    /// The place after a step along a tangent, which is shortened where the curve bends.
    fn step(&mut self, from: &Joints<M>, tangent: &Joints<M>, pace: &mut f64) -> Option<Spot<M>> {
        let (facts, held) = (self.problem.facts(), 1 << farthest(tangent.as_ref()));
        while *pace >= PACE[0] {
            let delta = Array::by(self.problem.joints(), |i| *pace * tangent.as_ref()[i]);
            let ahead = shifted::<M>(&facts, from, &delta);
            let end = self.problem.corrected(ahead.clone(), held);
            if let Some((q, _)) = end
                && facts.farthest(q.as_ref(), ahead.as_ref()) <= STRAIGHT * *pace
            {
                *pace = f64::min(2.0 * *pace, PACE[2]);
                return Some(self.spot(q));
            }
            *pace *= 0.5;
        }
        None
    }

    /// Searches a minimum between three consecutive places if the middle one is the best of them: nearest to the limits, then nearest to the reference.
    fn bracket(&mut self, places: [&Spot<M>; 3], number: usize) {
        let [a, b, c] = places.map(|place| &place.turned);
        if a.is_better(b) || c.is_better(b) || self.is_hopeless(places) {
            return;
        }
        let held = 1 << farthest(differences::<M>(&self.problem.facts(), &places[2].q, &places[0].q).as_ref());
        let (mut low, mut high) = (-1.0, 1.0);
        let (mut left, mut right) = (low + (1.0 - GOLDEN) * (high - low), low + GOLDEN * (high - low));
        let mut at_left = self.between(places, left, held, number);
        let mut at_right = self.between(places, right, held, number);
        for _ in 0..SECTIONS {
            if at_left.is_better(&at_right) {
                (high, right, at_right) = (right, left, at_left);
                left = low + (1.0 - GOLDEN) * (high - low);
                at_left = self.between(places, left, held, number);
            } else {
                (low, left, at_left) = (left, right, at_right);
                right = low + GOLDEN * (high - low);
                at_right = self.between(places, right, held, number);
            }
        }
    }

    /// Whether no place between three consecutive ones is nearer than the best solution so far.
    fn is_hopeless(&self, [a, b, c]: [&Spot<M>; 3]) -> bool {
        let Some(best) = &self.best else { return false };
        let facts = self.problem.facts();
        let [back, ahead] = [a, c].map(|side| differences::<M>(&facts, &side.q, &b.q));
        let mut square = 0.0;
        for (i, weight) in self.aim.weights.as_ref().iter().enumerate() {
            let most = LONGER * f64::max(back.as_ref()[i].abs(), ahead.as_ref()[i].abs());
            square += weight * most * most;
        }
        let least = Arithmetic::sqrt(b.turned.distance) - Arithmetic::sqrt(square);
        least > Arithmetic::sqrt(best.turned.distance)
    }

    /// The place on the curve at a share, from -1 to 1, of the distances from the middle one of three places.
    fn between(&mut self, [a, b, c]: [&Spot<M>; 3], share: f64, held: u32, number: usize) -> Turned<M> {
        let side = if share < 0.0 { a } else { c };
        let start = beyond::<M>(&self.problem.facts(), &side.q, &b.q, -share.abs());
        let end = self.problem.polished(start, held);
        self.consider(&end, Some(number))
    }

    /// Minimises the distance subject to the equations by Gauss-Newton steps from `q`. A joint that reaches its limit stays there.
    pub fn descend(&mut self, q: Joints<M>, member: Option<usize>) {
        let (facts, mut held) = (self.problem.facts(), 0);
        let mut q = shifted::<M>(&facts, &q, &Array::by(facts.joints.len(), |_| 0.0));
        self.aim.stop_at_limits(&facts, &mut q);
        for _ in 0..DESCENTS {
            let toward = self.toward(&q, held);
            let Some(step) = self.projected(&q, &toward, held) else { return };
            let mut next = shifted::<M>(&facts, &q, &step);
            held |= self.aim.stop_at_limits(&facts, &mut next);
            let end = self.settled(next, held);
            self.consider(&end, member);
            let moved = facts.farthest(end.0.as_ref(), q.as_ref());
            q = end.0;
            if moved <= POLISHING.step || moved.is_nan() {
                return;
            }
        }
    }

    /// The displacement to the reference within limits, shortened to a leap. Joints that are `held` do not move.
    fn toward(&self, q: &Joints<M>, held: u32) -> Joints<M> {
        let facts = self.problem.facts();
        let (turned, aim) = (self.aim.turned(&facts, q), self.aim);
        let delta: Joints<M> = Array::by(facts.joints.len(), |i| {
            let [low, high] = aim.limits.as_ref()[i];
            let wanted = f64::min(f64::max(aim.reference.as_ref()[i], low), high);
            if is_in(held, i) { 0.0 } else { wanted - turned.q.as_ref()[i] }
        });
        let longest = facts.longest(delta.as_ref());
        let share = if longest > LEAPS[0] { LEAPS[0] / longest } else { 1.0 };
        Array::by(facts.joints.len(), |i| share * delta.as_ref()[i])
    }

    /// The displacement with which the linearised equations hold, nearest to `toward` by the weights.
    fn projected(&mut self, q: &Joints<M>, toward: &Joints<M>, held: u32) -> Option<Joints<M>> {
        if self.problem.steps.are_spent() {
            return None;
        }
        let greatest = self.aim.weights.as_ref().iter().fold(0.0, |greatest, weight| f64::max(greatest, *weight));
        let scale: Joints<M> = Array::by(self.problem.joints(), |i| {
            let weight = f64::max(PIVOTS.regular * greatest, self.aim.weights.as_ref()[i]);
            if greatest > 0.0 { Arithmetic::sqrt(greatest / weight) } else { 1.0 }
        });
        let (mut derivatives, mut values) = self.problem.slopes(q);
        for (value, row) in values.as_mut().iter_mut().zip(derivatives.as_mut()) {
            for (i, slope) in row.as_mut().iter_mut().enumerate() {
                *value += *slope * toward.as_ref()[i];
                *slope *= scale.as_ref()[i];
            }
        }
        let back = self.problem.triangle_of(&derivatives, &values, POLISHING.dampings[1], held).substituted()?;
        Some(Array::by(self.problem.joints(), |i| toward.as_ref()[i] - scale.as_ref()[i] * back.as_ref()[i]))
    }

    /// The joint values after a few Newton steps, each the shortest one.
    fn settled(&mut self, q: Joints<M>, held: u32) -> End<M> {
        let mut end = self.problem.measured(q);
        for _ in 0..RETURNS {
            if end.1.relative <= ACCEPTANCE.rounding {
                break;
            }
            let Some(step) = self.problem.newton_step(&end.0, POLISHING.dampings[1], held) else { break };
            end = self.problem.measured(stepped::<M>(&self.problem.facts(), &end.0, &step));
        }
        end
    }
}

impl<M: Mechanism> Clone for Spot<M> {
    fn clone(&self) -> Self {
        Spot { q: self.q.clone(), turned: self.turned.clone() }
    }
}

impl<M: Mechanism> Problem<'_, M> {
    /// The tangent of a self-motion at `q`, with its longest component equal to one. The joints of a set are tried first as its parameter. `None` unless the
    /// self-motion is a curve there.
    fn direction(&mut self, q: &Joints<M>, first: u32) -> Option<Joints<M>> {
        let joints = self.joints();
        let order = (0..2 * joints).filter(|&i| is_in(first, i % joints) == (i < joints));
        let tangent = order.map(|i| 1 << (i % joints)).find_map(|free| self.tangent(q, free))?;
        let longest = self.facts().longest(tangent.as_ref());
        (longest > PIVOTS.regular).then(|| Array::by(joints, |i| tangent.as_ref()[i] / longest))
    }

    /// Same as [`Problem::direction`], on the side of the tangent before.
    fn direction_along(&mut self, q: &Joints<M>, before: &Joints<M>) -> Option<Joints<M>> {
        let tangent = self.direction(q, 1 << farthest(before.as_ref()))?;
        let along = tangent.as_ref().iter().zip(before.as_ref()).fold(0.0, |along, (a, b)| along + a * b);
        let side = if along < 0.0 { -1.0 } else { 1.0 };
        Some(Array::by(self.joints(), |i| side * tangent.as_ref()[i]))
    }
}
