//! Base and tool at run time, against forward kinematics of the base frame and products of isometries.

use std::path::Path;

use groebot_ik::ErrorKind;
use groebot_ik::folder;
use groebot_ik::solver::{Placement, Program, Solver};
use groebot_robot::kinematics::{InverseKinematics, Target, Task};
use groebot_robot::spatial::Pose;
use nalgebra::{Translation3, UnitQuaternion, Vector3};

use crate::codegen::random;

fn program(name: &str) -> Program {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations");
    folder::program(&root.join(name)).unwrap()
}

fn pose(between: &mut impl FnMut(f64, f64) -> f64) -> Pose {
    let [x, y, z, roll, pitch, yaw] = std::array::from_fn(|_| between(-1.5, 1.5));
    Pose::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}

fn pose_of(numbers: &[f64]) -> Pose {
    let Ok(Target::Pose(pose)) = Task::Pose.layout().target(numbers) else { panic!("{numbers:?}") };
    pose
}

fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
}

#[test]
fn a_placed_pose_has_the_solutions_of_the_pose_in_the_base_frame() {
    let solver = program("ur5").solver();
    let mut between = random();
    for _ in 0..50 {
        let q: Vec<f64> = (0..6).map(|_| between(-3.0, 3.0)).collect();
        let (base, tool) = (pose(&mut between), pose(&mut between));
        let placed = solver.placed(&Placement::default().base(base).tool(tool)).unwrap();
        let base_from_tip = pose_of(&solver.reached(&q).unwrap());
        let world_from_tool = base * base_from_tip * tool;
        let found = placed.solve(world_from_tool).unwrap();
        assert!(found.iter().any(|one| farthest(&one.q, &q) < 1e-9), "{q:?}: {found:?}");
        for one in &found {
            let reached = Task::Pose.layout().values(&Target::Pose(world_from_tool)).unwrap();
            assert!(farthest(&placed.reached(&one.q).unwrap(), &reached) < 1e-12 * 10.0, "{q:?}");
        }
        let mut through_trait = Vec::new();
        InverseKinematics::solve(&placed, &Target::Pose(world_from_tool), &[], &mut through_trait).unwrap();
        assert_eq!(through_trait, found);
    }
}

#[test]
fn a_placed_batch_and_limits_agree_with_single_targets_to_the_last_bit() {
    let solver = program("puma").solver();
    let mut between = random();
    let placement = Placement::default().base(pose(&mut between)).tool(pose(&mut between));
    let placed = solver.placed(&placement).unwrap();
    let targets: Vec<Vec<f64>> =
        (0..70).map(|_| placed.reached(&[(); 6].map(|()| between(-2.0, 2.0))).unwrap()).collect();
    let batch = placed.solve_batch(&targets.concat()).unwrap();
    assert_eq!(batch.targets(), targets.len());
    for (index, target) in targets.iter().enumerate() {
        let single = placed.solve_numbers(target).unwrap();
        assert!(!single.is_empty());
        let rows: Vec<Vec<f64>> =
            batch.of_target(index).map(|row| (0..6).map(|joint| batch.joint(joint)[row]).collect()).collect();
        assert_eq!(rows, single.iter().map(|one| one.q.clone()).collect::<Vec<_>>());
        assert_eq!(placed.solve_within(target, &[[-4.0, 4.0]; 6]).unwrap(), single);
        assert_eq!(placed.solve_pairs(target).unwrap().len(), single.len());
        assert_eq!(solver.solve_numbers(&placed.base_from_tip(target)).unwrap(), single);
    }
    assert_eq!(placed.solve_batch(&[0.0; 13]).unwrap_err().kind(), ErrorKind::BadValue);
    assert_eq!(placed.solve_numbers(&[0.0; 3]).unwrap_err().kind(), ErrorKind::BadValue);
}

#[test]
fn the_default_placement_changes_nothing() {
    let solver = program("puma").solver();
    let target = solver.reached(&[0.3, -0.4, 0.5, 0.6, -0.7, 0.8]).unwrap();
    let placed = solver.placed(&Placement::default()).unwrap();
    assert_eq!(placed.solve_numbers(&target).unwrap(), solver.solve_numbers(&target).unwrap());
}

/// What joints reach as the task's numbers, seen from the world, is found again.
fn come_back(solver: &Solver, placement: &Placement, joints: usize, expected: impl Fn(&[f64], &mut [f64])) {
    let placed = solver.placed(placement).unwrap();
    let mut between = random();
    for _ in 0..20 {
        let q: Vec<f64> = (0..joints).map(|_| between(-1.2, 1.2)).collect();
        let own = solver.reached(&q).unwrap();
        let mut seen = own.clone();
        expected(&own, &mut seen);
        assert!(farthest(&placed.reached(&q).unwrap(), &seen) < 1e-13, "{own:?}: {seen:?}");
        let found = placed.solve_numbers(&seen).unwrap();
        assert!(found.iter().any(|one| farthest(&one.q, &q) < 1e-7), "{q:?}: {found:?}");
    }
}

fn turned(axis: Vector3<f64>, angle: f64, at: [f64; 3]) -> Pose {
    Pose::from_parts(at.into(), UnitQuaternion::from_scaled_axis(axis * angle))
}

fn vector(numbers: &[f64]) -> Vector3<f64> {
    Vector3::from_row_slice(numbers)
}

#[test]
fn positions_and_rays_have_any_base() {
    let base = turned(Vector3::new(0.6, 0.0, 0.8), 0.7, [0.2, -0.3, 0.4]);
    let on_base = |own: &[f64]| base.rotation * vector(own) + base.translation.vector;
    let placement = Placement::default().base(base);
    come_back(&program("polar").solver(), &placement, 3, |own, seen| seen.copy_from_slice(on_base(own).as_slice()));
    come_back(&program("nao_left_arm").solver(), &placement, 5, |own, seen| {
        seen[..3].copy_from_slice(on_base(&own[..3]).as_slice());
        seen[3..].copy_from_slice((base.rotation * vector(&own[3..])).as_slice());
    });
    come_back(&program("nao_head").solver(), &placement, 2, |own, seen| {
        seen.copy_from_slice((base.rotation * vector(own)).as_slice());
    });
}

#[test]
fn a_rotation_has_any_base_and_any_tool() {
    let (base, tool) = (turned(Vector3::x(), 0.7, [1.0, 2.0, 3.0]), turned(Vector3::y(), -0.4, [3.0, 2.0, 1.0]));
    come_back(&program("wrist_rotation").solver(), &Placement::default().base(base).tool(tool), 3, |own, seen| {
        let Ok(Target::Rotation(rotation)) = Task::Rotation.layout().target(own) else { panic!() };
        let seen_rotation = Target::Rotation(base.rotation * rotation * tool.rotation);
        seen.copy_from_slice(&Task::Rotation.layout().values(&seen_rotation).unwrap());
    });
}

#[test]
fn planar_tasks_have_a_base_that_keeps_the_plane() {
    let base = turned(Vector3::y(), 0.4, [0.1, 5.0, -0.2]);
    let placed = |own: &[f64]| base.rotation * Vector3::new(own[0], 0.0, own[1]) + base.translation.vector;
    come_back(&program("prr").solver(), &Placement::default().base(base), 3, |own, seen| {
        let point = placed(own);
        seen.copy_from_slice(&[point.x, point.z, own[2] + 0.4]);
    });
    let solver = program("prr").solver();
    let tilted = Placement::default().base(turned(Vector3::x(), 0.1, [0.0; 3]));
    let error = solver.placed(&tilted).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.to_string().contains("the base may only rotate about y"), "{error}");
}

#[test]
fn a_tool_that_a_task_does_not_determine_is_refused() {
    let moved = Placement::default().tool(turned(Vector3::x(), 0.0, [0.1, 0.0, 0.0]));
    let rotated = Placement::default().tool(turned(Vector3::x(), 0.1, [0.0; 3]));
    for (name, placement, is_refused) in [
        ("polar", &moved, true),
        ("polar", &rotated, false),
        ("nao_left_arm", &moved, true),
        ("nao_left_arm", &rotated, true),
        ("nao_head", &moved, false),
        ("nao_head", &rotated, true),
        ("prr", &rotated, true),
        ("wrist_rotation", &rotated, false),
        ("upright_arm", &moved, true),
    ] {
        let solver = program(name).solver();
        let kind = solver.placed(placement).err().map(|error| error.kind());
        assert_eq!(kind, is_refused.then_some(ErrorKind::Unsupported), "{name}");
    }
    let legs = program("nao_legs").solver();
    assert_eq!(legs.placed(&Placement::default()).unwrap_err().kind(), ErrorKind::Unsupported);
}
