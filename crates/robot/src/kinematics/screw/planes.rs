//! Three rotations that move a plane to a plane: the problem that remains for three joints when a chain ends in three
//! parallel axes.
//!
//! The first joint is eliminated by two of its invariants: the component of the plane's normal along its axis, and the
//! offset of a point of the axis from the plane. Both are linear in the cosine and sine of the second angle.

use nalgebra::{Point3, Unit, Vector3};
use smallvec::SmallVec;

use super::trigonometric::zeros;
use super::turn::Turn;
use crate::spatial::{Axis, angle, rotation};

/// A plane: its unit normal and one of its points.
pub(super) type Plane = (Unit<Vector3<f64>>, Point3<f64>);

/// The second and third angles for which `first`, `second` and `third` can move `from` to `to`: up to four pairs.
pub(super) fn carry_plane(
    first: &Axis,
    second: &Axis,
    third: &Axis,
    from: &Plane,
    to: &Plane,
) -> SmallVec<[[f64; 2]; 4]> {
    let (w1, arm) = (first.direction().into_inner(), first.point() - second.point());
    let turn = Turn::new(&second.direction(), [w1, arm]);
    let products = [w1.dot(&to.0), (first.point() - to.1).dot(&to.0)];
    // For the third angle: the normal, and its products with the two vectors after rotation by the second angle.
    let at = |angle: f64| {
        let normal = from.0.into_inner() + rotation::displacement(&third.direction(), angle, &from.0);
        let offset = normal.dot(&(third.rotate(angle, &from.1) - second.point()));
        (normal, [products[0], products[1] + offset])
    };
    let condition = |angle: f64| {
        let (normal, b) = at(angle);
        turn.condition(&normal, b)
    };
    let complete = |third: f64| {
        let (normal, b) = at(third);
        turn.angles(&normal, b).into_iter().flatten().map(move |second| [angle::wrap(second), third])
    };
    zeros(2, condition).into_iter().flat_map(complete).collect()
}
