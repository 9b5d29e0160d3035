//! The best solution on each arc, and many targets at once: [`BestByArc`].

use rayon::prelude::*;
use serde::Serialize;

use super::{Absence, ArmTarget, Best, Criterion, JointLimits, RedundantSolver, Within};
use crate::{Error, ErrorKind, Result, Watch};

/// The best solution on each arc of a target, or the reason why there is none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BestByArc {
    /// One solution for each arc, the best ones first.
    pub best: Vec<Best>,
    /// The reason why there is no solution; `None` with solutions.
    pub absence: Option<Absence>,
    /// Whether arcs may be missing, or an arc is unsure.
    pub is_unsure: bool,
}

impl RedundantSolver {
    /// The best solution of `target` on each arc within `limits`. The first one is that of [`RedundantSolver::best`].
    ///
    /// # Errors
    /// As [`RedundantSolver::best`].
    pub fn best_by_arc(&self, target: &ArmTarget, limits: &JointLimits, criterion: &Criterion) -> Result<BestByArc> {
        let arcs = self.arcs(target, limits)?;
        let of_arc = |(index, arc)| {
            let best = self.best_on(target, limits, std::slice::from_ref(arc), criterion)?;
            Ok(best.map(|best| Best { arc: index, ..best }))
        };
        let best = arcs.arcs.iter().enumerate().map(of_arc).collect::<Result<Vec<_>>>()?;
        let mut best: Vec<Best> = best.into_iter().flatten().collect();
        if criterion.is_least_best() {
            best.sort_by(|a, b| a.value.total_cmp(&b.value));
        } else {
            best.sort_by(|a, b| b.value.total_cmp(&a.value));
        }
        Ok(BestByArc { best, absence: arcs.absence, is_unsure: arcs.is_unsure })
    }

    /// [`RedundantSolver::any_within`] of many targets, in their order, on rayon's threads. The results are those of single targets, with their errors.
    ///
    /// # Errors
    /// The error of `watch` if it stops the work.
    pub fn any_within_batch<'w>(
        &self,
        targets: &[ArmTarget],
        limits: &JointLimits,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Vec<Result<Within>>> {
        each(targets, Watch::or_none(watch), |_, target| self.any_within(target, limits))
    }

    /// [`RedundantSolver::best_by_arc`] of many targets, in their order, on rayon's threads. `criteria` has one criterion for all targets, or one for each. The
    /// results are those of single targets, with their errors.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of criteria, and for a criterion with values that do not fit the joints. The error of `watch` if it stops the
    /// work.
    pub fn best_by_arc_batch<'w>(
        &self,
        targets: &[ArmTarget],
        limits: &JointLimits,
        criteria: &[Criterion],
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Vec<Result<BestByArc>>> {
        if criteria.len() != 1 && criteria.len() != targets.len() {
            let text = format!("{} criteria for {} targets; give one, or one each", criteria.len(), targets.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        criteria.iter().try_for_each(|criterion| self.run_time_criterion(criterion).map(drop))?;
        each(targets, Watch::or_none(watch), |index, target| {
            self.best_by_arc(target, limits, if criteria.len() == 1 { &criteria[0] } else { &criteria[index] })
        })
    }

    /// The largest magnitude among the equations' values of `target` at joint values `q`, in the equations' own unit: zero where `q` reaches the target. NaN for
    /// another number of joint values, and where equations read numbers that follow from no joint.
    pub fn residual(&self, target: &ArmTarget, q: &[f64]) -> f64 {
        let Some(given) = q.get(self.arm.scanned) else { return f64::NAN };
        let (inputs, count) = self.inputs(&target.row, *given);
        self.main().residual(&inputs[..count], &self.all_joints(q))
    }
}

/// The results of all targets, in order.
fn each<T: Send>(
    targets: &[ArmTarget],
    watch: &Watch,
    solve: impl Fn(usize, &ArmTarget) -> Result<T> + Sync,
) -> Result<Vec<Result<T>>> {
    let solve = |(index, target): (usize, &ArmTarget)| watch.check().map(|()| solve(index, target));
    targets.par_iter().enumerate().map(solve).collect()
}
