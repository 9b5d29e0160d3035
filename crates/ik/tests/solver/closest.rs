//! The closest joint values: analytic for stretched arms, against a search from many random points, and against `solve` for reachable targets.

use std::path::Path;

use groebot_ik::ErrorKind;
use groebot_ik::folder;
use groebot_ik::solver::{ClosestOptions, Placement, Program, Solver};
use groebot_robot::kinematics::{Target, Task};
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};

use crate::codegen::random;

fn program(name: &str) -> Program {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    folder::program(&root.join(name)).unwrap()
}

/// The numbers of a target.
fn values(target: &Target) -> Vec<f64> {
    let task = Task::all().into_iter().find(|task| target.is_of(*task)).unwrap();
    task.layout().values(target).unwrap()
}

fn pose(between: &mut impl FnMut(f64, f64) -> f64, size: f64) -> Pose {
    let [x, y, z] = std::array::from_fn(|_| between(-size, size));
    let [roll, pitch, yaw] = std::array::from_fn(|_| between(-3.0, 3.0));
    Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}

#[test]
fn a_planar_arm_stretches_towards_a_target_out_of_reach() {
    let solver = program("planar_2r").solver();
    let reach = 0.9;
    let mut between = random();
    for _ in 0..20 {
        let (angle, radius) = (between(-3.1, 3.1), between(reach + 0.01, 5.0));
        let target = Target::PlanarPosition([radius * angle.cos(), radius * angle.sin()]);
        assert!(solver.solve(target).unwrap().is_empty());
        let found = solver.closest(target).unwrap();
        assert!(!found.reachable && found.is_minimum, "{found:?}");
        assert!((found.distance - (radius - reach)).abs() < 1e-12 && found.angle == 0.0, "{found:?}");
        assert!((found.q[0] - angle).abs() < 1e-7 && found.q[1].abs() < 1e-7, "{angle}: {found:?}");
        let Target::PlanarPosition(at) = found.reached else { panic!() };
        assert!((at[0] - reach * angle.cos()).hypot(at[1] - reach * angle.sin()) < 1e-7, "{at:?}");
        assert!(found.agreeing > 0 && found.agreeing <= found.starts, "{found:?}");
    }
}

/// Inside the hole of an arm with links of 0.5 and 0.4 the closest point is on the inner circle.
#[test]
fn a_target_inside_the_hole_has_the_folded_arm() {
    let solver = program("planar_2r").solver();
    let found = solver.closest(Target::PlanarPosition([0.03, 0.04])).unwrap();
    assert!((found.distance - 0.05).abs() < 1e-12 && !found.reachable && found.is_minimum, "{found:?}");
    assert!((found.q[1].abs() - std::f64::consts::PI).abs() < 1e-7, "{found:?}");
}

/// The wrist of PUMA is spherical: for a far target the angle is not missed where the length weighs rotation little, and the wrist is as far out as it can be.
#[test]
fn a_spherical_wrist_keeps_the_orientation_when_rotation_weighs_much() {
    let solver = program("spherical_wrist").solver();
    let mut between = random();
    for _ in 0..4 {
        let target = pose(&mut between, 1.0);
        let far = Pose::from_parts(Translation3::from(target.translation.vector.normalize() * 4.0), target.rotation);
        let found = solver.closest_by(far, &ClosestOptions::default().length(1e4)).unwrap();
        assert!(found.angle < 1e-4 && !found.reachable && found.is_minimum, "{found:?}");
        // The reachable distance along the ray, found by bisection with the orientation kept, is an upper bound of the error.
        let along = |share: f64| Pose::from_parts(Translation3::from(far.translation.vector * share), far.rotation);
        let (mut low, mut high) = (0.0, 1.0);
        if let Some(start) =
            (1..40).map(|k| f64::from(k) / 40.0).rev().find(|s| !solver.solve(along(*s)).unwrap().is_empty())
        {
            (low, high) = (start, start + 1.0 / 40.0);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if solver.solve(along(middle)).unwrap().is_empty() { high = middle } else { low = middle }
            }
        }
        assert!(found.distance <= 4.0 * (1.0 - low) + 1e-6, "{} {low} {high}", found.distance);
    }
}

/// Minimum of the same error by a coordinate-free search: random points, each improved by random steps that shrink.
fn searched(solver: &Solver, target: &Target, length: f64, between: &mut impl FnMut(f64, f64) -> f64) -> f64 {
    let goal = values(target);
    let error = |q: &[f64]| {
        let own = solver.reached(q).unwrap();
        let squares = |range: std::ops::Range<usize>| range.map(|i| (own[i] - goal[i]).powi(2)).sum::<f64>();
        squares(0..3) + 0.5 * length * length * squares(3..12)
    };
    let joints = 6;
    let mut best = f64::INFINITY;
    for _ in 0..30 {
        let mut q: Vec<f64> = (0..joints).map(|_| between(-3.1, 3.1)).collect();
        let (mut value, mut width) = (error(&q), 1.0);
        while width > 1e-7 {
            let mut improved = false;
            for _ in 0..40 {
                let next: Vec<f64> = q.iter().map(|own| own + between(-width, width)).collect();
                let moved = error(&next);
                if moved < value {
                    (q, value, improved) = (next, moved, true);
                }
            }
            if !improved {
                width *= 0.5;
            }
        }
        best = best.min(value);
    }
    best
}

#[test]
fn no_random_search_finds_a_smaller_error() {
    for name in ["puma", "ur5"] {
        let solver = program(name).solver();
        let mut between = random();
        let mut seen = 0;
        for _ in 0..6 {
            let target = Target::Pose(pose(&mut between, 2.5));
            if !solver.solve(target).unwrap().is_empty() {
                continue;
            }
            let found = solver.closest_by(target, &ClosestOptions::default().length(0.7)).unwrap();
            let own = found.distance.powi(2) + (2.0 * 0.7 * (0.5 * found.angle).sin()).powi(2);
            let other = searched(&solver, &target, 0.7, &mut between);
            assert!(own <= other * (1.0 + 1e-9) + 1e-12, "{name}: {own} {other} {found:?}");
            assert!(found.is_minimum, "{name}: {found:?}");
            seen += 1;
        }
        assert!(seen > 3, "{name}: {seen}");
    }
}

#[test]
fn a_reachable_target_has_one_of_its_solutions() {
    for (name, joints) in [("puma", 6), ("ur5", 6), ("nao_left_arm", 5), ("polar", 3)] {
        let solver = program(name).solver();
        let mut between = random();
        for _ in 0..10 {
            let q: Vec<f64> = (0..joints).map(|_| between(-1.5, 1.5)).collect();
            let target = solver.reached(&q).unwrap();
            let found = solver.closest_numbers(&target, &ClosestOptions::default()).unwrap();
            assert!(found.reachable && found.is_minimum, "{name}: {found:?}");
            assert!(found.distance < 1e-12 && found.angle < 1e-12, "{name}: {found:?}");
            let solutions = solver.solve_numbers(&target).unwrap();
            assert!(solutions.iter().any(|one| one.q == found.q), "{name}: {found:?}");
        }
    }
}

#[test]
fn the_same_target_has_the_same_closest_joints() {
    let (solver, target) = (program("puma").solver(), pose(&mut random(), 4.0));
    assert_eq!(solver.closest(target).unwrap(), solver.closest(target).unwrap());
}

#[test]
fn limits_are_respected_on_request() {
    let solver = program("planar_2r").solver();
    let limits = [[-0.5, 0.5], [-0.2, 2.0]];
    // Straight up: the first joint is at its limit, and the second is where the tip is nearest.
    let target = [0.0, 3.0];
    let found = solver.closest_numbers(&target, &ClosestOptions::default().limits(&limits)).unwrap();
    assert!(!found.reachable && found.is_minimum, "{found:?}");
    assert!((found.q[0] - 0.5).abs() < 1e-12, "{found:?}");
    let elbow = [0.5 * 0.5_f64.cos(), 0.5 * 0.5_f64.sin()];
    let towards = (target[1] - elbow[1]).atan2(target[0] - elbow[0]);
    assert!((found.q[1] - (towards - 0.5)).abs() < 1e-7, "{found:?} {towards}");
    // A reachable target within the limits only by the other elbow, and one that no solution has within.
    let reached = solver.reached(&[0.3, 1.0]).unwrap();
    let found = solver.closest_numbers(&reached, &ClosestOptions::default().limits(&limits)).unwrap();
    assert!(found.reachable && (found.q[0] - 0.3).abs() < 1e-9, "{found:?}");
    let beyond = solver.reached(&[2.0, 0.5]).unwrap();
    let found = solver.closest_numbers(&beyond, &ClosestOptions::default().limits(&limits)).unwrap();
    assert!(!found.reachable && found.distance > 0.1, "{found:?}");
    assert!(found.q.iter().zip(&limits).all(|(q, [low, high])| low <= q && q <= high), "{found:?}");
}

/// The axis of a head of two joints reaches a part of the sphere; a ray of five joints, a rotation of two.
#[test]
fn other_tasks_have_closest_joints_too() {
    for (name, target) in [
        ("nao_head", Target::Direction(Vector3::new(0.6, 0.0, 0.8))),
        ("nao_left_arm", Target::Ray { point: Point3::new(1.0, 0.5, 0.2), direction: Vector3::new(0.6, 0.0, -0.8) }),
        ("polar", Target::Position(Point3::new(9.0, 1.0, 2.0))),
        ("prr", Target::PlanarPose([40.0, 60.0, 0.3])),
        ("scara_yaw", Target::PositionYaw { point: Point3::new(5.0, 1.0, 0.2), yaw: 0.3 }),
    ] {
        let solver = program(name).solver();
        let found = solver.closest(target).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(found.is_minimum, "{name}: {found:?}");
        let (distance, angle) = {
            let (own, goal) = (values(&found.reached), values(&target));
            let lengths = if matches!(target, Target::Direction(_)) { 0 } else { 2.max(goal.len().min(3)) };
            let lengths = if matches!(target, Target::PlanarPose(_)) { 2 } else { lengths };
            let distance = (0..lengths).map(|i| (own[i] - goal[i]).powi(2)).sum::<f64>().sqrt();
            let angle = match (found.reached, target) {
                (Target::Direction(a), Target::Direction(b))
                | (Target::Ray { direction: a, .. }, Target::Ray { direction: b, .. }) => a.angle(&b),
                _ => found.angle,
            };
            (distance, angle)
        };
        assert!((found.distance - distance).abs() < 1e-9, "{name}: {distance} {found:?}");
        assert!((found.angle - angle).abs() < 1e-7, "{name}: {angle} {found:?}");
        assert_eq!(found.reachable, !solver.solve(target).unwrap().is_empty(), "{name}");
    }
}

#[test]
fn given_joints_keep_their_values() {
    let solver = program("iiwa14").solver();
    let target = pose(&mut random(), 4.0);
    let found = solver.closest_by(target, &ClosestOptions::default().given(&[0.4])).unwrap();
    assert!(!found.reachable && found.q[2] == 0.4 && found.is_minimum, "{found:?}");
}

/// With a tool the error is that of the tool: the same as of a target in the world, and less than that of the tip's closest joints.
#[test]
fn the_closest_pose_of_a_tool_is_that_of_the_tool() {
    let solver = program("puma").solver();
    let mut between = random();
    let placement = Placement::default().base(pose(&mut between, 1.0)).tool(pose(&mut between, 0.4));
    let placed = solver.placed(&placement).unwrap();
    let far = pose(&mut between, 5.0);
    let found = placed.closest(far).unwrap();
    let numbers = placed.reached(&found.q).unwrap();
    let distance = (0..3).map(|i| (numbers[i] - values(&Target::Pose(far))[i]).powi(2)).sum::<f64>().sqrt();
    assert!((distance - found.distance).abs() < 1e-9 && found.is_minimum, "{distance} {found:?}");
    let Target::Pose(reached) = found.reached else { panic!() };
    assert!((reached.rotation.angle_to(&far.rotation) - found.angle).abs() < 1e-7, "{found:?}");
    let of_tip = solver.closest_numbers(&placed.base_from_tip(&values(&Target::Pose(far))), &ClosestOptions::default());
    let numbers = placed.reached(&of_tip.unwrap().q).unwrap();
    let Ok(Target::Pose(other)) = Task::Pose.layout().target(&numbers) else { panic!() };
    let error = |pose: &Pose| {
        let chord = 2.0 * solver_scale() * (0.5 * pose.rotation.angle_to(&far.rotation)).sin();
        (pose.translation.vector - far.translation.vector).norm_squared() + chord * chord
    };
    assert!(error(&reached) <= error(&other) + 1e-9, "{} {}", error(&reached), error(&other));
}

fn solver_scale() -> f64 {
    program("puma").scale
}

#[test]
fn wrong_options_and_other_programs_are_refused_by_kind() {
    let solver = program("puma").solver();
    let target = pose(&mut random(), 1.0);
    let kind = |options: &ClosestOptions| solver.closest_by(target, options).unwrap_err().kind();
    assert_eq!(kind(&ClosestOptions::default().length(0.0)), ErrorKind::BadValue);
    assert_eq!(kind(&ClosestOptions::default().length(f64::NAN)), ErrorKind::BadValue);
    assert_eq!(kind(&ClosestOptions::default().limits(&[[0.0, 1.0]])), ErrorKind::BadValue);
    assert_eq!(kind(&ClosestOptions::default().limits(&[[1.0, 0.0]; 6])), ErrorKind::BadValue);
    assert_eq!(kind(&ClosestOptions::default().given(&[1.0])), ErrorKind::BadValue);
    let upright = Target::PositionPitchRoll { point: Point3::new(5.0, 1.0, 2.0), pitch: 0.3, roll: 0.2 };
    let error = program("upright_arm").solver().closest(upright).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    let legs = program("nao_legs").solver();
    let (numbers, q) = (program("nao_legs").inputs.len(), program("nao_legs").joints.len());
    let target = legs.reached(&vec![0.1; q]).unwrap_or_else(|| vec![0.1; numbers]);
    assert_eq!(legs.closest_numbers(&target, &ClosestOptions::default()).unwrap_err().kind(), ErrorKind::Unsupported);
}
