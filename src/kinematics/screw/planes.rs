//! Three rotations carry a plane to a plane: what three parallel axes at an end of a chain leave to the other three.
//!
//! The first axis is cancelled by two numbers that it keeps: the component of the plane's normal along it, and the offset
//! of a point of it from the plane. Both are linear in the cosine and sine of the second angle with constant factors, so
//! that the length of a vector gives an equation of degree four in the half tangent of the third.

use nalgebra::{Matrix2, Point3, Unit, Vector2, Vector3};
use smallvec::SmallVec;

use super::trigonometric::zeros;
use crate::spatial::{Axis, angle, rotation};

/// A plane: its unit normal and a point of it.
pub(super) type Plane = (Unit<Vector3<f64>>, Point3<f64>);

/// The second and third angles with which `first`, `second` and `third` can carry `from` to `to`: up to four pairs.
pub(super) fn carry_plane(first: &Axis, second: &Axis, third: &Axis, from: &Plane, to: &Plane) -> SmallVec<[[f64; 2]; 4]> {
    let along = second.direction();
    let Some(e1) = Unit::try_new(along.cross(&Vector3::ith(along.iamin(), 1.0)), 0.0) else { return SmallVec::new() };
    let flat = |x: &Vector3<f64>| Vector2::new(e1.dot(x), along.cross(&e1).dot(x));
    // The two vectors whose products with the turned normal are known.
    let (w1, arm) = (first.direction().into_inner(), first.point() - second.point());
    let (f1, f2) = (flat(&w1), flat(&arm));
    let Some(inverse) = Matrix2::new(f1.x, f1.y, f2.x, f2.y).try_inverse() else { return SmallVec::new() };
    let products = (w1.dot(&to.0), (first.point() - to.1).dot(&to.0));
    // At the third angle: the normal across the second axis, and what the second angle must turn it to.
    let at = |angle: f64| {
        let normal = from.0.into_inner() + rotation::displacement(&third.direction(), angle, &from.0);
        let offset = normal.dot(&(third.rotate(angle, &from.1) - second.point()));
        let height = along.dot(&normal);
        let known = Vector2::new(
            products.0 - height * along.dot(&w1),
            products.1 + offset - height * along.dot(&arm),
        );
        (flat(&normal), inverse * known)
    };
    let condition = |angle: f64| {
        let (have, want) = at(angle);
        want.norm_squared() - have.norm_squared()
    };
    let complete = |third: f64| {
        let (have, want) = at(third);
        [angle::wrap(have.perp(&want).atan2(have.dot(&want))), third]
    };
    zeros(2, condition).into_iter().map(complete).collect()
}
