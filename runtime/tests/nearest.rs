//! The solution nearest to reference joint values at singular poses: on the self-motion, not only its listed member.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use groebot_runtime::storage::Array;
use groebot_runtime::{Mechanism, Solution, Solve};

use super::random;

#[rustfmt::skip]
#[path = "../../derivations/puma/5_solver.rs"]
mod puma;
#[rustfmt::skip]
#[path = "../../derivations/ur5/5_solver.rs"]
mod ur5;
#[rustfmt::skip]
#[path = "../../derivations/irb120/5_solver.rs"]
mod irb120;
#[rustfmt::skip]
#[path = "../../derivations/irb4600_rounded/5_solver.rs"]
mod irb4600_rounded;
#[rustfmt::skip]
#[path = "../../derivations/puma560/5_solver.rs"]
mod puma560;

type Six = [f64; 6];

const FREE: [[f64; 2]; 6] = [[-TAU, TAU]; 6];

/// The number of poses of each test: `GROEBOT_TARGETS`, else 40.
fn poses() -> usize {
    std::env::var("GROEBOT_TARGETS").ok().and_then(|text| text.parse().ok()).unwrap_or(40)
}

/// The nearest solution for the pose that `q` reaches, and its distance.
fn nearest<M: Mechanism>(
    m: &M,
    q: &Six,
    reference: &Six,
    weights: &Six,
    limits: &[[f64; 2]; 6],
) -> Option<(Solution<M>, f64)> {
    let mut out = vec![Solution::empty(m); m.facts().capacity];
    let target = m.forward(&Array::by(6, |i| q[i])).unwrap();
    let [reference, weights] = [reference, weights].map(|row| Array::by(6, |i| row[i]));
    m.nearest_to(&target, &reference, &weights, &Array::by(6, |i| limits[i]), &mut out).unwrap()
}

/// Checks that the solution nearest to joint values, for the pose that they reach, is these joint values.
#[track_caller]
fn check_itself<M: Mechanism>(m: &M, q: &Six, tolerance: f64) {
    let (found, distance) = nearest(m, q, q, &[1.0; 6], &FREE).unwrap();
    assert!(distance.sqrt() <= tolerance, "{q:?}: {distance:e} {found:?}");
    let [reached, target] = [&found.q, &Array::by(6, |i| q[i])].map(|q| m.forward(q).unwrap());
    let error = reached.as_ref().iter().zip(target.as_ref()).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()));
    assert!(error <= 1e-11, "{q:?}: {error:e}");
}

fn any(random: &mut impl FnMut() -> f64) -> Six {
    [(); 6].map(|()| PI * (2.0 * random() - 1.0))
}

/// Joint values with this value of the fifth joint.
fn with_wrist(q5: f64) -> impl Iterator<Item = Six> {
    let mut random = random();
    (0..poses()).map(move |_| {
        let mut q = any(&mut random);
        q[4] = q5;
        q
    })
}

#[test]
fn the_members_of_self_motions_are_the_references_that_made_them() {
    with_wrist(FRAC_PI_2).for_each(|q| check_itself(&puma::Solver, &q, 1e-9));
    with_wrist(0.0).for_each(|q| check_itself(&puma560::Solver, &q, 1e-9));
    with_wrist(0.0).for_each(|q| check_itself(&ur5::Solver, &q, 1e-9));
    with_wrist(FRAC_PI_2).for_each(|q| check_itself(&irb120::Solver, &q, 1e-9));
    with_wrist(0.0).for_each(|q| check_itself(&irb4600_rounded::Solver, &q, 1e-6));
}

/// Rounding moves listed solutions by the reciprocal of the distance from the singular pose.
#[test]
fn next_to_singular_poses_the_reference_is_found_too() {
    for beside in [1e-10, 1e-9, -1e-8, 1e-7, 1e-6] {
        with_wrist(FRAC_PI_2 + beside).for_each(|q| check_itself(&puma::Solver, &q, 1e-6));
        with_wrist(beside).for_each(|q| check_itself(&puma560::Solver, &q, 1e-6));
        with_wrist(beside).for_each(|q| check_itself(&ur5::Solver, &q, 1e-6));
        with_wrist(FRAC_PI_2 + beside).for_each(|q| check_itself(&irb120::Solver, &q, 1e-6));
        with_wrist(beside).for_each(|q| check_itself(&irb4600_rounded::Solver, &q, 1e-6));
    }
}

#[test]
fn round_joint_values_are_found() {
    let mut random = random();
    for _ in 0..poses() {
        let q = [(); 6].map(|()| PI / 12.0 * ((24.0 * random()).floor() - 11.0));
        check_itself(&puma::Solver, &q, 1e-6);
        check_itself(&puma560::Solver, &q, 1e-6);
        check_itself(&ur5::Solver, &q, 1e-6);
        check_itself(&irb120::Solver, &q, 1e-6);
        check_itself(&irb4600_rounded::Solver, &q, 1e-6);
    }
}

/// The distance of the wrist's centre from the first axis, in the plane of the arm.
fn off_the_first_axis(q2: f64, q3: f64) -> f64 {
    let tip = irb120::Solver.forward(&[0.0, q2, q3, 0.0, 0.0, 0.0]).unwrap();
    // The third column of the rotation leads from the wrist's centre to the tip.
    tip[0] - 0.16 * tip[5]
}

/// With the wrist's centre on the first axis, that joint rotates, and all joints of the wrist compensate: a closed curve that no joint parametrises everywhere.
#[test]
fn the_reference_is_found_where_the_wrist_is_on_the_first_axis() {
    let mut random = random();
    let mut singular = 0;
    while singular < poses() {
        let mut q = any(&mut random);
        let (mut low, mut high) = (q[1], q[1] + FRAC_PI_2);
        if off_the_first_axis(low, q[2]) * off_the_first_axis(high, q[2]) > 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let is_left = off_the_first_axis(low, q[2]) * off_the_first_axis(middle, q[2]) <= 0.0;
            (low, high) = if is_left { (low, middle) } else { (middle, high) };
        }
        q[1] = 0.5 * (low + high);
        check_itself(&irb120::Solver, &q, 1e-6);
        singular += 1;
    }
}

/// On the self-motion of a wrist the fourth and the sixth joint rotate against each other, so that the nearest place is known.
#[test]
fn displaced_references_lead_to_their_projections() {
    let mut random = random();
    for mut q in with_wrist(0.0) {
        q = q.map(|value| 0.5 * value);
        let aside = [(); 6].map(|()| 0.05 * (2.0 * random() - 1.0));
        let weights = [(); 6].map(|()| 0.2 + random());
        let reference: Six = std::array::from_fn(|i| q[i] + aside[i]);
        let along = (weights[3] * aside[3] - weights[5] * aside[5]) / (weights[3] + weights[5]);
        let gaps = [aside[0], aside[1], aside[2], aside[3] - along, aside[4], aside[5] + along];
        let expected: f64 = gaps.iter().zip(weights).map(|(gap, weight)| weight * gap * gap).sum();
        let (found, distance) = nearest(&puma560::Solver, &q, &reference, &weights, &FREE).unwrap();
        assert!(distance <= expected + 1e-14, "{q:?} {reference:?}: {distance:e} {expected:e} {found:?}");
        let moved: Six = std::array::from_fn(|i| {
            q[i] + if i == 3 {
                along
            } else if i == 5 {
                -along
            } else {
                0.0
            }
        });
        let near = found.q.iter().zip(moved).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(near || distance < expected - 1e-14, "{q:?} {reference:?}: {found:?} {moved:?}");
        // The reference was a solution before it was displaced.
        let whole = aside.iter().map(|value| value * value).sum::<f64>();
        let reference = std::array::from_fn(|i| q[i] + aside[i]);
        let (_, distance) = nearest(&ur5::Solver, &q, &reference, &[1.0; 6], &FREE).unwrap();
        assert!(distance <= whole, "{q:?} {aside:?}: {distance:e} {whole:e}");
    }
}

/// The fourth joint is at its limit, and the sixth one moves as far in the opposite direction.
#[test]
fn limits_end_the_search_along_a_self_motion() {
    for (q, width) in with_wrist(0.0).zip([0.5, 0.05, 0.001].into_iter().cycle()) {
        let q = q.map(|value| 0.5 * value);
        let mut limits = FREE;
        limits[3] = [q[3] + 0.3, q[3] + 0.3 + width];
        for joint in [0, 1, 2, 4] {
            limits[joint] = [q[joint] - 0.1, q[joint] + 0.1];
        }
        let (found, distance) = nearest(&puma560::Solver, &q, &q, &[1.0; 6], &limits).unwrap();
        assert!((distance - 0.18).abs() < 1e-8, "{q:?}: {distance} {found:?}");
        limits[5] = [q[5] - 0.25, q[5] + 0.25];
        assert!(nearest(&puma560::Solver, &q, &q, &[1.0; 6], &limits).is_none());
    }
}
