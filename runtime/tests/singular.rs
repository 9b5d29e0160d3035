//! Poses next to a singular wrist: isolated answers, the joint values that made the pose among them, and no self-motion.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_runtime::tolerances::UNSETTLED;
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

/// Joint values with the wrist so far from where two of its axes are parallel.
fn beside_a_singular_wrist(way: f64) -> impl Iterator<Item = [f64; 6]> {
    let mut random = random();
    (0..200).map(move |_| {
        let mut q = [(); 6].map(|()| PI * (2.0 * random() - 1.0));
        q[4] = FRAC_PI_2 + way;
        q
    })
}

/// Eight answers, as at other poses of the arm, which is out of no pose's reach. Candidates for members of the self-motion that the singular pose has miss the
/// pose by a share of the way; as long as they were polished along it, some came within what is accepted and were told as self-motions.
#[test]
fn poses_next_to_a_singular_wrist_have_isolated_answers() {
    for way in [1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, -1e-6, -1e-9] {
        for q in beside_a_singular_wrist(way) {
            let found = solved(&q);
            assert!(found.iter().all(|answer| answer.free == 0), "{way} {q:?}: {found:?}");
            assert_eq!(found.len(), 8, "{way} {q:?}");
            // Rounding of the pose, and what the arm's joints make of it, moves those of the wrist by its share of the way.
            let bound = f64::max(1e-7, 1e-12 / f64::abs(way));
            let near = |a: f64, b: f64| (a - b).sin().abs() < bound && (a - b).cos() > 0.0;
            assert!(found.iter().any(|answer| answer.q.iter().zip(q).all(|(a, b)| near(*a, b))), "{way} {q:?}");
        }
    }
}

/// At the singular pose itself the first and the last joint of the wrist turn against each other: a self-motion for each posture of the arm in which it is singular.
#[test]
fn a_singular_wrist_has_a_self_motion() {
    for q in beside_a_singular_wrist(0.0) {
        let found = solved(&q);
        assert_eq!(found.iter().filter(|answer| answer.free != 0).count(), 2, "{q:?}: {found:?}");
    }
}

/// How far the tip of joint values is from a target: a position by the arm's length, or an entry of a rotation.
fn missed(q: &[f64; 6], target: &[f64; 12]) -> f64 {
    puma::Solver.forward(q).unwrap().iter().zip(target).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}

/// With too few steps all answers to a target say that they are not settled, and each holds within what that allows; none is no silent loss.
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
                    assert!(count > 0, "{q:?}: no answer with {steps} steps, and no word of it");
                    let found = &out[..count];
                    assert!(found.iter().all(|answer| !answer.settled), "{steps} {q:?}: {found:?}");
                    assert!(found.iter().all(|answer| answer.relative <= UNSETTLED), "{steps} {q:?}: {found:?}");
                    assert!(found.iter().all(|answer| missed(&answer.q, &target) < 1e-5), "{steps} {q:?}: {found:?}");
                    unsettled += 1;
                }
            }
        }
    }
    assert_eq!(unsettled + without, 4 * 200, "a self-motion is followed in more than 30 steps");
    assert!(unsettled > 700, "{unsettled}");
}

/// Where the steps are enough, more of them change nothing.
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

/// Ordinary targets take no steps of polishing: next to a stretched elbow alone they do.
#[test]
fn ordinary_targets_are_settled_without_steps() {
    let mut out = [puma::EMPTY; puma::CAPACITY];
    for q in beside_a_singular_wrist(0.3).filter(|q| q[2].sin().abs() > 0.1) {
        let target = puma::Solver.forward(&q).unwrap();
        let count = puma::Solver.solve_bounded(&target, 0, &mut out).unwrap();
        assert!(count == 8 && out.iter().all(|answer| answer.settled), "{q:?}");
    }
}
