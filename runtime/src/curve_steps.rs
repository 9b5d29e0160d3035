//! Steps along a curve on which the equations of a nearby mechanism hold almost: [`Place`] and the next one. See [`crate::curve`].

use crate::joints::{beyond, differences, shifted, stepped};
use crate::mechanism::{Equations, Joints, Mechanism};
use crate::problem::Problem;
use crate::starts::product;
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, PIVOTS, SELF_MOTIONS, STRATA};

/// Maximal number of least-squares steps that correct a place onto the curve.
const ROUNDS: usize = 6;
/// Maximal movement of a joint in such a step (rad, or relative to the length scale).
const BOUND: f64 = 0.5;
/// The shortest, the first and the longest step along the curve (rad, or relative to the length scale).
pub(crate) const PACE: [f64; 3] = [1.5e-3, 2.5e-2, 0.1];
/// The end of a step must be no farther from the extrapolated line than this share of the step's length. Otherwise it may be on another curve.
const STRAIGHT: f64 = 0.5;
/// Distances from a crossing at which the other curve is searched for (rad, or relative to the length scale).
const ASIDE: [f64; 3] = [0.1, 0.2, 0.4];
/// A place on the other curve is at most this factor times the distance from the crossing.
const ASTRAY: f64 = 3.0;
/// The least squared cosine between the residual vectors at two consecutive places.
const ALIGNED: f64 = 0.5;
/// The largest ratio of the squared residuals at two consecutive places.
const FEWFOLD: f64 = 30.0;
/// A curve whose relative residual nowhere exceeds this is a self-motion. The factor leaves room for the tolerance of solutions next to an exact self-motion.
pub(crate) const WHOLE: f64 = 10.0 * ACCEPTANCE.residual;

/// A place on a curve.
pub(crate) struct Place<M: Mechanism> {
    pub q: Joints<M>,
    /// The relative residuals there.
    pub miss: Equations<M>,
    /// The largest of them.
    pub most: f64,
    /// The least pivot of the joints that follow the one that is held, relative to the largest. It is small where another curve crosses.
    pub pivot: f64,
}

impl<M: Mechanism> Clone for Place<M> {
    fn clone(&self) -> Self {
        Place { q: self.q.clone(), miss: self.miss.clone(), ..*self }
    }
}

impl<M: Mechanism> Place<M> {
    /// The scalar product of the residual vectors of two places.
    pub fn along(&self, other: &Place<M>) -> f64 {
        product(self.miss.as_ref(), other.miss.as_ref())
    }

    /// Whether the residual vector changes little from another place, or only its sign: then no solution between the two is missed.
    pub fn goes_on(&self, other: &Place<M>) -> bool {
        let [here, there, along] = [self.along(self), other.along(other), self.along(other)];
        let is_aligned = along * along > ALIGNED * here * there;
        let is_flat = (ACCEPTANCE.rounding..=WHOLE).contains(&self.most);
        is_aligned && !is_flat && (along < 0.0 || f64::max(here, there) <= FEWFOLD * f64::min(here, there))
    }
}

impl<M: Mechanism> Problem<'_, M> {
    /// The place on the curve next to `q`, and the joint that is held to reach it. This is a free joint. Where none is free, or the others move without it, it
    /// is the joint that moves farthest in the direction in which the equations change least.
    pub fn start(&mut self, q: &Joints<M>, free: u32) -> Option<(Place<M>, usize)> {
        let of_free = if free == 0 { None } else { self.start_with(q, free.trailing_zeros() as usize) };
        if of_free.is_some() {
            return of_free;
        }
        let triangle = self.triangle(q, 0.0, 0);
        let held = farthest(self.stillest(triangle)?.0.as_ref());
        self.start_with(q, held)
    }

    /// The place next to `q` reached with one joint held, if it is on a curve along which all other joints follow.
    pub fn start_with(&mut self, q: &Joints<M>, held: usize) -> Option<(Place<M>, usize)> {
        let place = self.settled(q.clone(), held)?;
        (self.regularity_of(&place.q, 1 << held) > PIVOTS.weak).then_some((place, held))
    }

    /// Takes least-squares steps with one joint held, until they are short.
    pub fn settled(&mut self, mut q: Joints<M>, held: usize) -> Option<Place<M>> {
        for _ in 0..ROUNDS {
            if self.steps.are_spent() {
                return None;
            }
            let (derivatives, mut miss) = self.shared(&q);
            let triangle = self.triangle_of(&derivatives, &miss, 0.0, 1 << held);
            let step = triangle.substituted()?;
            let longest = self.facts().longest(step.as_ref());
            if longest > BOUND {
                return None;
            }
            q = stepped::<M>(&self.facts(), &q, &step);
            if longest <= SELF_MOTIONS.curve {
                for (value, row) in miss.as_mut().iter_mut().zip(derivatives.as_ref()) {
                    let slopes = row.as_ref().iter().zip(step.as_ref());
                    *value = slopes.fold(*value, |rest, (slope, delta)| rest - slope * delta);
                }
                let most = miss.as_ref().iter().fold(0.0, |most, value| f64::max(most, value.abs()));
                let pivot = triangle.regularity();
                return (most <= STRATA.near).then_some(Place { q, miss, most, pivot });
            }
        }
        None
    }

    /// The place on the curve at a fraction `share` of the distance from `a` to `b`.
    pub fn between(&mut self, a: &Place<M>, b: &Place<M>, share: f64) -> Option<Place<M>> {
        let facts = self.facts();
        let held = farthest(differences::<M>(&facts, &b.q, &a.q).as_ref());
        self.settled(beyond::<M>(&facts, &b.q, &a.q, -share), held)
    }

    /// A step along the curve from `at`, shorter where it bends, and its length. `None` where the curve ends.
    pub fn pace(&mut self, before: &Place<M>, at: &Place<M>, last: f64, pace: &mut f64) -> Option<(Place<M>, f64)> {
        let facts = self.facts();
        let held = farthest(differences::<M>(&facts, &at.q, &before.q).as_ref());
        while *pace >= PACE[0] {
            let ahead = beyond::<M>(&facts, &before.q, &at.q, *pace / last);
            let is_straight = |next: &Place<M>| {
                let is_near = facts.farthest(next.q.as_ref(), ahead.as_ref()) <= STRAIGHT * *pace;
                is_near && (*pace <= PACE[1] || next.goes_on(at))
            };
            if let Some(next) = self.settled(ahead.clone(), held).filter(is_straight) {
                let length = facts.farthest(next.q.as_ref(), at.q.as_ref());
                *pace = f64::min(2.0 * *pace, PACE[2]);
                return Some((next, length));
            }
            *pace *= 0.5;
        }
        None
    }

    /// Places on either side of `at` on a curve that crosses the one from `before` there. It leads in the direction in which the equations change least while
    /// the joint that is held on the first curve does not move.
    pub fn aside(&mut self, before: &Place<M>, at: &Place<M>) -> [Option<Place<M>>; 2] {
        let facts = self.facts();
        let held = farthest(differences::<M>(&facts, &at.q, &before.q).as_ref());
        let triangle = self.shares(&at.q, 0.0, 1 << held);
        let Some((direction, _)) = self.stillest(triangle) else { return [None, None] };
        let joint = farthest(direction.as_ref());
        [-1.0, 1.0].map(|sign| {
            ASIDE.iter().find_map(|distance| {
                let step: Joints<M> = Array::by(self.joints(), |i| sign * distance * direction.as_ref()[i]);
                let place = self.settled(shifted::<M>(&facts, &at.q, &step), joint)?;
                let is_near = facts.farthest(place.q.as_ref(), at.q.as_ref()) <= ASTRAY * distance;
                (is_near && place.pivot > at.pivot).then_some(place)
            })
        })
    }

    /// The minimum of a parabola through the residuals of three places, projected on a direction; the middle place has the least residual. Also returns the
    /// side on which the minimum is.
    pub fn vertex(&mut self, unit: &Place<M>, least: &Place<M>, sides: &[Place<M>; 2]) -> Option<(usize, Place<M>)> {
        let [low, middle, high] = [&sides[0], least, &sides[1]].map(|place| place.along(unit));
        let lengths = sides.each_ref().map(|side| self.facts().farthest(side.q.as_ref(), least.q.as_ref()));
        let (fall, rise) = ((middle - low) / lengths[0], (high - middle) / lengths[1]);
        let delta = 0.5 * (fall * lengths[1] + rise * lengths[0]) / (fall - rise);
        let side = usize::from(delta >= 0.0);
        Some((side, self.between(least, &sides[side], delta.abs() / lengths[side])?))
    }
}

/// The index of the entry with the greatest magnitude, the first of equals.
pub(crate) fn farthest(delta: &[f64]) -> usize {
    let farther = |best: usize, i: usize| if delta[i].abs() > delta[best].abs() { i } else { best };
    (1..delta.len()).fold(0, farther)
}
