//! Tests of the equations: each task's derivatives, direction and curvature against differences.

use super::arm::{Arm, MOST_JOINTS, Q, Target, Task};
use super::model::{Model, norm, plus};
use crate::six_axes::vector::dot;
use crate::six_axes::{Rigid, Vector};

/// Unit vectors in any directions.
const DIRECTIONS: [Vector; MOST_JOINTS] = [
    [0.6, 0.0, 0.8],
    [0.48, 0.6, 0.64],
    [0.0, -0.28, 0.96],
    [0.8, 0.36, -0.48],
    [-0.6, 0.64, 0.48],
    [0.0, 1.0, 0.0],
    [0.36, 0.48, 0.8],
];

fn arm(task: Task, sliding: usize) -> Arm {
    let mut arm = Arm {
        count: task.equations() + 1,
        directions: DIRECTIONS,
        task,
        length: 0.7,
        tip: Rigid { rotation: [[0.0, -1.0, 0.0], [0.6, 0.0, -0.8], [0.8, 0.0, 0.6]], translation: [0.3, -0.2, 1.4] },
        ..Arm::NONE
    };
    for i in 0..MOST_JOINTS {
        let step = i as f64;
        arm.points[i] = [0.1 * step, 0.05 * step * step - 0.1, 0.2 * step];
    }
    if sliding < MOST_JOINTS {
        arm.slides[sliding] = true;
    }
    arm
}

/// A planar arm: all axes along one coordinate.
fn planar(coordinates: [usize; 2], task: Task) -> Arm {
    let mut arm = arm(task, MOST_JOINTS);
    let mut normal = [0.0; 3];
    normal[3 - coordinates[0] - coordinates[1]] = 1.0;
    arm.directions = [normal; MOST_JOINTS];
    arm
}

/// The numbers of the task at joint values, by the pose of the tip.
fn target(arm: &Arm, q: &Q) -> Target {
    let full = Arm { task: Task::Pose, ..*arm };
    let model = Model::new(&full, &[0.0; 12], &full.limits).unwrap();
    let tip = model.tip(&model.scaled(q));
    let p = [0, 1, 2].map(|i| tip.translation[i] * arm.length);
    let mut target = [0.0; 12];
    target[..3].copy_from_slice(&p);
    let [x, y, z] = tip.rotation;
    match arm.task {
        Task::Pose => target[3..].copy_from_slice(&[x, y, z].concat()),
        Task::Position => {}
        Task::Rotation => target[..9].copy_from_slice(&[x, y, z].concat()),
        Task::Ray { direction } => target[3..6].copy_from_slice(&tip.turned(&direction)),
        Task::Direction { direction } => target[..3].copy_from_slice(&tip.turned(&direction)),
        Task::PositionPitchRoll => target[3..5].copy_from_slice(&[(-z[0]).asin(), z[1].atan2(z[2])]),
        Task::PositionYaw { axis, direction } => {
            let image = tip.turned(&direction);
            target[3] = image[(axis + 2) % 3].atan2(image[(axis + 1) % 3]);
        }
        Task::PlanarPosition { coordinates: [a, b] } => target[..3].copy_from_slice(&[p[a], p[b], 0.0]),
        Task::PlanarPose { coordinates: [a, b] } => {
            let sum: f64 = q.iter().sum();
            target[..3].copy_from_slice(&[p[a], p[b], sum]);
        }
    }
    target
}

/// Follows the curve from joint values by its direction and curvature.
fn check(arm: &Arm, q: &Q) {
    let model = Model::new(arm, &target(arm, q), &arm.limits).unwrap();
    let x = model.scaled(q);
    let (place, bend) = model.bent(&x);
    let size = |values: &[f64; 6]| values.iter().fold(0.0, |most, value| f64::max(most, value.abs()));
    assert!(size(&place.values) < 1e-14, "{arm:?}");
    assert!((norm(&place.linear.tangent) - 1.0).abs() < 1e-14);
    let along = |h: f64| {
        let at = plus(&plus(&x, h, &place.linear.tangent), 0.5 * h * h, &bend);
        size(&model.values(&at))
    };
    // Errors of the third order: a tenth of the step has a thousandth of the error.
    let (far, near) = (along(1e-2), along(1e-3));
    assert!(far < 1e-4, "{far} {:?}", arm.task);
    assert!(near < 2e-3 * far + 1e-13, "{near} {far} {:?}", arm.task);
    // The corrector converges from aside.
    let mut aside = x;
    for i in 0..arm.count {
        aside[i] += 1e-3 * (i as f64 - 2.0);
    }
    for _ in 0..4 {
        let place = model.place(&aside);
        aside = plus(&aside, -1.0, &place.linear.least(&place.values));
    }
    assert!(size(&model.values(&aside)) < 1e-14, "{:?}", arm.task);
}

#[test]
fn equations_of_each_task() {
    let q = [0.3, -0.7, 0.5, 1.1, -0.4, 0.8, -0.2];
    let direction = [0.36, 0.48, 0.8];
    assert!((dot(&direction, &direction) - 1.0).abs() < 1e-15);
    let tasks = [
        Task::Pose,
        Task::Position,
        Task::Rotation,
        Task::Ray { direction },
        Task::Direction { direction },
        Task::PositionPitchRoll,
    ];
    for task in tasks {
        for sliding in [0, 1, 2, MOST_JOINTS] {
            // A prismatic joint does not change rotations.
            if sliding < MOST_JOINTS && matches!(task, Task::Rotation | Task::Direction { .. }) {
                continue;
            }
            let arm = arm(task, sliding);
            let mut q = q;
            q[arm.count..].fill(0.0);
            check(&arm, &q);
        }
    }
}

#[test]
fn equations_of_planar_tasks() {
    for coordinates in [[0, 1], [0, 2], [1, 2]] {
        let [a, b] = coordinates;
        let tasks = [Task::PlanarPosition { coordinates: [a, b] }, Task::PlanarPose { coordinates: [a, b] }];
        for task in tasks {
            let arm = planar(coordinates, task);
            let mut q = [0.3, -0.7, 0.5, 1.1, 0.0, 0.0, 0.0];
            q[arm.count..].fill(0.0);
            check(&arm, &q);
        }
        // A SCARA arm: rotations about one axis, and a joint along it.
        let axis = 3 - a - b;
        let mut direction = [0.0; 3];
        direction[a] = 1.0;
        let mut arm = planar(coordinates, Task::PositionYaw { axis, direction });
        arm.tip.rotation = Rigid::NONE.rotation;
        arm.slides[2] = true;
        check(&arm, &[0.3, -0.7, 0.5, 1.1, -0.4, 0.0, 0.0]);
    }
}
