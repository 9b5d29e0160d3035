//! Paths along poses: continuous if possible, otherwise with a report of the places and causes of jumps.

use std::f64::consts::PI;
use std::sync::LazyLock;

use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{Chain, ChainParts, InverseKinematics, Task, along_z};
use groebot_robot::motion::{Followed, Pace, PathRequest, follow};
use groebot_robot::robots;
use groebot_robot::spatial::Pose;
use groebot_robot::{ErrorKind, Watch};

static SOLVER: LazyLock<Derivation> = LazyLock::new(|| groebot_ik::derive(&robots::ur5()).unwrap());

/// UR5 with equal limits for all joints.
fn ur5(limits: Option<(f64, f64)>) -> Chain {
    let mut parts: ChainParts = robots::ur5().into();
    parts.joints.iter_mut().for_each(|joint| joint.limits = limits);
    Chain::new(parts).unwrap()
}

/// The tip's poses along joint values.
fn poses(chain: &Chain, path: impl Fn(f64) -> [f64; 6], count: usize) -> Vec<Pose> {
    (0..count).map(|k| chain.forward(&path(k as f64 / (count - 1) as f64)).unwrap()).collect()
}

fn followed(chain: &Chain, poses: &[Pose], solver: &dyn InverseKinematics) -> groebot_robot::Result<Followed> {
    follow(chain, solver, &PathRequest::new(poses, &Pace::Every(0.1)), &Watch::none())
}

/// Checks that every pose is reached within the limits.
fn is_along(chain: &Chain, poses: &[Pose], found: &Followed) {
    for (pose, q) in poses.iter().zip(&found.trajectory.q) {
        let off = (chain.forward(q).unwrap().to_homogeneous() - pose.to_homogeneous()).amax();
        assert!(off < 1e-9, "{off}");
        for (joint, value) in chain.joints().iter().zip(q) {
            assert!(joint.limits.is_none_or(|(low, high)| low <= *value && *value <= high), "{}: {value}", joint.name);
        }
    }
}

fn swing(share: f64) -> [f64; 6] {
    let s = (PI * share).sin();
    [0.8 * share, -1.2 + 0.5 * s, 1.4 - 0.6 * share, -0.5 + s, 1.0 + 0.4 * s, -0.7 + share]
}

#[test]
fn a_smooth_path_is_followed_without_a_jump() {
    let chain = ur5(Some((-PI, PI)));
    let poses = poses(&chain, swing, 40);
    let screws = ScrewSolver::new(&chain).unwrap();
    let solvers: [&dyn InverseKinematics; 2] = [SOLVER.program(), &screws];
    for solver in solvers {
        let found = followed(&chain, &poses, solver).unwrap();
        assert!(found.jumps.is_empty(), "{:?}", found.jumps);
        is_along(&chain, &poses, &found);
        let length = |q: &[Vec<f64>]| -> f64 {
            q.windows(2).map(|pair| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).powi(2)).sum::<f64>()).sum()
        };
        let known: Vec<Vec<f64>> = (0..40).map(|k| swing(k as f64 / 39.0).to_vec()).collect();
        assert!(
            length(&found.trajectory.q) <= length(&known) + 1e-9,
            "the shortest, at most as long as the one that is known"
        );
    }
}

/// The base rotates by 1.5 turns. It continues within limits of two turns and without limits, and moves back by a full turn within limits of one turn.
#[test]
fn turns_go_on_where_limits_let_them() {
    let turning = |share: f64| [-0.6 + 3.0 * PI * share, -1.2, 1.4, -0.5, 1.0, -0.7];
    let wide = ur5(Some((-3.0 * PI, 3.0 * PI)));
    let targets = poses(&wide, turning, 60);
    for chain in [wide, ur5(None)] {
        let found = followed(&chain, &targets, SOLVER.program()).unwrap();
        assert!(found.jumps.is_empty(), "{:?}", found.jumps);
        is_along(&chain, &targets, &found);
        let turned = found.trajectory.q[59][0] - found.trajectory.q[0][0];
        assert!((turned.abs() - 3.0 * PI).abs() < 1e-9, "{turned}");
    }
    let narrow = ur5(Some((-PI, PI)));
    let found = followed(&narrow, &targets, SOLVER.program()).unwrap();
    is_along(&narrow, &targets, &found);
    assert_eq!(found.jumps.len(), 1, "{:?}", found.jumps);
    let jump = &found.jumps[0];
    assert!(jump.step.abs() > 0.5 && jump.why.contains("would leave its limits"), "{jump:?}");
}

#[test]
fn a_step_that_is_too_fast_for_its_time_is_a_jump() {
    let chain = ur5(Some((-PI, PI)));
    let poses = poses(&chain, swing, 10);
    let speeds = vec![Some(1.0); 6];
    let at = |time| {
        let pace = Pace::Every(time);
        let request = PathRequest::new(&poses, &pace).speeds(&speeds);
        follow(&chain, SOLVER.program(), &request, &Watch::none()).unwrap()
    };
    assert!(at(1.0).jumps.is_empty());
    let hasty = at(0.05);
    assert!(
        !hasty.jumps.is_empty() && hasty.jumps[0].why.contains("would exceed its maximum velocity"),
        "{:?}",
        hasty.jumps
    );
    assert_eq!(hasty.trajectory.joints[0].speed, Some(1.0));
    assert_eq!(hasty.trajectory.times[9], 0.45);
}

#[test]
fn poses_that_cannot_be_followed_are_refused_with_their_number() {
    let chain = ur5(Some((-PI, PI)));
    let mut far = poses(&chain, swing, 5);
    far[3].translation.x = 5.0;
    let refused = |error: groebot_robot::Error, kind, words: &str| {
        assert!(error.kind() == kind && error.to_string().contains(words), "{error}");
    };
    refused(followed(&chain, &far, SOLVER.program()).unwrap_err(), ErrorKind::BadValue, "pose 4: it is out of reach");
    let tight = ur5(Some((0.0, 0.01)));
    let some = poses(&chain, swing, 2);
    refused(followed(&tight, &some, SOLVER.program()).unwrap_err(), ErrorKind::BadValue, "beyond the limits");
    refused(followed(&chain, &[], SOLVER.program()).unwrap_err(), ErrorKind::BadValue, "no pose");
    let pace = Pace::At(vec![0.0]);
    refused(
        follow(&chain, SOLVER.program(), &PathRequest::new(&some, &pace), &Watch::none()).unwrap_err(),
        ErrorKind::BadValue,
        "1 times for 2",
    );
    let pace = Pace::At(vec![0.1, 0.1]);
    refused(
        follow(&chain, SOLVER.program(), &PathRequest::new(&some, &pace), &Watch::none()).unwrap_err(),
        ErrorKind::BadValue,
        "give increasing times",
    );
    let position = chain.with_task(Task::Position, along_z(), Vec::new()).unwrap();
    refused(followed(&position, &some, SOLVER.program()).unwrap_err(), ErrorKind::Unsupported, "followed by `pose`");
}

#[test]
fn a_path_begins_where_the_arm_stands_or_jumps_there() {
    let chain = ur5(None);
    let poses = poses(&chain, swing, 40);
    let from = |start: &[f64]| {
        let (pace, watch) = (Pace::Every(0.1), Watch::none());
        follow(&chain, SOLVER.program(), &PathRequest::new(&poses, &pace).start(start), &watch)
    };
    let mut start = swing(0.0);
    start[5] += 2.0 * PI;
    let found = from(&start).unwrap();
    assert!(found.jumps.is_empty(), "{:?}", found.jumps);
    assert!(found.trajectory.q[0].iter().zip(&start).all(|(q, start)| (q - start).abs() < 1e-9), "turns are kept");
    let mut away = swing(0.0);
    away[0] += 2.0;
    let found = from(&away).unwrap();
    assert_eq!((found.jumps[0].sample, found.jumps.len()), (0, 1), "{:?}", found.jumps);
    is_along(&chain, &poses, &found);
    assert_eq!(from(&away[..5]).unwrap_err().kind(), ErrorKind::BadValue);
}

/// A path that passes a singular wrist, or begins, stays or ends there, continues along the self-motions.
#[test]
fn a_path_through_a_singular_wrist_has_no_jump() {
    let starts: [[f64; 6]; 3] =
        [[0.3, -1.2, 1.4, 0.4, 0.0, -2.2], [-2.0, -0.7, 1.1, 2.5, 0.0, 1.9], [1.0, -2.1, -1.3, -2.8, 0.0, 0.6]];
    for limits in [None, Some((-PI, PI)), Some((-2.0 * PI, 2.0 * PI))] {
        let chain = ur5(limits);
        for start in starts {
            for bend in [[-0.5, 0.5], [0.0, 0.5], [-0.5, 0.0], [0.0, 0.0]] {
                let along = |share: f64| {
                    let mut q: [f64; 6] =
                        std::array::from_fn(|i| start[i] + 0.3 * share * [1.0, -0.5, 0.7, 0.4, 0.0, -0.9][i]);
                    q[4] = bend[0] + (bend[1] - bend[0]) * share;
                    q
                };
                let targets = poses(&chain, along, 11);
                let found = followed(&chain, &targets, SOLVER.program()).unwrap();
                assert!(found.jumps.is_empty(), "{limits:?} {start:?} {bend:?}: {:?}", found.jumps);
                is_along(&chain, &targets, &found);
                let (pace, first) = (Pace::Every(0.1), along(0.0));
                let request = PathRequest::new(&targets, &pace).start(&first);
                let found = follow(&chain, SOLVER.program(), &request, &Watch::none()).unwrap();
                assert!(found.jumps.is_empty(), "{limits:?} {start:?} {bend:?} from its start: {:?}", found.jumps);
                for (k, q) in found.trajectory.q.iter().enumerate() {
                    let own = along(k as f64 / 10.0);
                    let most = q.iter().zip(own).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(most < 0.5, "{limits:?} {start:?} {bend:?} at {k}: {q:?} {own:?}");
                }
            }
        }
    }
}
