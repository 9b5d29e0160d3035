//! Continuation along curves on which the equations of a nearby mechanism hold almost. Where the formulas have a self-motion, the mechanism itself may have
//! isolated solutions anywhere on the remaining curve. Newton steps find none of them, because the equations change little along the curve. A walk holds one
//! joint after the other while the remaining ones minimise the residual. At each solution the residual changes its sign.
//!
//! Same as `six_axes/curve.rs`, for any number of joints and equations. (E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.)

use crate::answers::Answers;
use crate::counters::Phase;
use crate::joints::{beyond, differences, is_in, moved, stepped};
use crate::mechanism::{Equations, Found, Joints, Mechanism};
use crate::problem::Problem;
use crate::starts::{Starts, product};
use crate::tolerances::{ACCEPTANCE, PIVOTS, SELF_MOTIONS, STRATA};

/// Maximal number of least-squares steps that correct a place onto the curve.
const ROUNDS: usize = 6;
/// Maximal movement of a joint in such a step (rad, or relative to the length scale).
const BOUND: f64 = 0.5;
/// The shortest, the first and the longest step along the curve (rad, or relative to the length scale).
const PACE: [f64; 3] = [1.5e-3, 2.5e-2, 0.1];
/// Maximal number of steps of a walk in one direction.
const PACES: usize = 400;
/// The end of a step must be no farther from the extrapolated line than this share of the step's length. Otherwise it may be on another curve.
const STRAIGHT: f64 = 0.5;
/// The least squared cosine between the residual vectors at two consecutive places.
const ALIGNED: f64 = 0.5;
/// The largest ratio of the squared residuals at two consecutive places.
const FEWFOLD: f64 = 30.0;
/// Iterations of false position between two steps.
const NARROWED: usize = 24;
/// Maximal number of parabolas that search for the least residual on a curve.
const PARABOLAS: usize = 12;
/// Where the residual at a parabola's vertex is more than this share of the one before, the curve may have no zero.
const FALLEN: f64 = 0.5;
/// The search stops after so many such vertices.
const STALLS: usize = 2;
/// A curve whose relative residual nowhere exceeds this is a self-motion. The factor leaves room for the tolerance of solutions next to an exact self-motion.
const WHOLE: f64 = 10.0 * ACCEPTANCE.residual;

/// A place on a curve.
struct Place<M: Mechanism> {
    q: Joints<M>,
    /// The relative residuals there.
    miss: Equations<M>,
    /// The largest of them.
    most: f64,
}

/// A walk along one curve.
struct Walk<M: Mechanism> {
    /// How its solutions are found: same as its start, but isolated.
    found: Found,
    home: Place<M>,
    /// The place with the least residual so far.
    best: Place<M>,
    /// The largest residual so far.
    most: f64,
}

impl<M: Mechanism> Clone for Place<M> {
    fn clone(&self) -> Self {
        Place { q: self.q.clone(), miss: self.miss.clone(), most: self.most }
    }
}

impl<M: Mechanism> Place<M> {
    /// The scalar product of the residual vectors of two places.
    fn along(&self, other: &Place<M>) -> f64 {
        product(self.miss.as_ref(), other.miss.as_ref())
    }

    /// Whether the residual vector changes little from another place, or only its sign: then no solution between the two is missed.
    fn goes_on(&self, other: &Place<M>) -> bool {
        let [here, there, along] = [self.along(self), other.along(other), self.along(other)];
        let is_aligned = along * along > ALIGNED * here * there;
        let is_flat = (ACCEPTANCE.rounding..=WHOLE).contains(&self.most);
        is_aligned && !is_flat && (along < 0.0 || f64::max(here, there) <= FEWFOLD * f64::min(here, there))
    }
}

impl<M: Mechanism> Walk<M> {
    fn pass(&mut self, place: &Place<M>) {
        self.most = f64::max(self.most, place.most);
        if place.most < self.best.most {
            self.best = place.clone();
        }
    }
}

impl<M: Mechanism> Answers<'_, M> {
    /// Stores a candidate next to which there is a curve, for [`Answers::walk_curves`] after all candidates. Returns whether there is one.
    #[cold]
    pub fn begin_curve(&mut self, found: &Found, q: &Joints<M>) -> bool {
        let _phase = Phase::Curve.begin();
        // Numbers that follow from no joint belong to one candidate, so they cannot be stored.
        let place = if self.problem.facts().has_extras { None } else { self.problem.start(q, found.free) };
        let Some((start, held)) = place else { return false };
        let free = if is_in(found.free, held) { found.free } else { 0 };
        if self.starts.as_ref().is_some_and(Starts::is_full) {
            self.walk_curves();
        }
        self.starts.get_or_insert(Starts::NONE).add(Found { free, ..*found }, start.q);
        true
    }

    /// Follows the curves next to the stored candidates, and keeps the solutions on them.
    #[cold]
    pub fn walk_curves(&mut self) {
        let _phase = Phase::Curve.begin();
        let Some(mut starts) = self.starts.take() else { return };
        for index in 0..starts.count {
            if let Some((found, q)) = starts.list[index].take() {
                self.walk_curve(&found, q, &mut starts);
            }
        }
    }

    /// Follows the curve next to a candidate, in both directions if it is not closed. Where the residual is zero along the curve, it is a self-motion, and one
    /// member is kept.
    fn walk_curve(&mut self, found: &Found, q: Joints<M>, starts: &mut Starts<M>) {
        let Some((home, held)) = self.problem.start(&q, found.free) else { return };
        let sides = [-PACE[1], PACE[1]].map(|delta| {
            let side = moved::<M>(&self.problem.facts(), &home.q, held, delta);
            self.problem.settled(side, held)
        });
        let most = home.most;
        let mut walk = Walk { found: Found { free: 0, ..*found }, best: home.clone(), home, most };
        if walk.home.most <= SELF_MOTIONS.member {
            self.keep_on_curve(&walk.found, walk.home.q.clone());
        }
        if let [Some(before), Some(behind)] = &sides {
            self.dip(&walk.found, [before, &walk.home, behind]);
        }
        for side in sides.into_iter().flatten() {
            if self.leads_home(&mut walk, side, starts) {
                break;
            }
        }
        if walk.most <= WHOLE {
            self.keep_whole_curve(found, held, walk.best.q);
        }
    }

    /// Follows the curve from home through `at` until it closes or ends. Returns whether it closed.
    fn leads_home(&mut self, walk: &mut Walk<M>, mut at: Place<M>, starts: &mut Starts<M>) -> bool {
        let (mut before, mut pace, mut last, mut is_away) = (walk.home.clone(), PACE[1], PACE[1], false);
        self.change(&walk.found, &before, &at);
        for _ in 0..PACES {
            let facts = self.problem.facts();
            starts.pass(&facts, &before.q, &at.q);
            walk.pass(&at);
            let delta = facts.farthest(at.q.as_ref(), walk.home.q.as_ref());
            is_away |= delta > 3.0 * PACE[2];
            if is_away && delta <= PACE[2] {
                self.change(&walk.found, &at, &walk.home);
                return true;
            }
            let Some((next, length)) = self.problem.pace(&before, &at, last, &mut pace) else { return false };
            self.change(&walk.found, &at, &next);
            self.dip(&walk.found, [&before, &at, &next]);
            // Consecutive places with residuals within rounding are one solution, or several close together.
            if (at.most <= SELF_MOTIONS.member) != (next.most <= SELF_MOTIONS.member) {
                self.keep_on_curve(
                    &walk.found,
                    if at.most <= SELF_MOTIONS.member { at.q.clone() } else { next.q.clone() },
                );
            }
            (before, at, last) = (at, next, length);
        }
        false
    }

    /// Keeps the solution between two places where the residual changes its sign, by false position (the Illinois rule: M. Dowell and P. Jarratt, BIT 11 (1971)
    /// 168-174).
    fn change(&mut self, found: &Found, a: &Place<M>, b: &Place<M>) {
        if a.along(b) > 0.0 || f64::max(a.most, b.most) <= SELF_MOTIONS.member {
            return;
        }
        let unit = if a.most > b.most { a } else { b };
        let (mut low, mut high) = (a.along(unit), b.along(unit));
        let (mut near, mut far, mut side) = (a.clone(), b.clone(), 0.0);
        for _ in 0..NARROWED {
            let Some(middle) = self.problem.between(&near, &far, low / (low - high)) else { break };
            let (value, is_exact) = (middle.along(unit), middle.most <= ACCEPTANCE.rounding);
            if (value <= 0.0) == (low <= 0.0) {
                high = if side < 0.0 { 0.5 * high } else { far.along(unit) };
                (near, low, side) = (middle, value, -1.0);
            } else {
                low = if side > 0.0 { 0.5 * low } else { near.along(unit) };
                (far, high, side) = (middle, value, 1.0);
            }
            if is_exact {
                break;
            }
        }
        self.keep_on_curve(found, if near.most <= far.most { near.q } else { far.q });
    }

    /// Searches for two solutions, or a double one, where the residual has a minimum without a change of sign: at the vertex of a parabola.
    fn dip(&mut self, found: &Found, [a, b, c]: [&Place<M>; 3]) {
        let unit = if a.most > c.most { a } else { c };
        let (middle, ends) = (b.along(unit), f64::min(a.along(unit), c.along(unit)));
        let is_zero = b.most <= SELF_MOTIONS.member;
        if !(f64::min(a.most, c.most) > SELF_MOTIONS.member && ends > middle && (is_zero || middle > 0.0)) {
            return;
        }
        let (mut least, mut sides, mut stalls) = (b.clone(), [a.clone(), c.clone()], 0);
        for _ in 0..PARABOLAS {
            if f64::max(sides[0].most, sides[1].most) <= SELF_MOTIONS.member {
                break;
            }
            let Some((side, vertex)) = self.problem.vertex(unit, &least, &sides) else { break };
            if vertex.along(unit) < 0.0 {
                sides.iter().for_each(|side| self.change(found, &vertex, side));
                // Rounding alone may have changed the sign.
                return if least.most <= SELF_MOTIONS.member {
                    self.keep_on_curve(found, least.q)
                };
            }
            stalls += usize::from(vertex.most > FALLEN * least.most);
            if vertex.most < least.most {
                sides[1 - side] = core::mem::replace(&mut least, vertex);
            } else {
                sides[side] = vertex;
            }
            if least.most > SELF_MOTIONS.member && stalls >= STALLS {
                break;
            }
        }
        if is_zero || least.most <= FALLEN * b.most {
            self.keep_on_curve(found, least.q);
        }
    }

    /// Polishes a place on a curve and keeps the result if it is a new solution: a member of a self-motion where one joint can move.
    fn keep_on_curve(&mut self, found: &Found, q: Joints<M>) {
        let end = self.problem.polished(q, 0);
        if self.is_listed(&end.0) {
            return;
        }
        let is_singular = self.problem.regularity(&end.0) <= PIVOTS.regular;
        let free = if is_singular { self.problem.joint_on_long_self_motion(&end.0) } else { None }.unwrap_or(0);
        self.keep(&Found { free, ..*found }, end);
    }

    /// Keeps a member of a self-motion of the joints that the candidate frees, or of the joint that was held first.
    fn keep_whole_curve(&mut self, found: &Found, held: usize, q: Joints<M>) {
        let free = if found.free == 0 { 1 << held } else { found.free };
        let end = self.problem.polished(q, free);
        self.keep(&Found { free, ..*found }, end);
    }
}

impl<M: Mechanism> Problem<'_, M> {
    /// The place on the curve next to `q`, and the joint that is held to reach it. This is a free joint. Where none is free, or the others move without it, it
    /// is the joint that moves farthest in the direction in which the equations change least.
    fn start(&mut self, q: &Joints<M>, free: u32) -> Option<(Place<M>, usize)> {
        let of_free = if free == 0 { None } else { self.start_with(q, free.trailing_zeros() as usize) };
        if of_free.is_some() {
            return of_free;
        }
        let triangle = self.triangle(q, 0.0, 0);
        let held = farthest(self.stillest(triangle)?.0.as_ref());
        self.start_with(q, held)
    }

    /// The place next to `q` reached with one joint held, if it is on a curve along which all other joints follow.
    fn start_with(&mut self, q: &Joints<M>, held: usize) -> Option<(Place<M>, usize)> {
        let place = self.settled(q.clone(), held)?;
        (self.regularity_of(&place.q, 1 << held) > PIVOTS.weak).then_some((place, held))
    }

    /// Takes least-squares steps with one joint held, until they are short.
    fn settled(&mut self, mut q: Joints<M>, held: usize) -> Option<Place<M>> {
        for _ in 0..ROUNDS {
            if self.steps.are_spent() {
                return None;
            }
            let (derivatives, mut miss) = self.shared(&q);
            let step = self.triangle_of(&derivatives, &miss, 0.0, 1 << held).substituted()?;
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
                return (most <= STRATA.near).then_some(Place { q, miss, most });
            }
        }
        None
    }

    /// The place on the curve at a fraction `share` of the distance from `a` to `b`.
    fn between(&mut self, a: &Place<M>, b: &Place<M>, share: f64) -> Option<Place<M>> {
        let facts = self.facts();
        let held = farthest(differences::<M>(&facts, &b.q, &a.q).as_ref());
        self.settled(beyond::<M>(&facts, &b.q, &a.q, -share), held)
    }

    /// A step along the curve from `at`, shorter where it bends, and its length. `None` where the curve ends.
    fn pace(&mut self, before: &Place<M>, at: &Place<M>, last: f64, pace: &mut f64) -> Option<(Place<M>, f64)> {
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

    /// The minimum of a parabola through the residuals of three places, projected on a direction; the middle place has the least residual. Also returns the
    /// side on which the minimum is.
    fn vertex(&mut self, unit: &Place<M>, least: &Place<M>, sides: &[Place<M>; 2]) -> Option<(usize, Place<M>)> {
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
