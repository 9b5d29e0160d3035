//! Angles, rotations, screws and twists compared with matrix definitions that share no code with them.

mod errata;
mod exact_rotation;
mod inertia;
mod intersection;
mod matrix;
mod pose;
mod robotman;
mod roll_pitch_yaw;
mod rotation;
mod screw_coordinates;
mod twist;
mod wrench;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use groebot_robot::ErrorKind;
use groebot_robot::spatial::{Axis, Pose, Screw, Twist, angle};
use nalgebra::{Matrix4, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

/// A vector with entries in [-size, size].
pub fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    (-size..size, -size..size, -size..size).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

/// A direction that is not too short.
pub fn direction() -> impl Strategy<Value = Vector3<f64>> {
    vector(1.0).prop_filter("short", |w| w.norm() > 0.1)
}

/// An axis through a point near the origin.
pub fn axis() -> impl Strategy<Value = Axis> {
    (direction(), vector(2.0)).prop_map(|(w, r)| Axis::new(w, Point3::from(r)).unwrap())
}

/// A twist with parts of size up to 2.
pub fn twist() -> impl Strategy<Value = Twist> {
    (vector(2.0), vector(2.0)).prop_map(|(v, w)| Twist { v, w })
}

/// A rigid transform with any rotation, up to 2 from the origin.
pub fn pose() -> impl Strategy<Value = Pose> {
    (direction(), -PI..PI, vector(2.0)).prop_map(|(w, angle, d)| {
        let rotation = UnitQuaternion::from_axis_angle(&Unit::new_normalize(w), angle);
        Pose::from_parts(Translation3::from(d), rotation)
    })
}

/// The matrix of a twist, entry by entry as printed in RH0 (2-4), (2-6).
pub fn wedge(twist: &Twist) -> Matrix4<f64> {
    let Twist { v, w } = twist;
    Matrix4::new(0.0, -w.z, w.y, v.x, w.z, 0.0, -w.x, v.y, -w.y, w.x, 0.0, v.z, 0.0, 0.0, 0.0, 0.0)
}

/// The distance of `actual` from `expected`, relative to the length of `expected`.
fn relative(actual: &Vector3<f64>, expected: &Vector3<f64>) -> f64 {
    (actual - expected).norm() / expected.norm()
}

/// The power series of the matrix exponential: the definition that (2-7) sums up.
pub fn series(matrix: &Matrix4<f64>) -> Matrix4<f64> {
    let mut term = Matrix4::identity();
    (1..80).fold(term, |sum, n| {
        term = term * matrix / n as f64;
        sum + term
    })
}

fn assert_close(actual: &Pose, expected: &Matrix4<f64>, tolerance: f64) {
    let difference = (actual.to_homogeneous() - expected).norm();
    assert!(difference <= tolerance, "off by {difference:e}: {actual} is not {expected}");
}

#[test]
fn wrap_keeps_the_upper_end_and_moves_the_lower() {
    assert_eq!(angle::wrap(PI), PI);
    assert_eq!(angle::wrap(-PI), PI);
    assert_eq!(angle::wrap(PI.next_up()), PI.next_up() - TAU);
    assert_eq!(angle::wrap((-PI).next_up()), (-PI).next_up());
    assert_eq!(angle::wrap(TAU), 0.0);
    assert_eq!(angle::wrap(3.0 * FRAC_PI_2), -FRAC_PI_2);
    assert!(angle::wrap(f64::NAN).is_nan() && angle::wrap(f64::INFINITY).is_nan());
}

#[test]
fn difference_is_the_shorter_rotation() {
    assert!((angle::difference(PI - 0.1, 0.1 - PI) + 0.2).abs() < 1e-15);
    assert_eq!(angle::difference(FRAC_PI_2, -FRAC_PI_2), PI);
    assert_eq!(angle::difference(-FRAC_PI_2, FRAC_PI_2), PI);
}

#[test]
fn a_quarter_turn_follows_the_right_hand() {
    let axis = Axis::new(Vector3::z() * 7.0, Point3::new(1.0, 0.0, 5.0)).unwrap();
    let turned = axis.rotate(FRAC_PI_2, &Point3::new(2.0, 0.0, 3.0));
    assert!((turned - Point3::new(1.0, 1.0, 3.0)).norm() < 1e-15);
}

#[test]
fn axes_without_direction_are_refused() {
    let origin = Point3::origin();
    for bad in [Vector3::zeros(), Vector3::x() * f64::NAN, Vector3::x() * f64::INFINITY] {
        assert_eq!(Axis::new(bad, origin).unwrap_err().kind(), ErrorKind::BadValue);
        assert_eq!(Screw::prismatic(bad).unwrap_err().kind(), ErrorKind::BadValue);
    }
    assert_eq!(Axis::new(Vector3::x(), origin * f64::NAN).unwrap_err().kind(), ErrorKind::BadValue);
    for size in [1e-300, 5e-324, 1e300] {
        let axis = Axis::new(Vector3::new(size, 0.0, size), origin).unwrap();
        assert!((axis.direction().norm() - 1.0).abs() < 1e-15);
        assert!((axis.direction().x - 0.5_f64.sqrt()).abs() < 1e-15);
    }
}

proptest! {
    #![proptest_config(crate::cases(2000))]

    #[test]
    fn wrapped_angles_lie_in_the_interval_on_the_same_ray(angle in -1e6..1e6_f64) {
        let wrapped = angle::wrap(angle);
        prop_assert!(-PI < wrapped && wrapped <= PI);
        let turns = (angle - wrapped) / TAU;
        prop_assert!((turns - turns.round()).abs() < 1e-9);
        prop_assert!((angle::difference(angle, wrapped)).abs() == 0.0);
    }

    #[test]
    fn rodrigues_is_the_matrix_exponential(w in direction(), theta in -7.0..7.0_f64, x in vector(3.0)) {
        let unit = Unit::new_normalize(w);
        let rotation = groebot_robot::spatial::rotation::rodrigues(&unit, theta);
        let twist = Twist { v: Vector3::zeros(), w: unit.into_inner() };
        let expected = series(&(wedge(&twist) * theta));
        prop_assert!((rotation.to_homogeneous() - expected).amax() < 1e-12);
        prop_assert!((rotation.matrix() * rotation.matrix().transpose()).is_identity(1e-14));
        let moved = x + groebot_robot::spatial::rotation::displacement(&unit, theta, &x);
        prop_assert!((rotation * x - moved).norm() < 1e-13);
    }

    #[test]
    fn a_twist_of_any_length_exponentiates(
        v in vector(2.0), w in direction(), size in prop_oneof![Just(0.0), -20.0..0.0_f64], theta in -3.0..3.0_f64,
    ) {
        let w = if size == 0.0 { Vector3::zeros() } else { w * 10f64.powf(size) };
        let twist = Twist { v, w };
        assert_close(&twist.exp(theta), &series(&(wedge(&twist) * theta)), 1e-12);
    }

    #[test]
    fn screws_move_as_their_twists(axis in axis(), w in direction(), q in -7.0..7.0_f64) {
        for screw in [Screw::Revolute(axis), Screw::prismatic(w).unwrap()] {
            assert_close(&screw.exp(q), &series(&(wedge(&screw.twist()) * q)), 1e-11);
            assert_close(&screw.exp(q), &screw.twist().exp(q).to_homogeneous(), 1e-13);
        }
    }

    #[test]
    fn motions_about_one_screw_add_up(axis in axis(), a in -4.0..4.0_f64, b in -4.0..4.0_f64) {
        let both = axis.rotation(a) * axis.rotation(b);
        assert_close(&both, &axis.rotation(a + b).to_homogeneous(), 1e-13);
    }

    #[test]
    fn rotations_fix_their_axis_and_keep_distances_to_it(axis in axis(), p in vector(3.0), q in -4.0..4.0_f64) {
        let p = Point3::from(p);
        let turned = axis.rotate(q, &p);
        prop_assert!((axis.rotation(q) * p - turned).norm() < 1e-13);
        let foot = axis.foot(&p);
        prop_assert!((foot - p).dot(&axis.direction()).abs() < 1e-13);
        prop_assert!((axis.rotate(q, &foot) - foot).norm() < 1e-13);
        prop_assert!(((turned - axis.point()).norm() - (p - axis.point()).norm()).abs() < 1e-13);
        prop_assert_eq!(axis.level_with(&p).point(), foot);
        prop_assert_eq!(axis.rotate(0.0, &p), p);
    }
}
