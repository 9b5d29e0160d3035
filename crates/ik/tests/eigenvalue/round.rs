//! Round targets, which users try first: joint values in multiples of 15 degrees, orientations along the base's axes.

use std::f64::consts::PI;

use groebot_ik::derive::eigenvalue;
use groebot_runtime::six_axes;
use nalgebra::{Matrix6, Vector6};

use super::robots::{OFFSET_LEG, OFFSET_WRIST, SIDE_WRIST, robot};
use super::{Axes, Random, distance, found, nearest};

const X: [i64; 3] = [1_000_000, 0, 0];
const Y: [i64; 3] = [0, 1_000_000, 0];
const Z: [i64; 3] = [0, 0, 1_000_000];

/// Axes along x, y and z, drawn at random. One solution has the doubled joint at -90 degrees, where cosine and sine of its half are equal up to their signs.
const ALONG_AXES: Axes = [
    (X, [0, 2000, 0]),
    (Y, [0, 2500, -1000]),
    (Z, [-1500, 2500, 0]),
    (Y, [-1000, 2500, 0]),
    (Z, [-3500, 2500, 500]),
    (X, [-3500, 2500, -500]),
];

/// The lower limit of the Jacobian's smallest singular value at an ordinary joint vector.
const ORDINARY: f64 = 1e-3;

/// The error of joint values at a target: of the position, and of the rotation as a vector (length 2 for 180 degrees).
fn miss(solver: &six_axes::Chain, q: &[f64; 6], target: &[f64; 12]) -> Vector6<f64> {
    let reached = solver.forward(q);
    let columns = |pose: &[f64; 12]| [0, 1, 2].map(|k| nalgebra::Vector3::new(pose[3 + k], pose[6 + k], pose[9 + k]));
    let turn =
        columns(&reached).iter().zip(&columns(target)).map(|(a, b)| a.cross(b) * 0.5).sum::<nalgebra::Vector3<f64>>();
    let difference = |k: usize| target[k] - reached[k];
    Vector6::new(difference(0), difference(1), difference(2), turn.x, turn.y, turn.z)
}

fn jacobian(solver: &six_axes::Chain, q: &[f64; 6]) -> Matrix6<f64> {
    const STEP: f64 = 1e-6;
    let target = solver.forward(q);
    let column = |joint: usize| {
        let mut beside = *q;
        beside[joint] += STEP;
        miss(solver, &beside, &target) / -STEP
    };
    Matrix6::from_columns(&[0, 1, 2, 3, 4, 5].map(column))
}

fn sigma(solver: &six_axes::Chain, q: &[f64; 6]) -> f64 {
    jacobian(solver, q).singular_values().min()
}

/// Whether joint values reach a target, in every entry of the pose.
fn reaches(solver: &six_axes::Chain, q: &[f64; 6], target: &[f64; 12]) -> bool {
    solver.forward(q).iter().zip(target).all(|(a, b)| (a - b).abs() <= 1e-9)
}

/// All ordinary joint vectors that damped least squares finds from `starts` random starts.
fn searched(solver: &six_axes::Chain, target: &[f64; 12], starts: usize) -> Vec<[f64; 6]> {
    let (mut random, mut list) = (Random::new(5), Vec::<[f64; 6]>::new());
    for _ in 0..starts {
        let mut q = random.angles();
        for _ in 0..60 {
            let miss = miss(solver, &q, target);
            let matrix = jacobian(solver, &q);
            let damped = matrix.transpose() * matrix + Matrix6::identity() * (1e-2 * miss.norm_squared());
            let Some(step) = damped.lu().solve(&(matrix.transpose() * miss)) else { break };
            q = std::array::from_fn(|joint| q[joint] + step[joint] * f64::min(1.0, 0.5 / step.amax()));
            if miss.norm() <= 1e-11 {
                break;
            }
        }
        let is_new = list.iter().all(|known| distance(known, &q) > 1e-6);
        if is_new && reaches(solver, &q, target) && sigma(solver, &q) > ORDINARY {
            list.push(q);
        }
    }
    list
}

/// The target of the base frame at zero that brings the robot's tip to `target`, given the tip's position at zero with identity rotation.
fn carried(target: [f64; 12], tip: [f64; 3]) -> [f64; 12] {
    let mut pose = target;
    for k in 0..3 {
        pose[k] -= (0..3).map(|j| target[3 + 3 * k + j] * tip[j]).sum::<f64>();
    }
    pose
}

/// An offset wrist on a column of 245 mm, its tip 160 mm ahead. The numbers of solutions are from Newton's method in numpy with several hundred starts.
#[test]
fn axis_aligned_targets_of_an_offset_wrist_have_all_answers() {
    let raised = OFFSET_WRIST.map(|(axis, [x, y, z])| (axis, [x, y, z + 2450]));
    let solver = eigenvalue::solver(&robot(&raised)).unwrap();
    let tip = [0.7, -0.15, 0.785];
    for (target, count) in [
        ([-0.5, 0.0, 0.4, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0], 12),
        ([-0.6, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0], 8),
    ] {
        let target = carried(target, tip);
        let answers = found(&solver.solve(&target));
        assert_eq!(answers.len(), count, "{target:?}");
        assert!(answers.iter().all(|answer| reaches(&solver, &answer.q, &target)), "{target:?}");
    }
}

fn steps_of_fifteen_degrees(random: &mut Random) -> [f64; 6] {
    std::array::from_fn(|_| random.integer(-11, 12) as f64 * PI / 12.0)
}

/// All ordinary solutions of a numeric search are found.
#[test]
fn round_targets_have_what_a_search_finds() {
    for (name, axes) in [("offset wrist", &OFFSET_WRIST), ("along axes", &ALONG_AXES)] {
        let solver = eigenvalue::solver(&robot(axes)).unwrap();
        let mut random = Random::new(3);
        for _ in 0..6 {
            let target = solver.forward(&steps_of_fifteen_degrees(&mut random));
            let answers = solver.solve(&target);
            for q in searched(&solver, &target, 150) {
                assert!(nearest(&answers, &q) <= 1e-6, "{name}: {q:?} at {target:?}");
            }
        }
    }
}

/// The joint values that made a target are found if they are ordinary. All solutions reach the target; none is rotated by 180 degrees.
#[test]
fn joint_values_in_steps_of_fifteen_degrees_are_found() {
    for (name, axes) in [
        ("offset wrist", &OFFSET_WRIST),
        ("side wrist", &SIDE_WRIST),
        ("leg", &OFFSET_LEG),
        ("along axes", &ALONG_AXES),
    ] {
        let solver = eigenvalue::solver(&robot(axes)).unwrap();
        let mut random = Random::new(15);
        for _ in 0..1500 {
            let q = steps_of_fifteen_degrees(&mut random);
            let target = solver.forward(&q);
            let answers = solver.solve(&target);
            assert!(found(&answers).iter().all(|answer| reaches(&solver, &answer.q, &target)), "{name}: {q:?}");
            assert!(nearest(&answers, &q) <= 1e-6 || sigma(&solver, &q) <= ORDINARY, "{name}: {q:?}");
        }
    }
}

/// Joint values at which one solution was once lost. Causes: four solutions share the hidden angle; half the doubled angle is 135 degrees.
#[test]
fn targets_that_lost_an_answer() {
    let degrees = |q: [f64; 6]| q.map(f64::to_radians);
    let cases: [(&Axes, [f64; 6]); 2] = [
        (&ALONG_AXES, [-150.0, 150.0, 90.0, -90.0, 0.0, 90.0]),
        (&OFFSET_WRIST, [0.0, -150.0, 60.0, 180.0, -120.0, 60.0]),
    ];
    for (axes, q) in cases {
        let (solver, q) = (eigenvalue::solver(&robot(axes)).unwrap(), degrees(q));
        let answers = solver.solve(&solver.forward(&q));
        assert!(nearest(&answers, &q) <= 1e-6, "{q:?}");
        let moved = std::array::from_fn(|joint| q[joint] + 1e-7 * (joint as f64 - 2.3));
        assert_eq!(found(&answers).len(), found(&solver.solve(&solver.forward(&moved))).len(), "{q:?}");
    }
}
