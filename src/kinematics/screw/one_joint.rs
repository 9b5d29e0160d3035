//! The subproblems of one joint, about any axis or along any direction: Paden-Kahan 1 and 3, RH0 (2-28), (2-29), (2-32),
//! (2-33); Pardos-One, RH0 (2-34), (2-35); Pardos-Gotor's PG1, PG3, PG5; subproblems 1, 3, 4 of Elias and Wen, "IK-Geo" (2022).
//!
//! A joint moves `p` on a circle or a line, whose distance from a target (a point, a sphere, a plane) lies in an interval.
//!
//! Tolerance. *size* is, for a rotation, the larger of |p - r| and |k - r| (r: the axis' point; k: the target's point); for
//! a translation the larger of |p - k| and a hundredth of |p| and |k|, whose rounding it has to cover.
//! * A target outside the interval by at most [`Reach`] * size counts as its nearer end.
//! * The joint is free when the interval is at most [`TOLERANCE`] * size long, and the target is in reach.
//! * Two values are merged into one at an end of the interval when the target is within [`ROUNDING`] * size of it.
//!
//! Near an end the distance hardly depends on the joint: a target known to e * size leaves the value uncertain by about
//! sqrt(e). The distance that an answer reaches is accurate throughout.
//!
//! Lengths may have any magnitude, but r should be near p and k: rounding of the axis' direction acts at that distance.

use std::f64::consts::PI;

use nalgebra::{Point3, Unit, Vector3};

use super::values::{ROUNDING, Reach, TOLERANCE, Values};
use crate::spatial::{Axis, angle};

/// Paden-Kahan 1, RH0 (2-28), (2-29): the angle that rotates `p` about `axis` onto `k` \[m\].
///
/// Free when both points lie on the axis and coincide; none when `k` is not on the circle of `p` (see the
/// [tolerance](self)) or a coordinate is not finite. Never two. The closest angle brings `p` into the half-plane of `k`.
pub fn rotate_to_point(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Values {
    rotate_to_distance(axis, p, k, 0.0, reach)
}

/// Paden-Kahan 3, RH0 (2-32), (2-33): the angles that rotate `p` about `axis` to the distance `delta` from `k` \[m\].
///
/// Free when `p` or `k` lies on the axis and the distance fits; none when `delta` is out of reach (see the
/// [tolerance](self)), negative or NaN, or a coordinate is not finite. Of two angles, the first lies ahead of
/// the one nearest to `k`, the second behind it.
pub fn rotate_to_distance(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, delta: f64, reach: Reach) -> Values {
    Circle::new(axis, p, k).map_or(Values::None, |circle| circle.angles_at(delta / circle.unit, reach))
}

/// Subproblem 4 of IK-Geo: the angles that rotate `p` about `axis` into the plane through `plane_point` \[m\] with this `normal`.
///
/// Free when `p` stays at the plane's distance; none when its circle does not reach the plane (see the
/// [tolerance](self)) or a coordinate is not finite.
pub fn rotate_to_plane(
    axis: &Axis,
    p: &Point3<f64>,
    normal: &Unit<Vector3<f64>>,
    plane_point: &Point3<f64>,
    reach: Reach,
) -> Values {
    let (w, u, v) = (axis.direction(), p - axis.point(), plane_point - axis.point());
    let Some(unit) = unit_of(&[u, v]) else { return Values::None };
    let (u, v) = (u / unit, v / unit);
    let tangent = w.cross(&u);
    let height = normal.dot(&(v - w.scale(w.dot(&u))));
    angles_at_height(normal.dot(&tangent.cross(&w)), normal.dot(&tangent), height, u.norm().max(v.norm()), reach)
}

/// Pardos-Gotor 5: the angles that rotate the line through `p` that crosses `axis` at right angles into the plane of
/// `axis` and `k` \[m\].
///
/// Two, half a turn apart: the first brings `p` into the half-plane of `k` (the angle of Paden-Kahan 1), the second into the
/// opposite one. Free when `p` or `k` lies on the axis, to [`TOLERANCE`] * size; none when a coordinate is not finite.
pub fn rotate_line_to_plane(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> Values {
    match Circle::new(axis, p, k) {
        None => Values::None,
        Some(circle) if circle.is_trivial() => Values::Free,
        Some(circle) => Values::Two(circle.bearing, angle::wrap(circle.bearing + PI)),
    }
}

/// Pardos-Gotor 5 for a plane beside the axis (a shoulder's offset): the angles that rotate the plane through `p` \[m\] with
/// this `normal` about `axis` until it contains `k` \[m\].
///
/// That is [`rotate_to_plane`] of `k` by the opposite angle, and has its tolerance.
pub fn rotate_plane_to_point(
    axis: &Axis,
    p: &Point3<f64>,
    normal: &Unit<Vector3<f64>>,
    k: &Point3<f64>,
    reach: Reach,
) -> Values {
    rotate_to_plane(axis, k, normal, p, reach).map(|angle| angle::wrap(-angle))
}

/// The displacement \[m\] along `direction` that takes `p` to `k` \[m\].
///
/// None when `k` is not on the line of `p` (see the [tolerance](self)) or a coordinate is not finite. The closest
/// displacement brings `p` to the foot of `k`.
pub fn translate_to_point(direction: &Unit<Vector3<f64>>, p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Values {
    translate_to_distance(direction, p, k, 0.0, reach)
}

/// Pardos-One (Pardos-Gotor 3), RH0 (2-34), for (2-35) see `docs/errata.md`: the displacements \[m\] along `direction`
/// that take `p` to the distance `delta` from `k` \[m\].
///
/// None when the line of `p` stays farther away (see the [tolerance](self)), `delta` is negative or NaN, or a
/// coordinate is not finite. Of two displacements, the first is the larger.
pub fn translate_to_distance(
    direction: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    k: &Point3<f64>,
    delta: f64,
    reach: Reach,
) -> Values {
    let apart = k - p;
    let Some(unit) = unit_of(&[apart, p.coords * COVERED, k.coords * COVERED, Vector3::repeat(delta)]) else {
        return Values::None;
    };
    let size = apart.norm().max(p.coords.norm().max(k.coords.norm()) * COVERED) / unit;
    let (apart, delta) = (apart / unit, delta / unit);
    let foot = direction.dot(&apart);
    let nearest = (apart - direction.scale(foot)).norm();
    let excess = delta - nearest;
    if delta < 0.0 || (excess < 0.0 && !reach.covers(-excess / size)) {
        return Values::None;
    }
    if excess <= ROUNDING * size {
        return Values::One(foot * unit);
    }
    let half_chord = (excess * (delta + nearest)).sqrt();
    Values::Two((foot + half_chord) * unit, (foot - half_chord) * unit)
}

/// Pardos-Gotor 1: the displacement \[m\] along `direction` that takes `p` into the plane through `plane_point` \[m\] with this
/// `normal`.
///
/// Free when `p` is in the plane and moves in it; none when it moves beside the plane (see the [tolerance](self); directions
/// count as parallel to the plane to [`TOLERANCE`] rad) or a coordinate is not finite.
pub fn translate_to_plane(
    direction: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    normal: &Unit<Vector3<f64>>,
    plane_point: &Point3<f64>,
    reach: Reach,
) -> Values {
    let apart = plane_point - p;
    let Some(unit) = unit_of(&[apart, p.coords * COVERED, plane_point.coords * COVERED]) else { return Values::None };
    let (height, rate) = (normal.dot(&(apart / unit)), normal.dot(direction));
    if rate.abs() > TOLERANCE {
        return Values::One(height / rate * unit);
    }
    if reach.covers(height.abs()) { Values::Free } else { Values::None }
}

/// The share of the coordinates' magnitude that the size of a translation's problem has at least.
const COVERED: f64 = 1e-2;

/// The largest magnitude of the vectors' entries, or 1 when all are zero; `None` when one is not finite.
fn unit_of(vectors: &[Vector3<f64>]) -> Option<f64> {
    let finite = vectors.iter().all(|v| v.iter().all(|x| x.is_finite()));
    let largest = vectors.iter().fold(0.0, |largest: f64, v| largest.max(v.amax()));
    finite.then_some(if largest > 0.0 { largest } else { 1.0 })
}

/// The angles x with `a cos(x) + b sin(x) = height`, lengths being known to `size` times rounding.
pub(super) fn angles_at_height(a: f64, b: f64, height: f64, size: f64, reach: Reach) -> Values {
    let amplitude = a.hypot(b);
    let (above, below) = (amplitude - height, amplitude + height);
    let miss = (-above).max(-below).max(0.0);
    if !(amplitude + height).is_finite() || (miss > 0.0 && !reach.covers(miss / size)) {
        return Values::None;
    }
    if amplitude <= TOLERANCE * size {
        return Values::Free;
    }
    let top = angle::wrap(b.atan2(a));
    if above <= ROUNDING * size {
        return Values::One(top);
    }
    if below <= ROUNDING * size {
        return Values::One(angle::wrap(top + PI));
    }
    let turn = 2.0 * above.sqrt().atan2(below.sqrt());
    Values::Two(angle::wrap(top + turn), angle::wrap(top - turn))
}

/// The circle of `p` about an axis, seen from `k`.
pub(super) struct Circle {
    /// The unit of the lengths below \[m\]: keeps their squares in range.
    unit: f64,
    /// The larger distance of the two points from the axis' point.
    size: f64,
    /// The smallest distance from `k`.
    nearest: f64,
    /// The largest distance from `k`.
    farthest: f64,
    /// The angle in (-pi, pi] that brings `p` nearest to `k`: theta_0 of RH0 (2-33).
    pub(super) bearing: f64,
}

impl Circle {
    /// `None` when a coordinate, relative to the axis' point, is not finite.
    pub(super) fn new(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> Option<Circle> {
        let w = axis.direction();
        let (u, v) = (p - axis.point(), k - axis.point());
        let unit = unit_of(&[u, v])?;
        let (u, v) = (u / unit, v / unit);
        let height = w.dot(&(u - v));
        let (u_flat, v_flat) = (u - w.scale(w.dot(&u)), v - w.scale(w.dot(&v)));
        let (a, b) = (u_flat.norm(), v_flat.norm());
        Some(Circle {
            unit,
            size: u.norm().max(v.norm()),
            nearest: height.hypot(a - b),
            farthest: height.hypot(a + b),
            bearing: angle::wrap(w.dot(&u_flat.cross(&v_flat)).atan2(u_flat.dot(&v_flat))),
        })
    }

    /// The largest distance from `k` \[m\].
    pub(super) fn farthest(&self) -> f64 {
        self.farthest * self.unit
    }

    /// Whether no rotation changes the distance: one of the points lies on the axis.
    fn is_trivial(&self) -> bool {
        self.farthest - self.nearest <= TOLERANCE * self.size
    }

    /// The angles at `distance`, in this circle's unit.
    ///
    /// The law of cosines RH0 (2-33), for half the angle: its tangent squared is
    /// (distance^2 - nearest^2) / (farthest^2 - distance^2).
    fn angles_at(&self, distance: f64, reach: Reach) -> Values {
        let (above, below) = (distance - self.nearest, self.farthest - distance);
        let miss = (-above).max(-below).max(0.0);
        if distance < 0.0 || distance.is_nan() || (miss > 0.0 && !reach.covers(miss / self.size)) {
            return Values::None;
        }
        if self.is_trivial() {
            return Values::Free;
        }
        if above <= ROUNDING * self.size {
            return Values::One(self.bearing);
        }
        if below <= ROUNDING * self.size {
            return Values::One(angle::wrap(self.bearing + PI));
        }
        let sine = (above * (distance + self.nearest)).sqrt();
        let cosine = (below * (distance + self.farthest)).sqrt();
        let turn = 2.0 * sine.atan2(cosine);
        Values::Two(angle::wrap(self.bearing + turn), angle::wrap(self.bearing - turn))
    }
}
