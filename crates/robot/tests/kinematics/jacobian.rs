//! Manipulator Jacobians compared with differences of forward kinematics.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{Chain, jacobian};
use groebot_robot::spatial::{Pose, Screw, Wrench, pose};
use nalgebra::{Matrix4, Vector6};
use proptest::prelude::*;

use super::documented_example;
use crate::errors::assert_error;
use crate::spatial::{axis, direction, pose as any_pose};

/// A revolute or prismatic joint.
pub fn screw() -> impl Strategy<Value = Screw> {
    prop_oneof![3 => axis().prop_map(Screw::Revolute), 1 => direction().prop_map(|w| Screw::prismatic(w).unwrap())]
}

/// Up to six joints, their values and the tip at zero.
fn arm() -> impl Strategy<Value = (Vec<Screw>, Vec<f64>, Pose)> {
    (1..7_usize)
        .prop_flat_map(|n| (prop::collection::vec(screw(), n), prop::collection::vec(-3.0..3.0_f64, n), any_pose()))
}

/// The product of exponentials, RH0 (2-20), in matrices.
fn forward(screws: &[Screw], q: &[f64], tip: &Pose) -> Matrix4<f64> {
    let moved = screws.iter().zip(q).map(|(screw, q)| screw.exp(*q).to_homogeneous());
    moved.fold(Matrix4::<f64>::identity(), |product, motion| product * motion) * tip.to_homogeneous()
}

/// `q` with `by` added to joint `i`.
pub fn moved(q: &[f64], i: usize, by: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    q[i] += by;
    q
}

/// The derivative at zero of a function of one number, by the five-point formula: of order four in the step.
pub fn slope<T>(f: impl Fn(f64) -> T) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let h = 1e-3;
    (f(h) - f(-h)) * (2.0 / (3.0 * h)) - (f(2.0 * h) - f(-2.0 * h)) * (1.0 / (12.0 * h))
}

/// The coordinates (v, w) of a matrix of se(3).
fn coordinates(matrix: &Matrix4<f64>) -> Vector6<f64> {
    let m = |i: usize, j: usize| matrix[(i - 1, j - 1)];
    Vector6::new(m(1, 4), m(2, 4), m(3, 4), m(3, 2), m(1, 3), m(2, 1))
}

#[test]
fn joint_values_are_checked() {
    let leg = Chain::from_toml(&documented_example()).unwrap();
    for result in [leg.spatial_jacobian(&[0.0]), leg.body_jacobian(&[0.0])] {
        assert_error(&result.unwrap_err(), ErrorKind::BadValue, None, "there are 2 joints");
    }
    let error = leg.body_jacobian(&[0.0, f64::NAN]).unwrap_err();
    assert_error(&error, ErrorKind::BadValue, None, "joint 2 of 2");
}

#[test]
fn without_joints_nothing_moves() {
    assert_eq!(jacobian::spatial(&[], &[]).unwrap().shape(), (6, 0));
    assert_eq!(jacobian::body(&[], &Pose::identity(), &[]).unwrap().shape(), (6, 0));
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn the_spatial_jacobian_is_the_velocity_in_the_base_frame((screws, q, tip) in arm()) {
        let found = jacobian::spatial(&screws, &q).unwrap();
        let back = forward(&screws, &q, &tip).try_inverse().unwrap();
        for i in 0..q.len() {
            let velocity = slope(|h| forward(&screws, &moved(&q, i, h), &tip)) * back;
            prop_assert!((found.column(i) - coordinates(&velocity)).norm() < 1e-9);
        }
    }

    #[test]
    fn the_body_jacobian_is_the_velocity_in_the_tip_frame((screws, q, tip) in arm()) {
        let found = jacobian::body(&screws, &tip, &q).unwrap();
        let back = forward(&screws, &q, &tip).try_inverse().unwrap();
        for i in 0..q.len() {
            let velocity = back * slope(|h| forward(&screws, &moved(&q, i, h), &tip));
            prop_assert!((found.column(i) - coordinates(&velocity)).norm() < 1e-9);
        }
    }

    #[test]
    fn the_adjoint_of_the_tip_takes_one_jacobian_to_the_other((screws, q, tip) in arm()) {
        let base_from_tip = pose::from_matrix(&forward(&screws, &q, &tip)).unwrap();
        let moved = pose::adjoint(&base_from_tip) * jacobian::body(&screws, &tip, &q).unwrap();
        prop_assert!((moved - jacobian::spatial(&screws, &q).unwrap()).norm() < 1e-11);
    }

    #[test]
    fn the_transposed_jacobian_gives_the_joint_torques((screws, q, tip) in arm(), f in prop::array::uniform6(-1.0..1.0_f64)) {
        let wrench = Wrench::from_vector(&Vector6::from(f));
        let base_from_tip = pose::from_matrix(&forward(&screws, &q, &tip)).unwrap();
        let in_tip = jacobian::body(&screws, &tip, &q).unwrap().transpose() * wrench.to_vector();
        let in_base = jacobian::spatial(&screws, &q).unwrap().transpose() * wrench.transform(&base_from_tip).to_vector();
        prop_assert!((in_tip - in_base).norm() < 1e-11);
    }

    #[test]
    fn a_chain_has_the_jacobians_of_its_screws(q3 in -4.0..4.0f64, q4 in -4.0..4.0f64) {
        let leg = Chain::from_toml(&documented_example()).unwrap();
        let q = [q3, q4];
        prop_assert_eq!(leg.spatial_jacobian(&q).unwrap(), jacobian::spatial(leg.screws(), &q).unwrap());
        prop_assert_eq!(leg.body_jacobian(&q).unwrap(), jacobian::body(leg.screws(), &leg.base_from_tip(), &q).unwrap());
        let tip = leg.forward(&q).unwrap();
        let velocity = leg.body_jacobian(&q).unwrap() * nalgebra::Vector2::new(1.0, 0.0);
        let x_and_z = tip.rotation * nalgebra::Vector3::new(velocity[0], velocity[1], velocity[2]);
        let expected = nalgebra::Vector3::new(tip.translation.z, 0.0, -tip.translation.x);
        prop_assert!((x_and_z - expected).norm() < 1e-10, "the hip at the origin turns the tip about y");
    }
}
