//! Poses next to a singular wrist have isolated solutions, among them the joint values that made the pose, and no self-motion.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_runtime::tolerances::ACCEPTANCE;
use groebot_runtime::{Error, Solve};

use super::random;

#[rustfmt::skip]
#[path = "../../derivations/puma/5_solver.rs"]
mod puma;

/// Solutions for the pose that joint values of a PUMA reach.
fn solved(q: &[f64; 6]) -> Vec<puma::Solution> {
    let mut out = [puma::EMPTY; puma::CAPACITY];
    let target = puma::Solver.forward(q).unwrap();
    let count = puma::Solver.solve(&target, &mut out).unwrap();
    out[..count].to_vec()
}

/// Joint values with the wrist at this distance from a configuration with two parallel axes.
fn beside_a_singular_wrist(way: f64) -> impl Iterator<Item = [f64; 6]> {
    let mut random = random();
    (0..200).map(move |_| {
        let mut q = [(); 6].map(|()| PI * (2.0 * random() - 1.0));
        q[4] = FRAC_PI_2 + way;
        q
    })
}

/// Eight solutions, as at other poses of this arm. Candidates for members of the self-motion at the singular pose have residuals proportional to the distance
/// from it. When they were polished along it, some came within the tolerance and were reported as self-motions.
#[test]
fn poses_next_to_a_singular_wrist_have_isolated_answers() {
    for way in [1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, -1e-6, -1e-9] {
        for q in beside_a_singular_wrist(way) {
            let found = solved(&q);
            assert!(found.iter().all(|answer| answer.free == 0), "{way} {q:?}: {found:?}");
            assert_eq!(found.len(), 8, "{way} {q:?}");
            // Rounding errors of the pose and of the arm's joints, divided by the distance, are the errors of the wrist's joints.
            let bound = f64::max(1e-7, 1e-12 / f64::abs(way));
            let near = |a: f64, b: f64| (a - b).sin().abs() < bound && (a - b).cos() > 0.0;
            assert!(found.iter().any(|answer| answer.q.iter().zip(q).all(|(a, b)| near(*a, b))), "{way} {q:?}");
        }
    }
}

/// At the singular pose the first and the last joint of the wrist rotate against each other. There is one self-motion for each posture of the arm with a
/// singular wrist.
#[test]
fn a_singular_wrist_has_a_self_motion() {
    for q in beside_a_singular_wrist(0.0) {
        let found = solved(&q);
        assert_eq!(found.iter().filter(|answer| answer.free != 0).count(), 2, "{q:?}: {found:?}");
    }
}

/// The error of the tip for joint values: a position relative to the arm's length, or an entry of the rotation.
fn missed(q: &[f64; 6], target: &[f64; 12]) -> f64 {
    puma::Solver.forward(q).unwrap().iter().zip(target).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}

/// With too few steps all solutions of a target are marked as not settled, and each holds within the larger tolerance. No solution without steps is an error.
#[test]
fn too_few_steps_leave_answers_that_are_not_settled() {
    let (mut unsettled, mut without) = (0, 0);
    for q in beside_a_singular_wrist(0.0) {
        let target = puma::Solver.forward(&q).unwrap();
        let mut out = [puma::EMPTY; puma::CAPACITY];
        for steps in [0, 1, 10, 30] {
            match puma::Solver.solve_bounded(&target, steps, &mut out) {
                Err(error) => without += usize::from(error == Error::Unsettled),
                Ok(count) => {
                    assert!(count > 0, "{q:?}: no solution with {steps} steps, and no error");
                    let found = &out[..count];
                    assert!(found.iter().all(|answer| !answer.settled), "{steps} {q:?}: {found:?}");
                    assert!(
                        found.iter().all(|answer| answer.relative <= ACCEPTANCE.unsettled),
                        "{steps} {q:?}: {found:?}"
                    );
                    assert!(found.iter().all(|answer| missed(&answer.q, &target) < 1e-5), "{steps} {q:?}: {found:?}");
                    unsettled += 1;
                }
            }
        }
    }
    assert_eq!(unsettled + without, 4 * 200, "a self-motion is followed in more than 30 steps");
    assert!(unsettled > 700, "{unsettled}");
}

/// Where the steps suffice, more of them change nothing.
#[test]
fn enough_steps_leave_settled_answers() {
    let mut out = [puma::EMPTY; puma::CAPACITY];
    for q in [0.0, 1e-7].into_iter().flat_map(beside_a_singular_wrist) {
        let target = puma::Solver.forward(&q).unwrap();
        let count = puma::Solver.solve_bounded(&target, 1_000_000, &mut out).unwrap();
        assert!(out[..count].iter().all(|answer| answer.settled), "{q:?}");
        assert_eq!(out[..count], solved(&q)[..], "{q:?}");
    }
}

/// Ordinary targets need no polishing steps; targets next to a stretched elbow do.
#[test]
fn ordinary_targets_are_settled_without_steps() {
    let mut out = [puma::EMPTY; puma::CAPACITY];
    for q in beside_a_singular_wrist(0.3).filter(|q| q[2].sin().abs() > 0.1) {
        let target = puma::Solver.forward(&q).unwrap();
        let count = puma::Solver.solve_bounded(&target, 0, &mut out).unwrap();
        assert!(count == 8 && out.iter().all(|answer| answer.settled), "{q:?}");
    }
}
