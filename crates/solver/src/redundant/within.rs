//! One solution within limits: [`Within`].

use groebot_runtime::redundant as runtime;
use serde::Serialize;

use super::{Absence, ArmTarget, JointLimits, RedundantSolver};
use crate::Result;

/// One solution within limits, or the reason why there is none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Within {
    /// Joint values within limits, in rad or the length unit of the program.
    pub q: Option<Vec<f64>>,
    /// The reason why there is no solution; `None` with a solution.
    pub absence: Option<Absence>,
    /// Whether a solution may have been missed, as far as it is known; false with a solution.
    pub is_unsure: bool,
}

impl RedundantSolver {
    /// One solution of `target` within `limits`, by no criterion. Arcs are computed only if some values of one joint and the limits lead to no solution.
    ///
    /// # Errors
    /// As [`RedundantSolver::arcs`].
    pub fn any_within(&self, target: &ArmTarget, limits: &JointLimits) -> Result<Within> {
        Ok(self.within(&self.any_found(target, limits)?))
    }

    /// The result of the run time's search for one solution.
    pub(super) fn any_found(&self, target: &ArmTarget, limits: &JointLimits) -> Result<runtime::Within> {
        runtime::any_within(self, &target.row, &limits.rows).map_err(|error| self.refused(target, error))
    }

    /// The result with the joints that the arm has.
    pub(super) fn within(&self, found: &runtime::Within) -> Within {
        let none = |absence, is_unsure| Within { q: None, absence: Some(absence), is_unsure };
        match *found {
            runtime::Within::Solution(q) => Within { q: Some(self.values(&q)), absence: None, is_unsure: false },
            runtime::Within::Beyond { joints, is_unsure } => none(self.beyond(joints), is_unsure),
            runtime::Within::Unreachable { is_unsure } => none(Absence::Unreachable, is_unsure),
            _ => none(Absence::Unreachable, true),
        }
    }
}
