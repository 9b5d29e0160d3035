//! Logarithm, adjoint and parts of rigid transforms.

use std::f64::consts::PI;

use groebot_robot::ErrorKind;
use groebot_robot::spatial::pose::{
    adjoint, adjoint_inverse, coadjoint, from_matrix, from_parts, log, magnitude, orientation, position, unit_twist,
};
use groebot_robot::spatial::{Pose, Twist, rotation};
use nalgebra::{Matrix4, Matrix6, Translation3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::rotation::angles;
use super::{direction, pose, relative, series, twist, vector, wedge};

/// A few units in the last place, of the size of the translation.
const ULPS: f64 = 16.0 * f64::EPSILON;

/// Rigid transforms whose rotations are often near the identity or a half turn.
fn extreme() -> impl Strategy<Value = Pose> {
    (direction(), angles(), vector(2.0)).prop_map(|(n, theta, d)| {
        Pose::from_parts(Translation3::from(d), UnitQuaternion::from_axis_angle(&Unit::new_normalize(n), theta))
    })
}

/// The twist of `matrix`, entry by entry.
fn vee(matrix: &Matrix4<f64>) -> Twist {
    let m = |i: usize, j: usize| matrix[(i - 1, j - 1)];
    Twist { v: Vector3::new(m(1, 4), m(2, 4), m(3, 4)), w: Vector3::new(m(3, 2), m(1, 3), m(2, 1)) }
}

fn assert_same(g: &Pose, expected: &Pose) {
    let size = expected.translation.vector.norm();
    let off = (g.translation.vector - expected.translation.vector).norm();
    assert!(off <= ULPS * size, "translation off by {:e}", off / size);
    let turned = orientation(g) - orientation(expected);
    assert!(turned.norm() <= ULPS, "rotation off by {:e}", turned.norm());
}

#[test]
fn the_identity_moves_by_nothing() {
    let identity = Pose::identity();
    assert_eq!((log(&identity), magnitude(&identity), unit_twist(&identity)), (Twist::zero(), 0.0, Twist::zero()));
}

#[test]
fn matrices_that_are_no_rigid_transforms_are_refused() {
    let good = Pose::translation(1.0, 2.0, 3.0).to_homogeneous();
    assert_eq!(from_matrix(&good).unwrap(), Pose::translation(1.0, 2.0, 3.0));
    for (entry, value) in [((3, 3), 2.0), ((3, 0), 1e-3), ((0, 3), f64::NAN), ((0, 0), 1.1), ((2, 2), -1.0)] {
        let mut bad = good;
        bad[entry] = value;
        assert_eq!(from_matrix(&bad).unwrap_err().kind(), ErrorKind::BadValue, "{entry:?}");
    }
}

proptest! {
    #![proptest_config(crate::cases(4000))]

    #[test]
    fn exp_undoes_log(g in extreme()) {
        assert_same(&log(&g).exp(1.0), &g);
    }

    #[test]
    fn the_power_series_of_the_log_is_the_transform(g in pose()) {
        prop_assert!((series(&wedge(&log(&g))) - g.to_homogeneous()).norm() < 1e-12);
    }

    #[test]
    fn log_undoes_exp(n in direction(), theta in angles(), v in vector(2.0)) {
        let x = Twist { v, w: n.normalize() * theta };
        let found = log(&x.exp(1.0));
        if PI - theta < 1e-15 && found.w.dot(&x.w) < 0.0 {
            assert_same(&found.exp(1.0), &x.exp(1.0));
            prop_assert!(relative(&found.w, &-x.w) <= ULPS);
        } else {
            prop_assert!(relative(&found.w, &x.w) <= ULPS, "w off by {:e}", relative(&found.w, &x.w));
            prop_assert!(relative(&found.v, &x.v) <= ULPS, "v off by {:e}", relative(&found.v, &x.v));
        }
    }

    #[test]
    fn a_motion_is_its_unit_twist_times_its_magnitude(g in extreme()) {
        let (x, theta) = (unit_twist(&g), magnitude(&g));
        assert_same(&x.exp(theta), &g);
        prop_assert!((x.w.norm() - 1.0).abs() <= ULPS);
    }

    #[test]
    fn the_magnitude_of_a_motion_is_its_angle_or_else_its_distance(g in extreme(), d in vector(2.0)) {
        prop_assert!((magnitude(&g) - rotation::angle(&g.rotation)).abs() <= ULPS * magnitude(&g));
        let shift = Pose::translation(d.x, d.y, d.z);
        prop_assert!((magnitude(&shift) - d.norm()).abs() <= ULPS);
        let x = unit_twist(&shift);
        prop_assert!(x.w == Vector3::zeros() && (x.v * d.norm() - d).norm() <= ULPS);
    }

    #[test]
    fn the_adjoint_conjugates_the_matrix_of_a_twist(g in pose(), x in twist()) {
        let expected = vee(&(g.to_homogeneous() * wedge(&x) * g.inverse().to_homogeneous()));
        prop_assert!((adjoint(&g) * x.to_vector() - expected.to_vector()).norm() < 1e-13);
        prop_assert!((x.transform(&g).to_vector() - expected.to_vector()).norm() < 1e-13);
    }

    #[test]
    fn adjoints_multiply_as_their_transforms(g in pose(), h in pose()) {
        prop_assert!((adjoint(&(g * h)) - adjoint(&g) * adjoint(&h)).norm() < 1e-13);
        prop_assert!((adjoint(&g) * adjoint_inverse(&g) - Matrix6::identity()).norm() < 1e-13);
        prop_assert!((adjoint_inverse(&g) - adjoint(&g.inverse())).norm() < 1e-13);
        prop_assert!((coadjoint(&g).transpose() * adjoint(&g) - Matrix6::identity()).norm() < 1e-13);
    }

    #[test]
    fn the_adjoint_keeps_brackets(g in pose(), x in twist(), y in twist()) {
        let (outside, inside) = (x.bracket(&y).transform(&g), x.transform(&g).bracket(&y.transform(&g)));
        prop_assert!((outside - inside).to_vector().norm() < 1e-12);
    }

    #[test]
    fn the_exponential_of_an_adjoint_conjugates(g in pose(), x in twist()) {
        let (moved, expected) = (x.transform(&g).exp(1.0), g * x.exp(1.0) * g.inverse());
        prop_assert!((moved.to_homogeneous() - expected.to_homogeneous()).norm() < 1e-13);
    }

    #[test]
    fn the_orientation_turns_vectors(g in pose(), x in vector(2.0)) {
        prop_assert!((orientation(&g) * x - (g * nalgebra::Point3::from(x) - position(&g))).norm() < 1e-14);
    }

    #[test]
    fn the_position_is_where_the_origin_goes(g in pose()) {
        prop_assert_eq!(position(&g), g * nalgebra::Point3::origin());
    }

    #[test]
    fn a_transform_is_made_of_its_parts(g in extreme()) {
        let again = from_parts(&orientation(&g), &position(&g)).unwrap();
        assert_same(&again, &g);
        assert_same(&from_matrix(&g.to_homogeneous()).unwrap(), &g);
        let block = again.to_homogeneous();
        prop_assert!((block.fixed_view::<3, 3>(0, 0) - orientation(&g)).norm() <= ULPS);
        prop_assert_eq!(block.fixed_view::<3, 1>(0, 3).into_owned(), position(&g).coords);
        prop_assert_eq!(block.row(3).into_owned(), nalgebra::RowVector4::new(0.0, 0.0, 0.0, 1.0));
    }
}
