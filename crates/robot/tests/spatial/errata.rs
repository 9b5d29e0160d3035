//! RobotMan's listings (RH0, appendix D) as printed, where they are inaccurate: the proofs of `docs/errata.md`.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_robot::spatial::intersection::{of_line_and_sphere, of_twists};
use groebot_robot::spatial::{Axis, RollPitchYaw, Twist, rotation};
use nalgebra::{Matrix2, Matrix3, Point3, Rotation3, Unit, Vector2, Vector3};
use proptest::prelude::*;

use super::roll_pitch_yaw::product;
use super::{direction, vector};

/// f(25) rotationangle.
fn printed_angle(r: &Matrix3<f64>) -> f64 {
    ((r.trace() - 1.0) / 2.0).clamp(-1.0, 1.0).acos()
}

/// f(26) rotationaxis.
fn printed_axis(r: &Matrix3<f64>, angle: f64) -> Vector3<f64> {
    if angle.sin() == 0.0 {
        return Vector3::zeros();
    }
    Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]) / (2.0 * angle.sin())
}

/// The matrix that f(24) rigidtwist inverts to find v.
fn printed_divisor(r: &Matrix3<f64>) -> Matrix3<f64> {
    let angle = printed_angle(r);
    let w = printed_axis(r, angle);
    (Matrix3::identity() - r) * w.cross_matrix() + w * w.transpose() * angle
}

/// f(28) SphereLineIntersection of the line from `a` to `b`.
fn printed_intersection(
    a: &Vector3<f64>,
    b: &Vector3<f64>,
    centre: &Vector3<f64>,
    radius: f64,
) -> Option<Vector3<f64>> {
    let (d, e) = (b - a, a - centre);
    let (p, q, r) = (d.norm_squared(), 2.0 * d.dot(&e), e.norm_squared() - radius * radius);
    let index = q * q - 4.0 * p * r;
    if index < 0.0 {
        return None;
    }
    let [one, two] = [-1.0, 1.0].map(|sign| a + d * ((-q + sign * index.sqrt()) / (2.0 * p)));
    let far = |x: &Vector3<f64>| (a.z - x.z).hypot(a.x - x.x);
    Some(if far(&one) > far(&two) { two } else { one })
}

/// f(39) twistintersection: least squares, then exact equality of the two nearest points.
fn printed_meeting(a: &Axis, b: &Axis) -> Option<Vector3<f64>> {
    let (u, v, d) = (a.direction().into_inner(), b.direction().into_inner(), b.point() - a.point());
    let normal = Matrix2::new(u.dot(&u), -u.dot(&v), -u.dot(&v), v.dot(&v));
    let ts = normal.lu().solve(&Vector2::new(u.dot(&d), -v.dot(&d)))?;
    let (q1, q2) = (a.point().coords + u * ts.x, b.point().coords + v * ts.y);
    (q1 == q2).then_some(q1)
}

#[test]
fn a_rotation_vector_of_another_length_is_no_rotation_in_the_printed_formula() {
    let (w, t) = (Vector3::new(0.0, 0.0, 2.0), 0.5_f64);
    let ws = w.cross_matrix();
    let printed = Matrix3::identity() + ws * t.sin() + ws * ws * (1.0 - t.cos());
    assert!((printed.determinant() - 1.0).abs() > 0.1, "f(32) needs a vector of length one");
    let expected = Rotation3::from_axis_angle(&Vector3::z_axis(), 1.0);
    assert!((rotation::exp(&(w * t)).to_rotation_matrix().matrix() - expected.matrix()).norm() < 1e-15);
}

#[test]
fn printed_subproblems_answer_what_is_out_of_reach() {
    let (p, q, d): (Vector3<f64>, _, f64) = (Vector3::zeros(), Vector3::new(0.0, 2.0, 0.0), 1.0);
    let along = Vector3::x();
    let pqwn = along.dot(&(p - q)).abs();
    let c = (d * d - (p - q).norm_squared() + pqwn * pqwn).abs().sqrt();
    assert!(
        ((p + along * c - q).norm() - 7_f64.sqrt()).abs() < 1e-14,
        "f(16) answers a point at a distance of 2.6 instead of 1"
    );
    let (p, q, d): (Vector3<f64>, Vector3<f64>, f64) = (Vector3::x(), Vector3::new(3.0, 0.0, 0.0), 1.0);
    let cosine = (p.norm_squared() + q.norm_squared() - d * d) / (2.0 * p.norm() * q.norm());
    assert!(cosine > 1.0, "the real part of its complex arc cosine, which f(14) takes, is 0: a point 2 away");
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn the_printed_angle_loses_small_turns(n in direction(), k in 9..=16_i32) {
        let theta = 10_f64.powi(-k);
        let r = rotation::rodrigues(&Unit::new_normalize(n), theta);
        prop_assert!((printed_angle(r.matrix()) - theta).abs() > 0.5 * theta);
        let ours = rotation::angle(&rotation::from_matrix(r.matrix()).unwrap());
        prop_assert!((ours - theta).abs() < 1e-15 * theta);
    }

    #[test]
    fn the_printed_angle_loses_what_a_half_turn_lacks(n in direction(), k in 9..=14_i32) {
        let lack = 10_f64.powi(-k);
        let r = rotation::rodrigues(&Unit::new_normalize(n), PI - lack);
        prop_assert!((PI - printed_angle(r.matrix()) - lack).abs() > 0.5 * lack);
        let ours = rotation::angle(&rotation::from_matrix(r.matrix()).unwrap());
        prop_assert!((PI - ours - lack).abs() < 2e-15);
    }

    #[test]
    fn the_printed_axis_and_twist_lose_half_turns(n in direction()) {
        let n = n.normalize();
        let r = n * n.transpose() * 2.0 - Matrix3::identity();
        prop_assert_eq!(printed_axis(&r, printed_angle(&r)), Vector3::zeros());
        prop_assert_eq!(printed_divisor(&r).determinant(), 0.0);
        let ours = rotation::axis(&rotation::from_matrix(&r).unwrap()).unwrap();
        prop_assert!(ours.cross(&n).norm() < 1e-15);
    }

    #[test]
    fn the_printed_body_coordinates_turn_about_moving_axes(
        roll in -PI..PI, pitch in -FRAC_PI_2..FRAC_PI_2, yaw in -PI..PI,
    ) {
        let turn = |w: Vector3<f64>, angle| Rotation3::from_axis_angle(&Unit::new_normalize(w), angle);
        let first = turn(Vector3::x(), roll);
        let second = turn(first * Vector3::y(), pitch) * first;
        let third = turn(second * Vector3::z(), yaw) * second;
        let printed = product(&RollPitchYaw { roll, pitch, yaw });
        prop_assert!((third.matrix() - printed).norm() < 1e-14);
    }

    #[test]
    fn the_printed_intersection_keeps_one_of_two_points(a in vector(2.0), b in vector(2.0), centre in vector(1.0)) {
        let line = Axis::through(&a.into(), &b.into()).unwrap();
        let ours = of_line_and_sphere(&line, &centre.into(), 2.0, 0.0);
        let Some(printed) = printed_intersection(&a, &b, &centre, 2.0) else {
            prop_assert_eq!(ours, None);
            return Ok(());
        };
        let off = ours.unwrap().map(|end| (end.coords - printed).norm());
        prop_assert!(off[0].min(off[1]) < 1e-10 / (b - a).norm(), "{off:?}");
    }
}

#[test]
fn the_printed_meeting_point_of_axes_is_mostly_missed() {
    let (mut printed, mut ours) = (0, 0);
    for i in 0..1000 {
        let angle = f64::from(i) * 0.01 + 0.005;
        let p = Point3::new(angle.sin(), angle.cos(), 0.3);
        let directions = [Vector3::new(1.0, angle.cos(), 0.1), Vector3::new(0.2, angle.sin(), 1.0)];
        let [x, y] = directions.map(|w| Axis::new(w, p).unwrap().twist());
        let axis = |x: &Twist| x.axis().unwrap();
        printed += usize::from(printed_meeting(&axis(&x), &axis(&y)).is_some());
        ours += usize::from(of_twists(&x, &y, 1e-12).is_some());
    }
    assert!(printed < 500 && ours == 1000, "f(39) finds {printed}, ours {ours} of 1000 points");
}
