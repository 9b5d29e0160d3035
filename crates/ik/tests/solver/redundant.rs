//! All solutions within limits of arms with one joint more than their task determines.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use groebot_ik::solver::redundant::{Absence, Arc, ArmTarget, Criterion, PathOptions, RedundantSolver};
use groebot_ik::{Error, ErrorKind};
use groebot_robot::kinematics::Chain;
use groebot_robot::spatial::Pose;

use crate::derive::redundant as derived;

/// An arm with its solver.
pub struct Arm {
    pub chain: Chain,
    pub solver: RedundantSolver,
}

fn iiwa() -> &'static Arm {
    static ARM: OnceLock<Arm> = OnceLock::new();
    ARM.get_or_init(|| {
        let solver = derived::derived().1.program().redundant_solver().unwrap();
        Arm { chain: derived::iiwa(), solver }
    })
}

pub fn panda() -> &'static Arm {
    static ARM: OnceLock<Arm> = OnceLock::new();
    ARM.get_or_init(|| {
        let chain = Chain::from_toml(include_str!("../../../../derivations/panda/0_chain.toml")).unwrap();
        let solver = groebot_ik::derive(&chain).unwrap().program().redundant_solver().unwrap();
        Arm { chain, solver }
    })
}

impl Arm {
    pub fn target(&self, q: &[f64]) -> (Pose, ArmTarget) {
        let pose = self.chain.forward(q).unwrap();
        (pose, self.solver.target(pose).unwrap())
    }

    /// Asserts that joint values reach a pose within limits.
    #[track_caller]
    pub fn assert_solves(&self, pose: &Pose, q: &[f64]) {
        let reached = self.chain.forward(q).unwrap();
        let off = (reached.translation.vector - pose.translation.vector).norm();
        assert!(off < 1e-9 && reached.rotation.angle_to(&pose.rotation) < 1e-7, "{q:?}: {off}");
        for (value, joint) in q.iter().zip(self.chain.joints()) {
            let (low, high) = joint.limits.unwrap();
            assert!((low - 1e-9..=high + 1e-9).contains(value), "{}: {value}", joint.name);
        }
    }

    /// The lengths of the arcs at the pose of `q`, the longest first, and their number of end points. Every arc is checked.
    fn lengths(&self, q: &[f64]) -> (usize, Vec<f64>) {
        let (pose, target) = self.target(q);
        let limits = self.solver.limits();
        let arcs = self.solver.arcs(&target, &limits).unwrap();
        assert!(!arcs.is_unsure && !arcs.is_surface && arcs.absence.is_none(), "{arcs:?}");
        for arc in &arcs.arcs {
            self.assert_arc(&pose, &target, arc);
        }
        let mut lengths: Vec<f64> = arcs.arcs.iter().map(|arc| arc.length).collect();
        lengths.sort_by(|a, b| b.total_cmp(a));
        (2 * arcs.arcs.iter().filter(|arc| !arc.is_closed).count(), lengths)
    }

    #[track_caller]
    fn assert_arc(&self, pose: &Pose, target: &ArmTarget, arc: &Arc) {
        for end in [&arc.start, &arc.end] {
            self.assert_solves(pose, &end.q);
            let Some(joint) = end.joint else { continue };
            let (low, high) = self.chain.joints()[joint].limits.unwrap();
            let limit = if end.is_upper { high } else { low };
            assert!((end.q[joint] - limit).abs() < 1e-9, "{end:?}");
        }
        let limits = self.solver.limits();
        let samples = self.solver.samples(target, &limits, arc, 40).unwrap();
        samples.iter().for_each(|q| self.assert_solves(pose, q));
        // The samples are at equal distances along the arc within 1e-3 of them, so no step is longer than the arc between them.
        let step = |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        assert!(samples.windows(2).all(|pair| step(pair) <= arc.length / 39.0 * (1.0 + 1e-3)), "{arc:?}");
        let middle = self.solver.at(target, &limits, arc, 0.5 * arc.length).unwrap();
        self.assert_solves(pose, &middle);
    }
}

/// The ready pose of a Panda.
#[allow(clippy::approx_constant, reason = "as published, in six decimals")]
pub const READY: [f64; 7] = [0.0, -0.785398, 0.0, -2.356194, 0.0, 1.570796, 0.785398];

/// The lengths are those of a prototype in C++, which traces the arcs with another method.
#[test]
fn a_panda_has_three_arcs_at_its_ready_pose() {
    let (ends, lengths) = panda().lengths(&READY);
    assert_eq!(ends, 6);
    for (own, expected) in lengths.iter().zip([6.735620, 2.832865, 2.832865]) {
        assert!((own - expected).abs() < 1e-4, "{lengths:?}");
    }
    let (ends, lengths) = panda().lengths(&[2.6214, 1.7513, 0.5511, -1.3872, -2.5629, 1.4541, 0.1179]);
    assert_eq!((ends, lengths.len()), (8, 4), "{lengths:?}");
}

/// The margins are those of the prototype.
#[test]
fn the_largest_margin_of_each_arc_is_found() {
    let arm = panda();
    let (pose, target) = arm.target(&READY);
    let limits = arm.solver.limits();
    let optima = arm.solver.optima(&target, &limits, &Criterion::Margin).unwrap();
    let most = |arc: usize| optima.iter().filter(|best| best.arc == arc).map(|best| best.value).fold(0.0, f64::max);
    let mut margins = [most(0), most(1), most(2)];
    margins.sort_by(|a, b| b.total_cmp(a));
    for (own, expected) in margins.iter().zip([0.7506, 0.4055, 0.4055]) {
        assert!((own - expected).abs() < 1e-4, "{margins:?}");
    }
    let best = arm.solver.best(&target, &limits, &Criterion::Margin).unwrap().unwrap();
    assert!((best.value - margins[0]).abs() < 1e-12);
    arm.assert_solves(&pose, &best.q);
    let ends = best.q.iter().zip(arm.chain.joints()).map(|(value, joint)| {
        let (low, high) = joint.limits.unwrap();
        (value - low).min(high - value)
    });
    assert!((ends.fold(f64::INFINITY, f64::min) - best.value).abs() < 1e-12);
}

/// The joint values that made a pose are on an arc: the nearest solution to them is at distance zero.
#[test]
fn the_nearest_solution_is_the_vector_that_made_the_pose() {
    for (arm, q) in [
        (panda(), READY),
        (panda(), [0.4, 0.3, -0.7, -1.9, 0.6, 2.1, -1.1]),
        (iiwa(), [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5]),
        (iiwa(), [-1.4, 0.9, 1.3, -1.6, 2.1, -0.8, 2.6]),
    ] {
        let (pose, target) = arm.target(&q);
        let limits = arm.solver.limits();
        let best = arm.solver.nearest(&target, &limits, &q).unwrap().unwrap();
        assert!(best.value < 1e-7, "{best:?}");
        arm.assert_solves(&pose, &best.q);
        let any = arm.solver.any_within(&target, &limits).unwrap();
        assert_eq!((any.absence, any.is_unsure), (None, false));
        arm.assert_solves(&pose, &any.q.unwrap());
    }
}

/// The elbow of an iiwa is at an angle or its opposite, 1.1 here, wherever the other joints are.
#[test]
fn the_reason_for_no_solution_is_named() {
    let arm = iiwa();
    let (_, target) = arm.target(&[0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5]);
    let narrow = arm.solver.narrowed(arm.solver.limits(), 3, [0.0, 1.0]).unwrap();
    let arcs = arm.solver.arcs(&target, &narrow).unwrap();
    assert_eq!((arcs.arcs.len(), &arcs.absence), (0, &Some(Absence::Beyond(vec![3]))));
    assert_eq!(arcs.to_string(), "no solution within limits: reachable, but beyond the limits of joint 4\n");
    assert_eq!(arm.solver.any_within(&target, &narrow).unwrap().absence, Some(Absence::Beyond(vec![3])));
    assert_eq!(arm.solver.best(&target, &narrow, &Criterion::Margin).unwrap(), None);
    let far = arm.solver.target(Pose::translation(3.0, 0.0, 0.0)).unwrap();
    let none = arm.solver.any_within(&far, &arm.solver.limits()).unwrap();
    assert_eq!((none.q, none.absence), (None, Some(Absence::Unreachable)));
    assert_eq!(arm.solver.arcs(&far, &arm.solver.limits()).unwrap().absence, Some(Absence::Unreachable));
}

/// Three links of 0.5, 0.4 and 0.15 m in a plane reach (0.95, 0) only with joint angles of at most 0.464, 0.959 and 1.404 rad, by the cosine rule. With all
/// limits above, no problem with a joint at a limit has a solution.
#[test]
fn arcs_and_one_solution_have_the_same_reason() {
    let text = include_str!("../../../../derivations/planar_3r/0_chain.toml").replace("planar_pose", "planar_position");
    let solver = groebot_ik::derive(&Chain::from_toml(&text).unwrap()).unwrap().program().redundant_solver().unwrap();
    let limits = solver.limits_within(&[[1.5, 1.6]; 3]).unwrap();
    for (x, absence) in [(0.95, Absence::Beyond(vec![0, 1, 2])), (1.2, Absence::Unreachable)] {
        let target = solver.target_of_numbers(&[x, 0.0]).unwrap();
        assert_eq!(solver.any_within(&target, &limits).unwrap().absence, Some(absence.clone()));
        let arcs = solver.arcs(&target, &limits).unwrap();
        assert_eq!((arcs.arcs.len(), arcs.absence), (0, Some(absence)));
    }
}

/// The last joint has a range of more than one turn. Its value is the turn within limits that is nearest to the reference.
#[test]
fn the_nearest_solution_has_the_nearest_turn() {
    let q = [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5];
    let mut program = derived::derived().1.program().clone();
    let [low, high] = [-7.0, 3.0];
    program.redundancy.as_mut().unwrap().limits[6] = Some([low, high]);
    let solver = program.redundant_solver().unwrap();
    let target = solver.target(iiwa().chain.forward(&q).unwrap()).unwrap();
    for turn in [-1.0, 0.0, 1.0] {
        let mut q0 = q.to_vec();
        q0[6] += turn * TAU;
        let best = solver.nearest(&target, &solver.limits(), &q0).unwrap().unwrap();
        let distance = best.q.iter().zip(&q0).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        assert!((best.value - distance).abs() < 1e-9, "{best:?}");
        assert!((low..=high).contains(&best.q[6]), "{best:?}");
        for other in [-2.0, -1.0, 1.0, 2.0].map(|turns| best.q[6] + turns * TAU) {
            assert!(!(low..=high).contains(&other) || (other - q0[6]).abs() >= (best.q[6] - q0[6]).abs(), "{best:?}");
        }
        // The reference itself is a solution within limits, or one turn away from one.
        assert!(best.value < if turn > 0.0 { TAU + 1e-7 } else { 1e-7 }, "{best:?}");
    }
}

/// The last joint has a range of more than one turn: one or two turns of it are within limits.
#[test]
fn turns_of_solutions_and_arcs_are_listed() {
    let q = [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5];
    let mut program = derived::derived().1.program().clone();
    let [low, high] = [-7.0, 3.0];
    program.redundancy.as_mut().unwrap().limits[6] = Some([low, high]);
    let solver = program.redundant_solver().unwrap();
    let pose = iiwa().chain.forward(&q).unwrap();
    let (target, limits) = (solver.target(pose).unwrap(), solver.limits());
    let last: Vec<f64> = solver.turns(&limits, &q).unwrap().starts.iter().map(|start| start[6]).collect();
    assert_eq!(last, [0.5 - TAU, 0.5]);
    let all = solver.arcs(&target, &limits).unwrap();
    let mut listed = 0;
    for arc in &all.arcs {
        let turns = solver.arc_turns(&target, &limits, arc).unwrap();
        listed += turns.starts.len();
        for start in &turns.starts {
            let samples = solver.samples_from(&target, &limits, (arc, start), 60).unwrap();
            assert_eq!(&samples[0], start);
            let most = arc.length / 59.0 * (1.0 + 1e-3);
            let is_near = |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).all(|(a, b)| (a - b).abs() <= most);
            assert!(samples.windows(2).all(is_near), "{arc:?}");
            for own in &samples {
                assert!((low - 1e-9..=high + 1e-9).contains(&own[6]), "{own:?}");
                let reached = iiwa().chain.forward(own).unwrap();
                assert!((reached.translation.vector - pose.translation.vector).norm() < 1e-9, "{own:?}");
            }
        }
        // Another whole turn of the first arc is beyond a limit.
        if let Some(first) = turns.starts.first() {
            let (low_after, high_after) = (turns.low[6] - first[6], turns.high[6] - first[6]);
            let fits = |start: f64| start + low_after >= low && start + high_after <= high;
            assert_eq!(turns.starts.len(), (-3..=3).filter(|k| fits(first[6] + TAU * f64::from(*k))).count());
        }
    }
    assert!(listed > all.arcs.len() / 2, "{listed} of {}", all.arcs.len());
}

#[test]
fn limits_and_targets_have_their_numbers() {
    let arm = iiwa();
    let described = arm.chain.joints().iter().map(|joint| joint.limits.map(|(low, high)| [low, high]).unwrap());
    assert_eq!(arm.solver.limits().pairs(), described.collect::<Vec<_>>());
    let narrow = arm.solver.narrowed(arm.solver.limits(), 3, [0.0, 1.0]).unwrap();
    assert_eq!(narrow.pairs()[3], [0.0, 1.0]);
    let pose = Pose::translation(0.1, 0.2, 0.9);
    let numbers = [0.1, 0.2, 0.9, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    assert_eq!(arm.solver.target(pose).unwrap().numbers(), numbers);
}

/// Optima on arcs that are known already are those of the target.
#[test]
fn known_arcs_are_not_computed_again() {
    let arm = panda();
    let (_, target) = arm.target(&READY);
    let limits = arm.solver.limits();
    let arcs = arm.solver.arcs(&target, &limits).unwrap().arcs;
    let all = arm.solver.optima(&target, &limits, &Criterion::Margin).unwrap();
    assert_eq!(arm.solver.optima_on(&target, &limits, &arcs, &Criterion::Margin).unwrap(), all);
    let one = arm.solver.best_on(&target, &limits, &arcs[1..2], &Criterion::Margin).unwrap().unwrap();
    assert_eq!(one.arc, 0);
    assert!(all.iter().any(|best| best.arc == 1 && best.q == one.q));
}

/// Narrower limits cut arcs: every arc within them is within the described limits, too.
#[test]
fn narrower_limits_are_kept() {
    let arm = panda();
    let (pose, target) = arm.target(&READY);
    let narrow = arm.solver.narrowed(arm.solver.limits(), 0, [-0.5, 0.5]).unwrap();
    let arcs = arm.solver.arcs(&target, &narrow).unwrap();
    assert!(!arcs.arcs.is_empty());
    for arc in &arcs.arcs {
        for q in arm.solver.samples(&target, &narrow, arc, 30).unwrap() {
            arm.assert_solves(&pose, &q);
            assert!(q[0].abs() <= 0.5 + 1e-9, "{q:?}");
        }
    }
}

#[track_caller]
fn assert_refused<T: std::fmt::Debug>(result: Result<T, Error>, words: &str) {
    let error = result.unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadValue, "{error}");
    assert!(error.to_string().contains(words), "{error}");
}

#[test]
fn bad_input_is_refused() {
    let solver = &iiwa().solver;
    let all = solver.limits();
    assert_refused(solver.limits_within(&[[-1.0, 1.0]; 6]), "6 pairs of limits given; give one for each of 7 joints");
    assert_refused(solver.narrowed(all, 1, [0.5, -0.5]), "the limits of `A2` are 0.5 and -0.5");
    assert_refused(solver.narrowed(all, 1, [f64::NAN, 1.0]), "NaN");
    assert_refused(solver.narrowed(all, 7, [0.0, 1.0]), "there is no joint 7");
    assert_refused(solver.narrowed(all, 1, [5.0, 6.0]), "is allowed");
    assert_refused(solver.target_of_numbers(&[0.0; 11]), "11 numbers given, 12 expected");
    assert_refused(solver.target_of_numbers(&[0.0; 12]), "rotation");
    assert_refused(solver.target_of_numbers(&[f64::INFINITY; 12]), "finite");
    let (_, target) = iiwa().target(&[0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5]);
    assert_refused(solver.nearest(&target, &all, &[0.0; 6]), "6 joint values given");
    assert_refused(solver.nearest(&target, &all, &[f64::NAN; 7]), "`A1` is NaN");
    let weights = Criterion::Nearest { q0: vec![0.0; 7], weights: vec![-1.0; 7] };
    assert_refused(solver.best(&target, &all, &weights), "weights");
    assert_refused(solver.best(&target, &all, &Criterion::Change { joint: 7, value: 0.0 }), "7 joints");
    assert_refused(solver.path(&[], &PathOptions::new(), None), "no target");
    assert_refused(solver.path(&[target], &PathOptions::new().speeds(&[0.0, 1.0], &[]), None), "2 times for 1");
    assert_refused(solver.path(&[target; 2], &PathOptions::new().speeds(&[1.0, 1.0], &[]), None), "ascend");
    assert_refused(solver.path(&[target], &PathOptions::new().start(&[0.0; 6]), None), "6 joint values");
}

/// A reference from the definition: the Jacobian's columns are central differences of forward kinematics. Lengths are relative to the scale of the program.
fn manipulability(chain: &Chain, scale: f64, q: &[f64]) -> f64 {
    let column = |joint: usize| -> [f64; 6] {
        let moved = |by: f64| {
            let mut q = q.to_vec();
            q[joint] += by;
            chain.forward(&q).unwrap()
        };
        let [a, b] = [moved(-1e-5), moved(1e-5)];
        let v = (b.translation.vector - a.translation.vector) / (2e-5 * scale);
        let w = (b.rotation * a.rotation.inverse()).scaled_axis() / 2e-5;
        [v.x, v.y, v.z, w.x, w.y, w.z]
    };
    let columns: Vec<[f64; 6]> = (0..7).map(column).collect();
    let product = nalgebra::Matrix6::from_fn(|i, j| columns.iter().map(|column| column[i] * column[j]).sum::<f64>());
    product.determinant().sqrt()
}

#[test]
fn the_largest_manipulability_is_found() {
    let (arm, scale) = (panda(), derived_scale());
    let (_, target) = arm.target(&READY);
    let limits = arm.solver.limits();
    let best = arm.solver.best(&target, &limits, &Criterion::Manipulability).unwrap().unwrap();
    let own = manipulability(&arm.chain, scale, &best.q);
    assert!((best.value - own).abs() < 1e-6 * own, "{best:?}, {own}");
    for arc in &arm.solver.arcs(&target, &limits).unwrap().arcs {
        for q in arm.solver.samples(&target, &limits, arc, 40).unwrap() {
            assert!(manipulability(&arm.chain, scale, &q) <= best.value * (1.0 + 1e-6), "{q:?}");
        }
    }
}

/// The characteristic length of the panda.
fn derived_scale() -> f64 {
    panda().solver.arm_data().length
}

/// A joint of a panda changes least: with its value free to choose on an arc, the change is zero.
#[test]
fn the_least_change_of_one_joint_is_found() {
    let arm = panda();
    let (pose, target) = arm.target(&READY);
    let q1 = 0.1;
    let best = arm.solver.best(&target, &arm.solver.limits(), &Criterion::Change { joint: 0, value: q1 });
    let best = best.unwrap().unwrap();
    arm.assert_solves(&pose, &best.q);
    assert!(best.value < 1e-7 && (best.q[0] - q1).abs() < 1e-7, "{best:?}");
}

/// Poses along joint values that move slowly have a path without a jump, because these joint values are one.
#[test]
fn a_path_follows_poses_without_a_jump() {
    for (arm, from, by) in [
        (panda(), READY, [0.5, 0.4, -0.6, 0.5, 0.4, 0.3, -0.8]),
        (iiwa(), [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5], [0.9, 0.5, -0.8, -0.4, 0.7, -0.3, 0.6]),
    ] {
        let along = |k: usize| -> Vec<f64> { (0..7).map(|joint| from[joint] + by[joint] * k as f64 / 30.0).collect() };
        let (poses, targets): (Vec<_>, Vec<_>) = (0..=30).map(|k| arm.target(&along(k))).unzip();
        let times: Vec<f64> = (0..=30).map(f64::from).collect();
        let speeds = [Some(0.1); 7];
        let options = PathOptions::new().speeds(&times, &speeds).start(&from);
        let path = arm.solver.path(&targets, &options, None).unwrap();
        assert_eq!(path.jumps, []);
        poses.iter().zip(&path.q).for_each(|(pose, q)| arm.assert_solves(pose, q));
        let is_slow = |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).all(|(a, b)| (a - b).abs() <= 0.1);
        assert!(path.q.windows(2).all(is_slow));
    }
}

#[test]
fn a_path_that_must_jump_names_the_place() {
    let arm = panda();
    let (_, target) = arm.target(&READY);
    let (_, other) = arm.target(&[2.0, 0.8, 1.0, -1.0, -1.5, 2.5, -2.0]);
    let path = arm.solver.path(&[target, target, other], &PathOptions::new().start(&READY), None).unwrap();
    assert_eq!(path.jumps.len(), 1, "{:?}", path.jumps);
    assert_eq!(path.jumps[0].sample, 2);
    assert!(path.jumps[0].step.abs() > 0.5 && !path.jumps[0].why.is_empty());
    let far = [2.8, 1.7, 2.8, -0.1, 2.8, 3.7, 2.8];
    let path = arm.solver.path(&[target], &PathOptions::new().start(&far), None).unwrap();
    assert_eq!(path.jumps[0].why, "the path does not begin at the current joint values");
}
