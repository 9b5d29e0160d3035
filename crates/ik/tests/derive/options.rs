//! The derivation in one call, `groebot_ik::derive`, and the effect of its options.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use groebot_algebra::number::parse_rational;
use groebot_ik::derive::{Derivation, Options};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Chain, ChainParts, Target, along_z};
use groebot_robot::robots;

/// Joint values at which PUMA is not singular.
const Q: [f64; 6] = [0.31, -0.42, 0.53, 0.64, 0.75, -0.86];

/// PUMA with its first axis 3e-8 rad off the vertical.
fn rounded() -> Chain {
    let mut parts: ChainParts = robots::puma().into();
    parts.joints[0].axis[0] = parse_rational("3e-8").unwrap();
    Chain::new(parts).unwrap()
}

fn is_polished(derivation: &Derivation) -> bool {
    derivation.sequential().unwrap().problem.truth.is_some()
}

#[test]
fn the_default_solver_finds_the_joints_that_made_a_pose() {
    let chain = rounded();
    let derivation = groebot_ik::derive(&chain).unwrap();
    assert!(is_polished(&derivation));
    let pose = chain.forward(&Q).unwrap();
    let answers = derivation.solver().solve(pose).unwrap();
    let near = |q: &[f64]| q.iter().zip(Q).all(|(a, b)| (a - b).abs() < 1e-9);
    assert_eq!(answers.iter().filter(|answer| near(&answer.q)).count(), 1);
    assert_eq!(derivation.solver().solve(Target::Pose(pose)).unwrap(), answers);
}

#[test]
fn the_exact_chain_is_another_than_the_nearest_ideal_one() {
    let chain = rounded();
    let exact = Options::new().exact().derive(&chain).unwrap();
    assert!(!is_polished(&exact));
    assert_eq!(exact.sequential().unwrap().problem.chain.joints()[0].axis[0], parse_rational("3e-8").unwrap());
    assert!(is_polished(&Options::new().tolerance(1e-7).derive(&chain).unwrap()));
    assert!(!is_polished(&Options::new().tolerance(1e-9).derive(&chain).unwrap()), "3e-8 is more than 1e-9");
    assert_eq!(Options::new().tolerance(f64::NAN).derive(&chain).unwrap_err().kind(), ErrorKind::BadValue);
}

#[test]
fn given_joints_are_requested_with_each_target() {
    let arm = Chain::from_toml(include_str!("../../../../derivations/iiwa14/0_chain.toml")).unwrap();
    let arm = arm.with_task(arm.task(), along_z(), Vec::new()).unwrap();
    // Without a given joint, there is a solver for each joint as the given one.
    assert!(groebot_ik::derive(&arm).unwrap().redundancy().is_some());
    let third = arm.joints()[2].name.clone();
    let derivation = Options::new().given([third.as_str()]).derive(&arm).unwrap();
    assert_eq!(derivation.program().inputs.last().unwrap().name, third);
    let q = [0.31, -0.42, 0.53, 0.64, 0.75, -0.86, 0.47];
    let pose = arm.forward(&q).unwrap();
    let answers = derivation.solver().solve_given(pose, &[q[2]]).unwrap();
    assert!(answers.iter().any(|answer| answer.q.iter().zip(q).all(|(a, b)| (a - b).abs() < 1e-9)));
    assert_eq!(derivation.solver().solve(pose).unwrap_err().kind(), ErrorKind::BadValue);
    assert_eq!(Options::new().given(["elbow"]).derive(&arm).unwrap_err().kind(), ErrorKind::UnknownName);
}

#[test]
fn a_watch_cancels() {
    let flag = Arc::new(AtomicBool::new(true));
    let options = Options::new().watch(Watch::none().with_cancel(flag));
    assert_eq!(options.derive(&robots::puma()).unwrap_err().kind(), ErrorKind::Cancelled);
}
