//! The screw solver.

mod circles;
mod families;
mod instance;
mod one_joint;
mod slides_and_planes;
mod solver;
mod solver_record;
mod spare_orders;
mod subproblem_families;
mod subproblems_record;
mod tasks;
mod three_joints;
mod two_joints;
mod two_link;

use groebot_robot::spatial::{Axis, angle};
use nalgebra::{Point3, Rotation3, Vector3};

/// `p` rotated about `axis` by nalgebra's rotation, independently of `Axis::rotate`.
fn turned(axis: &Axis, angle: f64, p: &Point3<f64>) -> Point3<f64> {
    axis.point() + Rotation3::from_axis_angle(&axis.direction(), angle) * (p - axis.point())
}

/// Whether two angles agree modulo whole turns.
fn same(a: f64, b: f64, tolerance: f64) -> bool {
    angle::difference(a, b).abs() <= tolerance
}

/// The z axis through (1, 2, 0).
fn upright() -> Axis {
    Axis::new(Vector3::z(), Point3::new(1.0, 2.0, 0.0)).unwrap()
}

/// The larger distance of two points from the axis' point.
fn size(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> f64 {
    (p - axis.point()).norm().max((k - axis.point()).norm())
}
