//! The Coriolis matrix compared with differences of the inertia matrix.

use groebot_robot::spatial::Twist;
use nalgebra::{DMatrix, DVector, Vector6};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

use super::{Case, case};
use crate::kinematics::jacobian::{moved, slope};

fn inertia(case: &Case, q: &[f64]) -> DMatrix<f64> {
    case.arm.inertia(q).unwrap()
}

/// The derivative of the inertia matrix by joint `k`.
fn derivative(case: &Case, k: usize) -> DMatrix<f64> {
    slope(|h| inertia(case, &moved(&case.q, k, h)))
}

fn close(a: &DMatrix<f64>, b: &DMatrix<f64>, scale: f64) -> bool {
    (a - b).norm() < 1e-8 * (1.0 + scale)
}

/// RH0 (2-43) with its adjoints, for joints i, j, k; as printed its first `A_ki` is transposed.
fn derivative_by_adjoints(case: &Case, [i, j, k]: [usize; 3], as_printed: bool) -> f64 {
    let a = |i, j| case.arm.adjoint(i, j, &case.q).unwrap();
    let x = |i: usize| case.parts[i].screw.twist().to_vector();
    let bracket =
        |carried: Vector6<f64>| Twist::from_vector(&carried).bracket(&case.parts[k].screw.twist()).to_vector();
    let first = if as_printed { a(k, i).transpose() } else { a(k, i) };
    let term = |l: usize| {
        let mass = case.arm.transformed_inertia(l + 1).unwrap();
        (a(l, k) * bracket(first * x(i))).dot(&(mass * a(l, j) * x(j)))
            + (a(l, i) * x(i)).dot(&(mass * a(l, k) * bracket(a(k, j) * x(j))))
    };
    (i.max(j)..case.q.len()).map(term).sum()
}

fn derivatives_by_adjoints(case: &Case, k: usize, as_printed: bool) -> DMatrix<f64> {
    let n = case.q.len();
    DMatrix::from_fn(n, n, |i, j| derivative_by_adjoints(case, [i, j, k], as_printed))
}

#[test]
fn the_printed_derivative_has_one_transpose_too_many() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut wrong = 0;
    for _ in 0..100 {
        let case = case().prop_filter("two joints", |case| case.q.len() > 1).new_tree(&mut runner).unwrap().current();
        let last = case.q.len() - 1;
        wrong += usize::from(!close(&derivatives_by_adjoints(&case, last, true), &derivative(&case, last), 1.0));
    }
    assert!(wrong > 50, "{wrong} of 100");
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn derivatives_of_the_inertia_matrix_by_adjoints(case in case()) {
        let found = case.arm.inertia_derivatives(&case.q).unwrap();
        for (k, found) in found.iter().enumerate() {
            prop_assert!((found - derivatives_by_adjoints(&case, k, false)).norm() < 1e-11 * (1.0 + inertia(&case, &case.q).norm()));
        }
    }

    #[test]
    fn the_inertia_matrix_changes_as_its_derivatives_say(case in case()) {
        let size = inertia(&case, &case.q).norm();
        let found = case.arm.inertia_derivatives(&case.q).unwrap();
        prop_assert_eq!(found.len(), case.q.len());
        for (k, found) in found.iter().enumerate() {
            prop_assert!(close(found, &derivative(&case, k), size));
        }
    }

    #[test]
    fn inertia_rate_less_twice_coriolis_is_skew(case in case()) {
        let rate = slope(|t| inertia(&case, &case.after(t)));
        let passive = &rate - case.arm.coriolis(&case.q, &case.velocity).unwrap() * 2.0;
        prop_assert!(close(&passive, &-passive.transpose(), inertia(&case, &case.q).norm()));
    }

    #[test]
    fn coriolis_times_velocity_satisfies_the_lagrange_equations(case in case()) {
        let found = case.arm.coriolis(&case.q, &case.velocity).unwrap() * case.rates();
        let energy = |q: &[f64]| case.rates().dot(&(inertia(&case, q) * case.rates())) / 2.0;
        let along = slope(|t| inertia(&case, &case.after(t))) * case.rates();
        let gradient = (0..case.q.len()).map(|i| slope(|h| energy(&moved(&case.q, i, h))));
        let expected = along - DVector::from_iterator(case.q.len(), gradient);
        prop_assert!((found - expected).norm() < 1e-8 * (1.0 + inertia(&case, &case.q).norm()));
    }

    #[test]
    fn coriolis_is_the_sum_of_christoffel_symbols(case in case()) {
        let n = case.q.len();
        let slopes: Vec<_> = (0..n).map(|k| derivative(&case, k)).collect();
        let symbol = |i: usize, j: usize, k: usize| {
            (slopes[k][(i, j)] + slopes[j][(i, k)] - slopes[i][(k, j)]) / 2.0
        };
        let expected = DMatrix::from_fn(n, n, |i, j| (0..n).map(|k| symbol(i, j, k) * case.velocity[k]).sum());
        let found = case.arm.coriolis(&case.q, &case.velocity).unwrap();
        prop_assert!(close(&found, &expected, inertia(&case, &case.q).norm()));
    }
}
