//! The error of joint values for a target, with its gradient. Main type: [`Measure`].

use std::f64::consts::FRAC_1_SQRT_2;

use groebot_robot::kinematics::{Target, Task};

use super::ErrorWeights;
use crate::Solver;
use crate::prepared::{Outline, ReachedNumbers};
use crate::{Error, ErrorKind, Result};

/// The ratio of consecutive weights.
const WEIGHTS: f64 = 10.0;

/// The error of joint values: the squared norm of residuals, lengths and weighted chords of angles, as fractions of the scale.
#[derive(Clone)]
pub(super) struct Measure<'a> {
    solver: &'a Solver,
    task: Task,
    /// The number of residuals that are lengths.
    lengths: usize,
    /// The numbers of the target, and their features.
    target: Vec<f64>,
    goal: Vec<f64>,
    /// The translation of the tool in the tip frame.
    lever: [f64; 3],
    /// The weight of a chord, in units of the scale.
    weight: f64,
    /// Joint values with those of given joints that are not unknown.
    given: Vec<f64>,
    /// The joints that the search may move.
    pub unknown: Vec<usize>,
}

pub(super) fn unsupported() -> Error {
    let text = "closest joint values need a solver of one tip whose equations compare each number of the target with the joints; \
                derive one chain (`groebot derive CHAIN`) instead of equations or of several chains";
    Error::new(ErrorKind::Unsupported, text)
}

impl<'a> Measure<'a> {
    /// The error for `target`, whose numbers are valid. The search may move the `unknown` joints.
    pub fn new(solver: &'a Solver, target: &[f64], weights: &ErrorWeights, unknown: Vec<usize>) -> Result<Self> {
        let outline = &solver.outline;
        let task = outline.task.ok_or_else(unsupported)?;
        let joints = &outline.joints;
        let value = |joint: &super::super::prepared::JointOutline| joint.given.map_or(0.0, |input| target[input]);
        let mut measure = Measure {
            solver,
            task,
            lengths: task.layout().lengths(),
            target: pairs_of(task, &target[..outline.own]),
            goal: Vec::new(),
            lever: weights.tool,
            weight: weights.length.unwrap_or(outline.scale) / outline.scale,
            given: joints.iter().map(value).collect(),
            unknown,
        };
        measure.goal = measure.features(&measure.target);
        measure.reached_numbers(&measure.given, false).ok_or_else(unsupported)?;
        Ok(measure)
    }

    /// The same error with smaller weights of rotation, ascending, then this one. A large weight makes a narrow curved valley, along which Newton's method is
    /// slow; the minimum moves little from one weight to the next.
    pub fn by_weight(self) -> Vec<Self> {
        let mut measures = Vec::new();
        let mut weight = 1.0;
        while self.lengths > 0 && weight < self.weight {
            let mut easier = Measure { weight, ..self.clone() };
            easier.goal = easier.features(&easier.target);
            measures.push(easier);
            weight *= WEIGHTS;
        }
        measures.push(self);
        measures
    }

    pub fn outline(&self) -> &Outline {
        &self.solver.outline
    }

    fn reached_numbers(&self, q: &[f64], with_derivatives: bool) -> Option<ReachedNumbers> {
        self.solver.reached_numbers(q, with_derivatives)
    }

    /// All joint values for those of the unknown joints.
    pub fn whole(&self, values: &[f64]) -> Vec<f64> {
        let mut q = self.given.clone();
        self.unknown.iter().zip(values).for_each(|(&joint, value)| q[joint] = *value);
        self.outline().follow(&mut q);
        q
    }

    /// The squared norm of the residuals at `q`; `None` if it is not finite.
    pub fn error(&self, q: &[f64]) -> Option<f64> {
        let features = self.features(&self.reached_numbers(q, false)?.values);
        let error: f64 = features.iter().zip(&self.goal).map(|(a, b)| (a - b) * (a - b)).sum();
        error.is_finite().then_some(error)
    }

    /// Half the gradient of the error by the unknown joints, in units of the step of each ([`Measure::unit`]).
    pub fn gradient(&self, values: &[f64]) -> Option<Vec<f64>> {
        let q = self.whole(values);
        let reached = self.reached_numbers(&q, true)?;
        let features = self.features(&reached.values);
        let residuals: Vec<f64> = features.iter().zip(&self.goal).map(|(a, b)| a - b).collect();
        let along = |joint: usize| -> f64 {
            let moved = self.features(&reached.by_joint[joint]);
            moved.iter().zip(&residuals).map(|(a, b)| a * b).sum()
        };
        let all: Vec<f64> = (0..q.len()).map(along).collect();
        let of = |&joint: &usize| (all[joint] + self.outline().followed(joint, &all)) * self.unit(joint);
        Some(self.unknown.iter().map(of).collect())
    }

    /// The unit of a joint in the search: 1 rad, or the scale.
    pub fn unit(&self, joint: usize) -> f64 {
        if self.outline().joints[joint].is_angle { 1.0 } else { self.outline().scale }
    }

    /// The features of reached numbers: lengths in units of the scale, then numbers whose differences are chords, weighted. They are linear.
    fn features(&self, numbers: &[f64]) -> Vec<f64> {
        let (lengths, rest) = numbers.split_at(self.lengths);
        let scale = self.outline().scale;
        let mut features: Vec<f64> = lengths.iter().map(|length| length / scale).collect();
        match self.task {
            Task::Pose => {
                let lever = |row: usize| (0..3).map(|k| rest[3 * row + k] * self.lever[k]).sum::<f64>() / scale;
                features.iter_mut().enumerate().for_each(|(row, feature)| *feature += lever(row));
                features.extend(rest.iter().map(|entry| FRAC_1_SQRT_2 * self.weight * entry));
            }
            Task::Rotation => features.extend(rest.iter().map(|entry| FRAC_1_SQRT_2 * self.weight * entry)),
            _ => features.extend(rest.iter().map(|entry| self.weight * entry)),
        }
        features
    }

    /// The distance from the target in the unit of the inputs, and the angle \[rad\].
    pub fn missed(&self, q: &[f64]) -> Option<[f64; 2]> {
        let features = self.features(&self.reached_numbers(q, false)?.values);
        let norm =
            |part: &[f64], goal: &[f64]| part.iter().zip(goal).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        let (lengths, chords) = features.split_at(self.lengths);
        let (at, along) = self.goal.split_at(self.lengths);
        let half = norm(chords, along) / self.weight / 2.0;
        // The sum of no numbers is a negative zero.
        Some([norm(lengths, at) * self.outline().scale + 0.0, 2.0 * half.min(1.0).asin() + 0.0])
    }

    /// The target that `q` reaches, base_from_tip.
    pub fn reached(&self, q: &[f64]) -> Option<Target> {
        self.task.layout().target(&self.solver.reached(q)?[..self.outline().own]).ok()
    }
}

/// The numbers of a target, where an angle is its cosine and sine.
fn pairs_of(task: Task, target: &[f64]) -> Vec<f64> {
    match task {
        Task::PlanarPose { .. } | Task::PositionYaw { .. } => {
            let (lengths, angles) = target.split_at(task.layout().lengths());
            lengths.iter().copied().chain(angles.iter().flat_map(|angle| [angle.cos(), angle.sin()])).collect()
        }
        _ => target.to_vec(),
    }
}
