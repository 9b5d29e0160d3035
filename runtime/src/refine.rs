//! Refinement of candidates that are not solutions yet.

use crate::answers::Answers;
use crate::approach::Approach;
use crate::arithmetic::Arithmetic;
use crate::counters::Phase;
use crate::effort::{APART, FARTHER, FARTHEST, LEVER, MILD, STEEP, TWIN, TWIN_AT, TWIN_WITHIN};
use crate::joints::{differences, moved, shifted};
use crate::mechanism::{Found, Joints, Mechanism};
use crate::problem::End;
use crate::storage::Array;
use crate::tolerances::{ACCEPTANCE, MERGING, NEARBY_ROBOTS, PIVOTS, STRATA};
use crate::triangle::Triangle;

impl<M: Mechanism> Answers<'_, M> {
    /// Polishes a candidate with its number, and keeps the result if it solves the equations. Where two solutions almost meet, further starts around it are
    /// tried.
    #[cold]
    #[inline(never)]
    pub fn refine(&mut self, number: usize, found: &Found, q: Joints<M>) {
        let _phase = Phase::Polish.begin();
        if found.free != 0 {
            self.unsound = number;
            return self.refine_member(found, q);
        }
        let start = self.problem.measured(q.clone());
        let missed = start.1.relative;
        let end = self.problem.polish(start, 0);
        let miss = end.1.relative;
        let delta = self.problem.facts().farthest(q.as_ref(), end.0.as_ref());
        let is_nearby = self.problem.facts().nearby.is_some();
        let is_beside =
            (ACCEPTANCE.rounding..=if is_nearby { NEARBY_ROBOTS.off } else { STRATA.near }).contains(&missed);
        let holds = missed < ACCEPTANCE.rounding || miss < ACCEPTANCE.rounding && delta <= MERGING.joints;
        if !(end.1.accepted && holds) {
            self.unsound = number;
        }
        if found.close {
            self.doubted = number;
        }
        let triangle = (is_nearby && is_beside).then(|| self.problem.triangle(&end.0, 0.0, 0));
        let regularity = triangle.as_ref().map_or(1.0, Triangle::regularity);
        if triangle.is_some() && self.keep_moving(found, &end, regularity) {
            return;
        }
        if is_nearby && self.leads_to_curve(found, (&q, missed), &end, regularity) {
            return self.miss(end);
        }
        if (ACCEPTANCE.rounding..=STRATA.near).contains(&miss) {
            self.around(found, &end, miss);
        } else if is_beside && delta > LEVER * Arithmetic::sqrt(missed) {
            if !is_nearby || regularity <= PIVOTS.isolated {
                self.around(found, &end, missed);
            }
            // Such a candidate is between two solutions: starts again from the other side.
            let delta = differences::<M>(&self.problem.facts(), &q, &end.0);
            let start = shifted::<M>(&self.problem.facts(), &q, &delta);
            let start = self.problem.polished(start, 0);
            self.keep(found, start);
        }
        if let Some(triangle) = triangle {
            self.twin(found, &end.0, triangle, missed);
        }
        self.keep(found, end);
    }

    /// Searches for curves next to the end of the steps from a candidate, and next to the candidate if that is far away. Returns whether the steps ended on a
    /// curve.
    fn leads_to_curve(&mut self, found: &Found, (q, missed): (&Joints<M>, f64), end: &End<M>, regularity: f64) -> bool {
        let is_beside = (ACCEPTANCE.rounding..=NEARBY_ROBOTS.off).contains(&missed);
        if is_beside && self.is_curve(found, end, regularity, missed) && end.1.relative >= ACCEPTANCE.rounding {
            return true;
        }
        if self.problem.facts().farthest(q.as_ref(), end.0.as_ref()) > MERGING.blur {
            self.begin_curve(found, q);
        }
        false
    }

    /// Keeps the end of the Newton steps from the candidate with this number. If the equations are ill-conditioned, searches for a second solution.
    pub fn arrive(&mut self, number: usize, found: &Found, approach: Approach<M>) {
        let Approach { end, fit, missed, pivot, is_doubled } = approach;
        let is_steep = pivot < missed * if found.close { STEEP } else { MILD };
        if is_steep {
            self.unsound = number;
        }
        if !(is_steep && is_doubled) {
            return self.keep(found, (end, fit));
        }
        let triangle = self.problem.triangle(&end, 0.0, 0);
        let regularity = triangle.regularity();
        if self.keep_moving(found, &(end.clone(), fit), regularity) {
            return;
        }
        self.begin_curve_through(found, &end, regularity, missed);
        self.keep(found, (end.clone(), fit));
        self.twin(found, &end, triangle, missed);
    }

    /// Keeps a solution that is a member of a self-motion of one joint that a case frees. The formulas of a nearby mechanism do not distinguish these from
    /// isolated solutions. Returns whether it is one.
    fn keep_moving(&mut self, found: &Found, end: &End<M>, regularity: f64) -> bool {
        let may_move = end.1.relative <= ACCEPTANCE.rounding && regularity <= PIVOTS.regular;
        let joint = if may_move { self.problem.joint_on_long_self_motion(&end.0) } else { None };
        if let Some(free) = joint {
            self.keep(&Found { free, ..*found }, end.clone());
        }
        joint.is_some()
    }

    /// Whether a curve goes through a solution of a nearby mechanism, or through the end of the steps from one. Such a curve is followed.
    fn is_curve(&mut self, found: &Found, (q, fit): &End<M>, regularity: f64, missed: f64) -> bool {
        if (ACCEPTANCE.rounding..=STRATA.near).contains(&fit.relative) {
            return self.begin_curve(found, q);
        }
        fit.accepted && self.begin_curve_through(found, q, regularity, missed)
    }

    /// Stores a solution of a nearby mechanism for continuation if a curve goes through it. If the solution is regular, there may be others on the curve only next
    /// to a crossing. The equations then change, along the curve, by less than the square root of the candidate's residual.
    fn begin_curve_through(&mut self, found: &Found, q: &Joints<M>, regularity: f64, missed: f64) -> bool {
        if regularity <= PIVOTS.regular {
            return self.begin_curve(found, q);
        }
        regularity <= Arithmetic::sqrt(missed) && self.begin_crossing_curve(found, q)
    }

    /// Searches for a second solution next to one whose candidate was a double root. Their distance is about the square root of the candidate's residual. The
    /// second one is in the direction in which the equations change least: a parabola through the first one has its second root there.
    fn twin(&mut self, found: &Found, end: &Joints<M>, triangle: Triangle<M>, missed: f64) {
        let _phase = Phase::Twin.begin();
        let nearby = Arithmetic::sqrt(missed);
        let Some((delta, share)) = self.problem.stillest(triangle) else { return };
        if share > TWIN * nearby {
            return;
        }
        let Some(distance) = self.problem.second_root(end, &delta, TWIN_AT * nearby) else { return };
        if distance.abs() > TWIN_WITHIN * nearby {
            return;
        }
        let step: Joints<M> = Array::by(self.problem.joints(), |i| distance * delta.as_ref()[i]);
        let start = shifted::<M>(&self.problem.facts(), end, &step);
        let at = self.problem.place(&start);
        let end = match self.problem.approached(&at, &start) {
            Some(Approach { end, fit, .. }) => (end, fit),
            None => self.problem.polished(start, 0),
        };
        self.keep(found, end);
    }

    /// Polishes again from points on either side of a candidate. Their distance is the square root of the residual, for a double root or an angle with little
    /// influence. If none of these leads to a solution, starts are farther away.
    pub fn around(&mut self, found: &Found, end: &End<M>, missed: f64) {
        let _phase = Phase::Around.begin();
        let weights = self.problem.weights(&end.0);
        let mut is_found = end.1.accepted;
        let mut farther = 1.0;
        while farther <= FARTHEST && !self.problem.steps.are_spent() {
            for i in 0..self.problem.joints() {
                for sign in [-1.0, 1.0] {
                    let weight = if end.1.accepted { 1.0 } else { weights.as_ref()[i] };
                    let delta = f64::min(farther * Arithmetic::sqrt(missed / weight), APART);
                    let start = moved::<M>(&self.problem.facts(), &end.0, i, 2.0 * sign * delta);
                    let start = self.problem.polished(start, 0);
                    is_found |= start.1.accepted;
                    self.keep(found, start);
                }
            }
            if is_found {
                return;
            }
            farther *= FARTHER;
        }
    }
}
