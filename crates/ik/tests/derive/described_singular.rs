//! Singular poses of robots described with rounded angles. They must have the self-motions and the solutions at the boundary of the workspace that the exactly
//! described robots have.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_ik::Watch;
use groebot_ik::witness::chain::check_within;
use groebot_ik::witness::{Fault, Options, Solver, Verdict};
use groebot_robot::kinematics::{BaseAxis, Chain, JointKind, Plane, Solution, Target, Task};
use groebot_robot::spatial::Pose;
use nalgebra::{DMatrix, DVector, Translation3};

use super::described::{EXACT, FOLDING, LYNX, Link, PINCHER, PLANAR, ROUNDINGS, derived, distance, robot, with_task};
use crate::codegen::random;

/// Joint values in multiples of 90 degrees, prismatic ones in multiples of a centimetre.
fn round_joints(chain: &Chain, count: usize) -> Vec<Vec<f64>> {
    let mut between = random();
    let mut value = |kind: JointKind| match kind {
        JointKind::Prismatic => 0.01 * between(-20.0, 20.0).round(),
        JointKind::Revolute => between(-1.4, 2.4).round() * FRAC_PI_2,
    };
    (0..count).map(|_| chain.joints().iter().map(|joint| value(joint.kind)).collect()).collect()
}

/// The numbers of a tip's pose: its position as a fraction of the reach, and its rotation.
fn seen(chain: &Chain, q: &[f64]) -> DVector<f64> {
    let pose = chain.forward(q).unwrap();
    let rotation = pose.rotation.to_rotation_matrix();
    let position = pose.translation.vector / chain.reach();
    DVector::from_iterator(12, position.iter().copied().chain(rotation.matrix().iter().copied()))
}

/// The joints of `member` after its free joints have moved in steps to their values in `end`, with the other joints following along the self-motion.
fn followed(chain: &Chain, member: &Solution, end: &[f64], is_long: bool) -> Vec<f64> {
    const STEPS: usize = 48;
    let (goal, mut q) = (seen(chain, &member.q), member.q.clone());
    let others: Vec<usize> = (0..q.len()).filter(|joint| !member.free.contains(joint)).collect();
    for step in 1..=STEPS {
        for &joint in &member.free {
            let short = end[joint] - member.q[joint] - 2.0 * PI * ((end[joint] - member.q[joint]) / (2.0 * PI)).round();
            let path = if is_long { short - 2.0 * PI.copysign(short) } else { short };
            q[joint] = member.q[joint] + path * step as f64 / STEPS as f64;
        }
        for _ in 0..6 {
            let slope = |&joint: &usize| {
                let [mut ahead, mut behind] = [q.clone(), q.clone()];
                (ahead[joint], behind[joint]) = (q[joint] + 5e-6, q[joint] - 5e-6);
                (seen(chain, &ahead) - seen(chain, &behind)) / 1e-5
            };
            let slopes = DMatrix::from_columns(&others.iter().map(slope).collect::<Vec<_>>());
            let step = slopes.svd(true, true).solve(&(seen(chain, &q) - &goal), 1e-7).unwrap();
            others.iter().zip(step.iter()).for_each(|(&joint, step)| q[joint] -= step);
        }
    }
    q
}

/// Whether the exact robot's self-motion through this member leads to `answer`, within the tolerance next to a double root.
fn is_same_self_motion(exact: &Chain, member: &Solution, answer: &Solution, bound: f64) -> bool {
    let is_there = |end: Vec<f64>| distance(exact, &end, &answer.q) <= 4.0 * bound.sqrt();
    member.free == answer.free
        && [false, true].into_iter().any(|is_long| is_there(followed(exact, member, &answer.q, is_long)))
}

/// Compares the described robot with the exact one at targets of both: round ones, and that of the joints `singular`. Returns the number of self-motions.
fn compare(links: &[Link], rounding: [&str; 2], singular: &[f64]) -> usize {
    let (described, exact) = (robot(links, rounding), robot(links, EXACT));
    let bound = described.ideal().1.bound();
    let (solver, reference) = (derived(&described).solver(), derived(&exact).solver());
    let is_free = |answer: &&Solution| !answer.free.is_empty();
    let mut seen = 0;
    for q in round_joints(&exact, 16).into_iter().chain([singular.to_vec()]) {
        let target = Target::reached(&exact, &q).unwrap();
        let wanted = reference.solve(target).unwrap();
        for target in [target, Target::reached(&described, &q).unwrap()] {
            let answers = solver.solve(target).unwrap();
            assert!(answers.len() >= wanted.len(), "{q:?}: {wanted:?} {answers:?}");
            for answer in &answers {
                let [position, rotation] = target.missed(&described, &answer.q);
                assert!(position / described.reach() <= 4.0 * bound && rotation <= 4.0 * bound, "{q:?}: {answer:?}");
            }
            // Where two self-motions meet, the described robot may have both separately.
            let [least, count] = [&wanted, &answers].map(|list| list.iter().filter(is_free).count());
            assert!(count >= least && (count == 0) == (least == 0), "{q:?}: {wanted:?} {answers:?}");
            for member in wanted.iter().filter(is_free) {
                let is_same = |answer: &&Solution| is_same_self_motion(&exact, member, answer, bound);
                assert!(answers.iter().filter(is_free).any(|answer| is_same(&answer)), "{q:?}: {member:?} {answers:?}");
                seen += 1;
            }
        }
    }
    seen
}

#[test]
fn self_motions_of_rounded_robots_are_those_of_all_digits() {
    for rounding in ROUNDINGS {
        // Folded, with the hand at the shoulder, and straight up.
        let folded = [0.3, PI, -0.05, 0.4];
        let at_shoulder = [-PI / 3.0, 0.75 * PI, -FRAC_PI_2, -1.3];
        let upright = [FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0, FRAC_PI_2];
        for (links, singular) in [(&FOLDING[..], &folded[..]), (&PINCHER, &at_shoulder), (&LYNX, &upright)] {
            let seen = compare(links, rounding, singular);
            assert!(seen >= 2, "{links:?} {rounding:?}: {seen}");
        }
    }
}

/// Also next to the folded pose: the distance of the tool from the first joint's axis is below or above the tolerance.
#[test]
fn a_pose_within_the_tolerance_of_a_self_motion_has_it() {
    let described = robot(&FOLDING, ROUNDINGS[1]);
    let (solver, bound) = (derived(&described).solver(), described.ideal().1.bound());
    let Target::Pose(pose) = Target::reached(&described, &[0.3, PI, -0.05, 0.4]).unwrap() else { unreachable!() };
    for (share, count, free) in [(0.0, 1, vec![0]), (0.5, 1, vec![0]), (100.0, 2, vec![])] {
        let aside = Translation3::new(0.0, share * bound * described.reach(), 0.0);
        let target = Target::Pose(Pose::from_parts(aside * pose.translation, pose.rotation));
        let answers = solver.solve(target).unwrap();
        assert_eq!(answers.len(), count, "{share}: {answers:?}");
        assert!(answers.iter().all(|answer| answer.free == free), "{share}: {answers:?}");
    }
}

/// The stretched arm is one solution if the target is just out of reach; farther out there is none.
#[test]
fn poses_just_out_of_reach_have_the_answer_at_the_edge() {
    let described = robot(&FOLDING, ROUNDINGS[1]);
    let (solver, bound) = (derived(&described).solver(), described.ideal().1.bound());
    let q = [0.3, 0.0, -0.05, 0.4];
    let Target::Pose(pose) = Target::reached(&described, &q).unwrap() else { unreachable!() };
    for (share, count) in [(0.5, 1), (20.0, 0)] {
        let out = share * bound * described.reach();
        let target = Target::Pose(Pose::from_parts(
            Translation3::new(out * 0.3_f64.cos(), out * 0.3_f64.sin(), 0.0) * pose.translation,
            pose.rotation,
        ));
        let answers = solver.solve(target).unwrap();
        assert_eq!(answers.len(), count, "{share}: {answers:?}");
        assert!(answers.iter().all(|answer| distance(&described, &answer.q, &q) <= 4.0 * bound.sqrt()), "{answers:?}");
    }
}

/// A member of a self-motion is moved along it until it is within limits.
#[test]
fn self_motions_of_rounded_robots_are_followed_into_limits() {
    let described = robot(&FOLDING, ROUNDINGS[1]);
    let program = derived(&described);
    let (solver, bound) = (program.solver(), described.ideal().1.bound());
    let target = solver.reached(&[0.3, PI, -0.05, 0.4]).unwrap();
    for first in [-2.0, -0.5, 0.25, 1.9] {
        let limits = [[first, first + 0.3], [-4.0, 4.0], [-1.0, 1.0], [-4.0, 4.0]];
        let answers = solver.solve_within(&target, &limits).unwrap();
        assert_eq!(answers.len(), 1, "{first}: {answers:?}");
        assert!((first..=first + 0.3).contains(&answers[0].q[0]), "{answers:?}");
        let missed = seen(&described, &answers[0].q) - seen(&described, &[0.3, PI, -0.05, 0.4]);
        assert!(missed.amax() <= 4.0 * bound, "{first}: {missed}");
    }
}

/// A solver that finds everything except self-motions.
struct WithoutSelfMotions(groebot_ik::solver::Program);

impl Solver for WithoutSelfMotions {
    fn solve(&self, inputs: &[f64]) -> groebot_ik::Result<Vec<Solution>> {
        let all = Solver::solve(&self.0, inputs)?;
        Ok(all.into_iter().filter(|answer| answer.free.is_empty()).collect())
    }
}

#[test]
fn the_check_takes_self_motions_within_the_tolerance_and_misses_them() {
    let described = robot(&FOLDING, ROUNDINGS[1]);
    let program = derived(&described);
    let within = program.described.as_ref().unwrap().within;
    let options = Options { targets: 240, oracle: 0, exact: 0, seed: 1, ..Options::default() };
    let missing = |solver: &dyn Solver| {
        let report = check_within(&described, solver, None, (&options, 2.0 * within), &Watch::none()).unwrap();
        let is_missing = |verdict: &Verdict| verdict.faults().contains(&Fault::Missing);
        let failed = report.failures().count();
        (report.rows.iter().filter(|row| is_missing(&row.verdict)).count(), failed)
    };
    assert_eq!(missing(&program), (0, 0));
    assert!(missing(&WithoutSelfMotions(program)).0 >= 1);
}

/// Two solvers of a tilted plane give different joint values that are equally near.
#[test]
fn planar_poses_and_yaws_of_rounded_robots_pass_their_checks() {
    for rounding in [ROUNDINGS[0], ROUNDINGS[1]] {
        let planar = with_task(&robot(&PLANAR, rounding), Task::PlanarPose { plane: Plane::Xz }, [0, 0, 1]);
        let yaw = with_task(&robot(&FOLDING, rounding), Task::PositionYaw { axis: BaseAxis::Z }, [1, 0, 0]);
        for chain in [planar, yaw] {
            let program = derived(&chain);
            let tolerance = 2.0 * program.described.as_ref().unwrap().within;
            let options = Options { targets: 120, oracle: 0, exact: 0, seed: 1, ..Options::default() };
            let report = check_within(&chain, &program, None, (&options, tolerance), &Watch::none()).unwrap();
            let failures: Vec<String> = report.failures().map(ToString::to_string).collect();
            assert!(failures.is_empty(), "{failures:?}");
        }
    }
}
