//! The subproblems of one joint with planes and prismatic joints: both ends of the reach, free values, and the nearest
//! value out of reach.

use std::f64::consts::PI;

use groebot_robot::kinematics::screw::one_joint;
use groebot_robot::kinematics::screw::values::{Reach, Values};
use groebot_robot::spatial::Axis;
use nalgebra::{Point3, Unit, Vector3};

use super::instance::Random;
use super::{same, turned, upright};

/// The z axis, and the plane z = height.
fn level(height: f64) -> (Unit<Vector3<f64>>, Point3<f64>) {
    (Vector3::z_axis(), Point3::new(0.3, 0.1, height))
}

#[test]
fn a_plane_is_reached_between_its_ends_only() {
    // A circle of radius 2 about the x axis, around height 0.
    let axis = Axis::new(Vector3::x(), Point3::origin()).unwrap();
    let p = Point3::new(0.5, 0.0, 2.0);
    let solve = |height: f64, reach| one_joint::rotate_to_plane(&axis, &p, &level(height).0, &level(height).1, reach);
    assert_eq!(solve(2.0, Reach::EXACT), Values::One(0.0));
    assert_eq!(solve(-2.0, Reach::EXACT), Values::One(PI));
    for exponent in 1..=16 {
        let step = 10f64.powi(-exponent);
        for end in [-2.0, 2.0_f64] {
            let inside = end - end.signum() * step;
            let count = solve(inside, Reach::EXACT).iter().count();
            assert!(count == 2 || exponent > 14 && count == 1, "{exponent}");
            let outside = end + end.signum() * step;
            let refused = solve(outside, Reach::EXACT) == Values::None;
            assert!(exponent == 12 || refused == (exponent < 12), "{exponent}");
            let refused = solve(outside, Reach::Within(1e-6)) == Values::None;
            assert!(exponent == 6 || refused == (exponent < 6), "{exponent}");
            assert_eq!(solve(outside, Reach::Closest).iter().count(), 1);
        }
    }
}

#[test]
fn planes_normal_to_the_axis_leave_the_angle_free() {
    let axis = upright();
    let p = Point3::new(4.0, 2.0, 0.5);
    let solve = |p: &Point3<f64>, height: f64| {
        one_joint::rotate_to_plane(&axis, p, &level(height).0, &level(height).1, Reach::EXACT)
    };
    assert_eq!(solve(&p, 0.5), Values::Free);
    assert_eq!(solve(&p, 0.6), Values::None);
    let upright_plane = |p: &Point3<f64>| {
        one_joint::rotate_to_plane(&axis, p, &Vector3::x_axis(), &Point3::new(1.0, 0.0, 0.0), Reach::EXACT)
    };
    assert_eq!(upright_plane(&Point3::new(1.0, 2.0, 7.0)), Values::Free);
}

#[test]
fn a_line_along_the_axis_follows_its_point() {
    let line = Axis::new(Vector3::z(), Point3::new(3.0, 2.0, 0.0)).unwrap();
    let solve = |x: f64| {
        let plane = Point3::new(x, 0.0, 0.0);
        one_joint::rotate_line_to_plane(&upright(), &line, &Vector3::x_axis(), &plane, Reach::EXACT)
    };
    assert_eq!(solve(1.0).iter().count(), 2);
    assert_eq!(solve(3.0), Values::One(0.0));
    assert_eq!(solve(3.1), Values::None);
    // The plane z = 0 never contains a line along z.
    let (n, point) = level(0.0);
    assert_eq!(one_joint::rotate_line_to_plane(&upright(), &line, &n, &point, Reach::EXACT), Values::None);
}

#[test]
fn a_slide_along_a_plane_is_free_in_it() {
    let (n, plane) = level(1.0);
    let solve = |v: Vector3<f64>, z: f64| {
        one_joint::translate_to_plane(&Unit::new_normalize(v), &Point3::new(0.0, 0.0, z), &n, &plane, Reach::EXACT)
    };
    assert_eq!(solve(Vector3::x(), 1.0), Values::Free);
    assert_eq!(solve(Vector3::x(), 0.9), Values::None);
    assert_eq!(solve(Vector3::z(), 0.0), Values::One(1.0));
}

#[test]
fn a_slide_past_a_point_touches_its_sphere_once() {
    let (p, k) = (Point3::origin(), Point3::new(3.0, 4.0, 0.0));
    let solve = |delta: f64, reach| one_joint::translate_to_distance(&Vector3::x_axis(), &p, &k, delta, reach);
    assert_eq!(solve(4.0, Reach::EXACT), Values::One(3.0));
    assert_eq!(solve(5.0, Reach::EXACT), Values::Two(6.0, 0.0));
    for exponent in 1..=16 {
        let step = 10f64.powi(-exponent);
        assert!(exponent > 14 || solve(4.0 + step, Reach::EXACT).iter().count() == 2);
        assert_ne!(solve(4.0 + step, Reach::EXACT), Values::None);
        assert!(exponent == 12 || (solve(4.0 - step, Reach::EXACT) == Values::None) == (exponent < 12), "{exponent}");
        assert_eq!(solve(4.0 - step, Reach::Closest), Values::One(3.0));
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(solve(bad, Reach::EXACT), Values::None);
    }
}

/// The nearest angle or displacement, compared with 20000 values.
#[test]
fn closest_is_no_farther_than_any_value_of_a_scan() {
    let mut random = Random(1);
    for _ in 0..50 {
        let (axis, p, k, n) = (random.axis(), random.point(), random.point(), random.direction());
        let delta = random.within(0.0, 5.0);
        let turn = |q: f64| turned(&axis, q, &p);
        let slide = |q: f64| p + n.scale(q);
        let far = |x: Point3<f64>| ((x - k).norm() - delta).abs();
        let least = |miss: &dyn Fn(f64) -> f64, range: f64| {
            (-10_000..10_000).map(|i| miss(range * f64::from(i) / 1e4)).fold(f64::INFINITY, f64::min)
        };
        let check = |values: Values, miss: &dyn Fn(f64) -> f64, range: f64| {
            assert!(values.iter().count() > 0);
            values.iter().for_each(|q| assert!(miss(q) <= least(miss, range) + 1e-6));
        };
        check(one_joint::rotate_to_point(&axis, &p, &k, Reach::Closest), &|q| (turn(q) - k).norm(), PI);
        check(one_joint::rotate_to_distance(&axis, &p, &k, delta, Reach::Closest), &|q| far(turn(q)), PI);
        check(one_joint::rotate_to_plane(&axis, &p, &n, &k, Reach::Closest), &|q| n.dot(&(turn(q) - k)).abs(), PI);
        check(one_joint::translate_to_point(&n, &p, &k, Reach::Closest), &|q| (slide(q) - k).norm(), 8.0);
        check(one_joint::translate_to_distance(&n, &p, &k, delta, Reach::Closest), &|q| far(slide(q)), 8.0);
        check(
            one_joint::translate_to_plane(&n, &p, &axis.direction(), &k, Reach::Closest),
            &|q| axis.direction().dot(&(slide(q) - k)).abs(),
            8.0,
        );
    }
}

#[test]
fn slides_and_planes_take_no_bad_numbers() {
    let (axis, good, n) = (upright(), Point3::new(4.0, 2.0, 0.0), Vector3::x_axis());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let bad = Point3::new(bad, 0.1, 0.2);
        for (p, k) in [(bad, good), (good, bad), (bad, bad)] {
            for reach in [Reach::EXACT, Reach::Closest, Reach::Within(f64::NAN)] {
                assert_eq!(one_joint::rotate_to_plane(&axis, &p, &n, &k, reach), Values::None);
                assert_eq!(one_joint::translate_to_point(&n, &p, &k, reach), Values::None, "{p} {k} {reach:?}");
                assert_eq!(one_joint::translate_to_distance(&n, &p, &k, 1.0, reach), Values::None);
                assert_eq!(one_joint::translate_to_plane(&n, &p, &n, &k, reach), Values::None);
            }
        }
    }
}

#[test]
fn slides_and_planes_of_any_magnitude() {
    let axis = Axis::new(Vector3::z(), Point3::origin()).unwrap();
    for unit in [1e-150, 1e-100, 1e-9, 1e9, 1e100, 1e150] {
        let p = Point3::new(unit, 0.0, 0.0);
        let (k, n) = (Point3::new(3.0 * unit, 4.0 * unit, 0.0), Vector3::y_axis());
        let Values::Two(q, r) =
            one_joint::rotate_to_plane(&axis, &p, &n, &Point3::new(0.0, 0.5 * unit, 0.0), Reach::EXACT)
        else {
            panic!("{unit:e}")
        };
        assert!(same(q, 5.0 * PI / 6.0, 1e-14) && same(r, PI / 6.0, 1e-14));
        let slid =
            one_joint::translate_to_distance(&Vector3::x_axis(), &Point3::origin(), &k, 5.0 * unit, Reach::EXACT);
        let Values::Two(far, near) = slid else { panic!("{unit:e}") };
        assert!((far / unit - 6.0).abs() < 1e-14 && (near / unit).abs() < 1e-14);
        assert_eq!(one_joint::translate_to_plane(&n, &Point3::origin(), &n, &k, Reach::EXACT), Values::One(4.0 * unit));
    }
}
