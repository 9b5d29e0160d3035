//! The subproblems of one joint, for any axis: Paden-Kahan 1 and 3 (RH0 2.3.3), Pardos-One (RH0 2.3.4), and rotations
//! and translations to a plane (PG1, PG5). These are IK-Geo's subproblems 1, 3 and 4.
//!
//! A rotation of a point varies the required quantity (a distance, or a height over a plane) between two extreme
//! values. So there are two angles, one at an extreme value, or every angle is a solution. The tolerances are in
//! [`super::values`].
//!
//! Lengths may have any magnitude. An axis' point should be near the other points, because the rounding error of the
//! axis' direction is multiplied by that distance.

use std::f64::consts::PI;

use nalgebra::{Point3, Unit, Vector3};

use super::values::{ROUNDING, Reach, TOLERANCE, Values, displacement_size};
use crate::spatial::{Axis, angle};

/// Paden-Kahan 1, RH0 (2-28), (2-29): the angle that rotates `p` about `axis` onto `k` \[m\].
///
/// Free when both points are equal and on the axis; none when `k` is not on the circle of `p` or a coordinate is not
/// finite. Never two.
pub fn rotate_to_point(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Values {
    rotate_to_distance(axis, p, k, 0.0, reach)
}

/// Paden-Kahan 3, RH0 (2-32), (2-33): the angles that rotate `p` about `axis` to the distance `delta` from `k` \[m\].
///
/// Free when `p` or `k` is on the axis and the distance fits; none when `delta` is out of reach, negative or NaN, or a
/// coordinate is not finite. Of two angles, the first is after the angle nearest to `k` and the second before it, in
/// the direction of rotation.
pub fn rotate_to_distance(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, delta: f64, reach: Reach) -> Values {
    match Circle::new(axis, p, k) {
        Some(circle) if delta >= 0.0 => circle.half_angle(delta / circle.unit).angles(reach),
        _ => Values::None,
    }
}

/// The angles that rotate `p` about `axis` into the plane through `plane_point` \[m\] with this `normal`: PG5 for a
/// point, IK-Geo's circle and plane.
///
/// Free when `p` is on the axis, or the axis is normal to the plane, and `p` is in the plane; none when the circle does
/// not reach the plane or a coordinate is not finite. Of two angles, the first is after the angle that moves `p`
/// farthest along the normal.
pub fn rotate_to_plane(
    axis: &Axis,
    p: &Point3<f64>,
    normal: &Unit<Vector3<f64>>,
    plane_point: &Point3<f64>,
    reach: Reach,
) -> Values {
    let w = axis.direction();
    let (u, height) = (p - axis.point(), normal.dot(&(plane_point - axis.point())));
    let size = u.norm().max(height.abs());
    if !(u.norm().is_finite() && height.is_finite()) {
        return Values::None;
    }
    let (u_flat, n_flat) = (u - w.scale(w.dot(&u)), normal.into_inner() - w.scale(w.dot(normal)));
    let amplitude = u_flat.norm() * n_flat.norm();
    let target = height - w.dot(&u) * w.dot(normal);
    let bearing = w.dot(&u_flat.cross(&n_flat)).atan2(u_flat.dot(&n_flat));
    HalfAngle {
        above: amplitude - target,
        below: amplitude + target,
        weights: (1.0, 1.0),
        span: 2.0 * amplitude,
        size,
        bearing,
    }
    .angles(reach)
}

/// PG5: the angles that rotate `line` about `axis` into the plane through `plane_point` \[m\] with this `normal`.
///
/// A line is in a plane when its direction is normal to the plane's normal and one of its points is in the plane. The
/// angles of the first condition that satisfy the second one are returned. A line parallel to the axis keeps its
/// direction, so only its point is tested. With [`Reach::Closest`], the line becomes as parallel to the plane as
/// possible.
pub fn rotate_line_to_plane(
    axis: &Axis,
    line: &Axis,
    normal: &Unit<Vector3<f64>>,
    plane_point: &Point3<f64>,
    reach: Reach,
) -> Values {
    let direction = Point3::from(line.direction().into_inner());
    let turned = rotate_to_plane(&axis.through_origin(), &direction, normal, &Point3::origin(), reach);
    if turned == Values::Free {
        return rotate_to_plane(axis, &line.point(), normal, plane_point, reach);
    }
    let size = (line.point() - axis.point()).norm().max((plane_point - axis.point()).norm());
    // The residuals of the line's direction and of its point, with their derivatives.
    let misses = |q: f64| {
        let heading = axis.through_origin().rotate(q, &direction).coords;
        let (arm, w) = (axis.rotate(q, &line.point()) - axis.point(), axis.direction());
        let height = normal.dot(&(arm - (plane_point - axis.point()))) / size;
        let slopes = [normal.dot(&w.cross(&heading)), normal.dot(&w.cross(&arm)) / size];
        ([normal.dot(&heading), height], slopes)
    };
    let refined = |q: f64| {
        let ([a, b], [c, d]) = misses(q);
        let step = (a * c + b * d) / (c * c + d * d);
        if step.abs() <= 1e-6 { angle::wrap(q - step) } else { q }
    };
    let is_in_plane = |q: &f64| misses(*q).0.iter().all(|miss| miss.abs() <= reach.slack(1.0));
    let mut kept = turned.iter().map(refined).filter(is_in_plane);
    match (kept.next(), kept.next()) {
        (Some(q), Some(r)) => Values::Two(q, r),
        (Some(q), None) => Values::One(q),
        _ => Values::None,
    }
}

/// The displacement along `direction` that moves `p` to `k` \[m\]; none when `k` is not on the line.
pub fn translate_to_point(direction: &Unit<Vector3<f64>>, p: &Point3<f64>, k: &Point3<f64>, reach: Reach) -> Values {
    let displacement = k - p;
    let along = direction.dot(&displacement);
    let beside = (displacement - direction.scale(along)).norm();
    let is_reached = along.is_finite() && beside <= reach.slack(displacement_size(p, k));
    if is_reached { Values::One(along) } else { Values::None }
}

/// Pardos-One (PG3), RH0 (2-34): the displacements along `direction` that move `p` to the distance `delta` from `k`
/// \[m\].
///
/// `v.(k - p) +- sqrt(delta^2 - |k - p|^2 + (v.(k - p))^2)`: RH0 (2-35) without its sign factor, which loses solutions
/// (see `docs/errata.md`). None when the line is farther from `k` than `delta`, when `delta` is negative or NaN, or a
/// coordinate is not finite. Of two, the larger comes first.
pub fn translate_to_distance(
    direction: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    k: &Point3<f64>,
    delta: f64,
    reach: Reach,
) -> Values {
    let displacement = k - p;
    let along = direction.dot(&displacement);
    let beside = (displacement - direction.scale(along)).norm();
    let (size, beyond) = (displacement_size(p, k).max(delta), delta - beside);
    if !(displacement.norm().is_finite() && size.is_finite() && delta >= 0.0) || -beyond > reach.slack(size) {
        return Values::None;
    }
    if beyond <= ROUNDING * size {
        return Values::One(along);
    }
    let half = (beyond * (delta + beside)).sqrt();
    Values::Two(along + half, along - half)
}

/// PG1: the displacement along `direction` that moves `p` into the plane through `plane_point` \[m\] with this
/// `normal`.
///
/// Free when the direction is parallel to the plane and `p` is in the plane; none when it is parallel and `p` is not in
/// the plane.
pub fn translate_to_plane(
    direction: &Unit<Vector3<f64>>,
    p: &Point3<f64>,
    normal: &Unit<Vector3<f64>>,
    plane_point: &Point3<f64>,
    reach: Reach,
) -> Values {
    let (displacement, slope) = (plane_point - p, normal.dot(direction));
    let height = normal.dot(&displacement);
    if !height.is_finite() {
        return Values::None;
    }
    if slope.abs() > TOLERANCE {
        return Values::One(height / slope);
    }
    if height.abs() <= reach.slack(displacement_size(p, plane_point)) { Values::Free } else { Values::None }
}

/// A quantity that varies between two extreme values during one turn of a joint, with its target value.
struct HalfAngle {
    /// Distance of the target from the extreme value at `bearing`; negative beyond it.
    above: f64,
    /// Distance of the target from the other extreme value.
    below: f64,
    /// The tangent squared of half the angle from the bearing is `above * weights.0 / (below * weights.1)`.
    weights: (f64, f64),
    /// The difference of the extreme values.
    span: f64,
    /// The size of the subproblem.
    size: f64,
    /// The angle of the first extreme value \[rad\].
    bearing: f64,
}

impl HalfAngle {
    fn angles(&self, reach: Reach) -> Values {
        let slack = reach.slack(self.size);
        if !(self.above >= -slack && self.below >= -slack) {
            return Values::None;
        }
        if self.span <= TOLERANCE * self.size {
            return Values::Free;
        }
        if self.above <= ROUNDING * self.size {
            return Values::One(angle::wrap(self.bearing));
        }
        if self.below <= ROUNDING * self.size {
            return Values::One(angle::wrap(self.bearing + PI));
        }
        let turn = 2.0 * (self.above * self.weights.0).sqrt().atan2((self.below * self.weights.1).sqrt());
        Values::Two(angle::wrap(self.bearing + turn), angle::wrap(self.bearing - turn))
    }
}

/// The circle of `p` about an axis, relative to `k`.
pub(super) struct Circle {
    /// The unit of the lengths below \[m\], which keeps their squares in range.
    unit: f64,
    /// The larger distance of the two points from the axis' point.
    size: f64,
    /// The smallest distance from `k`.
    nearest: f64,
    /// The largest distance from `k`.
    farthest: f64,
    /// The angle in (-pi, pi] at which `p` is nearest to `k`: theta_0 of RH0 (2-33).
    pub(super) bearing: f64,
}

impl Circle {
    /// Builds the circle; `None` when a coordinate relative to the axis' point is not finite.
    pub(super) fn new(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> Option<Circle> {
        let w = axis.direction();
        let (u, v) = (p - axis.point(), k - axis.point());
        if !u.iter().chain(v.iter()).all(|x| x.is_finite()) {
            return None;
        }
        let largest = u.amax().max(v.amax());
        let unit = if largest > 0.0 { largest } else { 1.0 };
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

    /// The law of cosines RH0 (2-33) for half the angle, at `distance` in this circle's unit. Its squared tangent is
    /// (distance^2 - nearest^2) / (farthest^2 - distance^2).
    fn half_angle(&self, distance: f64) -> HalfAngle {
        HalfAngle {
            above: distance - self.nearest,
            below: self.farthest - distance,
            weights: (distance + self.nearest, distance + self.farthest),
            span: self.farthest - self.nearest,
            size: self.size,
            bearing: self.bearing,
        }
    }
}
