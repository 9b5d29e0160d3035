//! The Paden-Kahan subproblems of one rotation, about any axis: RH0 2.3.3, (2-28), (2-29), (2-32), (2-33).
//!
//! Rotating `p` about an axis moves it on a circle whose distance from `k` lies in an interval
//! \[nearest, farthest\]. Subproblem 3 asks for the angles at a given distance, subproblem 1 for distance zero.
//!
//! Tolerance. Let r be the axis' point and *size* the larger of |p - r| and |k - r|.
//! * A distance outside the interval by at most [`TOLERANCE`] * size counts as the nearer end.
//! * The angle is free when the interval is at most [`TOLERANCE`] * size long: no rotation matters.
//! * Two angles are merged into one at an end of the interval when the distance is within [`ROUNDING`] * size of it.
//!
//! Near an end the distance hardly depends on the angle: a distance known to e * size leaves the angle
//! uncertain by about sqrt(e). The distance that an answer reaches is accurate throughout.
//!
//! Lengths may have any magnitude, but r should be near p and k: rounding of the axis' direction acts at that distance.

use std::f64::consts::PI;

use nalgebra::Point3;

use crate::spatial::{Axis, angle};

/// How far out of reach, relative to the size of the problem, a target may be and still be reached.
pub const TOLERANCE: f64 = 1e-12;

/// How near to an end of its interval, relative to the size of the problem, a distance has one angle instead of two.
pub const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// All angles in (-pi, pi] that solve a subproblem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Angles {
    /// No angle does it.
    None,
    /// Exactly one angle does it.
    One(f64),
    /// Two different angles do it.
    Two(f64, f64),
    /// Every angle does it.
    Free,
}

impl Angles {
    /// The determined angles \[rad\]: none when there are none or when every angle does it.
    pub fn iter(self) -> impl Iterator<Item = f64> {
        let pair = match self {
            Angles::None | Angles::Free => [None, None],
            Angles::One(first) => [Some(first), None],
            Angles::Two(first, second) => [Some(first), Some(second)],
        };
        pair.into_iter().flatten()
    }
}

/// Subproblem 1, RH0 (2-28), (2-29): the angle that rotates `p` about `axis` onto `k` \[m\].
///
/// Free when both points lie on the axis and coincide; none when `k` is not on the circle of `p` (see the
/// [tolerance](self)) or a coordinate is not finite. Never two.
pub fn rotate_to_point(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> Angles {
    rotate_to_distance(axis, p, k, 0.0)
}

/// Subproblem 3, RH0 (2-32), (2-33): the angles that rotate `p` about `axis` to the distance `delta` from `k` \[m\].
///
/// Free when `p` or `k` lies on the axis and the distance fits; none when `delta` is out of reach (see the
/// [tolerance](self)), negative or NaN, or a coordinate is not finite. Of two angles, the first lies ahead of
/// the one nearest to `k`, the second behind it.
pub fn rotate_to_distance(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, delta: f64) -> Angles {
    Circle::new(axis, p, k).map_or(Angles::None, |circle| circle.angles_at(delta / circle.unit))
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

    /// The angles at `distance`, in this circle's unit.
    ///
    /// The law of cosines RH0 (2-33), for half the angle: its tangent squared is
    /// (distance^2 - nearest^2) / (farthest^2 - distance^2).
    fn angles_at(&self, distance: f64) -> Angles {
        let slack = TOLERANCE * self.size;
        let reach = self.nearest - slack..=self.farthest + slack;
        if distance < 0.0 || !reach.contains(&distance) {
            return Angles::None;
        }
        if self.farthest - self.nearest <= slack {
            return Angles::Free;
        }
        let (above, below) = (distance - self.nearest, self.farthest - distance);
        if above <= ROUNDING * self.size {
            return Angles::One(self.bearing);
        }
        if below <= ROUNDING * self.size {
            return Angles::One(angle::wrap(self.bearing + PI));
        }
        let sine = (above * (distance + self.nearest)).sqrt();
        let cosine = (below * (distance + self.farthest)).sqrt();
        let turn = 2.0 * sine.atan2(cosine);
        Angles::Two(angle::wrap(self.bearing + turn), angle::wrap(self.bearing - turn))
    }
}
