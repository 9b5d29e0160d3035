//! Chains of other shapes, for every task with a derivation, checked by forward kinematics at known joint values.

use groebot_ik::derive::Derivation;
use groebot_ik::derive::formulate;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Chain;

const HEAD: &str = "name = \"chain\"\nlength_unit = \"m\"\n";

fn joint(name: &str, kind: &str, axis: &str, point: &str) -> String {
    format!("[[joint]]\nname = \"{name}\"\ntype = \"{kind}\"\naxis = {axis}\npoint = {point}\n")
}

fn chain(task: &str, joints: &[String], tip: &str) -> Chain {
    let text = format!("{HEAD}[task]\n{task}\n{}[tip]\npoint = {tip}\n", joints.concat());
    Chain::from_toml(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn derive(chain: &Chain) -> Derivation {
    Derivation::of_problem(formulate(chain).unwrap(), &Watch::none()).unwrap()
}

/// Joint values distributed over the circle, away from special angles.
fn samples(joints: usize) -> Vec<Vec<f64>> {
    (0..40).map(|k| (0..joints).map(|j| ((k * 7 + j * 13) as f64 * 0.734).sin() * 3.1).collect()).collect()
}

/// Every sampled joint vector is among the solutions of its own tip, and every solution reaches that tip.
fn assert_complete(chain: &Chain, derivation: &Derivation, target: impl Fn(&[f64]) -> Vec<f64>, bound: usize) {
    for q in samples(chain.joints().len()) {
        let target_values = target(&q);
        let answers = derivation.program().solve_numbers(&target_values).unwrap();
        let near = |a: &f64, b: &f64| (a - b).sin().abs() < 1e-6 && (a - b).cos() > 0.0;
        let found = answers.iter().any(|answer| answer.q.iter().zip(&q).all(|(a, b)| near(a, b)));
        assert!(found, "{q:?} not among {answers:?}");
        assert!(answers.len() <= bound, "{answers:?}");
        for answer in &answers {
            let reached = target(&answer.q);
            let same = reached.iter().zip(&target_values).all(|(a, b)| (a - b).sin().abs() < 1e-10);
            assert!(same, "{answer:?} reaches {reached:?}, not {target_values:?}");
        }
    }
}

#[test]
#[ignore = "minutes: six unknowns in one block; the planner of blocks is to make it small"]
fn a_planar_arm_of_three_joints_reaches_poses() {
    let y = "[0, 1, 0]";
    let joints = [
        joint("shoulder", "revolute", y, "[0, 0, 0]"),
        joint("elbow", "revolute", y, "[0, 0, 0.4]"),
        joint("wrist", "revolute", y, "[0, 0, 0.7]"),
    ];
    let chain = chain("kind = \"planar_pose\"\nplane = \"xz\"", &joints, "[0, 0, 0.8]");
    let derivation = derive(&chain);
    assert_complete(
        &chain,
        &derivation,
        |q| {
            let tip = chain.forward(q).unwrap().translation;
            vec![tip.x, tip.z, q.iter().sum()]
        },
        2,
    );
}

#[test]
#[ignore = "minutes: six unknowns in one block; the planner of blocks is to make it small"]
fn a_spherical_arm_reaches_positions() {
    let joints = [
        joint("yaw", "revolute", "[0, 0, 1]", "[0, 0, 0]"),
        joint("shoulder", "revolute", "[0, 1, 0]", "[0, 0, 0.3]"),
        joint("elbow", "revolute", "[0, 1, 0]", "[0, 0, 0.7]"),
    ];
    let chain = chain("kind = \"position\"", &joints, "[0, 0, 1.2]");
    let derivation = derive(&chain);
    let target = |q: &[f64]| chain.forward(q).unwrap().translation.vector.as_slice().to_vec();
    assert_complete(&chain, &derivation, target, 4);
}

#[test]
fn a_telescope_has_a_prismatic_unknown() {
    let joints =
        [joint("turn", "revolute", "[0, 0, 1]", "[0, 0, 0]"), joint("slide", "prismatic", "[1, 0, 0]", "[0, 0, 0]")];
    let chain = chain("kind = \"planar_position\"\nplane = \"xy\"", &joints, "[0.2, 0, 0]");
    let derivation = derive(&chain);
    assert_eq!(derivation.program().joints.len(), 2);
    for q in [[0.3, 0.5], [-2.9, 0.1], [1.2, -0.9]] {
        let tip = chain.forward(&q).unwrap().translation;
        let answers = derivation.program().solve_numbers(&[tip.x, tip.y]).unwrap();
        assert_eq!(answers.len(), 2, "{answers:?}");
        assert!(answers.iter().any(|a| (a.q[0] - q[0]).abs() < 1e-9 && (a.q[1] - q[1]).abs() < 1e-9), "{answers:?}");
    }
    let answers = derivation.program().solve_numbers(&[0.0, 0.0]).unwrap();
    assert_eq!(answers.len(), 1, "{answers:?}");
    assert_eq!(answers[0].free, [0], "at the centre the turn is free");
    assert!((answers[0].q[1] + 0.2).abs() < 1e-12);
}

/// NAO's hip axis (0, 1, 1)/sqrt 2: an algebraic number instead of a decimal.
#[test]
fn a_slanted_axis_brings_an_exact_root() {
    let joints = [
        joint("slanted", "revolute", "[0, 1, 1]", "[0, 0, 0]"),
        joint("roll", "revolute", "[1, 0, 0]", "[0, 0, 0]"),
        joint("reach", "prismatic", "[0, 0, 2]", "[0, 0, 0]"),
    ];
    let chain = chain("kind = \"position\"", &joints, "[0, 0, 0.5]");
    let system = formulate(&chain).unwrap();
    assert!(system.to_string().contains("root2^2 = 2"), "{system}");
    let derivation = derive(&chain);
    for q in [[0.3, 0.5, 0.2], [-0.9, 0.1, 0.4], [1.2, -0.9, 0.3]] {
        let tip = chain.forward(&q).unwrap().translation.vector;
        let answers = derivation.program().solve_numbers(tip.as_slice()).unwrap();
        let found = answers.iter().any(|a| a.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-8));
        assert!(found, "{q:?} not among {answers:?}");
    }
}

#[test]
fn what_is_not_derived_yet_says_so() {
    let joints = [joint("yaw", "revolute", "[0, 0, 1]", "[0, 0, 0]")];
    let error = formulate(&chain("kind = \"pose\"", &joints, "[1, 0, 0]")).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("planar_pose"), "{error}");
}
