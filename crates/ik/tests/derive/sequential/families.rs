//! Families of random chains: rational lengths and axes, not aligned with the base or the tool.

use std::time::Instant;

use groebot_algebra::number::BigRational;
use groebot_ik::derive::Derivation;
use groebot_ik::derive::sequential::Form;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Plane, Target, Task};
use groebot_robot::robots;

use super::{Random, derive, distance, miss};
use crate::derive::random_chains::{Shared, chain, planar_chain, reversed};

const SEEDS: u64 = 3;
const POSES: usize = 25;

/// Checks that the joints that made a pose are among its solutions, and that all solutions reach it. Their number is that of the screw solver, if it applies.
fn check(name: &str, chain: &Chain) -> Derivation {
    let start = Instant::now();
    let derived = derive(chain);
    let forms: Vec<Form> = derived.sequential().unwrap().method.steps.iter().map(|step| step.shape.form).collect();
    println!("{name}: {} solutions, {forms:?}, {:?}", derived.dimension().unwrap(), start.elapsed());
    let screws = ScrewSolver::new(chain);
    let mut random = Random(11);
    let solver = derived.program().solver();
    for pose in 0..POSES {
        let q = random.joints(chain);
        let target = derived.reached(&q).unwrap();
        let answers = solver.solve_numbers(&target).unwrap();
        let place = format!("{name} pose {pose} {q:?}: {answers:?}");
        assert!(answers.iter().any(|answer| distance(chain, &answer.q, &q, &answer.free) < 1e-7), "{place}");
        assert!(answers.iter().all(|answer| miss(&derived, &target, answer) <= 1e-12), "{place}");
        assert!(answers.len() <= derived.dimension().unwrap(), "{place}");
        if let Ok(screws) = &screws {
            // The given joints are the last inputs.
            let given = &target[target.len() - chain.parts().given.len()..];
            let expected = screws.solve_given(&Target::reached(chain, &q).unwrap(), given).unwrap();
            assert_eq!(answers.len(), expected.len(), "{place}\n{expected:?}");
        }
    }
    derived
}

fn family(name: &str, kinds: &str, shared: &[Shared], task: Task) {
    for seed in 0..SEEDS {
        check(name, &chain(kinds, shared, task, seed));
    }
}

#[test]
fn arms_with_a_spherical_wrist() {
    let wrist = Shared::Point(3, 5);
    family("parallel shoulder and elbow", "RRRRRR", &[Shared::Direction(1, 2), wrist], Task::Pose);
    family("shoulder axes meet", "RRRRRR", &[Shared::Point(0, 1), wrist], Task::Pose);
    family("gantry", "PPPRRR", &[wrist], Task::Pose);
}

#[test]
fn a_general_arm_with_a_slide() {
    family("two joints and a slide", "RRP", &[], Task::Position);
    family("slide in the middle", "RPR", &[], Task::Position);
    family("sliding third joint", "RRPRRR", &[Shared::Point(3, 5)], Task::Pose);
}

#[test]
fn legs_with_a_spherical_hip() {
    for seed in 0..SEEDS {
        check("leg", &reversed(&chain("RRRRRR", &[Shared::Direction(1, 2), Shared::Point(3, 5)], Task::Pose, seed)));
    }
}

#[test]
fn three_parallel_axes() {
    family("three parallel axes", "RRRRRR", &[Shared::Direction(1, 3), Shared::Point(4, 5)], Task::Pose);
}

#[test]
fn a_general_arm_needs_half_angles() {
    family("general three joints", "RRR", &[], Task::Position);
    family("general arm and spherical wrist", "RRRRRR", &[Shared::Point(3, 5)], Task::Pose);
    let derived = check("general three joints", &chain("RRR", &[], Task::Position, 9));
    assert!(derived.sequential().unwrap().method.steps.iter().any(|step| step.shape.form == Form::Quartic));
    let text = derived.certificate().unwrap();
    assert_eq!(Derivation::prove(derived.problem().clone(), &text).unwrap(), derived);
    println!("certificate {} bytes", text.len());
    let forged = text.replace(
        "\"eliminations\": [\n      {\n        \"member\": \"",
        "\"eliminations\": [\n      {\n        \"member\": \"x2 + ",
    );
    assert_ne!(forged, text);
    let error = Derivation::prove(derived.problem().clone(), &forged).unwrap_err();
    assert!(error.message().contains("cofactors of an elimination"), "{error}");
}

#[test]
fn other_tasks() {
    family("rotation", "RRR", &[], Task::Rotation);
    family("direction", "RR", &[], Task::Direction);
    family("polar", "RRP", &[Shared::Point(0, 1)], Task::Position);
    let along = [1, 0, 0].map(|entry| BigRational::from_integer(entry.into()));
    check("ray", &robots::nao_left_arm().with_task(Task::Ray, along, Vec::new()).unwrap());
    let plane = Plane::Xy;
    for (kinds, task) in [
        ("RR", Task::PlanarPosition { plane }),
        ("RRR", Task::PlanarPose { plane }),
        ("PRR", Task::PlanarPose { plane }),
    ] {
        for seed in 0..SEEDS {
            check(kinds, &planar_chain(kinds, task, seed));
        }
    }
}

/// Seven joints, one of them given: its value is returned unchanged.
#[test]
fn a_given_joint_stays_where_it_is() {
    for seed in 0..SEEDS {
        let shared = [Shared::Point(0, 2), Shared::Point(4, 6)];
        let chain = chain("RRRRRRR", &shared, Task::Pose, seed);
        let mut parts = chain.parts().clone();
        parts.given = vec!["joint1".to_owned()];
        let derived = check("seven joints", &Chain::new(parts).unwrap());
        assert_eq!(derived.program().inputs.last().unwrap().name, "joint1");
    }
}
