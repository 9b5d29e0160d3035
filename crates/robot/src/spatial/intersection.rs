//! Intersections of a line with a sphere, and of the axes of two twists.

use nalgebra::Point3;

use super::{Axis, Relation, Twist};

/// The two points of intersection of `line` and the sphere, in the order of its direction. Lengths are in one unit.
/// RobotMan f(28).
///
/// A line within `tolerance` of the sphere touches it: both points are then its point nearest to the centre. `None`
/// when it is further away, when the radius is negative, and when a number is not finite.
pub fn of_line_and_sphere(line: &Axis, centre: &Point3<f64>, radius: f64, tolerance: f64) -> Option<[Point3<f64>; 2]> {
    let foot = line.foot(centre);
    let distance = (foot - centre).norm();
    if !(0.0 <= radius && radius.is_finite() && distance <= radius + tolerance) {
        return None;
    }
    let half_chord = ((radius - distance) * (radius + distance)).max(0.0).sqrt();
    let step = line.direction().scale(half_chord);
    Some([foot - step, foot + step])
}

/// The point of intersection of the axes (2-12) of two twists, to `tolerance` in the unit of their pitch; RobotMan
/// f(39).
///
/// `None` when they do not intersect, when they are parallel or coaxial, and when a twist is zero or not finite. A pure
/// translation has no position, so it gives `None` too.
pub fn of_twists(x: &Twist, y: &Twist, tolerance: f64) -> Option<Point3<f64>> {
    if x.pitch().is_infinite() || y.pitch().is_infinite() {
        return None;
    }
    match x.axis().ok()?.relation(&y.axis().ok()?, tolerance) {
        Relation::Intersecting { point } => Some(point),
        Relation::Coincident | Relation::Parallel { .. } | Relation::Skew { .. } => None,
    }
}
