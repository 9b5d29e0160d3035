//! The joint values of a redundant arm whose target has the least error ([`Closest`]).

use super::{ArmTarget, JointLimits, RedundantSolver, ScanningSolver};
use crate::Result;
use crate::closest::{Closest, ErrorWeights, LimitedJoints};

impl RedundantSolver {
    /// The joint values within `limits` whose target has the least error: the solution of [`RedundantSolver::any_within`], else a local minimum, the best that
    /// the search over all joints finds. The error is `distance^2 + (2 length sin(angle / 2))^2`; the default of `weights` is that of a tip without a tool.
    ///
    /// [`Closest::reachable`] also holds if the search ends at a solution that `any_within` missed. Angles of joints without limits are not wrapped.
    ///
    /// # Errors
    /// As [`RedundantSolver::any_within`]. [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) for a length that is not positive;
    /// [`ErrorKind::Unsupported`](crate::ErrorKind::Unsupported) for a position with pitch and roll.
    pub fn closest(&self, target: &ArmTarget, limits: &JointLimits, weights: &ErrorWeights) -> Result<Closest> {
        let solution = self.any_within(target, limits)?.q.map(|q| self.all_joints(&q));
        let mut pairs = vec![[0.0; 2]; self.own.len() + self.held.len()];
        self.own.iter().zip(limits.pairs()).for_each(|(&joint, pair)| pairs[joint] = *pair);
        let mut found = self.closest_over(target, &self.own, &pairs, (weights, solution))?;
        found.q = self.own.iter().map(|&joint| found.q[joint]).collect();
        Ok(found)
    }

    /// The closest joint values of all joints of the chain, where `unknown` ones are within `limits`, and the others are held. A `solution` is the result.
    fn closest_over(
        &self,
        target: &ArmTarget,
        unknown: &[usize],
        limits: &[[f64; 2]],
        (weights, solution): (&ErrorWeights, Option<Vec<f64>>),
    ) -> Result<Closest> {
        let (inputs, count) = self.inputs(&target.row, 0.0);
        self.main().closest_over(&inputs[..count], &LimitedJoints { unknown, limits }, weights, solution)
    }
}

impl ScanningSolver {
    /// The joint values within limits whose target has the least error, as [`RedundantSolver::closest`]. The search moves the scanned joints, too. `limits` is
    /// that of [`ScanningSolver::any_within`].
    ///
    /// # Errors
    /// As [`RedundantSolver::closest`] and [`ScanningSolver::any_within`].
    pub fn closest(&self, target: &ArmTarget, limits: Option<&[[f64; 2]]>, weights: &ErrorWeights) -> Result<Closest> {
        let solution = self.any_within(target, limits)?.q;
        let narrow = |(joint, [low, high]): (usize, [f64; 2])| match limits {
            Some(limits) => [low.max(limits[joint][0]), high.min(limits[joint][1])],
            None => [low, high],
        };
        let pairs: Vec<[f64; 2]> = self.limits().into_iter().enumerate().map(narrow).collect();
        let all: Vec<usize> = (0..pairs.len()).collect();
        self.zero.closest_over(target, &all, &pairs, (weights, solution))
    }
}
