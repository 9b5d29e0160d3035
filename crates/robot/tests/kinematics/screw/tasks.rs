//! Every described mechanism with the screw solver: rays, directions, rotations, and given joints.

use std::path::Path;

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, JointKind, Target, Task};
use groebot_robot::robots;
use nalgebra::Vector3;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use crate::errors::assert_error;

/// Reads the chain of a folder in `derivations/`.
fn described(name: &str) -> Chain {
    let file =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name).join("0_chain.toml");
    let text = std::fs::read_to_string(file).unwrap();
    if text.contains("\ndh = ") { Chain::from_dh_toml(&text) } else { Chain::from_toml(&text) }.unwrap()
}

/// Each mechanism with its maximum number of solutions for one target. Six-joint arms with a spherical wrist, 8: Pieper
/// 1968. NAO's arm as a ray, 8: the elbow is on a circle about the ray and on a sphere about the shoulder (2), the
/// shoulder's two axes move it there (2), the elbow's two axes aim the forearm (2). Its position with ElbowYaw given,
/// 4: the distance from the shoulder (2), then the shoulder's axes (2).
const DESCRIBED: [(&str, usize); 11] = [
    ("nao_left_arm", 8),
    ("nao_right_arm_position", 4),
    ("nao_head", 2),
    ("wrist_rotation", 2),
    ("iiwa14", 8),
    ("planar_4r", 2),
    ("puma560", 8),
    ("offset_wrist", 8),
    ("spherical_wrist", 8),
    ("rrp", 4),
    ("upright_arm", 8),
];

/// The residual of the tip of `chain` at `q`: a length divided by the reach, or an angle.
fn miss(chain: &Chain, q: &[f64], target: &Target) -> f64 {
    let pose = chain.forward(q).unwrap();
    let aimed = pose.rotation * chain.aim().into_inner();
    let at = |point: &nalgebra::Point3<f64>| (pose.translation.vector - point.coords).norm() / chain.reach();
    match target {
        Target::Pose(wanted) => at(&wanted.translation.vector.into()).max(pose.rotation.angle_to(&wanted.rotation)),
        Target::Position(point) => at(point),
        Target::Ray { point, direction } => at(point).max((aimed - direction).norm()),
        Target::Direction(direction) => (aimed - direction).norm(),
        Target::Rotation(rotation) => pose.rotation.angle_to(rotation),
        Target::PositionPitchRoll { point, pitch, roll } => {
            let (rolled, pitched, _) = pose.rotation.euler_angles();
            let differ = |a: f64, b: f64| groebot_robot::spatial::angle::difference(a, b).abs();
            at(point).max(differ(pitched, *pitch)).max(differ(rolled, *roll))
        }
        Target::PositionYaw { point, yaw } => {
            at(point).max(groebot_robot::spatial::angle::difference(aimed.y.atan2(aimed.x), *yaw).abs())
        }
        Target::PlanarPosition(_) | Target::PlanarPose(_) => 0.0,
    }
}

fn near(chain: &Chain, a: &[f64], b: &[f64]) -> bool {
    let differ = |(joint, (a, b)): (_, (&f64, &f64))| match joint {
        JointKind::Revolute => groebot_robot::spatial::angle::difference(*a, *b).abs(),
        JointKind::Prismatic => (a - b).abs(),
    };
    chain.joints().iter().map(|joint| joint.kind).zip(a.iter().zip(b)).all(|pair| differ(pair) < 1e-7)
}

#[test]
fn the_joints_that_made_a_target_are_among_its_answers() {
    for (name, most) in DESCRIBED {
        let chain = described(name);
        let solver = ScrewSolver::new(&chain).unwrap();
        let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(40) });
        let run = |q: [f64; 7]| {
            let q = &q[..chain.joints().len()];
            let target = Target::reached(&chain, q).unwrap();
            let given: Vec<f64> = chain.given().iter().map(|&joint| q[joint]).collect();
            let answers = solver.solve_given(&target, &given).unwrap();
            prop_assert!(answers.iter().any(|answer| near(&chain, &answer.q, q)), "{name} at {q:?}: {answers:?}");
            prop_assert!(answers.len() <= most, "{name}: {} answers", answers.len());
            for answer in &answers {
                prop_assert!(miss(&chain, &answer.q, &target) < 1e-9, "{name}: {answer:?}");
                prop_assert!(chain.given().iter().zip(&given).all(|(&joint, value)| answer.q[joint] == *value));
            }
            Ok(())
        };
        runner.run(&prop::array::uniform7(-3.1f64..3.1), run).unwrap();
    }
}

/// NAO's head by hand: yaw rotates about z, then pitch about y. The view is along x.
#[test]
fn a_head_has_two_solutions() {
    let solver = ScrewSolver::new(&described("nao_head")).unwrap();
    let view = Vector3::new(2.0, 1.0, -1.0).normalize();
    let answers = solver.solve(&Target::Direction(view)).unwrap();
    let yaw = 1f64.atan2(2.0);
    let pitch = 1f64.atan2(5f64.sqrt());
    let turned = [yaw - std::f64::consts::PI, std::f64::consts::PI - pitch];
    assert_eq!(answers.len(), 2);
    for wanted in [[yaw, pitch], turned] {
        assert!(
            answers.iter().any(|a| (a.q[0] - wanted[0]).abs() < 1e-12 && (a.q[1] - wanted[1]).abs() < 1e-12),
            "{answers:?}"
        );
    }
}

#[test]
fn requested_tasks_must_fit() {
    let arm = described("nao_left_arm_position");
    let solver = ScrewSolver::new(&arm).unwrap();
    let target = Target::reached(&arm, &[0.1, 0.2, 0.3, -0.4]).unwrap();
    assert_error(&solver.solve(&target).unwrap_err(), ErrorKind::BadValue, None, "ElbowYaw");
    assert_error(&solver.solve_given(&target, &[f64::NAN]).unwrap_err(), ErrorKind::BadValue, None, "finite");
    let free = arm.with_task(Task::Position, arm.direction().clone(), Vec::new()).unwrap();
    assert_error(&ScrewSolver::new(&free).unwrap_err(), ErrorKind::PositiveDimensional, None, "determines 3 at most");
    let head = ScrewSolver::new(&described("nao_head")).unwrap();
    let long = Target::Direction(Vector3::new(0.0, 3.0, 4.0));
    assert_error(&head.solve(&long).unwrap_err(), ErrorKind::BadValue, None, "length 5");
    assert_error(&head.solve(&target).unwrap_err(), ErrorKind::BadValue, None, "direction");
    let polar = robots::polar();
    let polar = polar.with_task(Task::Direction, polar.direction().clone(), vec!["Yaw".into()]).unwrap();
    assert_error(&ScrewSolver::new(&polar).unwrap_err(), ErrorKind::PositiveDimensional, None, "`Slide` is prismatic");
}
