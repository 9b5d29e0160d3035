//! The inertia matrix of a manipulator, by Jacobians and by adjoints.

use groebot_robot::ErrorKind;
use groebot_robot::dynamics::Model;
use groebot_robot::spatial::{Inertia, Pose, Screw};
use nalgebra::{DMatrix, Matrix3, Matrix4, Matrix6, Point3, Vector3, Vector6};
use proptest::prelude::*;

use super::{Part, case, model};
use crate::spatial::{twist, wedge};

fn pendulum() -> Model {
    let inertia = Inertia::new(2.0, Point3::new(0.5, 0.0, 0.0), Matrix3::identity() * 0.1).unwrap();
    let screw = Screw::revolute(Vector3::z(), Point3::origin()).unwrap();
    model(None, &[Part { parent: None, screw, base_from_link: Pose::identity(), inertia }])
}

#[test]
fn a_pendulum_has_the_inertia_of_steiner() {
    let expected = 0.1 + 2.0 * 0.5 * 0.5;
    assert!((pendulum().inertia(&[0.7]).unwrap()[(0, 0)] - expected).abs() < 1e-15);
    assert!(pendulum().coriolis(&[0.7], &[3.0]).unwrap()[(0, 0)].abs() < 1e-15);
}

#[test]
fn two_pendulums_in_a_plane_have_the_matrices_of_the_textbook() {
    // Spong and Vidyasagar 1989, 6.4: two links, centres at l1/2 and l2/2, moments i1 and i2.
    let (m1, m2, l1, l2, i1, i2) = (2.0, 1.5, 0.8, 0.6, 0.11, 0.07);
    let (lc1, lc2) = (l1 / 2.0, l2 / 2.0);
    let part = |parent, at, mass, centre, moment| Part {
        parent,
        screw: Screw::revolute(Vector3::z(), Point3::new(at, 0.0, 0.0)).unwrap(),
        base_from_link: Pose::translation(at, 0.0, 0.0),
        inertia: Inertia::new(mass, Point3::new(centre, 0.0, 0.0), Matrix3::identity() * moment).unwrap(),
    };
    let arm = model(None, &[part(None, 0.0, m1, lc1, i1), part(Some(0), l1, m2, lc2, i2)]);
    let (q, rate) = ([0.4_f64, -1.1_f64], [0.7, -0.3]);
    let (sine, cosine) = q[1].sin_cos();
    let d11 = m1 * lc1 * lc1 + m2 * (l1 * l1 + lc2 * lc2 + 2.0 * l1 * lc2 * cosine) + i1 + i2;
    let d12 = m2 * (lc2 * lc2 + l1 * lc2 * cosine) + i2;
    let d22 = m2 * lc2 * lc2 + i2;
    let expected = DMatrix::from_row_slice(2, 2, &[d11, d12, d12, d22]);
    assert!((arm.inertia(&q).unwrap() - expected).norm() < 1e-14);
    let h = -m2 * l1 * lc2 * sine;
    let expected = DMatrix::from_row_slice(2, 2, &[h * rate[1], h * (rate[0] + rate[1]), -h * rate[0], 0.0]);
    assert!((arm.coriolis(&q, &rate).unwrap() - expected).norm() < 1e-14);
}

#[test]
fn joints_bodies_and_values_are_checked() {
    let arm = pendulum();
    let refused = [
        arm.inertia(&[]).unwrap_err(),
        arm.inertia(&[f64::NAN]).unwrap_err(),
        arm.body_jacobian(2, &Pose::identity(), &[0.0]).unwrap_err(),
        arm.transformed_inertia(2).unwrap_err(),
        arm.adjoint(0, 1, &[0.0]).unwrap_err(),
        arm.adjoint(0, 0, &[]).unwrap_err(),
        arm.inertia_derivatives(&[]).unwrap_err(),
        arm.coriolis(&[0.0], &[]).unwrap_err(),
    ];
    for error in refused {
        assert_eq!(error.kind(), ErrorKind::BadValue, "{error}");
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn a_link_adds_its_kinetic_energy(case in case()) {
        for link in 0..case.q.len() {
            let found = case.rates().dot(&(case.arm.body_inertia(link + 1, &case.q).unwrap() * case.rates())) / 2.0;
            let energy = case.kinetic_energy_of(link);
            prop_assert!((found - energy).abs() < 1e-8 * (1.0 + energy), "{found} is not {energy}");
        }
    }

    #[test]
    fn the_inertia_matrix_gives_the_kinetic_energy_of_all_links(case in case()) {
        let matrix = case.arm.inertia(&case.q).unwrap();
        let energy: f64 = (0..case.q.len()).map(|link| case.kinetic_energy_of(link)).sum();
        let found = case.rates().dot(&(&matrix * case.rates())) / 2.0;
        prop_assert!((found - energy).abs() < 1e-8 * (1.0 + energy), "{found} is not {energy}");
    }

    #[test]
    fn the_inertia_matrix_is_symmetric_and_positive(case in case()) {
        let matrix = case.arm.inertia(&case.q).unwrap();
        prop_assert!((&matrix - matrix.transpose()).norm() < 1e-14 * matrix.norm());
        prop_assert!(matrix.cholesky().is_some());
    }

    #[test]
    fn a_transformed_inertia_gives_the_energy_in_the_base_frame(case in case(), x in twist()) {
        let body = &case.parts[0];
        let velocity = |place: &Vector3<f64>| x.v + x.w.cross(&(body.base_from_link * Point3::from(*place)).coords);
        let energy: f64 = case.clouds[0].0.iter().map(|(mass, place)| velocity(place).norm_squared() * mass / 2.0).sum();
        let found = x.to_vector().dot(&(case.arm.transformed_inertia(1).unwrap() * x.to_vector())) / 2.0;
        prop_assert!((found - energy).abs() < 1e-12 * (1.0 + energy));
    }

    #[test]
    fn the_manipulator_adjoint_takes_back_the_joints_between(case in case(), x in twist()) {
        for i in 0..case.q.len() {
            for j in 0..case.q.len() {
                let found = case.arm.adjoint(i, j, &case.q).unwrap();
                let product = (j + 1..=i).fold(Matrix4::<f64>::identity(), |product, k| {
                    product * case.parts[k].screw.exp(case.q[k]).to_homogeneous()
                });
                let m = product.try_inverse().unwrap() * wedge(&x) * product;
                let taken = Vector6::new(m.m14, m.m24, m.m34, m.m32, m.m13, m.m21);
                let expected = if i < j { Vector6::zeros() } else { taken };
                prop_assert!((found * x.to_vector() - expected).norm() < 1e-11);
                prop_assert!(i != j || found == Matrix6::identity());
            }
        }
    }

    #[test]
    fn adjoints_and_transformed_inertias_make_the_inertia_matrix(case in case()) {
        let (arm, n) = (&case.arm, case.q.len());
        let carried = |l, i: usize| arm.adjoint(l, i, &case.q).unwrap() * arm.joints()[i].screw.twist().to_vector();
        let entry = |i: usize, j: usize| -> f64 {
            (i.max(j)..n).map(|l| carried(l, i).dot(&(arm.transformed_inertia(l + 1).unwrap() * carried(l, j)))).sum()
        };
        let matrix = arm.inertia(&case.q).unwrap();
        prop_assert!((DMatrix::from_fn(n, n, entry) - &matrix).norm() < 1e-12 * (1.0 + matrix.norm()));
    }
}
