//! Limits that are singular, joints at limits, and joints without limits, of an arm with spherical shoulder and wrist.

use std::f64::consts::PI;

use groebot_runtime::redundant::{Arc, Criterion, Limits, Outcome, Q, Within, any_within, arcs, best, sample};

use super::srs::{Srs, pose};
use crate::random;

/// The arcs of the pose of joint values that are within limits. Checks that a solution exists, that the joint values are on an arc within a distance, and that
/// arcs reach the pose within limits.
fn check(robot: &Srs, limits: &Limits, q: &Q, near: f64) -> (Vec<Arc>, Outcome) {
    let target = pose(q);
    let mut out = [Arc::NONE; 256];
    let outcome = arcs(robot, &target, limits, &mut out).unwrap();
    let found = out[..outcome.count].to_vec();
    let is_right = |q: &Q| {
        let reached = pose(q);
        (0..12).all(|i| (reached[i] - target[i]).abs() < 1e-7)
            && (0..7).all(|i| (limits[i][0] - 1.1e-9..=limits[i][1] + 1.1e-9).contains(&q[i]))
    };
    match any_within(robot, &target, limits).unwrap() {
        Within::Solution(found) => assert!(is_right(&found), "{q:?}"),
        other => panic!("{other:?} at {q:?}"),
    }
    let criterion = Criterion::Nearest { q0: *q, weights: [1.0; 7] };
    let nearest = best(&robot.arm, &target, limits, &found, &criterion).unwrap();
    assert!(nearest.is_some_and(|best| best.value > -near), "{q:?} is {nearest:?} of {found:?}, {outcome:?}");
    for arc in &found {
        let mut list = [[0.0; 7]; 12];
        sample(&robot.arm, &target, limits, arc, &mut list).unwrap();
        assert!(list.iter().all(is_right), "{q:?} {arc:?}");
    }
    (found, outcome)
}

fn vector(limits: &Limits, next: &mut impl FnMut() -> f64) -> Q {
    std::array::from_fn(|i| {
        let [low, high] = limits[i].map(|limit| limit.clamp(-PI, PI));
        low + next() * (high - low)
    })
}

/// The equations are singular along all curves, because a straight elbow is at the limit.
#[test]
fn elbow_that_is_straight_at_its_limit() {
    let mut robot = Srs::iiwa();
    robot.arm.limits[3][0] = 0.0;
    let limits = robot.arm.limits;
    let mut next = random();
    for _ in 0..60 {
        let mut q = vector(&limits, &mut next);
        q[3] = 0.0;
        // Rounding of the target bends the elbow by its square root, 3e-8 rad, and the other joints turn by this angle over the sine of the shoulder or the wrist.
        check(&robot, &limits, &q, 1e-7 + 1e-7 / q[1].sin().abs().min(q[5].sin().abs()));
    }
}

#[test]
fn joints_at_limits_at_once() {
    let robot = Srs::iiwa();
    let limits = robot.arm.limits;
    let mut next = random();
    for number in 0..90 {
        let mut q = vector(&limits, &mut next);
        for _ in 0..1 + number % 3 {
            let joint = [0, 1, 2, 4, 5, 6][(6.0 * next()) as usize];
            q[joint] = limits[joint][usize::from(next() < 0.5)];
        }
        check(&robot, &limits, &q, 1e-6);
    }
}

/// No arc ends at a joint whose range is a turn.
#[test]
fn joints_without_limits() {
    let mut robot = Srs::iiwa();
    for joint in [0, 2, 4, 6] {
        robot.arm.limits[joint] = if joint < 4 { [-PI, PI] } else { [f64::NEG_INFINITY, f64::INFINITY] };
    }
    let limits = robot.arm.limits;
    let mut next = random();
    let mut closed = 0;
    for _ in 0..60 {
        let q = vector(&limits, &mut next);
        let (found, outcome) = check(&robot, &limits, &q, 1e-6);
        assert!(!outcome.is_unsure, "{q:?}");
        let is_limited = |joint: Option<usize>| joint.is_none_or(|joint| joint % 2 == 1);
        assert!(found.iter().all(|arc| is_limited(arc.start.joint) && is_limited(arc.end.joint)), "{found:?}");
        closed += outcome.closed;
    }
    assert!(closed > 0);
}
