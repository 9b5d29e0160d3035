//! Numeric inverse kinematics for chains without a closed form: damped least squares from many starting points. Main
//! type: [`NumericSolver`].
//!
//! Every solution is checked by forward kinematics. It is not known whether all solutions are found.

use std::cmp::Ordering;

use super::oracle::{Oracle, Unknown};
use super::{Chain, InverseKinematics, JointKind, Solution, Target};
use crate::{Error, ErrorKind, Result};

/// Number of starting points: three times that of the checks, so that solutions with small basins of attraction are
/// found too.
const SEEDS: usize = 300;

/// A numeric solver for one chain.
#[derive(Clone, Debug)]
pub struct NumericSolver {
    chain: Chain,
    /// The joints that are neither given nor mimic joints.
    unknown: Vec<usize>,
    /// The reach, or one for a chain without translation of its tip.
    length: f64,
}

impl NumericSolver {
    /// Builds the solver of `chain` for its task.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] when there are more unknown joints than task numbers; those of
    /// [`Chain::check_base`].
    pub fn new(chain: &Chain) -> Result<Self> {
        chain.check_base(None)?;
        let given = chain.given();
        let is_unknown = |joint: &usize| !given.contains(joint) && chain.leader(*joint).is_none();
        let unknown: Vec<usize> = (0..chain.joints().len()).filter(is_unknown).collect();
        if unknown.len() > chain.task().freedoms() {
            let text = format!(
                "the task `{}` leaves some of the {} unknown joints free: give the values of at least {}",
                chain.task().name(),
                unknown.len(),
                unknown.len() - chain.task().freedoms()
            );
            return Err(Error::new(ErrorKind::PositiveDimensional, text));
        }
        let reach = chain.reach();
        Ok(NumericSolver { chain: chain.clone(), unknown, length: if reach > 0.0 { reach } else { 1.0 } })
    }

    /// Searches joint values for `target`, within 1e-11 of the reach and 1e-11 rad. `given` are the values of the given
    /// joints from base to tip \[rad or the chain's unit\]. Solutions are sorted by the first joint's value. If the
    /// target leaves a joint free, there are about as many as starting points. Joint limits are used only as starting
    /// ranges of prismatic joints.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a target of another task's kind, or not finite, and unless each given joint has a
    /// finite value.
    pub fn solve(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        target.check(&self.chain)?;
        self.chain.check_given(given)?;
        let unknowns: Vec<Unknown> = self.unknown.iter().map(|&joint| self.unknown_of(joint)).collect();
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

    /// The type of a joint's unknown and its starting range: a displacement within its limits, or within the reach.
    fn unknown_of(&self, joint: usize) -> Unknown {
        let joint = &self.chain.joints()[joint];
        match (joint.kind, joint.limits) {
            (JointKind::Revolute, _) => Unknown::Angle,
            (JointKind::Prismatic, Some((low, high))) if low < high && (high - low).is_finite() => {
                Unknown::Displacement { low, high }
            }
            (JointKind::Prismatic, _) => Unknown::Displacement { low: -self.length, high: self.length },
        }
    }

    /// The residual of the tip at `q`: lengths as fractions of the reach, then rotations. Not finite if `q` is not.
    fn misses(&self, target: &Target, q: &[f64]) -> Vec<f64> {
        let Ok(reached) = Target::reached(&self.chain, q) else { return vec![f64::NAN] };
        let (position, rotation) = reached.difference(target);
        position.into_iter().map(|miss| miss / self.length).chain(rotation).collect()
    }

    fn answer(&self, target: &Target, q: Vec<f64>) -> Solution {
        let [position, rotation] = target.missed(&self.chain, &q);
        Solution { q, residual: position.max(rotation), ..Solution::default() }
    }
}

impl InverseKinematics for NumericSolver {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve(target, given)?;
        Ok(())
    }
}
