//! Inverse kinematics by search, for chains that nothing solves in closed form: damped least squares from many starts. Main type:
//! [`NumericSolver`].
//!
//! Every answer is checked by forward kinematics; nothing tells whether they are all.

use std::cmp::Ordering;

use super::oracle::{Oracle, Unknown};
use super::screw::{Solution, Target};
use super::{Chain, JointKind};
use crate::spatial::{angle, vertical};
use crate::{Error, ErrorKind, Result};

/// Starting points: three times those of the checks, so that what is seldom reached is found too.
const SEEDS: usize = 300;

/// A search for the joint values of one chain.
#[derive(Clone, Debug)]
pub struct NumericSolver {
    chain: Chain,
    /// The joints that are not given and follow no others.
    unknown: Vec<usize>,
    /// The reach, or one for a chain that only turns its tip.
    length: f64,
}

impl NumericSolver {
    /// The search in `chain` for its task.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] when there are more unknown joints than the task asks for numbers.
    pub fn new(chain: &Chain) -> Result<Self> {
        let given = chain.given();
        let is_unknown = |joint: &usize| !given.contains(joint) && chain.leader(*joint).is_none();
        let unknown: Vec<usize> = (0..chain.joints().len()).filter(is_unknown).collect();
        if unknown.len() > chain.task().freedoms() {
            let text = format!(
                "the `{}` task leaves some of the {} unknown joints free: give the values of at least {}",
                chain.task().name(),
                unknown.len(),
                unknown.len() - chain.task().freedoms()
            );
            return Err(Error::new(ErrorKind::PositiveDimensional, text));
        }
        let reach = chain.reach();
        Ok(NumericSolver { chain: chain.clone(), unknown, length: if reach > 0.0 { reach } else { 1.0 } })
    }

    /// Joint values that bring the tip to `target` within 1e-11 of the reach and 1e-11 rad, with the values `given` of the given joints from
    /// the base \[rad or the chain's unit\]: those that are found, by the first joint's value. Where the target leaves a joint free there are
    /// about as many as starting points. Joint limits only say where slides are sought.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a target of another task's kind, or not finite, and unless each given joint has a finite value.
    pub fn solve(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        target.check(&self.chain)?;
        self.chain.check_given(given)?;
        let unknowns: Vec<Unknown> = self.unknown.iter().map(|&joint| self.sought(joint)).collect();
        let mut start = vec![0.0; self.chain.joints().len()];
        self.chain.given_inputs().into_iter().zip(given).for_each(|(joint, value)| start[joint] = *value);
        let whole = |values: &[f64]| {
            let mut q = start.clone();
            self.unknown.iter().zip(values).for_each(|(&joint, value)| q[joint] = *value);
            self.chain.follow(&mut q);
            q
        };
        let oracle = Oracle { seeds: SEEDS, ..Oracle::default() };
        let found = oracle.search(&unknowns, |values| self.misses(target, &whole(values)))?;
        let mut answers: Vec<Solution> = found.iter().map(|answer| self.answer(target, whole(&answer.q))).collect();
        answers.sort_by(|a, b| a.q.partial_cmp(&b.q).unwrap_or(Ordering::Equal));
        for (index, answer) in answers.iter_mut().enumerate() {
            answer.branch = index;
        }
        Ok(answers)
    }

    /// How a joint is sought: a slide within its limits, or within the reach.
    fn sought(&self, joint: usize) -> Unknown {
        let joint = &self.chain.joints()[joint];
        match (joint.kind, joint.limits) {
            (JointKind::Revolute, _) => Unknown::Angle,
            (JointKind::Prismatic, Some((low, high))) if low < high && (high - low).is_finite() => {
                Unknown::Displacement { low, high }
            }
            (JointKind::Prismatic, _) => Unknown::Displacement { low: -self.length, high: self.length },
        }
    }

    /// What the tip at `q` misses: lengths as shares of the reach, then what turns. Not finite where `q` is not.
    fn misses(&self, target: &Target, q: &[f64]) -> Vec<f64> {
        let Ok(reached) = Target::reached(&self.chain, q) else { return vec![f64::NAN] };
        let (position, rotation) = difference(&reached, target);
        position.into_iter().map(|miss| miss / self.length).chain(rotation).collect()
    }

    fn answer(&self, target: &Target, q: Vec<f64>) -> Solution {
        let norm = |part: &[f64]| part.iter().map(|miss| miss * miss).sum::<f64>().sqrt();
        let reached = Target::reached(&self.chain, &q);
        let (position, rotation) = reached.map_or_else(|_| Default::default(), |reached| difference(&reached, target));
        Solution {
            q,
            free: Vec::new(),
            position_residual: norm(&position),
            rotation_residual: norm(&rotation),
            branch: 0,
        }
    }
}

/// What `reached` differs by from `target`, which is of the same kind: lengths, then numbers that for small turns have the angle \[rad\] as
/// their norm.
fn difference(reached: &Target, target: &Target) -> (Vec<f64>, Vec<f64>) {
    let turn = |a: &nalgebra::UnitQuaternion<f64>, b: &nalgebra::UnitQuaternion<f64>| {
        let difference = a.to_rotation_matrix().matrix() - b.to_rotation_matrix().matrix();
        difference.iter().map(|entry| entry * std::f64::consts::FRAC_1_SQRT_2).collect::<Vec<f64>>()
    };
    let list = |vector: nalgebra::Vector3<f64>| vector.iter().copied().collect::<Vec<f64>>();
    match (reached, target) {
        (Target::Pose(a), Target::Pose(b)) => {
            (list(a.translation.vector - b.translation.vector), turn(&a.rotation, &b.rotation))
        }
        (Target::Position(a), Target::Position(b)) => (list(a - b), Vec::new()),
        (Target::Ray { point, direction }, Target::Ray { point: to, direction: along }) => {
            (list(point - to), list(direction - along))
        }
        (
            Target::PositionPitchRoll { point, pitch, roll },
            Target::PositionPitchRoll { point: to, pitch: other, roll: rolled },
        ) => (list(point - to), list(vertical(*pitch, *roll) - vertical(*other, *rolled))),
        (Target::Direction(a), Target::Direction(b)) => (Vec::new(), list(a - b)),
        (Target::Rotation(a), Target::Rotation(b)) => (Vec::new(), turn(a, b)),
        (Target::PlanarPosition(a), Target::PlanarPosition(b)) => (vec![a[0] - b[0], a[1] - b[1]], Vec::new()),
        (Target::PlanarPose(a), Target::PlanarPose(b)) => {
            (vec![a[0] - b[0], a[1] - b[1]], vec![angle::difference(a[2], b[2])])
        }
        _ => (Vec::new(), vec![f64::NAN]),
    }
}
