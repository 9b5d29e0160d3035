//! Solvers with scanned joints: arms with two to four joints more than their task determines, such as an arm on a rail. Main type: [`ScanQuestion`].

use std::sync::Arc as Shared;

use groebot::solver::redundant::{ArmTarget, Criterion, Scanned, ScanningSolver};
use pyo3::prelude::*;

use crate::errors::raised;
use crate::kernel::Answer;
use crate::options::TargetOptions;
use crate::redundant::{one_target, reason_of, row};
use crate::solution::{Solution, answers};
use crate::solver::Solver;
use crate::stored::Stored;

/// A target of a solver with scanned joints, and the limits of its solutions.
pub struct ScanQuestion<'a> {
    stored: &'a Shared<Stored>,
    scan: &'a ScanningSolver,
    target: ArmTarget,
    limits: Option<Vec<[f64; 2]>>,
}

impl<'a> ScanQuestion<'a> {
    /// The question for a target; `None` for a solver without scanned joints.
    ///
    /// # Errors
    /// `BadValueError` for a wrong target or limits.
    pub fn new(
        solver: &'a Solver,
        target: &Bound<'_, PyAny>,
        options: &TargetOptions<'_, '_>,
    ) -> PyResult<Option<Self>> {
        let Some(scan) = solver.0.scan() else { return Ok(None) };
        let target = one_target(&solver.0, target, options.tolerance)?;
        Ok(Some(ScanQuestion { stored: &solver.0, scan, target, limits: solver.bounds(options.limits)? }))
    }

    /// The best solution by a criterion.
    fn found(&self, py: Python<'_>, criterion: &Criterion) -> PyResult<Scanned> {
        let limits = self.limits.as_deref();
        py.detach(|| self.scan.best(&self.target, limits, criterion)).map_err(|error| raised(&error))
    }

    fn solution(&self, q: &[f64]) -> Solution {
        let residual = self.scan.residual(&self.target, q);
        Answer { q, residual, branch: 0, free: 0, chosen: true, settled: true }.into()
    }

    /// The solution with the largest margin, or the nearest to `q0`, as `groebot.Solutions` or an array.
    pub fn solve<'py>(&self, py: Python<'py>, q0: Option<Vec<f64>>, as_array: bool) -> PyResult<Bound<'py, PyAny>> {
        let found = self.found(py, &q0.map_or(Criterion::Margin, Criterion::nearest))?;
        let solutions = found.q.iter().map(|q| self.solution(q)).collect();
        let solutions = answers(py, solutions, self.stored.program.joints.len(), as_array)?;
        if as_array {
            return Ok(solutions);
        }
        let reason = reason_of(py, self.stored, found.absence.as_ref())?;
        py.import("groebot._arms")?.getattr("Solutions")?.call1((solutions, reason, true))
    }

    /// The solution nearest to `q0`.
    pub fn nearest(&self, py: Python<'_>, q0: &[f64]) -> PyResult<Option<Solution>> {
        Ok(self.found(py, &Criterion::nearest(q0.to_vec()))?.q.map(|q| self.solution(&q)))
    }

    /// One solution, as a `groebot.Within`.
    pub fn any_within<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let limits = self.limits.as_deref();
        let found = py.detach(|| self.scan.any_within(&self.target, limits)).map_err(|error| raised(&error))?;
        let is_unsure = found.q.is_none();
        let q = found.q.map(|q| row(py, q)).transpose()?;
        let reason = reason_of(py, self.stored, found.absence.as_ref())?;
        py.import("groebot._arms")?.getattr("Within")?.call1((q, reason, is_unsure))
    }

    /// The best solution by a criterion, as a `groebot.Best` without an arc.
    pub fn best<'py>(&self, py: Python<'py>, criterion: &Criterion) -> PyResult<Option<Bound<'py, PyAny>>> {
        let found = self.found(py, criterion)?;
        let Some(q) = found.q else { return Ok(None) };
        let made = py.import("groebot._arms")?.getattr("Best")?;
        made.call1((row(py, q)?, found.value, -1, f64::NAN)).map(Some)
    }
}
