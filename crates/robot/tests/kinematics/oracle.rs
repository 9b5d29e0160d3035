//! The numeric oracle on planar arms, whose solutions are known from elementary geometry.

use std::f64::consts::PI;

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::oracle::{Oracle, Solution};
use groebot_robot::spatial::angle;
use proptest::prelude::*;

/// The tip of a planar arm: x, y and the direction of its last link.
fn tip(lengths: &[f64], q: &[f64]) -> [f64; 3] {
    lengths.iter().zip(q).fold([0.0; 3], |[x, y, direction], (length, q)| {
        let direction = direction + q;
        [x + length * direction.cos(), y + length * direction.sin(), direction]
    })
}

/// The joint values of a two-link arm at (x, y), by the law of cosines.
fn two_link([l1, l2]: [f64; 2], [x, y]: [f64; 2]) -> Vec<Vec<f64>> {
    let cosine = (x * x + y * y - l1 * l1 - l2 * l2) / (2.0 * l1 * l2);
    let elbow = |q2: f64| vec![y.atan2(x) - (l2 * q2.sin()).atan2(l1 + l2 * q2.cos()), q2];
    [cosine.acos(), -cosine.acos()].map(elbow).to_vec()
}

/// Asserts that `found` and `expected` are the same set.
fn assert_same_set(found: &[Solution], expected: &[Vec<f64>]) {
    let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| angle::difference(*a, *b).abs() < 1e-8);
    assert_eq!(found.len(), expected.len(), "{found:?} is not {expected:?}");
    for q in expected {
        assert!(found.iter().any(|f| same(&f.q, q)), "{q:?} is not among {found:?}");
    }
    assert!(found.iter().all(|f| f.residual <= 1e-11 && f.q.iter().all(|q| -PI < *q && *q <= PI)));
}

#[test]
fn an_unreachable_target_has_no_answer() {
    let position = |q: &[f64]| vec![tip(&[1.0, 0.5], q)[0] - 1.6, tip(&[1.0, 0.5], q)[1]];
    assert_eq!(Oracle::default().solve(2, position).unwrap(), vec![]);
}

#[test]
fn a_stretched_arm_has_one_answer() {
    let position = |q: &[f64]| vec![tip(&[1.0, 0.5], q)[0] - 1.5, tip(&[1.0, 0.5], q)[1]];
    let found = Oracle { distinct: 1e-4, ..Oracle::default() }.solve(2, position).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].q.iter().all(|q| q.abs() < 1e-4));
}

#[test]
fn bad_residuals_find_nothing_and_do_not_panic() {
    let oracle = Oracle { seeds: 5, ..Oracle::default() };
    assert_eq!(oracle.solve(2, |_| vec![f64::NAN]).unwrap(), vec![]);
    assert_eq!(oracle.solve(1, |q| vec![1.0; 1 + usize::from(q[0] > 0.0)]).unwrap(), vec![]);
    assert_eq!(oracle.solve(1, |_| vec![1.0]).unwrap(), vec![]);
    assert_eq!(oracle.solve(0, |_| vec![]).unwrap_err().kind(), ErrorKind::BadValue);
    let none = Oracle { tolerance: f64::NAN, ..oracle };
    assert_eq!(none.solve(1, |q| vec![q[0].sin()]).unwrap(), vec![]);
}

#[test]
fn of_equal_answers_the_most_accurate_is_kept() {
    // One step per starting point: the solutions near zero differ, and more starting points can only improve them.
    let rough = |seeds| {
        let oracle = Oracle { seeds, iterations: 1, tolerance: 1e-2, distinct: 0.5 };
        let found = oracle.solve(1, |q| vec![q[0].sin()]).unwrap();
        found.into_iter().find(|f| f.q[0].abs() < 0.5).map_or(1.0, |f| f.residual)
    };
    let residuals: Vec<f64> = (1..60).map(rough).collect();
    assert!(residuals.is_sorted_by(|a, b| a >= b), "{residuals:?}");
    assert!(residuals[58] < 1e-4);
}

#[test]
fn the_same_question_has_the_same_answer() {
    let ask = || Oracle::default().solve(1, |q| vec![(3.0 * q[0]).sin() - 0.25]).unwrap();
    assert_eq!(ask().len(), 6);
    assert_eq!(ask(), ask());
}

proptest! {
    #![proptest_config(crate::cases(200))]

    #[test]
    fn two_links(l1 in 0.3..1.0, l2 in 0.3..1.0, q1 in -PI..PI, q2 in 0.1..3.0) {
        let [x, y, _] = tip(&[l1, l2], &[q1, q2]);
        let position = |q: &[f64]| vec![tip(&[l1, l2], q)[0] - x, tip(&[l1, l2], q)[1] - y];
        assert_same_set(&Oracle::default().solve(2, position).unwrap(), &two_link([l1, l2], [x, y]));
    }

    #[test]
    fn three_links_with_an_orientation(
        l1 in 0.3..1.0, l2 in 0.3..1.0, l3 in 0.1..0.5, q1 in -PI..PI, q2 in 0.1..3.0, q3 in -PI..PI,
    ) {
        let lengths = [l1, l2, l3];
        let [x, y, direction] = tip(&lengths, &[q1, q2, q3]);
        let wrist = [x - l3 * direction.cos(), y - l3 * direction.sin()];
        let expected: Vec<Vec<f64>> = two_link([l1, l2], wrist)
            .into_iter()
            .map(|q| vec![q[0], q[1], direction - q[0] - q[1]])
            .collect();
        let pose = |q: &[f64]| {
            let [at_x, at_y, at] = tip(&lengths, q);
            vec![at_x - x, at_y - y, at.cos() - direction.cos(), at.sin() - direction.sin()]
        };
        assert_same_set(&Oracle::default().solve(3, pose).unwrap(), &expected);
    }
}
