//! Arms with two joints more than their task determines: a Panda on a rail.

use std::sync::OnceLock;

use groebot_ik::solver::redundant::{Absence, Criterion, PathOptions, ScanningSolver};
use groebot_ik::solver::{Program, RedundantPart};
use groebot_ik::{ErrorKind, derive};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::Robot;
use groebot_robot::spatial::Pose;

pub struct Arm {
    pub chain: Chain,
    pub program: Program,
    pub solver: ScanningSolver,
}

/// A Panda on a rail from -1 to 1 m.
pub fn arm() -> &'static Arm {
    static ARM: OnceLock<Arm> = OnceLock::new();
    ARM.get_or_init(|| {
        let rail = "<link name=\"floor\"/><joint name=\"rail\" type=\"prismatic\"><parent link=\"floor\"/><child link=\"panda_link0\"/>\
                    <origin xyz=\"0 0.1 0.5\" rpy=\"0.3 0 0.5\"/><axis xyz=\"0 1 0\"/>\
                    <limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"0.5\"/></joint></robot>";
        let text = include_str!("../../../../tests/corpus/redundant/arms/panda.urdf").replace("</robot>", rail);
        let chain = Robot::from_urdf(&text).unwrap().chain(None, Some("panda_hand_tcp")).unwrap();
        let program = derive(&chain).unwrap().program().clone();
        let solver = program.scanning_solver().unwrap();
        Arm { chain, program, solver }
    })
}

pub const READY: [f64; 8] = [0.4, 0.0, -0.8, 0.0, -2.3, 0.0, 1.55, 0.8];

impl Arm {
    pub fn pose(&self, q: &[f64]) -> Pose {
        self.chain.forward(q).unwrap()
    }

    #[track_caller]
    pub fn assert_solves(&self, pose: &Pose, q: &[f64]) {
        let reached = self.pose(q);
        let off = (reached.translation.vector - pose.translation.vector).norm();
        assert!(off < 1e-9 && reached.rotation.angle_to(&pose.rotation) < 1e-7, "{q:?}: {off}");
        for (value, joint) in q.iter().zip(self.chain.joints()) {
            let (low, high) = joint.limits.unwrap();
            assert!((low - 1e-9..=high + 1e-9).contains(value), "{}: {value}", joint.name);
        }
    }
}

#[test]
fn one_joint_is_scanned_and_the_others_have_solvers() {
    let arm = arm();
    assert_eq!(arm.solver.scanned().len(), 1);
    assert!(arm.program.redundant_solver().is_none());
    let redundancy = arm.program.redundancy.as_ref().unwrap();
    let solved = redundancy.parts.iter().filter(|part| matches!(part, RedundantPart::Program(_) | RedundantPart::Main));
    assert_eq!(solved.count(), 7);
    assert_eq!(Program::from_json(&arm.program.to_json()).unwrap(), arm.program);
}

/// The solver with the scanned joint held has the arcs of the whole chain: forward kinematics is that of the chain.
#[test]
fn arcs_with_the_scanned_joint_held_reach_the_pose() {
    let arm = arm();
    let scanned = arm.solver.scanned()[0];
    let pose = arm.pose(&READY);
    let held = arm.solver.held(&[READY[scanned]]).unwrap();
    let target = held.target(pose).unwrap();
    let limits = held.limits();
    let arcs = held.arcs(&target, &limits).unwrap();
    assert!(!arcs.arcs.is_empty());
    let own = |q: &[f64]| [&q[..scanned], &[READY[scanned]], &q[scanned..]].concat();
    for arc in &arcs.arcs {
        held.samples(&target, &limits, arc, 9).unwrap().iter().for_each(|q| arm.assert_solves(&pose, &own(q)));
    }
}

#[test]
fn some_solution_is_found_and_the_best_ones_are_better() {
    let arm = arm();
    let pose = arm.pose(&READY);
    let target = arm.solver.target(pose).unwrap();
    let found = arm.solver.any_within(&target, None).unwrap();
    arm.assert_solves(&pose, found.q.as_ref().unwrap());
    let best = arm.solver.best(&target, None, &Criterion::Margin).unwrap();
    let q = best.q.unwrap();
    arm.assert_solves(&pose, &q);
    let margin = |q: &[f64]| {
        let pairs = q.iter().zip(arm.chain.joints());
        pairs
            .map(|(q, joint)| joint.limits.map_or(f64::MAX, |(low, high)| (q - low).min(high - q)))
            .fold(f64::MAX, f64::min)
    };
    // The rail is in the middle of its range in both.
    assert!(margin(&q) > margin(&READY) && margin(&q) >= margin(&found.q.unwrap()) - 1e-9, "{q:?}");
    let near = arm.solver.nearest(&target, None, &READY).unwrap();
    arm.assert_solves(&pose, near.q.as_ref().unwrap());
    assert!(near.value.unwrap() < 1e-5, "{near:?}");
}

/// Only values of the rail next to the upper end reach the pose.
#[test]
fn poses_beyond_reach_have_a_reason() {
    let arm = arm();
    let mut far = arm.pose(&READY);
    far.translation.vector[0] += 4.0;
    let found = arm.solver.any_within(&arm.solver.target(far).unwrap(), None).unwrap();
    assert_eq!((found.q, found.absence), (None, Some(Absence::Unreachable)));
    let pose = arm.pose(&READY);
    let target = arm.solver.target(pose).unwrap();
    let mut limits = arm.solver.limits();
    let elbow = 4;
    limits[elbow] = [-0.2, -0.1];
    limits[arm.solver.scanned()[0]] = [READY[arm.solver.scanned()[0]]; 2];
    let found = arm.solver.any_within(&target, Some(&limits)).unwrap();
    assert!(matches!(found.absence, Some(Absence::Beyond(_))), "{found:?}");
}

/// Poses along 2.4 m in the direction of the rail: the arm alone reaches 0.86 m.
#[test]
fn a_path_moves_the_scanned_joint_where_it_must() {
    let arm = arm();
    let count = 41;
    let poses: Vec<Pose> = (0..count)
        .map(|k| {
            let mut pose = arm.pose(&[0.0, 0.0, -0.8, 0.0, -2.3, 0.0, 1.55, 0.8]);
            let along =
                arm.pose(&[1.0, 0.0, -0.8, 0.0, -2.3, 0.0, 1.55, 0.8]).translation.vector - pose.translation.vector;
            pose.translation.vector += along * (-1.2 + 2.4 * f64::from(k) / f64::from(count - 1));
            pose
        })
        .collect();
    let targets: Vec<_> = poses.iter().map(|pose| arm.solver.target(*pose).unwrap()).collect();
    let path = arm.solver.path(&targets, None, &PathOptions::new(), None).unwrap();
    assert!(path.jumps.is_empty(), "{:?}", path.jumps);
    for (pose, q) in poses.iter().zip(&path.q) {
        arm.assert_solves(pose, q);
    }
    let most = |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(path.q.windows(2).all(|pair| most(pair) <= 0.5 + 1e-9));
}

#[test]
fn wrong_numbers_are_refused() {
    let arm = arm();
    let target = arm.solver.target(arm.pose(&READY)).unwrap();
    let refused = |result: groebot_ik::Result<groebot_ik::solver::redundant::Scanned>| {
        assert_eq!(result.unwrap_err().kind(), ErrorKind::BadValue);
    };
    refused(arm.solver.any_within(&target, Some(&[[0.0, 1.0]])));
    let mut limits = arm.solver.limits();
    limits[arm.solver.scanned()[0]] = [0.5, -0.5];
    refused(arm.solver.any_within(&target, Some(&limits)));
    limits[arm.solver.scanned()[0]] = [f64::NAN, 0.5];
    refused(arm.solver.any_within(&target, Some(&limits)));
    refused(arm.solver.nearest(&target, None, &READY[1..]));
    assert_eq!(arm.solver.held(&[]).unwrap_err().kind(), ErrorKind::BadValue);
}
