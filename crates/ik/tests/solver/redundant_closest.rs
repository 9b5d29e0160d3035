//! The closest joint values of redundant arms without the value of a given joint: plane geometry, forward kinematics, and a search from random joint vectors.

use std::f64::consts::PI;

use groebot_ik::solver::ErrorWeights;
use groebot_ik::{ErrorKind, derive};
use groebot_robot::kinematics::{Chain, Target};
use groebot_robot::spatial::Pose;
use nalgebra::{Translation3, Vector3};

use super::redundant::{Arm, READY, panda};
use super::redundant_scanned;
use crate::codegen::random;

/// Three links of 0.5, 0.4 and 0.15 m that place their end in a plane.
fn planar() -> Arm {
    let text = include_str!("../../../../derivations/planar_3r/0_chain.toml").replace("planar_pose", "planar_position");
    let chain = Chain::from_toml(&text).unwrap();
    let solver = derive(&chain).unwrap().program().redundant_solver().unwrap();
    Arm { chain, solver }
}

#[test]
fn three_links_stretch_towards_a_point_out_of_reach() {
    let (arm, mut between) = (planar(), random());
    for _ in 0..10 {
        let (angle, radius) = (between(-3.0, 3.0), between(1.06, 4.0));
        let target = arm.solver.target(Target::PlanarPosition([radius * angle.cos(), radius * angle.sin()])).unwrap();
        let found = arm.solver.closest(&target, &arm.solver.limits(), &ErrorWeights::default()).unwrap();
        assert!(!found.reachable && found.is_minimum && found.agreeing > 0, "{found:?}");
        assert!((found.distance - (radius - 1.05)).abs() < 1e-9 && found.angle == 0.0, "{found:?}");
        let turns = |value: f64| (value / (2.0 * PI)).round() * 2.0 * PI;
        assert!(found.q[1..].iter().all(|q| (q - turns(*q)).abs() < 1e-6), "{found:?}");
    }
}

/// The elbow bends by at least 1 rad and the wrist is straight: the arm reaches the distance of the law of cosines at most.
#[test]
fn limits_are_respected() {
    let arm = planar();
    let free = [f64::NEG_INFINITY, f64::INFINITY];
    let limits = arm.solver.limits_within(&[free, [1.0, 2.0], [0.0, 0.5]]).unwrap();
    let radius = (0.5f64.powi(2) + 0.55f64.powi(2) + 2.0 * 0.5 * 0.55 * 1f64.cos()).sqrt();
    for x in [radius + 0.01, 1.0, 3.0] {
        let target = arm.solver.target(Target::PlanarPosition([0.0, x])).unwrap();
        let found = arm.solver.closest(&target, &limits, &ErrorWeights::default()).unwrap();
        assert!(!found.reachable && found.is_minimum, "{found:?}");
        assert!((found.distance - (x - radius)).abs() < 1e-9, "{x} {radius}: {found:?}");
        assert!((found.q[1] - 1.0).abs() < 1e-9 && found.q[2].abs() < 1e-6, "{found:?}");
    }
}

/// The error of joint values by forward kinematics.
fn error(chain: &Chain, q: &[f64], goal: &Pose, length: f64) -> f64 {
    let reached = chain.forward(q).unwrap();
    let chord = 2.0 * length * (0.5 * reached.rotation.angle_to(&goal.rotation)).sin();
    (reached.translation.vector - goal.translation.vector).norm_squared() + chord * chord
}

#[test]
fn a_reachable_pose_has_a_solution_within_limits() {
    let (arm, mut between) = (panda(), random());
    for _ in 0..10 {
        let q: Vec<f64> =
            arm.chain.joints().iter().map(|joint| joint.limits.map_or(0.0, |(low, high)| between(low, high))).collect();
        let (pose, target) = arm.target(&q);
        let found = arm.solver.closest(&target, &arm.solver.limits(), &ErrorWeights::default()).unwrap();
        assert!(found.reachable && found.distance < 1e-9 && found.angle < 1e-7, "{found:?}");
        arm.assert_solves(&pose, &found.q);
    }
}

/// No search from random joint vectors within limits, which moves them by random steps that shrink, finds a smaller error.
#[test]
fn no_random_search_of_a_panda_finds_a_smaller_error() {
    let (arm, mut between) = (panda(), random());
    let limits: Vec<(f64, f64)> = arm.chain.joints().iter().map(|joint| joint.limits.unwrap()).collect();
    for (offset, length) in [(Vector3::new(0.8, 0.1, 0.3), 0.5), (Vector3::new(-0.2, 0.9, -0.4), 0.2)] {
        let mut pose = arm.chain.forward(&READY).unwrap();
        pose.translation = Translation3::from(pose.translation.vector + offset);
        let target = arm.solver.target(pose).unwrap();
        let found = arm.solver.closest(&target, &arm.solver.limits(), &ErrorWeights::default().length(length)).unwrap();
        assert!(!found.reachable && found.is_minimum, "{found:?}");
        let own = error(&arm.chain, &found.q, &pose, length);
        assert!((own - (found.distance.powi(2) + (2.0 * length * (0.5 * found.angle).sin()).powi(2))).abs() < 1e-9);
        assert!(found.q.iter().zip(&limits).all(|(q, (low, high))| (*low..=*high).contains(q)), "{found:?}");
        let mut best = f64::INFINITY;
        for _ in 0..10 {
            let mut q: Vec<f64> = limits.iter().map(|(low, high)| between(*low, *high)).collect();
            let (mut value, mut width) = (error(&arm.chain, &q, &pose, length), 1.0);
            while width > 1e-4 {
                let mut is_better = false;
                for _ in 0..30 {
                    let next: Vec<f64> = q
                        .iter()
                        .zip(&limits)
                        .map(|(q, (low, high))| (q + between(-width, width)).clamp(*low, *high))
                        .collect();
                    let moved = error(&arm.chain, &next, &pose, length);
                    if moved < value {
                        (q, value, is_better) = (next, moved, true);
                    }
                }
                if !is_better {
                    width *= 0.5;
                }
            }
            best = best.min(value);
        }
        assert!(own <= best + 1e-9, "{own} {best}");
    }
}

/// A Panda on a rail: the rail is at its end towards a far target.
#[test]
fn scanned_joints_move_too() {
    let arm = redundant_scanned::arm();
    let near = arm.pose(&redundant_scanned::READY);
    let target = arm.solver.target(near).unwrap();
    let found = arm.solver.closest(&target, None, &ErrorWeights::default()).unwrap();
    assert!(found.reachable, "{found:?}");
    arm.assert_solves(&near, &found.q);
    let rail = |value: f64| arm.pose(&[&[value], &redundant_scanned::READY[1..]].concat()).translation.vector;
    let along = rail(1.0) - rail(0.0);
    let mut far = near;
    far.translation.vector += 5.0 * along;
    let found =
        arm.solver.closest(&arm.solver.target(far).unwrap(), None, &ErrorWeights::default().length(0.01)).unwrap();
    assert!(!found.reachable && (found.q[0] - 1.0).abs() < 1e-9, "{found:?}");
    // The ready pose with the rail at its end is farther.
    assert!(found.distance < (far.translation.vector - rail(1.0)).norm(), "{found:?}");
    let reached = arm.pose(&found.q);
    assert!(((reached.translation.vector - far.translation.vector).norm() - found.distance).abs() < 1e-9, "{found:?}");
    let mut limits = arm.solver.limits();
    limits[0] = [-0.2, 0.3];
    let found = arm.solver.closest(&arm.solver.target(far).unwrap(), Some(&limits), &ErrorWeights::default()).unwrap();
    assert!(!found.reachable && (found.q[0] - 0.3).abs() < 1e-9, "{found:?}");
}

#[test]
fn a_length_must_be_positive() {
    let arm = panda();
    let (_, target) = arm.target(&READY);
    for length in [0.0, -1.0, f64::NAN] {
        let weights = ErrorWeights::default().length(length);
        let refused = arm.solver.closest(&target, &arm.solver.limits(), &weights).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::BadValue);
    }
}
