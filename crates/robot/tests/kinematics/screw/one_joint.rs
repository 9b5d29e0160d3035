//! The subproblems of one revolute joint and a point: angles known by construction, solutions checked by rotation, both
//! ends of the reach, and errors of the printed formulas.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_robot::kinematics::screw::one_joint;
use groebot_robot::kinematics::screw::values::{Reach, Values};
use groebot_robot::spatial::Axis;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use super::instance::Random;
use super::{same, size, turned, upright};
use crate::spatial::{axis, vector};

fn rotate_to_distance(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, delta: f64) -> Values {
    one_joint::rotate_to_distance(axis, p, k, delta, Reach::EXACT)
}

fn rotate_to_point(axis: &Axis, p: &Point3<f64>, k: &Point3<f64>) -> Values {
    one_joint::rotate_to_point(axis, p, k, Reach::EXACT)
}

fn point(size: f64) -> impl Strategy<Value = Point3<f64>> {
    vector(size).prop_map(Point3::from)
}

/// Distance of `p` from the axis.
fn radius(axis: &Axis, p: &Point3<f64>) -> f64 {
    axis.direction().cross(&(p - axis.point())).norm()
}

/// Checks that every solution is in (-pi, pi] and reaches `delta` within `tolerance` * size; for a free angle, checks
/// some values.
fn check(angles: Values, axis: &Axis, p: &Point3<f64>, k: &Point3<f64>, delta: f64, tolerance: f64) {
    let some: &[f64] = if angles == Values::Free { &[0.0, 1.0, PI, -2.0] } else { &[] };
    for angle in angles.iter().chain(some.iter().copied()) {
        assert!(-PI < angle && angle <= PI, "{angle} is outside (-pi, pi]");
        let error = ((turned(axis, angle, p) - k).norm() - delta).abs();
        assert!(error <= tolerance * size(axis, p, k), "{angles:?} misses by {error:e}");
    }
}

#[test]
fn all_four_quadrants() {
    let p = Point3::new(2.0, 2.0, 0.5);
    let cases = [
        (Point3::new(2.0, 2.0, 0.5), 0.0),
        (Point3::new(1.0, 3.0, 0.5), FRAC_PI_2),
        (Point3::new(0.0, 2.0, 0.5), PI),
        (Point3::new(1.0, 1.0, 0.5), -FRAC_PI_2),
    ];
    for (k, expected) in cases {
        let Values::One(angle) = rotate_to_point(&upright(), &p, &k) else { panic!("one angle") };
        assert!((angle - expected).abs() < 1e-15, "{angle} is not {expected}");
    }
}

#[test]
fn a_right_triangle_gives_right_angles() {
    // Radii 3 and 4 at a distance of 5 enclose a right angle, on both sides.
    let (p, k) = (Point3::new(4.0, 2.0, 0.0), Point3::new(5.0, 2.0, 0.0));
    let Values::Two(ahead, after) = rotate_to_distance(&upright(), &p, &k, 5.0) else { panic!("two angles") };
    assert!((ahead - FRAC_PI_2).abs() < 1e-15 && (after + FRAC_PI_2).abs() < 1e-15);
}

#[test]
fn ends_of_the_reach_have_one_angle() {
    let (p, k) = (Point3::new(4.0, 2.0, 0.0), Point3::new(1.0, 6.0, 0.0));
    assert_eq!(rotate_to_distance(&upright(), &p, &k, 1.0), Values::One(FRAC_PI_2));
    assert_eq!(rotate_to_distance(&upright(), &p, &k, 7.0), Values::One(-FRAC_PI_2));
    // Twelve metres above, the distances are the hypotenuses (12, 5, 13) and (12, 9, 15).
    let (p, k) = (Point3::new(8.0, 2.0, 0.0), Point3::new(1.0, 4.0, 12.0));
    assert_eq!(rotate_to_distance(&upright(), &p, &k, 13.0), Values::One(FRAC_PI_2));
    assert_eq!(rotate_to_distance(&upright(), &p, &k, 15.0), Values::One(-FRAC_PI_2));
}

#[test]
fn points_on_the_axis_leave_the_angle_free() {
    let (on, other) = (Point3::new(1.0, 2.0, 3.0), Point3::new(1.0, 5.0, 7.0));
    assert_eq!(rotate_to_point(&upright(), &on, &on), Values::Free);
    assert_eq!(rotate_to_point(&upright(), &upright().point(), &upright().point()), Values::Free);
    assert_eq!(rotate_to_point(&upright(), &on, &other), Values::None);
    assert_eq!(rotate_to_point(&upright(), &other, &on), Values::None);
    for (p, k) in [(on, other), (other, on)] {
        assert_eq!(rotate_to_distance(&upright(), &p, &k, 5.0), Values::Free);
        check(Values::Free, &upright(), &p, &k, 5.0, 1e-15);
        assert_eq!(rotate_to_distance(&upright(), &p, &k, 4.9), Values::None);
        assert_eq!(rotate_to_distance(&upright(), &p, &k, 5.1), Values::None);
    }
}

#[test]
fn coincident_points_need_no_rotation() {
    let p = Point3::new(4.0, -1.0, 0.3);
    assert_eq!(rotate_to_point(&upright(), &p, &p), Values::One(0.0));
    assert_eq!(rotate_to_distance(&upright(), &p, &p, 0.0), Values::One(0.0));
}

#[test]
fn nothing_comes_of_bad_numbers() {
    let (p, k) = (Point3::new(4.0, 2.0, 0.0), Point3::new(1.0, 6.0, 0.0));
    for bad in [f64::NAN, f64::INFINITY, -1.0, -f64::MIN_POSITIVE] {
        assert_eq!(rotate_to_distance(&upright(), &p, &k, bad), Values::None);
        assert_eq!(rotate_to_distance(&upright(), &p, &p, bad), Values::None);
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let bad = Point3::new(0.0, bad, 0.0);
        for (p, k) in [(p, bad), (bad, k), (bad, bad)] {
            assert_eq!(rotate_to_point(&upright(), &p, &k), Values::None);
            assert_eq!(rotate_to_distance(&upright(), &p, &k, 5.0), Values::None);
        }
    }
}

#[test]
fn any_magnitude_will_do() {
    let axis = Axis::new(Vector3::z(), Point3::origin()).unwrap();
    for unit in [1e-300, 1e-200, 1e-9, 1e9, 1e200, 1e300] {
        let (p, k) = (Point3::new(3.0 * unit, 0.0, 0.0), Point3::new(4.0 * unit, 0.0, 0.0));
        let Values::Two(ahead, after) = rotate_to_distance(&axis, &p, &k, 5.0 * unit) else { panic!("{unit}") };
        assert!((ahead - FRAC_PI_2).abs() < 1e-15 && (after + FRAC_PI_2).abs() < 1e-15);
    }
}

/// Near an end, inside by 10^-k: two solutions or the merged one. Outside: none, or the end within 1e-12.
#[test]
fn the_boundary_is_crossed_in_order() {
    let axis = Axis::new(Vector3::new(1.0, -2.0, 0.5), Point3::new(0.3, 0.1, -0.2)).unwrap();
    let (p, k) = (Point3::new(1.3, 0.4, 0.9), Point3::new(-0.5, 0.8, 0.2));
    let height = axis.direction().dot(&(p - k));
    let (a, b) = (radius(&axis, &p), radius(&axis, &k));
    for (limit, inwards) in [(height.hypot(a + b), -1.0), (height.hypot(a - b), 1.0)] {
        for exponent in 1..=16 {
            let step = 10f64.powi(-exponent) * size(&axis, &p, &k);
            let inside = limit + inwards * step;
            let angles = rotate_to_distance(&axis, &p, &k, inside);
            let expected = if exponent <= 14 { 2 } else { angles.iter().count().clamp(1, 2) };
            assert_eq!(angles.iter().count(), expected, "{exponent}: {angles:?}");
            check(angles, &axis, &p, &k, inside, 4e-15);
            let outside = limit - inwards * step;
            let angles = rotate_to_distance(&axis, &p, &k, outside);
            match exponent {
                ..12 => assert_eq!(angles, Values::None),
                12 => {}
                _ => assert!(matches!(angles, Values::One(_)), "{exponent}: {angles:?}"),
            }
            check(angles, &axis, &p, &k, outside, 1.01e-12);
        }
    }
}

/// A point moves off the axis by 10^-k: the known angle stays among the solutions, and they stay accurate.
#[test]
fn the_axis_is_left_in_order() {
    let k = Point3::new(1.0, 5.0, 0.0);
    for exponent in 1..=18 {
        let offset = 10f64.powi(-exponent);
        let p = upright().point() + Vector3::new(offset, 0.0, 0.0);
        let delta = (turned(&upright(), 0.7, &p) - k).norm();
        let angles = rotate_to_distance(&upright(), &p, &k, delta);
        let found = angles == Values::Free || angles.iter().any(|angle| same(angle, 0.7, 1e-14 / offset));
        assert!(found, "{exponent}: {angles:?}");
        // The circle changes the distance by twice the offset, relative to a size of three metres.
        assert_eq!(angles == Values::Free, 2.0 * offset < 3e-12, "{exponent}: {angles:?}");
        check(angles, &upright(), &p, &k, delta, if angles == Values::Free { 1e-12 } else { 1e-15 });
    }
}

/// sign(v.(k - p)) v.(p - k) +- l loses both values where k is ahead.
#[test]
fn rh0_2_35_as_printed_is_wrong_along_the_direction() {
    let mut random = Random(2);
    for _ in 0..1000 {
        let (v, p, k, q) = (random.direction(), random.point(), random.point(), random.within(-2.0, 2.0));
        let delta = (p + v.scale(q) - k).norm();
        let along = v.dot(&(k - p));
        if along.abs() < 0.01 {
            continue;
        }
        let l = (delta.powi(2) - (p - k).norm_squared() + along.powi(2)).max(0.0).sqrt();
        let printed = [l, -l].map(|l| along.signum() * v.dot(&(p - k)) + l);
        let right = printed.iter().all(|q| ((p + v.scale(*q) - k).norm() - delta).abs() < 1e-7);
        assert_eq!(right, along < 0.0, "{v:?} {p} {k} {q}");
        let values = one_joint::translate_to_distance(&v, &p, &k, delta, Reach::EXACT);
        assert!(values.iter().any(|found| (found - q).abs() < 1e-6), "{values:?} without {q}");
    }
}

/// The arc cosine of RH0 (2-33) is undefined at many ends of the reach, and loses digits near them.
#[test]
fn rh0_2_33_fails_at_the_ends() {
    let mut random = Random(3);
    let (mut none, mut worst) = (0, 0.0_f64);
    for _ in 0..1000 {
        let (axis, p, k) = (random.axis(), random.point(), random.point());
        let w = axis.direction();
        let [u, v] = [p, k].map(|x| x - axis.foot(&x));
        let bearing = w.dot(&u.cross(&v)).atan2(u.dot(&v));
        let printed = |delta: f64| {
            let square = delta.powi(2) - w.dot(&(p - k)).powi(2);
            ((u.norm_squared() + v.norm_squared() - square) / (2.0 * u.norm() * v.norm())).acos()
        };
        let end = (turned(&axis, bearing, &p) - k).norm();
        none += usize::from(printed(end).is_nan());
        assert!(rotate_to_distance(&axis, &p, &k, end).iter().any(|q| same(q, bearing, 1e-6)));
        let near = (turned(&axis, bearing + 1e-5, &p) - k).norm();
        worst = worst.max((printed(near) - 1e-5).abs());
    }
    assert!(none > 100, "{none} ends without an angle");
    assert!(worst > 1e-9, "off by {worst:e}");
}

proptest! {
    #![proptest_config(ProptestConfig { max_global_rejects: 20_000, ..crate::cases(20_000) })]

    #[test]
    fn the_angle_that_moved_the_point_is_found(axis in axis(), p in point(3.0), theta in -PI..PI) {
        prop_assume!(radius(&axis, &p) > 1e-3);
        let k = turned(&axis, theta, &p);
        let angles = rotate_to_point(&axis, &p, &k);
        let Values::One(angle) = angles else { return Err(TestCaseError::fail(format!("{angles:?}"))) };
        prop_assert!(same(angle, theta, 1e-14 / radius(&axis, &p)), "{angle} is not {theta}");
        check(angles, &axis, &p, &k, 0.0, 4e-15);
    }

    #[test]
    fn points_off_the_circle_are_not_reached(axis in axis(), p in point(3.0), by in vector(1.0), theta in -PI..PI) {
        prop_assume!(radius(&axis, &p) > 1e-3);
        let on_circle = turned(&axis, theta, &p);
        let tangent = axis.direction().cross(&(on_circle - axis.point())).normalize();
        let off_circle = by - tangent * tangent.dot(&by);
        prop_assume!(off_circle.norm() > 1e-3);
        // Steps straight across the axis and back to the circle are not off the circle.
        let k = on_circle + off_circle;
        let height = axis.direction().dot(&(k - p));
        prop_assume!(height.hypot(radius(&axis, &k) - radius(&axis, &p)) > 1e-6);
        prop_assert_eq!(rotate_to_point(&axis, &p, &k), Values::None);
    }

    #[test]
    fn the_angle_that_made_the_distance_is_found(axis in axis(), p in point(3.0), k in point(3.0), theta in -PI..PI) {
        let delta = (turned(&axis, theta, &p) - k).norm();
        let angles = rotate_to_distance(&axis, &p, &k, delta);
        prop_assert!(angles != Values::None);
        check(angles, &axis, &p, &k, delta, 1e-14);
        // The derivative of the distance by the angle, at the known angle.
        let radial = (turned(&axis, theta, &p) - k) / delta;
        let slope = radial.dot(&axis.direction().cross(&(turned(&axis, theta, &p) - axis.point()))).abs();
        let found = angles.iter().any(|angle| same(angle, theta, (1e-14 / slope).max(1e-9)));
        prop_assert!(slope < 1e-6 || found, "{theta} is not among {angles:?}, slope {slope}");
        prop_assert!(slope < 1e-6 || matches!(angles, Values::Two(..)));
    }

    #[test]
    fn tangent_distances_are_reached_at_the_tangent(axis in axis(), p in point(3.0), k in point(3.0)) {
        let (a, b) = (radius(&axis, &p), radius(&axis, &k));
        prop_assume!(a > 0.1 && b > 0.1 && (a - b).abs() > 0.1);
        let Values::One(nearest) = rotate_to_point(&axis, &p, &(axis.foot(&p) + (k - axis.foot(&k)) * (a / b))) else {
            return Err(TestCaseError::fail("no nearest point"));
        };
        let height = axis.direction().dot(&(p - k));
        for (delta, tangent) in [(height.hypot(a - b), nearest), (height.hypot(a + b), nearest + PI)] {
            for delta in [delta, delta - 1e-14, delta + 1e-14] {
                let angles = rotate_to_distance(&axis, &p, &k, delta);
                prop_assert!(angles.iter().count() > 0, "{angles:?}");
                prop_assert!(angles.iter().all(|angle| same(angle, tangent, 1e-5)), "{angles:?} is not {tangent}");
                check(angles, &axis, &p, &k, delta, 3e-13);
            }
            prop_assert_eq!(rotate_to_distance(&axis, &p, &k, delta + 1e-9).iter().count(), 2 * usize::from(tangent == nearest));
            prop_assert_eq!(rotate_to_distance(&axis, &p, &k, delta - 1e-9).iter().count(), 2 * usize::from(tangent != nearest));
        }
    }
}
