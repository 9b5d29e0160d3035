//! Solvers of robots described in rounded numbers, whose formulas are those of a nearby robot.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::TAU;

use groebot_runtime::{Mechanism, Solution, Solve};

#[rustfmt::skip]
#[path = "../../derivations/irb4600_rounded/5_solver.rs"]
mod irb4600;

use irb4600::{CAPACITY, EMPTY, Solver};

/// The joint values at which two of the four candidates miss the described robot most.
const NEAR: [f64; 6] = [
    -1.1574905997267422,
    0.22468450350688896,
    -1.3915150992706793,
    2.8325809440093583,
    -2.6048401351736263,
    0.24387500039140875,
];

/// Random joint values, of which the fifth is within `beside` of zero.
fn poses(beside: f64) -> Vec<[f64; 12]> {
    let mut random = crate::random();
    let mut pose = || {
        let mut q: [f64; 6] = core::array::from_fn(|_| TAU * random() - 0.5 * TAU);
        if beside < 1.0 {
            q[4] *= beside;
        }
        Solver.forward(&q).unwrap()
    };
    (0..60).map(|_| pose()).collect()
}

/// The numbers of a solution, bitwise.
fn bits(solution: &Solution<Solver>) -> (Vec<u64>, [u64; 2], usize, u32) {
    let Solution { q, residual, relative, branch, free, .. } = solution;
    (q.iter().map(|value| value.to_bits()).collect(), [residual.to_bits(), relative.to_bits()], *branch, *free)
}

/// Two Newton steps with the derivatives of the first lead to the described robot, without polishing steps.
#[test]
fn candidates_are_led_without_polishing() {
    let mut out = [EMPTY; CAPACITY];
    let target = Solver.forward(&NEAR).unwrap();
    assert_eq!(Solver.solve_bounded(&target, 0, &mut out), Ok(2));
}

#[test]
fn batches_have_the_solutions_of_single_calls() {
    for beside in [1.0, 1e-2, 1e-4, 1e-6, 1e-9] {
        let targets = poses(beside);
        let mut batch = vec![EMPTY; targets.len() * CAPACITY];
        let mut counts = vec![Ok(0); targets.len()];
        assert_eq!(Solver.solve_batch(&targets, &mut batch, &mut counts), targets.len());
        let mut rest = batch.iter();
        for (target, count) in targets.iter().zip(&counts) {
            let mut out = [EMPTY; CAPACITY];
            assert_eq!(Solver.solve(target, &mut out), *count);
            for solution in &out[..count.unwrap()] {
                assert_eq!(bits(solution), bits(rest.next().unwrap()), "{beside} {target:?}");
            }
        }
    }
}

/// The solutions hold on the described robot, and the joint values that made a target are among them. The fifth joint is at least fifty times farther from
/// zero than the axes are from those of the ideal robot.
#[test]
fn no_solution_is_lost() {
    let mut random = crate::random();
    for beside in [1.0, 1e-2, 1e-3] {
        for _ in 0..200 {
            let mut q: [f64; 6] = core::array::from_fn(|_| TAU * random() - 0.5 * TAU);
            if beside < 1.0 {
                q[4] = beside * (0.5 + random());
            }
            let target = Solver.forward(&q).unwrap();
            let mut out = [EMPTY; CAPACITY];
            let count = Solver.solve(&target, &mut out).unwrap();
            let is_same = |a: &Solution<Solver>| {
                a.q.iter().zip(&q).all(|(a, b)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() < 1e-7)
            };
            assert!(out[..count].iter().any(is_same), "{beside} {q:?}");
            assert!(out[..count].iter().all(|a| Solver.residual(&target, &a.q) < 1e-12));
        }
    }
    assert!(Solver.facts().nearby.is_some());
}
