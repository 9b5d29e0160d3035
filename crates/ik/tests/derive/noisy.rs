//! Robots with inexact numbers: errors of rounding, of float32, of a few decimals.
//!
//! The solver of the ideal robot is polished on the described one. It must find the joint values that made each ordinary pose of the described robot. Poses
//! come from the described robot's own exponentials.

use groebot_algebra::number::BigRational;
use groebot_ik::Watch;
use groebot_ik::derive::{ChainProblem, Derivation};
use groebot_robot::kinematics::{Chain, ExactVector};
use groebot_robot::robots;
use nalgebra::DMatrix;
use proptest::prelude::*;

/// The number of poses per robot.
const POSES: usize = 1000;
/// The lower limit of the smallest singular value at an ordinary pose, with lengths as fractions of the reach.
const ORDINARY: f64 = 1e-3;

/// `chain` with errors of up to `noise` in every number: angles in radians, lengths as fractions of the reach.
fn noisy(chain: &Chain, noise: f64, draw: &mut impl FnMut() -> f64) -> Chain {
    let mut off = |vector: &mut ExactVector, size: f64| {
        vector.iter_mut().for_each(|x| *x += BigRational::from_float(noise * size * draw()).unwrap());
    };
    let mut parts = chain.parts().clone();
    for joint in &mut parts.joints {
        off(&mut joint.axis, 1.0);
        off(&mut joint.point, chain.reach());
    }
    off(&mut parts.tip.point, chain.reach());
    Chain::new(parts).unwrap()
}

fn sigma(jacobian: DMatrix<f64>) -> f64 {
    jacobian.svd(false, false).singular_values.min()
}

/// A reproducible sequence of numbers in [-1, 1].
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(2) | 1;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// The number of ordinary poses whose joint values are not found, and the number of ordinary poses.
fn lost(described: &Chain, draw: &mut impl FnMut() -> f64) -> (usize, usize) {
    let problem = ChainProblem::ideal(described.ideal(), described);
    let derived = Derivation::sequentially(problem, &Watch::none()).unwrap();
    let (mut lost, mut ordinary) = (0, 0);
    let solver = derived.program().solver();
    for _ in 0..POSES {
        let q: Vec<f64> = described.joints().iter().map(|_| std::f64::consts::PI * draw()).collect();
        if sigma(described.task_jacobian(&q, &[])) <= ORDINARY {
            continue;
        }
        let pose = described.forward(&q).unwrap();
        let rotation = pose.rotation.to_rotation_matrix();
        let rows = (0..9).map(|entry| rotation[(entry / 3, entry % 3)]);
        let target: Vec<f64> = pose.translation.vector.iter().copied().chain(rows).collect();
        let answers = solver.solve_numbers(&target).unwrap();
        let near =
            |a: f64, b: f64| ((a - b) / std::f64::consts::TAU - ((a - b) / std::f64::consts::TAU).round()).abs() < 1e-9;
        let found = answers.iter().filter(|answer| answer.q.iter().zip(&q).all(|(a, b)| near(*a, *b))).count();
        assert!(found <= 1, "an answer is given twice at {q:?}");
        ordinary += 1;
        lost += usize::from(found == 0);
    }
    (lost, ordinary)
}

proptest! {
    #![proptest_config(crate::cases(4))]

    #[test]
    fn no_ordinary_pose_of_a_noisy_robot_is_lost(seed: u64, digits in 8i32..18) {
        for robot in [robots::ur5(), robots::puma(), robots::nao_left_leg()] {
            let mut draw = numbers(seed);
            let described = noisy(&robot, 10f64.powi(-digits), &mut draw);
            let (lost, ordinary) = lost(&described, &mut draw);
            prop_assert!(ordinary > POSES * 9 / 10);
            prop_assert!(lost == 0, "{} with noise 1e-{}: {} of {} lost", robot.name(), digits, lost, ordinary);
        }
    }
}
