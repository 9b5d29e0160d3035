//! Several joints at multiples of pi/2: poses that are singular for more than one reason.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_robot::robots;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// Joint values of six joints: arbitrary or, more often, multiples of pi/2.
fn corners() -> impl Strategy<Value = [f64; 6]> {
    let corner = prop::sample::select(vec![-FRAC_PI_2, 0.0, FRAC_PI_2, PI]);
    prop::array::uniform6(prop_oneof![2 => -PI..PI, 3 => corner])
}

/// UR5 with elbow and wrist straight and the wrist's offset in line. The wrist, which is free elsewhere, then has only one solution. Any motion of a joint
/// misses the target by at least its square.
fn stretched() -> impl Strategy<Value = [f64; 6]> {
    let wrist = prop::sample::select(vec![0.0, PI]);
    (prop::array::uniform3(-PI..PI), wrist)
        .prop_map(|([pan, lift, last], wrist)| [pan, lift, 0.0, -FRAC_PI_2, wrist, last])
}

/// Solves the poses of `cases` joint values. Each pose must have a solution, and each solution must reach it. If no joint is free, the joint values must be
/// among the solutions.
fn answer_all(derived: &Derivation, cases: u32, joints: impl Strategy<Value = [f64; 6]>) {
    let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(cases) });
    let run = |q: [f64; 6]| {
        let target = derived.reached(&q).unwrap();
        let found = derived.program().solve_numbers(&target).unwrap();
        prop_assert!(!found.is_empty(), "{q:?}: no answer");
        for answer in &found {
            let reached = derived.reached(&answer.q).unwrap();
            prop_assert!(reached.iter().zip(&target).all(|(a, b)| (a - b).abs() < 1e-11), "{q:?}: {answer:?}");
        }
        // An error of 1e-14 moves the joints of a double root by its square root.
        let near = |a: f64, b: f64| (a - b).sin().abs() < 1e-5 && (a - b).cos() > 0.0;
        let is_found = found.iter().any(|answer| answer.q.iter().zip(q).all(|(a, b)| near(*a, b)));
        prop_assert!(is_found || found.iter().any(|answer| !answer.free.is_empty()), "{q:?}: {found:?}");
        Ok(())
    };
    runner.run(&joints, run).unwrap();
}

fn ur5() -> Derivation {
    Derivation::sequentially(&robots::ur5(), &Watch::none()).unwrap()
}

#[test]
fn a_pose_that_is_singular_twice_is_answered() {
    let derived = ur5();
    answer_all(&derived, 60, stretched());
    answer_all(&derived, 500, corners());
}

#[test]
#[ignore = "a minute: 20,000 poses each"]
fn poses_that_are_singular_twice_are_answered() {
    let derived = ur5();
    answer_all(&derived, 20_000, corners());
    answer_all(&derived, 20_000, stretched());
}
