//! The algebra of twists, and the geometry of a twist.

use groebot_robot::ErrorKind;
use groebot_robot::spatial::{Axis, Screw, Twist};
use nalgebra::{Point3, Unit, Vector3};
use proptest::prelude::*;

use super::{axis, direction, twist, vector, wedge};

fn close(x: Twist, y: Twist, tolerance: f64) -> bool {
    (x - y).to_vector().norm() <= tolerance
}

#[test]
fn twists_that_are_zero_or_not_finite_have_no_axis() {
    let not_finite = Twist { v: Vector3::x() * f64::NAN, w: Vector3::x() };
    let infinite = Twist { v: Vector3::x(), w: Vector3::x() * f64::INFINITY };
    let beyond_the_doubles = Twist { v: Vector3::x(), w: Vector3::x() * 1e-310 };
    for bad in [Twist::zero(), not_finite, infinite, beyond_the_doubles] {
        assert_eq!(bad.axis().unwrap_err().kind(), ErrorKind::BadValue);
    }
    assert_eq!(Twist::zero().unit(), Twist::zero());
}

#[test]
fn the_size_of_a_twist_does_not_matter() {
    for size in [1e-200, 1e200] {
        let x = Twist { v: Vector3::new(0.0, -3.0, 2.0) * size, w: Vector3::z() * size };
        let (axis, pitch) = (x.axis().unwrap(), x.pitch());
        assert!((axis.point() - Point3::new(3.0, 0.0, 0.0)).norm() < 1e-14 && (pitch - 2.0).abs() < 1e-14);
        assert!((x.magnitude() / size - 1.0).abs() < 1e-14);
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn the_bracket_is_the_commutator_of_matrices(x in twist(), y in twist()) {
        let expected = wedge(&x) * wedge(&y) - wedge(&y) * wedge(&x);
        prop_assert!((wedge(&x.bracket(&y)) - expected).norm() < 1e-13);
    }

    #[test]
    fn twists_are_a_lie_algebra(x in twist(), y in twist(), z in twist(), a in -2.0..2.0_f64) {
        prop_assert!(close(x.bracket(&y), -y.bracket(&x), 1e-14));
        prop_assert!(close((x * a + z).bracket(&y), x.bracket(&y) * a + z.bracket(&y), 1e-13));
        let cycle = |x: &Twist, y: &Twist, z: &Twist| x.bracket(&y.bracket(z));
        prop_assert!(close(cycle(&x, &y, &z) + cycle(&y, &z, &x) + cycle(&z, &x, &y), Twist::zero(), 1e-12));
    }

    #[test]
    fn the_bracket_is_how_a_motion_changes_a_twist(x in twist(), y in twist()) {
        let h = 1e-4;
        let slope = (y.transform(&x.exp(h)) - y.transform(&x.exp(-h))) * (0.5 / h);
        prop_assert!(close(slope, x.bracket(&y), 1e-6));
    }

    #[test]
    fn coordinates_are_linear_part_first(x in twist()) {
        let vector = x.to_vector();
        prop_assert_eq!([vector[0], vector[1], vector[2]], <[f64; 3]>::from(x.v));
        prop_assert_eq!([vector[3], vector[4], vector[5]], <[f64; 3]>::from(x.w));
        prop_assert_eq!(Twist::from_vector(&vector), x);
    }

    #[test]
    fn on_its_axis_a_twist_moves_along_it_only(x in twist(), along in -3.0..3.0_f64) {
        let axis = x.axis().unwrap();
        let q = axis.point() + axis.direction().scale(along);
        prop_assert!((x.v + x.w.cross(&q.coords) - x.w * x.pitch()).norm() < 1e-12);
    }

    #[test]
    fn the_direction_of_a_twist_is_that_of_its_turning(x in twist()) {
        prop_assert!((x.axis().unwrap().direction().scale(x.w.norm()) - x.w).norm() < 1e-14);
        let shift = Twist { w: Vector3::zeros(), ..x };
        prop_assert!((shift.axis().unwrap().direction().scale(x.v.norm()) - x.v).norm() < 1e-14);
    }

    #[test]
    fn the_point_of_a_twist_is_nearest_to_the_origin(x in twist()) {
        let q = x.axis().unwrap().point().coords;
        prop_assert!(q.dot(&x.w).abs() < 1e-13 * (1.0 + q.norm()));
        let shift = Twist { w: Vector3::zeros(), ..x };
        prop_assert_eq!(shift.axis().unwrap().point(), Point3::origin());
    }

    #[test]
    fn the_magnitude_of_a_twist_is_its_angle_or_else_its_distance(x in twist(), p in vector(2.0)) {
        prop_assert!((x.magnitude() - x.w.norm()).abs() < 1e-14);
        prop_assert!((x.unit().magnitude() - 1.0).abs() < 1e-14);
        prop_assert!(close(x.unit() * x.magnitude(), x, 1e-13));
        let (shift, p) = (Twist { w: Vector3::zeros(), ..x }, Point3::from(p));
        prop_assert!((shift.magnitude() - (shift.exp(1.0) * p - p).norm()).abs() < 1e-14);
    }

    #[test]
    fn the_pitch_is_the_advance_in_one_radian(x in twist()) {
        let axis = x.axis().unwrap();
        let moved = x.unit().exp(1.0) * axis.point();
        let scale = 1.0 + x.pitch().abs();
        prop_assert!(((moved - axis.point()) - axis.direction().scale(x.pitch())).norm() < 1e-12 * scale * scale);
        prop_assert_eq!(Twist { w: Vector3::zeros(), ..x }.pitch(), f64::INFINITY);
    }

    #[test]
    fn a_revolute_joint_turns_about_its_axis(axis in axis(), q in -3.0..3.0_f64, p in vector(2.0)) {
        let x = Screw::revolute(axis.direction().into_inner(), axis.point()).unwrap().twist();
        prop_assert!((x.w - axis.direction().into_inner()).norm() < 1e-15);
        prop_assert!((x.v + x.w.cross(&axis.point().coords)).norm() < 1e-14, "the axis is at rest");
        let p = Point3::from(p);
        prop_assert!((x.exp(q) * p - axis.rotate(q, &p)).norm() < 1e-13);
    }

    #[test]
    fn a_prismatic_joint_shifts_all_points_alike(w in direction(), q in -3.0..3.0_f64, p in vector(2.0)) {
        let x = Screw::prismatic(w).unwrap().twist();
        let p = Point3::from(p);
        prop_assert!((x.exp(q) * p - p - Unit::new_normalize(w).scale(q)).norm() < 1e-14);
        prop_assert_eq!(x.w, Vector3::zeros());
    }

    #[test]
    fn two_points_have_one_line(a in vector(2.0), b in vector(2.0)) {
        let (a, b) = (Point3::from(a), Point3::from(b));
        let line = Axis::through(&a, &b).unwrap();
        prop_assert!(line.distance_to(&a) < 1e-14 && line.distance_to(&b) < 1e-13);
        prop_assert!(line.direction().dot(&(b - a)) > 0.0);
        prop_assert_eq!(Axis::through(&a, &a).unwrap_err().kind(), ErrorKind::BadValue);
    }
}
