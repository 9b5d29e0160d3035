//! Exponential and logarithm of SO(3), at all angles and near the two ends of their interval.

use std::f64::consts::PI;

use groebot_robot::ErrorKind;
use groebot_robot::spatial::rotation::{angle, axis, exp, from_matrix, log, rodrigues, rows_of_quaternion};
use nalgebra::{Matrix3, Quaternion, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::{direction, relative, series, vector, wedge};
use groebot_robot::spatial::Twist;

/// A few units in the last place.
const ULPS: f64 = 8.0 * f64::EPSILON;

/// A small angle: any, or 10^-k for k = 1..16.
pub fn small() -> impl Strategy<Value = f64> {
    prop_oneof![1e-3..PI / 2.0, (1..=16_i32).prop_map(|k| 10_f64.powi(-k))]
}

/// Angles of the interval (0, pi\], often within 10^-k of its ends for k = 1..16.
pub fn angles() -> impl Strategy<Value = f64> {
    prop_oneof![small(), small().prop_map(|delta| PI - delta), Just(PI)]
}

fn quaternion(scalar: f64, vector: Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::from_parts(scalar, vector))
}

/// Whether a logarithm equals `w`, or its opposite if the angle is a half turn up to rounding.
fn is_log(found: &Vector3<f64>, w: &Vector3<f64>) -> bool {
    let opposite = -w * ((2.0 * PI - w.norm()) / w.norm());
    relative(found, w) <= ULPS || (PI - w.norm() < 1e-15 && relative(found, &opposite) <= ULPS)
}

/// That the exponential undoes the logarithm of a rotation whose scalar part has that sign. The quaternions are compared and not their matrices, which
/// differ in the Frobenius norm by up to 2 sqrt(2) times as much.
fn is_undone(rotation: &UnitQuaternion<f64>, sign: bool) -> Result<(), TestCaseError> {
    let again = exp(&log(rotation));
    let short_way = if sign { **rotation } else { -**rotation };
    prop_assert!(relative(&again.imag(), &short_way.imag()) <= ULPS);
    prop_assert!((again.scalar() - short_way.scalar()).abs() <= ULPS);
    Ok(())
}

proptest! {
    #[test]
    fn the_rows_of_a_quaternion_are_those_of_its_rotation(w in vector(PI), stretch in -9e-7..9e-7_f64) {
        let rotation = exp(&w);
        let found = rows_of_quaternion((rotation.coords * (1.0 + stretch)).into()).unwrap();
        let wanted = rotation.to_rotation_matrix().into_inner();
        prop_assert!((Matrix3::from_row_slice(&found) - wanted).amax() < ULPS);
    }
}

#[test]
fn a_quaternion_of_another_length_has_no_rotation() {
    assert_eq!(rows_of_quaternion([0.0, 3.0, 0.0, 4.0]), Err(5.0));
    assert_eq!(rows_of_quaternion([0.0; 4]), Err(0.0));
    assert!(rows_of_quaternion([f64::NAN, 0.0, 0.0, 1.0]).is_err());
}

#[test]
fn the_identity_has_no_axis_and_log_zero() {
    for identity in [quaternion(1.0, Vector3::zeros()), quaternion(-1.0, Vector3::zeros())] {
        assert_eq!((log(&identity), angle(&identity), axis(&identity)), (Vector3::zeros(), 0.0, None));
    }
    assert_eq!(exp(&Vector3::zeros()), UnitQuaternion::identity());
}

#[test]
fn tiny_rotations_keep_their_logarithm() {
    for size in [1e-17, 1e-100, 1e-200, 1e-300] {
        let w = Vector3::new(size, -2.0 * size, size);
        assert!((log(&exp(&w)) - w).amax() <= ULPS * size, "{size:e}");
        assert!((angle(&exp(&w)) / size - 6_f64.sqrt()).abs() <= 2.0 * ULPS, "{size:e}");
        assert!((axis(&exp(&w)).unwrap().into_inner() * 6_f64.sqrt() - w / size).norm() <= 2.0 * ULPS, "{size:e}");
    }
}

/// Its matrix differs by more than `ULPS`, its quaternion does not.
#[test]
fn a_logarithm_near_a_half_turn_is_undone() {
    let n = Vector3::new(0.857_466_740_934_108_5, -0.600_988_254_174_390_2, -0.346_647_394_055_096_37);
    let rotation = UnitQuaternion::from_axis_angle(&Unit::new_normalize(n), 2.987_521_467_263_921);
    for rotation in [rotation, quaternion(-rotation.scalar(), -rotation.imag())] {
        is_undone(&rotation, rotation.scalar() > 0.0).unwrap();
    }
}

#[test]
fn matrices_that_are_no_rotations_are_refused() {
    let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
    for bad in [Matrix3::zeros(), mirror, Matrix3::identity() * 1.001, Matrix3::identity() * f64::NAN] {
        assert_eq!(from_matrix(&bad).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

proptest! {
    #![proptest_config(crate::cases(4000))]

    #[test]
    fn log_undoes_exp(n in direction(), theta in angles()) {
        let w = n.normalize() * theta;
        prop_assert!(is_log(&log(&exp(&w)), &w), "{:e}", relative(&log(&exp(&w)), &w));
    }

    #[test]
    fn exp_undoes_log(n in direction(), theta in angles(), sign in prop::bool::ANY) {
        let rotation = UnitQuaternion::from_axis_angle(&Unit::new_normalize(n), theta);
        let rotation = if sign { rotation } else { quaternion(-rotation.scalar(), -rotation.imag()) };
        is_undone(&rotation, sign)?;
    }

    #[test]
    fn exp_is_the_power_series(w in vector(2.0)) {
        let expected = series(&wedge(&Twist { v: Vector3::zeros(), w }));
        prop_assert!((exp(&w).to_homogeneous() - expected).norm() < 1e-14 * w.norm().exp());
    }

    #[test]
    fn a_quaternion_holds_half_the_angle(n in direction(), theta in small()) {
        let (n, (sine, cosine)) = (n.normalize(), (theta / 2.0).sin_cos());
        for sign in [1.0, -1.0] {
            let short = quaternion(sign * cosine, n * (sign * sine));
            prop_assert!(relative(&log(&short), &(n * theta)) <= ULPS);
            prop_assert!((angle(&short) - theta).abs() <= ULPS * theta);
            prop_assert!((axis(&short).unwrap().into_inner() - n).norm() <= ULPS);
            let long = quaternion(sign * sine, n * (sign * cosine));
            prop_assert!(relative(&log(&long), &(n * (PI - theta))) <= ULPS);
            prop_assert!((angle(&long) - (PI - theta)).abs() <= ULPS);
            prop_assert!((axis(&long).unwrap().into_inner() - n).norm() <= ULPS);
        }
    }

    #[test]
    fn an_exact_half_turn_has_the_axis_with_a_positive_first_coordinate(n in direction(), flat in 0..3_usize) {
        let mut n = n;
        n.rows_mut(0, flat).fill(0.0);
        prop_assume!(n.norm() > 0.0);
        let n = n.normalize();
        let leading = n.iter().find(|x| **x != 0.0).unwrap();
        let expected = n * leading.signum();
        for half_turn in [quaternion(0.0, n), quaternion(-0.0, n), quaternion(0.0, -n)] {
            prop_assert!(relative(&log(&half_turn), &(expected * PI)) <= ULPS);
            prop_assert!((axis(&half_turn).unwrap().into_inner() - expected).norm() <= ULPS);
            prop_assert!((angle(&half_turn) - PI).abs() <= ULPS);
        }
    }

    #[test]
    fn matrices_keep_the_logarithm(n in direction(), theta in angles()) {
        let n = Unit::new_normalize(n);
        let found = log(&from_matrix(rodrigues(&n, theta).matrix()).unwrap());
        let w = n.into_inner() * theta;
        let opposite = relative(&found, &(n.into_inner() * (theta - 2.0 * PI)));
        prop_assert!(relative(&found, &w) <= ULPS || (PI - theta < 1e-15 && opposite <= ULPS), "{}", relative(&found, &w));
    }

    #[test]
    fn the_angle_is_that_of_the_trace(n in direction(), theta in 0.0..PI) {
        let rotation = rodrigues(&Unit::new_normalize(n), theta);
        let found = angle(&from_matrix(rotation.matrix()).unwrap());
        prop_assert!((found.cos() - (rotation.matrix().trace() - 1.0) / 2.0).abs() < 1e-15 * 4.0);
    }

    #[test]
    fn the_axis_stays_where_it_is(n in direction(), theta in angles()) {
        let rotation = rodrigues(&Unit::new_normalize(n), theta);
        let found = axis(&from_matrix(rotation.matrix()).unwrap()).unwrap();
        prop_assert!((rotation * found.into_inner() - found.into_inner()).norm() <= ULPS);
        let aside = found.cross(&Vector3::new(0.36, -0.48, 0.8)).normalize();
        prop_assert!((rotation * aside).dot(&found.cross(&aside)) >= -ULPS, "it turns right-handed");
    }
}
