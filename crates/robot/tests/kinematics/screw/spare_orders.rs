//! Targets at which a step of the screw solver's plan degenerates although the pose is not singular. Axes with joints
//! between them become parallel, so a direction along them leaves a joint free that other equations determine.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Target, Task};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// A table-top arm of five joints, in metres: yaw, three parallel pitch joints, and a roll of the tool.
fn arm(task: &str) -> Chain {
    let joints = [
        ("[0, 0, 1]", "[0, 0, 0.1]"),
        ("[0, 1, 0]", "[0.033, 0, 0.047]"),
        ("[0, 1, 0]", "[0, 0, 0.155]"),
        ("[0, 1, 0]", "[0, 0, 0.135]"),
        ("[0, 0, 1]", "[0, 0, 0.1136]"),
    ];
    let joint = |(index, (axis, at)): (usize, &(&str, &str))| {
        let name = format!("name = \"j{}\"\ntype = \"revolute\"\n", index + 1);
        format!("[[joint]]\n{name}axis = {axis}\norigin = {{ xyz = {at} }}\n")
    };
    let joints: String = joints.iter().enumerate().map(joint).collect();
    let head = format!(
        "name = \"table\"\nangle_unit = \"rad\"\ntask = {task}\ntip = {{ origin = {{ xyz = [0, 0, 0.1] }} }}\n"
    );
    Chain::from_toml(&format!("{head}{joints}")).unwrap()
}

const POSE: &str = "{ kind = \"pose\" }";
const RAY: &str = "{ kind = \"ray\", direction = [1, 0, 0] }";

/// The distance of two configurations \[rad\].
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| groebot_robot::spatial::angle::difference(*a, *b).abs()).fold(0.0, f64::max)
}

/// Numbers of the arm's solutions: the plane of the arm has two azimuths, and the elbow two solutions. For a ray, the
/// tool has two directions in this plane.
fn most(chain: &Chain) -> usize {
    if chain.task() == Task::Pose { 4 } else { 8 }
}

fn assert_solved(chain: &Chain, solver: &ScrewSolver, q: &[f64]) -> Result<(), TestCaseError> {
    let target = Target::reached(chain, q).unwrap();
    let answers = solver.solve(&target).unwrap();
    prop_assert!(answers.iter().any(|answer| apart(&answer.q, q) < 1e-6), "{q:?}: {answers:?}");
    prop_assert!(answers.len() <= most(chain), "{q:?}: {answers:?}");
    prop_assert!(answers.iter().all(|answer| answer.free.is_empty()), "{q:?}: {answers:?}");
    Ok(())
}

#[test]
fn an_upright_tool_leaves_no_joint_free() {
    for task in [POSE, RAY] {
        let chain = arm(task);
        let solver = ScrewSolver::new(&chain).unwrap();
        assert_solved(&chain, &solver, &[0.1, 1.0, 1.0, PI - 2.0, 0.5]).unwrap();
        assert_solved(&chain, &solver, &[0.0, 1.0, 1.0, PI - 2.0, 0.5]).unwrap();
        let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(300) });
        let part = -2.0..2.0;
        let cases = ([part.clone(), part.clone(), part.clone(), part], prop::bool::ANY, 0..4_usize);
        let run = |([q1, q2, q3, q5], up, near): ([f64; 4], bool, usize)| {
            let sum = if up { 0.0 } else { PI };
            let q4 = sum - q2 - q3 + [0.0, 1e-9, 1e-6, 1e-3][near];
            let radius = 0.033 + 0.155 * q2.sin() + 0.135 * (q2 + q3).sin();
            prop_assume!(radius.abs() > 0.01 && q3.sin().abs() > 0.01);
            // The rotation about a ray is about the tool's x axis. It must not be parallel to the arm's three parallel
            // axes either.
            prop_assume!(task == POSE || (q5 - FRAC_PI_2).sin().abs() > 0.01);
            assert_solved(&chain, &solver, &[q1, q2, q3, q4, q5])
        };
        runner.run(&cases, run).unwrap();
    }
}

/// With the tool vertical above the first axis, the first and the last joint rotate about one line.
#[test]
fn an_upright_tool_over_the_base_leaves_two_joints_free() {
    let chain = arm(POSE);
    let solver = ScrewSolver::new(&chain).unwrap();
    let q2 = -0.3f64;
    let q3 = (-(0.033 + 0.155 * q2.sin()) / 0.135).asin() - q2;
    let target = Target::reached(&chain, &[0.4, q2, q3, -q2 - q3, 0.2]).unwrap();
    let answers = solver.solve(&target).unwrap();
    assert!(!answers.is_empty());
    assert!(answers.iter().all(|answer| answer.free == [0] || answer.free == [4]), "{answers:?}");
}
