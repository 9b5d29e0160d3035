//! Inverse kinematics by search, for chains that nothing solves in closed form: damped least squares from many starts. Main type:
//! [`NumericSolver`].
//!
//! Every answer is checked by forward kinematics; nothing tells whether they are all.

use std::cmp::Ordering;

use super::oracle::{Oracle, Unknown};
use super::{Chain, InverseKinematics, JointKind, Solution, Target};
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
    /// [`ErrorKind::PositiveDimensional`] when there are more unknown joints than the task asks for numbers; as [`Chain::check_base`].
    pub fn new(chain: &Chain) -> Result<Self> {
        chain.check_base(None)?;
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
