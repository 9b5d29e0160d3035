//! The subproblems of two joints, `exp(S1 q1) exp(S2 q2) p = k`, for any axes and directions: Paden-Kahan 2, RH0 (2-30),
//! (2-31), and Pardos-Gotor's PG2, PG4, PG6.
//!
//! The first joint leaves two things of `k` as they are: its plane across the axis and its distance from a point of the axis,
//! or, sliding, two coordinates across the direction. Each is a condition on `exp(S2 q2) p`, hence a subproblem of
//! [one joint](super::one_joint), and every solution solves both. Nothing is divided by the angle of the axes, so that none of
//! perpendicular, parallel, nearly parallel and meeting axes is special. What solves one condition is polished by Newton's
//! method on the equation itself and kept when it solves that.
//!
//! Tolerance. *size* is the largest distance of `p` from `k` and from the axes, and at least a hundredth of the coordinates.
//! * An answer may miss `k` by [`Reach`] * size. With [`Reach::EXACT`] none does by more than 1e-12 of the size.
//! * Two answers are merged when rounding cannot tell them apart: half-way between them the miss is no larger.
//! * A joint is free when no value of it changes the miss by more than [`TOLERANCE`](super::values::TOLERANCE) * size: `p` on the second
//!   axis, `k` on the first. Of coincident axes (and of equal directions) the second joint counts as free.
//!
//! Three equations for two unknowns: in general `k` is not reached. [`Reach::Closest`] gives the least miss.

use nalgebra::{Point3, Unit, Vector3};
use smallvec::SmallVec;

use super::motion::{Candidates, Motion, coincide, holds, moved};
use super::one_joint::{
    Circle, rotate_to_distance, rotate_to_plane, rotate_to_point, translate_to_distance, translate_to_plane,
    translate_to_point,
};
use super::values::{Answers, Reach, Values};
use crate::spatial::{Axis, Screw};

/// All q1, q2 with `exp(S1 q1) exp(S2 q2) p = k` \[m\], for joints of either kind: at most two answers.
///
/// None when `k` is out of reach (see the [tolerance](self)) or a coordinate is not finite.
pub fn two_screws_to_point(
    first: &Screw,
    second: &Screw,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    Motion::new([first, second], p, k).map_or(Answers::none(), |motion| motion.to_metres(solve(&motion, reach)))
}

/// Paden-Kahan 2, RH0 (2-30), (2-31): rotations of `p` about two axes that meet, onto `k` \[m\].
///
/// As [`two_screws_to_point`], and like it right when the axes miss each other.
pub fn rotate_about_meeting_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    two_screws_to_point(&Screw::Revolute(*first), &Screw::Revolute(*second), p, k, reach)
}

/// Pardos-Gotor 4: rotations of `p` about two parallel axes, onto `k` \[m\].
///
/// As [`two_screws_to_point`], and like it right when the axes are not quite parallel.
pub fn rotate_about_parallel_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    two_screws_to_point(&Screw::Revolute(*first), &Screw::Revolute(*second), p, k, reach)
}

/// Pardos-Gotor 6: rotations of `p` about two skew axes, at any angle to each other, onto `k` \[m\].
///
/// As [`two_screws_to_point`].
pub fn rotate_about_skew_axes(
    first: &Axis,
    second: &Axis,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    two_screws_to_point(&Screw::Revolute(*first), &Screw::Revolute(*second), p, k, reach)
}

/// Pardos-Gotor 2: displacements \[m\] of `p` along two directions, to `k` \[m\].
///
/// As [`two_screws_to_point`].
pub fn translate_twice(
    first: &Unit<Vector3<f64>>,
    second: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    k: &Point3<f64>,
    reach: Reach,
) -> Answers<2> {
    two_screws_to_point(&Screw::Prismatic(*first), &Screw::Prismatic(*second), p, k, reach)
}

/// The answers in the motion's unit.
pub(super) fn solve(motion: &Motion<2>, reach: Reach) -> Answers<2> {
    let ([first, second], p, k) = (&motion.screws, &motion.p, &motion.k);
    let free = if holds(second, p) || coincide(first, second) {
        Some([to_point(first, p, k), Values::Free])
    } else if holds(first, k) {
        Some([Values::Free, to_point(second, p, k)])
    } else {
        None
    };
    match free {
        None => motion.settle(candidates(first, second, p, k), reach),
        Some(values) => {
            let answers = Answers::from(values);
            answers.iter().filter(|q| reach.covers(motion.size(&q.map(|q| q.unwrap_or(0.0))))).copied().collect()
        }
    }
}

/// Values that solve one of the two conditions on the second joint each; all solutions are among them, to rounding.
pub(super) fn candidates(first: &Screw, second: &Screw, p: &Point3<f64>, k: &Point3<f64>) -> Candidates<2> {
    let mut list = Candidates::new();
    for condition in conditions(first, second, k) {
        let values = condition.solve(second, p);
        let free = (values == Values::Free).then_some(0.0);
        list.extend(values.iter().chain(free).map(|q2| [bearing(first, &moved(second, q2, p), k), q2]));
    }
    list
}

/// A surface that the first joint moves in itself.
enum Condition {
    /// The plane through a point with a normal.
    Plane(Unit<Vector3<f64>>, Point3<f64>),
    /// The sphere about a point with a radius.
    Sphere(Point3<f64>, f64),
}

impl Condition {
    /// The values of `screw` that take `p` to the surface, or nearest to it.
    fn solve(&self, screw: &Screw, p: &Point3<f64>) -> Values {
        let reach = Reach::Closest;
        match (screw, self) {
            (Screw::Revolute(axis), Condition::Plane(normal, point)) => rotate_to_plane(axis, p, normal, point, reach),
            (Screw::Revolute(axis), Condition::Sphere(centre, radius)) => {
                rotate_to_distance(axis, p, centre, *radius, reach)
            }
            (Screw::Prismatic(d), Condition::Plane(normal, point)) => translate_to_plane(d, p, normal, point, reach),
            (Screw::Prismatic(d), Condition::Sphere(centre, radius)) => {
                translate_to_distance(d, p, centre, *radius, reach)
            }
        }
    }
}

/// Two independent surfaces through `k` that the first joint moves in themselves.
fn conditions(first: &Screw, second: &Screw, k: &Point3<f64>) -> SmallVec<[Condition; 2]> {
    let mut list = SmallVec::new();
    match first {
        Screw::Revolute(axis) => {
            let centre = match second {
                Screw::Revolute(other) => facing(axis, other) + axis.direction().into_inner(),
                Screw::Prismatic(_) => axis.foot(k),
            };
            list.push(Condition::Plane(axis.direction(), *k));
            list.push(Condition::Sphere(centre, (k - centre).norm()));
        }
        Screw::Prismatic(direction) => {
            list.extend(across(direction, second).map(|normal| Condition::Plane(normal, *k)));
        }
    }
    list
}

/// The point of `axis` nearest to `other`, unless that is far away.
pub(super) fn facing(axis: &Axis, other: &Axis) -> Point3<f64> {
    match axis.nearest_points(other) {
        Some((point, _)) if (point - axis.point()).norm() <= 3.0 => point,
        _ => axis.foot(&other.point()),
    }
}

/// Two normals of `direction` at right angles: the first is a normal of the other joint's direction, too.
pub(super) fn across(direction: &Unit<Vector3<f64>>, other: &Screw) -> [Unit<Vector3<f64>>; 2] {
    let w = match other {
        Screw::Revolute(axis) => axis.direction(),
        Screw::Prismatic(direction) => *direction,
    };
    let shared = Unit::try_new(direction.cross(&w), 1e-9);
    let normal = shared.unwrap_or_else(|| Unit::new_normalize(direction.cross(&Vector3::ith(direction.iamin(), 1.0))));
    [normal, Unit::new_normalize(direction.cross(&normal))]
}

/// The value of `screw` that takes `p` nearest to `k`.
fn bearing(screw: &Screw, p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    match screw {
        Screw::Revolute(axis) => Circle::new(axis, p, k).map_or(0.0, |circle| circle.bearing),
        Screw::Prismatic(direction) => direction.dot(&(k - p)),
    }
}

/// The values of one joint that take `p` nearest to `k`.
fn to_point(screw: &Screw, p: &Point3<f64>, k: &Point3<f64>) -> Values {
    match screw {
        Screw::Revolute(axis) => rotate_to_point(axis, p, k, Reach::Closest),
        Screw::Prismatic(direction) => translate_to_point(direction, p, k, Reach::Closest),
    }
}
