//! A chain and its task in floating point, the reference of all checks. It uses only forward kinematics. Main types: [`Configuration`], the interface for
//! checks, and [`Model`], that of one chain.

use std::f64::consts::PI;

use nalgebra::DMatrix;

use super::singular::smallest_singular_value;
use crate::Result;
use groebot_robot::kinematics::oracle::{Oracle, Unknown};
use groebot_robot::kinematics::{Chain, JointKind, Solution, Target, TargetNumber, Task};
use groebot_robot::spatial::{Pose, angle, vertical};

/// The chain, its task, and which of its joints are unknown.
pub(super) struct Model<'a> {
    pub chain: &'a Chain,
    /// The reach, or one for a chain that only rotates its tip.
    pub length: f64,
    /// The unknown joints, without those that follow others.
    pub unknown: Vec<usize>,
    /// The joints whose values are given.
    pub given: Vec<usize>,
}

impl<'a> Model<'a> {
    pub fn new(chain: &'a Chain) -> Self {
        let given = chain.given();
        let reach = chain.reach();
        Model { chain, length: if reach > 0.0 { reach } else { 1.0 }, unknown: chain.independent(), given }
    }

    /// The range of a prismatic joint: its limits, or the reach in both directions.
    pub fn slide(&self, joint: usize) -> (f64, f64) {
        let limits = self.chain.joints()[joint].limits.filter(|(low, high)| low < high);
        limits.unwrap_or((-self.length, self.length))
    }

    /// The names of a target's numbers: those of the task, then those of the given joints.
    pub fn input_names(&self) -> Vec<String> {
        let mut names = self.chain.task().layout().names();
        names.extend(self.chain.given_inputs().iter().map(|&joint| self.chain.joints()[joint].name.clone()));
        names
    }

    /// The number of lengths among a target's numbers. They come first.
    pub fn lengths(&self) -> usize {
        self.chain.task().layout().lengths()
    }

    pub fn forward(&self, q: &[f64]) -> Pose {
        let steps = self.chain.screws().iter().zip(q).rev();
        steps.fold(self.chain.base_from_tip(), |pose, (screw, &q)| screw.exp(q) * pose)
    }

    /// The numbers of the task for a pose.
    pub fn seen(&self, pose: &Pose) -> Vec<f64> {
        let target = Target::of_pose(self.chain, pose);
        self.chain.task().layout().values(&target).expect("the target is of the chain's task")
    }

    /// A target's numbers for comparison. Pitch and roll are discontinuous; the vertical direction in the tip frame replaces them.
    fn compared(&self, target: &[f64]) -> Vec<f64> {
        match (self.chain.task(), target) {
            (Task::PositionPitchRoll, &[x, y, z, pitch, roll, ref rest @ ..]) => {
                [&[x, y, z], vertical(pitch, roll).as_slice(), rest].concat()
            }
            _ => target.to_vec(),
        }
    }

    /// The reach plus the displacements of the prismatic joints in `q`.
    fn size(&self, q: &[f64]) -> f64 {
        let slides = q.iter().enumerate().filter(|(joint, _)| !self.turns(*joint));
        self.length + slides.map(|(_, q)| q.abs()).sum::<f64>()
    }
}

/// The joints of a mechanism under check.
pub(in crate::witness) trait Joints {
    /// The number of joints, including given ones.
    fn count(&self) -> usize;

    /// Whether a joint is revolute.
    fn turns(&self, joint: usize) -> bool;

    /// `a - b`; for angles the difference modulo 2 pi in (-pi, pi].
    fn difference(&self, joint: usize, a: f64, b: f64) -> f64 {
        if self.turns(joint) { angle::difference(a, b) } else { a - b }
    }

    /// `q` with every angle in (-pi, pi].
    fn wrapped(&self, q: &[f64]) -> Vec<f64> {
        let wrap = |(joint, q): (usize, &f64)| if self.turns(joint) { angle::wrap(*q) } else { *q };
        q.iter().enumerate().map(wrap).collect()
    }

    /// Whether `q` has a finite value for each joint, angles in (-pi, pi].
    fn is_well_formed(&self, q: &[f64]) -> bool {
        let allowed = |(joint, q): (usize, &f64)| q.is_finite() && (!self.turns(joint) || (-PI < *q && *q <= PI));
        q.len() == self.count() && q.iter().enumerate().all(allowed)
    }
}

/// The interface of a mechanism and its task for checks: its joints, and the errors of joint values at a target.
pub(super) trait Configuration: Joints {
    /// The unknown joints.
    fn unknown(&self) -> &[usize];

    /// A typical length of the mechanism.
    fn length(&self) -> f64;

    /// The target that joint values reach, as inputs of a program.
    fn target(&self, q: &[f64]) -> Vec<f64>;

    /// The error of joint values in each number of a target: fractions of the reach, then plain numbers or radians.
    fn misses(&self, target: &[f64], q: &[f64]) -> Vec<f64>;

    /// The residual of joint values: the larger of the position error (a fraction of the reach) and the orientation error \[rad\].
    fn residual(&self, target: &[f64], q: &[f64]) -> f64;

    /// The derivative of the task's numbers by the unknown joints: lengths as fractions of the reach, angles in radians. It has as many rows as the task has
    /// freedoms.
    fn jacobian(&self, q: &[f64]) -> DMatrix<f64>;

    /// The joint vectors that the numeric oracle finds from `seeds` starting points.
    ///
    /// # Errors
    /// As [`Oracle::search`].
    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>>;

    /// A solution with the values of all joints.
    fn completed(&self, target: &[f64], answer: Solution) -> Solution;

    /// Sets joints that follow others to the values of their laws.
    fn settle(&self, _q: &mut [f64]) {}

    /// One radian, or the reach.
    fn unit(&self, joint: usize) -> f64 {
        if self.turns(joint) { 1.0 } else { self.length() }
    }

    /// The smallest singular value of the Jacobian.
    fn sigma(&self, q: &[f64]) -> f64 {
        smallest_singular_value(self.jacobian(q))
    }

    /// The largest difference of two joint vectors: rad, or a fraction of the reach.
    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let one = |&joint: &usize| self.difference(joint, a[joint], b[joint]).abs() / self.unit(joint);
        self.unknown().iter().map(one).fold(0.0, f64::max)
    }
}

impl Joints for Model<'_> {
    fn count(&self) -> usize {
        self.chain.joints().len()
    }

    fn turns(&self, index: usize) -> bool {
        self.chain.joints()[index].kind == JointKind::Revolute
    }
}

impl Configuration for Model<'_> {
    fn unknown(&self) -> &[usize] {
        &self.unknown
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn target(&self, q: &[f64]) -> Vec<f64> {
        let mut target = self.seen(&self.forward(q));
        target.extend(self.chain.given_inputs().iter().map(|&joint| q[joint]));
        target
    }

    fn misses(&self, target: &[f64], q: &[f64]) -> Vec<f64> {
        let seen = self.compared(&self.seen(&self.forward(q)));
        let target = &self.compared(target)[..];
        let size = self.size(q);
        let is_turn = |number: &TargetNumber| matches!(number, TargetNumber::PlaneAngle(_) | TargetNumber::Yaw(_));
        let turn = self.chain.task().layout().numbers().iter().position(is_turn);
        let miss = |(index, (seen, wanted)): (usize, (&f64, &f64))| match index {
            index if index < self.lengths() => (seen - wanted) / size,
            index if turn == Some(index) => angle::difference(*seen, *wanted),
            _ => seen - wanted,
        };
        let misses = seen.iter().zip(target).enumerate().map(miss);
        // Without followers, the task has no such number.
        let strays = self.chain.joints().iter().any(|joint| joint.mimic.is_some()).then(|| self.chain.strays(q));
        misses.chain(strays).collect()
    }

    fn residual(&self, target: &[f64], q: &[f64]) -> f64 {
        let misses = self.misses(target, q);
        let (position, turn) = misses.split_at(self.lengths());
        let norm = |part: &[f64]| part.iter().map(|miss| miss * miss).sum::<f64>().sqrt();
        // A small rotation by an angle changes the nine entries of a matrix by sqrt(2) times the angle in all (Frobenius norm).
        let whole = matches!(self.chain.task(), Task::Pose | Task::Rotation);
        let turn = norm(turn) / if whole { 2.0_f64.sqrt() } else { 1.0 };
        let worst = norm(position).max(turn);
        if worst.is_nan() { f64::INFINITY } else { worst }
    }

    fn jacobian(&self, q: &[f64]) -> DMatrix<f64> {
        let mut q = q.to_vec();
        self.chain.follow(&mut q);
        self.chain.coupled_jacobian(&q, &self.given).select_columns(&self.unknown)
    }

    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>> {
        let unknown = |&joint: &usize| match self.turns(joint) {
            true => Unknown::Angle,
            false => Unknown::Displacement { low: -1.5 * self.length, high: 1.5 * self.length },
        };
        let unknowns: Vec<Unknown> = self.unknown.iter().map(unknown).collect();
        let whole = |values: &[f64]| {
            let part = Solution { q: values.to_vec(), ..Solution::default() };
            self.completed(target, part).q
        };
        let oracle = Oracle { seeds, ..Oracle::default() };
        let found = oracle.search(&unknowns, |values| self.misses(target, &whole(values)))?;
        Ok(found.iter().map(|answer| whole(&answer.q)).collect())
    }

    fn settle(&self, q: &mut [f64]) {
        self.chain.follow(q);
    }

    /// A solution with the values of all joints, in the chain's order. Given values are taken from the target. A free follower is replaced by its leader.
    fn completed(&self, target: &[f64], answer: Solution) -> Solution {
        let count = self.chain.joints().len();
        let open: Vec<usize> = (0..count).filter(|joint| !self.given.contains(joint)).collect();
        let places = match answer.q.len() {
            length if length == count => (0..count).collect(),
            length if length == open.len() => open,
            length if length == self.unknown.len() => self.unknown.clone(),
            _ => return answer,
        };
        let mut q = vec![0.0; count];
        let inputs = &target[target.len() - self.chain.given_inputs().len()..];
        let values = self.chain.given_values(inputs);
        self.given.iter().zip(values).for_each(|(&joint, value)| q[joint] = value);
        places.iter().zip(&answer.q).for_each(|(&joint, &value)| q[joint] = value);
        if places.len() < count - self.given.len() {
            self.chain.follow(&mut q);
        }
        let leading = |joint: usize| self.chain.leader(joint).map_or(joint, |(leader, _)| leader);
        let free = answer.free.iter().map(|&place| leading(places[place])).collect();
        Solution { q, free, ..answer }
    }
}
