//! Continuation along curves on which the equations of a nearby mechanism hold almost. Where the formulas have a self-motion, the mechanism itself may have
//! isolated solutions anywhere on the remaining curve. Newton steps find none of them, because the equations change little along the curve. A walk holds one
//! joint after the other while the remaining ones minimise the residual. At each solution the residual changes its sign. Where the ideal mechanism has two
//! self-motions through one configuration, two curves cross: from one of them the other is found, too.
//!
//! Same as `six_axes/curve.rs`, for any number of joints and equations. (E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990, chapter 3.)

use crate::answers::Answers;
use crate::counters::Phase;
use crate::curve_steps::{PACE, Place, WHOLE};
use crate::joints::{is_in, moved};
use crate::mechanism::{Found, Joints, Mechanism};
use crate::starts::Starts;
use crate::tolerances::{ACCEPTANCE, PIVOTS, SELF_MOTIONS};

/// Maximal number of steps of a walk in one direction.
const PACES: usize = 400;
/// Iterations of false position between two steps.
const NARROWED: usize = 24;
/// Where the least pivot of the joints that follow has a minimum below this, another curve may cross.
const CROSSING: f64 = 5e-2;
/// Maximal least pivot of the joints that follow at a regular solution next to a crossing.
const AT_CROSSING: f64 = 2e-2;
/// Crossings that are nearer to each other are one: the places next to it on both curves are half a step away.
const ONE_CROSSING: f64 = 2.0 * PACE[2];
/// Maximal number of parabolas that search for the least residual on a curve.
const PARABOLAS: usize = 12;
/// Where the residual at a parabola's vertex is more than this share of the one before, the curve may have no zero.
const FALLEN: f64 = 0.5;
/// The search stops after so many such vertices.
const STALLS: usize = 2;

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
        self.begin_curve_within(found, q, 1.0)
    }

    /// Same as [`Answers::begin_curve`], if another curve crosses it next to the candidate.
    pub fn begin_crossing_curve(&mut self, found: &Found, q: &Joints<M>) -> bool {
        self.begin_curve_within(found, q, AT_CROSSING)
    }

    /// Same as [`Answers::begin_curve`], if the least pivot of the joints that follow is at most `pivot` there.
    fn begin_curve_within(&mut self, found: &Found, q: &Joints<M>, pivot: f64) -> bool {
        let _phase = Phase::Curve.begin();
        // Numbers that follow from no joint belong to one candidate, so they cannot be stored.
        let place = if self.problem.facts().has_extras { None } else { self.problem.start(q, found.free) };
        let Some((start, held)) = place.filter(|(start, _)| start.pivot <= pivot) else { return false };
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
        while let Some((found, q)) = starts.take() {
            self.walk_curve(&found, q, &mut starts);
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
            self.branch(&walk.found, [before, &walk.home, behind], starts);
        }
        // A place without neighbours shows no self-motion.
        let is_curve = sides.iter().any(Option::is_some);
        for side in sides.into_iter().flatten() {
            if self.leads_home(&mut walk, side, starts) {
                break;
            }
        }
        if is_curve && walk.most <= WHOLE {
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
            let Some((next, length)) = self.problem.pace(&before, &at, last, &mut pace) else {
                self.branch(&walk.found, [&before, &at, &before], starts);
                return false;
            };
            self.change(&walk.found, &at, &next);
            self.dip(&walk.found, [&before, &at, &next]);
            self.branch(&walk.found, [&before, &at, &next], starts);
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

    /// Adds starts on a curve that crosses another one next to the second of three places.
    fn branch(&mut self, found: &Found, [before, at, next]: [&Place<M>; 3], starts: &mut Starts<M>) {
        let is_least = at.pivot < CROSSING && at.pivot <= before.pivot && at.pivot <= next.pivot;
        if is_least && starts.is_new_crossing(&self.problem.facts(), &at.q, ONE_CROSSING) {
            for place in self.problem.aside(before, at).into_iter().flatten() {
                starts.insert(*found, place.q);
            }
        }
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
        let is_zero = b.most <= SELF_MOTIONS.member;
        let are_alike = f64::min(a.along(unit), c.along(unit)) > 0.0 && (is_zero || b.along(unit) > 0.0);
        // By the sizes of residuals, as for the triples before and after this one: of two places with equal residuals exactly one is the least.
        let is_least = b.along(b) < a.along(a) && b.along(b) <= c.along(c);
        if !(f64::min(a.most, c.most) > SELF_MOTIONS.member && are_alike && is_least) {
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
