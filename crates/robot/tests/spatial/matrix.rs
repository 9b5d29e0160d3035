//! Hat, vee and homogeneous coordinates.

use groebot_robot::ErrorKind;
use groebot_robot::spatial::matrix::{
    point_from_homogeneous, point_to_homogeneous, skew, unskew, vector_to_homogeneous, vee, wedge,
};
use groebot_robot::spatial::pose::position;
use nalgebra::{Matrix3, Point3, Vector4};
use proptest::prelude::*;

use super::{pose, twist, vector};

#[test]
fn points_at_infinity_are_refused() {
    for bad in [[1.0, 0.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0, f64::INFINITY]] {
        assert_eq!(point_from_homogeneous(&Vector4::from(bad)).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn a_skew_matrix_multiplies_as_the_cross_product(w in vector(3.0), x in vector(3.0)) {
        prop_assert_eq!(skew(&w) * x, w.cross(&x));
        prop_assert_eq!(skew(&w).transpose(), -skew(&w));
    }

    #[test]
    fn unskew_undoes_skew_and_sees_the_skew_part_only(w in vector(3.0), a in vector(3.0), b in vector(3.0)) {
        prop_assert_eq!(unskew(&skew(&w)), w);
        let square = a * a.transpose() + b * b.transpose();
        prop_assert!((unskew(&(skew(&w) + square)) - w).norm() < 1e-13);
        prop_assert_eq!(unskew(&Matrix3::from_diagonal(&w)).norm(), 0.0);
    }

    #[test]
    fn wedge_is_the_matrix_of_a_twist(x in twist()) {
        prop_assert_eq!(wedge(&x), super::wedge(&x));
    }

    #[test]
    fn vee_undoes_wedge(x in twist()) {
        prop_assert_eq!(vee(&super::wedge(&x)), x);
    }

    #[test]
    fn a_twist_matrix_gives_the_velocity_of_points(x in twist(), p in vector(3.0)) {
        let velocity = wedge(&x) * point_to_homogeneous(&Point3::from(p));
        prop_assert!((velocity - vector_to_homogeneous(&(x.v + x.w.cross(&p)))).norm() < 1e-13);
    }

    #[test]
    fn homogeneous_points_are_turned_and_shifted(g in pose(), p in vector(3.0)) {
        let moved = g.to_homogeneous() * point_to_homogeneous(&Point3::from(p));
        let expected = g.rotation * p + position(&g).coords;
        prop_assert!((point_from_homogeneous(&moved).unwrap().coords - expected).norm() < 1e-13);
    }

    #[test]
    fn homogeneous_vectors_are_turned_only(g in pose(), v in vector(3.0)) {
        let moved = g.to_homogeneous() * vector_to_homogeneous(&v);
        prop_assert!((moved.xyz() - g.rotation * v).norm() < 1e-13);
        prop_assert_eq!(moved.w, 0.0);
    }

    #[test]
    fn all_multiples_are_the_same_point(p in vector(3.0), factor in prop_oneof![-9.0..-0.1_f64, 0.1..9.0_f64]) {
        let many = point_to_homogeneous(&Point3::from(p)) * factor;
        prop_assert!((point_from_homogeneous(&many).unwrap().coords - p).norm() < 1e-14);
    }
}
