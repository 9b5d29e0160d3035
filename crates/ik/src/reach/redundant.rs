//! Targets of a redundant arm, without the value of its given joint. Main type: [`AnyWithin`].

use super::request::{Measure, Request};
use crate::solver::Program;
use crate::solver::redundant::{JointLimits, RedundantSolver, ScanningSolver};
use crate::{Error, ErrorKind, Result};

/// The search for one solution within limits.
pub(super) enum AnyWithin {
    /// Of an arm with one joint more than its task determines.
    Curves(Box<RedundantSolver>, JointLimits),
    /// Of an arm with scanned joints.
    Scanned(Box<ScanningSolver>, Vec<[f64; 2]>),
}

/// Whether a target has a solution within limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    Solution,
    Nothing,
    /// None was found, but one may exist.
    Unsure,
}

impl AnyWithin {
    /// The search for a program with a redundancy whose joint has no given value, within `limits` that narrow the described ones; `None` for other programs.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for another measure than [`Measure::Limits`]; as [`RedundantSolver::limits_within`] for limits.
    pub(super) fn new(program: &Program, request: &Request) -> Result<Option<Self>> {
        if !request.lacks_given(program) {
            return Ok(None);
        }
        if request.measure != Measure::Limits {
            let text = format!(
                "targets of {} have curves of solutions: the measure `{}` needs the values of {} (given); \
                 without them the measure `limits` is allowed",
                program.name,
                request.measure.name(),
                program.given_names().join(", ")
            );
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let limits = match &request.limits {
            Some(limits) => limits.clone(),
            None => Request::described(program)?,
        };
        if let Some(solver) = program.scanning_solver() {
            solver.check_limits(&limits)?;
            return Ok(Some(AnyWithin::Scanned(Box::new(solver), limits)));
        }
        let Some(solver) = program.redundant_solver() else { return Ok(None) };
        let limits = solver.limits_within(&limits)?;
        Ok(Some(AnyWithin::Curves(Box::new(solver), limits)))
    }

    /// Searches for the target with these numbers.
    ///
    /// # Errors
    /// As [`RedundantSolver::target_of_numbers`] and [`RedundantSolver::any_within`].
    pub(super) fn find(&self, numbers: &[f64]) -> Result<Found> {
        let (is_found, is_unsure) = match self {
            AnyWithin::Curves(solver, limits) => {
                let found = solver.any_within(&solver.target_of_numbers(numbers)?, limits)?;
                (found.q.is_some(), found.is_unsure)
            }
            AnyWithin::Scanned(solver, limits) => {
                let found = solver.any_within(&solver.target_of_numbers(numbers)?, Some(limits))?;
                (found.q.is_some(), false)
            }
        };
        Ok(match (is_found, is_unsure) {
            (true, _) => Found::Solution,
            (false, true) => Found::Unsure,
            (false, false) => Found::Nothing,
        })
    }
}
