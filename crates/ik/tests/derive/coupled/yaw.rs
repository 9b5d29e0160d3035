//! NAO on both feet with unknown yaw of the torso: `derivations/nao_legs_yaw`.
//!
//! The witness samples the yaw and solves each leg by screw theory in the torso's frame. There is a solution where both legs have solutions with equal hip
//! values.

use std::path::Path;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use groebot_ik::derive::Derivation;
use groebot_ik::derive::coupled::CoupledChains;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Target;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::robots;
use groebot_robot::spatial::{Pose, angle};
use nalgebra::{Translation3, UnitQuaternion};

use super::{Random, distance};

static STANDING: LazyLock<Derivation> = LazyLock::new(|| {
    let file = concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/derivations/nao_legs_yaw/0_coupled.toml");
    Derivation::of_problem(CoupledChains::read(Path::new(file)).unwrap(), &Watch::none()).unwrap()
});

/// The number of yaw samples at which the legs are solved.
const PLACES: usize = 1500;

/// The pose of the torso from its yaw, pitch and roll.
fn torso(q: &[f64]) -> Pose {
    Pose::from_parts(Translation3::identity(), UnitQuaternion::from_euler_angles(q[2], q[1], q[0]))
}

/// The poses of both feet, left first, by forward kinematics of the robot's legs.
fn feet(q: &[f64]) -> [Pose; 2] {
    let legs = [robots::nao_left_leg(), robots::nao_right_leg()];
    [0, 1]
        .map(|leg| torso(q) * legs[leg].forward(&STANDING.coupled().unwrap().joints_of(leg, q).unwrap()[3..]).unwrap())
}

/// The largest difference of two poses (m, and rotation entries).
fn miss(a: &Pose, b: &Pose) -> f64 {
    let turn = a.rotation.to_rotation_matrix().matrix() - b.rotation.to_rotation_matrix().matrix();
    (a.translation.vector - b.translation.vector).amax().max(turn.amax())
}

#[test]
fn the_solver_asks_for_both_feet_and_the_torso_s_tilt() {
    STANDING.program().validate().unwrap();
    let names: Vec<&str> = STANDING.program().joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names[..5], ["TorsoYaw", "TorsoPitch", "TorsoRoll", "HipYawPitch", "left_HipRoll"]);
    assert_eq!(names.len(), 14);
    let inputs: Vec<&str> = STANDING.program().inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!(
        (inputs.len(), &inputs[11..15]),
        (26, &["left_r33", "left_TorsoPitch", "left_TorsoRoll", "right_px"][..])
    );
    assert_eq!(STANDING.dimension(), Some(4 * 2 * 4 * 4));
    assert_eq!(STANDING.coupled().unwrap().simultaneous_names(), ["TorsoYaw", "HipYawPitch"]);
}

#[test]
fn the_joints_that_made_a_target_are_found_and_every_answer_reaches_it() {
    let mut random = Random(21);
    let (mut running, mut most) = (Duration::ZERO, 0);
    let solver = STANDING.program().solver();
    for _ in 0..12 {
        let q = random.angles(14);
        let target = STANDING.reached(&q).unwrap();
        let start = Instant::now();
        let answers = solver.solve_numbers(&target).unwrap();
        running += start.elapsed();
        assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-9), "{q:?}: {answers:?}");
        let requested = feet(&q);
        for answer in &answers {
            assert!(distance(&answer.q[1..3], &q[1..3]) < 1e-12, "the tilt is given: {answer:?}");
            let reached = feet(&answer.q);
            assert!((0..2).all(|leg| miss(&reached[leg], &requested[leg]) < 1e-12), "{q:?}: {answer:?}");
        }
        assert!(answers.len() <= STANDING.dimension().unwrap());
        most = most.max(answers.len());
    }
    println!("at most {most} answers, {:?} each", running / 12);
}

/// Both feet below the hips, soles level, knees bent. Cases: upright or leaning, one foot ahead, feet turned out.
#[test]
fn the_standing_robot_is_found() {
    let solver = STANDING.program().solver();
    for (pitch, hip) in [(0.0, 0.0), (0.1, 0.0), (0.0, -0.3), (0.1, -0.3)] {
        for (ahead, knee) in [(-0.4, 0.8), (-0.2, 0.9)] {
            let leg = |thigh: f64| [0.0, thigh - pitch, knee, -thigh - knee, 0.0];
            let q = [&[0.0, pitch, 0.0, hip][..], &leg(-0.4), &leg(ahead)].concat();
            let answers = solver.solve_numbers(&STANDING.reached(&q).unwrap()).unwrap();
            assert!(answers.iter().any(|answer| distance(&answer.q, &q) < 1e-7), "{q:?}: {answers:?}");
        }
    }
}

/// The solutions of both legs for one yaw of the torso.
fn solutions(legs: &[ScrewSolver; 2], requested: &[Pose; 2], tilt: &[f64], yaw: f64) -> [Vec<Vec<f64>>; 2] {
    let world_from_torso = torso(&[yaw, tilt[0], tilt[1]]);
    [0, 1].map(|leg| {
        let target = Target::Pose(world_from_torso.inverse() * requested[leg]);
        legs[leg].solve(&target).unwrap().into_iter().map(|answer| answer.q).collect()
    })
}

/// The solution that continues `solution` at the next sample.
fn next<'a>(solutions: &'a [Vec<f64>], solution: &[f64]) -> Option<&'a Vec<f64>> {
    let nearest = solutions.iter().min_by(|a, b| distance(a, solution).total_cmp(&distance(b, solution)))?;
    (distance(nearest, solution) < 0.2).then_some(nearest)
}

/// All yaws, with the legs' joints, at which solutions of both legs have equal hip values. Solutions that begin or end between two samples are skipped.
fn meetings(legs: &[ScrewSolver; 2], requested: &[Pose; 2], tilt: &[f64]) -> Vec<(f64, [Vec<f64>; 2])> {
    let place = |k: usize| std::f64::consts::TAU * (k as f64 + 0.123) / PLACES as f64 - std::f64::consts::PI;
    let off = |a: &[f64], b: &[f64]| angle::difference(a[0], b[0]);
    let mut found = Vec::new();
    let mut here = solutions(legs, requested, tilt, place(0));
    for k in 0..PLACES {
        let there = solutions(legs, requested, tilt, place(k + 1));
        for (a, b) in here[0].iter().flat_map(|a| here[1].iter().map(move |b| (a, b))) {
            let (Some(c), Some(d)) = (next(&there[0], a), next(&there[1], b)) else { continue };
            let (start, end) = (off(a, b), off(c, d));
            if start * end > 0.0 || start.abs().max(end.abs()) > 1.0 {
                continue;
            }
            let (mut low, mut high, mut at) = (place(k), place(k + 1), [a.clone(), b.clone()]);
            for _ in 0..45 {
                let middle = 0.5 * (low + high);
                let both = solutions(legs, requested, tilt, middle);
                let (Some(e), Some(f)) = (next(&both[0], &at[0]), next(&both[1], &at[1])) else { break };
                if off(e, f) * start > 0.0 {
                    low = middle
                } else {
                    high = middle
                }
                at = [e.clone(), f.clone()];
            }
            if off(&at[0], &at[1]).abs() < 1e-9 {
                found.push((angle::wrap(low), at));
            }
        }
        here = there;
    }
    found
}

#[test]
fn going_round_with_the_yaw_finds_the_same_answers() {
    let legs = [robots::nao_left_leg(), robots::nao_right_leg()].map(|leg| ScrewSolver::new(&leg).unwrap());
    let mut random = Random(22);
    let (mut ours, mut theirs) = (0, 0);
    let solver = STANDING.program().solver();
    for _ in 0..6 {
        let q = random.angles(14);
        let answers = solver.solve_numbers(&STANDING.reached(&q).unwrap()).unwrap();
        let found = meetings(&legs, &feet(&q), &q[1..3]);
        for (yaw, [left, right]) in &found {
            let is_ours = |other: &Vec<f64>| {
                let legs = [0, 1].map(|leg| STANDING.coupled().unwrap().joints_of(leg, other).unwrap()[3..].to_vec());
                distance(&other[..1], &[*yaw]) < 1e-6
                    && distance(&legs[0], left) < 1e-6
                    && distance(&legs[1], right) < 1e-6
            };
            assert!(answers.iter().any(|answer| is_ours(&answer.q)), "{q:?}: {yaw} {left:?} {right:?}");
        }
        (ours, theirs) = (ours + answers.len(), theirs + found.len());
    }
    println!("{ours} answers, {theirs} of them by going round");
    assert!(10 * theirs >= 9 * ours && theirs <= ours, "{theirs} of {ours}");
}

#[test]
fn the_certificate_proves_it_again_and_no_other() {
    let text = STANDING.certificate().unwrap();
    assert_eq!(Derivation::prove(STANDING.problem().clone(), &text).unwrap().program(), STANDING.program());
    let refused = |from: &str, to: &str, words: &str| {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        let error = Derivation::prove(STANDING.problem().clone(), &changed).unwrap_err();
        assert!(error.kind() == ErrorKind::Certificate && error.message().contains(words), "`{words}`: {error}");
    };
    refused("\"member\": \"", "\"member\": \"x3 + ", "do not multiply out");
    refused("\"1/20\"", "\"1/10\"", "");
    refused("\"joints\": [0, 3]", "\"joints\": [3, 0]", "");
}
