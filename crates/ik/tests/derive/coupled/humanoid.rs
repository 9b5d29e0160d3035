//! NAO's legs, whose hips have one common actuator: eleven actuators.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use groebot_ik::derive::Derivation;
use groebot_ik::derive::coupled::CoupledChains;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, Solution, Target, Task, along_z};
use groebot_robot::robots;

use super::{Random, distance};

/// The left foot's pose. For the right foot: the position and the direction of the sole's normal.
const POSE_AND_RAY: &str = r#"
name = "legs"
shared = [["left.HipYawPitch", "right.HipYawPitch"]]
[[chain]]
name = "right"
chain = "right.toml"
task = { kind = "ray", direction = [0, 0, 1] }
[[chain]]
name = "left"
chain = "left.toml"
"#;

fn derive(text: &str) -> Derivation {
    let folder = tempfile::tempdir().unwrap();
    for (file, robot) in [("left.toml", "nao_left_leg"), ("right.toml", "nao_right_leg")] {
        let described = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
            .join("derivations")
            .join(robot)
            .join("0_chain.toml");
        fs::copy(described, folder.path().join(file)).unwrap();
    }
    fs::write(folder.path().join("0_coupled.toml"), text).unwrap();
    let members = CoupledChains::read(&folder.path().join("0_coupled.toml")).unwrap();
    Derivation::of_problem(members, &Watch::none()).unwrap()
}

static LEGS: LazyLock<Derivation> = LazyLock::new(|| derive(POSE_AND_RAY));

/// The poses of both feet: twelve numbers for eleven actuators.
static BOTH_POSES: LazyLock<Derivation> =
    LazyLock::new(|| derive(&POSE_AND_RAY.replace("task = { kind = \"ray\", direction = [0, 0, 1] }", "")));

fn names<'a>(list: impl IntoIterator<Item = &'a String>) -> String {
    list.into_iter().map(String::as_str).collect::<Vec<_>>().join(" ")
}

#[test]
fn the_solver_has_eleven_joints_and_the_inputs_of_both_feet() {
    let program = LEGS.program();
    program.validate().unwrap();
    assert_eq!(
        names(program.joints.iter().map(|joint| &joint.name)),
        "HipYawPitch left_HipRoll left_HipPitch left_KneePitch left_AnklePitch left_AnkleRoll right_HipRoll \
         right_HipPitch right_KneePitch right_AnklePitch right_AnkleRoll"
    );
    assert_eq!(
        names(program.inputs.iter().map(|input| &input.name)),
        "left_px left_py left_pz left_r11 left_r12 left_r13 left_r21 left_r22 left_r23 left_r31 left_r32 left_r33 \
         right_px right_py right_pz right_dx right_dy right_dz"
    );
    let members: Vec<&str> = LEGS
        .coupled()
        .unwrap()
        .method
        .stages
        .iter()
        .map(|stage| LEGS.coupled().unwrap().problem.chains()[stage.member].name.as_str())
        .collect();
    assert_eq!(members, ["left", "right"], "the ray alone does not determine six joints");
}

/// The largest error of a foot: of its position as a fraction of the leg's length, and of its rotation or its sole's normal.
fn miss(chain: &Chain, reached: &[f64], requested: &[f64]) -> f64 {
    let reached = chain.forward(reached).unwrap();
    let requested = chain.forward(requested).unwrap();
    let position = (reached.translation.vector - requested.translation.vector).amax() / chain.reach();
    let (reached, requested) = (reached.rotation.to_rotation_matrix(), requested.rotation.to_rotation_matrix());
    let turn = reached.matrix() - requested.matrix();
    position.max(if chain.task() == Task::Ray { turn.column(2).amax() } else { turn.amax() })
}

/// The number of solutions by screw theory: for each solution of the left leg, those of the right leg with its hip at the left leg's value.
fn counted(left: &ScrewSolver, right: &ScrewSolver, q: [&[f64]; 2]) -> usize {
    let answers = left.solve(&Target::reached(left.chain(), q[0]).unwrap()).unwrap();
    let target = Target::reached(right.chain(), q[1]).unwrap();
    let solved = |hip: f64| right.solve_given(&target, &[hip]).unwrap().len();
    answers.iter().map(|answer| solved(answer.q[0])).sum()
}

#[test]
fn both_feet_are_reached_in_all_ways_and_as_often_as_screw_theory_says() {
    let left = robots::nao_left_leg();
    let given = vec!["RHipYawPitch".to_owned()];
    let right = robots::nao_right_leg().with_task(Task::Ray, along_z(), given).unwrap();
    let screws = [&left, &right].map(|chain| ScrewSolver::new(chain).unwrap());
    let mut random = Random(11);
    let (mut running, mut most) = (Duration::ZERO, 0);
    let solver = LEGS.program().solver();
    for pose in 0..200 {
        let q = random.angles(11);
        let target = LEGS.reached(&q).unwrap();
        let start = Instant::now();
        let answers = solver.solve_numbers(&target).unwrap();
        running += start.elapsed();
        let place = format!("pose {pose} {q:?}");
        assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-9), "{place}: {answers:?}");
        let feet = |q: &[f64]| {
            [LEGS.coupled().unwrap().joints_of(1, q).unwrap(), LEGS.coupled().unwrap().joints_of(0, q).unwrap()]
        };
        let requested = feet(&q);
        for answer in &answers {
            let reached = feet(&answer.q);
            assert!(miss(&left, &reached[0], &requested[0]) <= 1e-12, "{place}: left foot of {answer:?}");
            assert!(miss(&right, &reached[1], &requested[1]) <= 1e-12, "{place}: right foot of {answer:?}");
            assert!(answer.free.is_empty(), "{place}: {answer:?}");
        }
        let expected = counted(&screws[0], &screws[1], [&requested[0], &requested[1]]);
        assert_eq!(answers.len(), expected, "{place}: {answers:?}");
        most = most.max(answers.len());
    }
    println!("at most {most} answers, {:?} each", running / 200);
}

#[test]
fn two_full_poses_are_solved_when_they_agree_on_the_hip() {
    let legs = [robots::nao_left_leg(), robots::nao_right_leg()];
    let mut random = Random(12);
    let solver = BOTH_POSES.program().solver();
    for pose in 0..40 {
        let q = random.angles(11);
        let target = BOTH_POSES.reached(&q).unwrap();
        let answers = solver.solve_numbers(&target).unwrap();
        assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-9), "pose {pose} {q:?}: {answers:?}");
        for (member, chain) in [(1, &legs[0]), (0, &legs[1])] {
            let requested = BOTH_POSES.coupled().unwrap().joints_of(member, &q).unwrap();
            for answer in &answers {
                let reached = BOTH_POSES.coupled().unwrap().joints_of(member, &answer.q).unwrap();
                assert!(miss(chain, &reached, &requested) <= 1e-12, "pose {pose} {q:?}: {answer:?}");
            }
        }
        assert_eq!(BOTH_POSES.coupled().unwrap().explain(&target, &Watch::none()).unwrap(), None);
    }
}

/// Each foot is reachable, but not with a common value of the hip's actuator: the left leg's value is 0.01 rad off. The reported values differ by that amount,
/// unless two other solutions of the legs happen to be nearer.
#[test]
fn two_poses_that_disagree_are_refused_by_the_actuator_and_by_how_much() {
    let mut random = Random(13);
    let mut exact = 0;
    let solver = BOTH_POSES.program().solver();
    for _ in 0..8 {
        let q = random.angles(11);
        let mut other = q.clone();
        other[0] += 0.01;
        let mut target = BOTH_POSES.reached(&q).unwrap();
        // The target of the right foot comes first.
        target[12..].copy_from_slice(&BOTH_POSES.reached(&other).unwrap()[12..]);
        // Some of these targets reach the step limit. Then no solution is found either.
        let found = solver.solve_numbers(&target);
        assert!(found.map_or_else(|error| error.kind() == ErrorKind::Budget, |answers| answers.is_empty()));
        let explained = BOTH_POSES.coupled().unwrap().explain(&target, &Watch::none()).unwrap().unwrap();
        assert_eq!((explained.member.as_str(), explained.before), ("left", 8));
        assert!(explained.to_string().contains("chain `left` needs `HipYawPitch` at"), "{explained}");
        let disagreement = explained.disagreement.unwrap();
        assert!(disagreement.actuator == "HipYawPitch" && disagreement.off().abs() <= 0.01 + 1e-9, "{disagreement:?}");
        exact += usize::from((disagreement.off() - 0.01).abs() < 1e-9);
    }
    assert!(exact >= 7, "{exact} of 8");
}

/// Both feet below the hips, soles level, knees bent. The foot's x axis is parallel to that of the hip's roll.
#[test]
fn the_standing_robot_is_found() {
    let leg = [0.0, -0.4, 0.8, -0.4, 0.0];
    let q = [&[0.0][..], &leg, &leg].concat();
    let answers = BOTH_POSES.program().solve_numbers(&BOTH_POSES.reached(&q).unwrap()).unwrap();
    assert_eq!(answers.len(), 32, "{answers:?}");
    assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-9), "{answers:?}");
}

/// If one hip's axes are in line, its leg does not determine the actuator; the other leg does.
#[test]
fn a_hip_that_one_leg_leaves_open_is_found_from_the_other() {
    let mut random = Random(15);
    // The first and third axes are in line if the roll rotates the third onto the first: by 45 and 135 degrees to either side.
    let solver = BOTH_POSES.program().solver();
    for (member, roll) in [(1, 2.356_194_490_192_345), (0, -2.356_194_490_192_345)] {
        let roll_place =
            BOTH_POSES.coupled().unwrap().method.stages.iter().find(|stage| stage.member == member).unwrap().joints[1];
        for _ in 0..10 {
            let mut q = random.angles(11);
            q[roll_place] = roll;
            let target = BOTH_POSES.reached(&q).unwrap();
            let answers = solver.solve_numbers(&target).unwrap();
            let near = |answer: &Solution| distance(&answer.q, &q) < 1e-6;
            assert!(answers.iter().any(near), "{q:?}: {answers:?}");
        }
    }
}

#[test]
fn a_foot_out_of_reach_is_named() {
    let q = Random(14).angles(11);
    let mut target = LEGS.reached(&q).unwrap();
    target[12] += 1.0;
    let explained = LEGS.coupled().unwrap().explain(&target, &Watch::none()).unwrap().unwrap();
    assert_eq!(explained.member, "right");
    target[12] -= 1.0;
    target[0] += 1.0;
    let explained = LEGS.coupled().unwrap().explain(&target, &Watch::none()).unwrap().unwrap();
    assert_eq!((explained.member.as_str(), explained.before), ("left", 0));
}

#[test]
fn the_certificate_proves_the_same_solver_again_and_no_other() {
    let text = LEGS.certificate().unwrap();
    let again = Derivation::prove(LEGS.problem().clone(), &text).unwrap();
    assert_eq!(again.program(), LEGS.program());
    let refused = |text: &str, kind: ErrorKind, word: &str| {
        let error = Derivation::prove(LEGS.problem().clone(), text).unwrap_err();
        assert!(error.kind() == kind && error.message().contains(word), "`{word}`: {error}");
    };
    refused(&text.replacen("\"chain\": \"left\"", "\"chain\": \"right\"", 1), ErrorKind::Certificate, "`left`");
    refused(&text.replacen("\"name\": \"legs\"", "\"name\": \"arms\"", 1), ErrorKind::Certificate, "`arms`");
    refused(&text.replacen("\"joint\": 0", "\"joint\": 1", 1), ErrorKind::Certificate, "chain `left`");
    refused(&text[..text.len() / 2], ErrorKind::Syntax, "certificate");
    let both = Derivation::prove(BOTH_POSES.problem().clone(), &text).unwrap_err();
    assert_eq!(both.kind(), ErrorKind::Certificate, "{both}");
}
