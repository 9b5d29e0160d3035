//! Many targets of a redundant solver, on several threads. Main type: [`Rows`].

use groebot::solver::redundant::{Absence, ArmTarget, BestByArc, Criterion, JointLimits};
use groebot::{ErrorKind, Result};
use numpy::{PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::shaped;
use crate::batch::reason;
use crate::errors::bad_value;
use crate::many::{Wanted, check_rows, front, reference, refuse, room};
use crate::redundant::{PassedCriterion, arm, criteria, limits, narrowed, solver_of, status, targets};
use crate::sink::Status;
use crate::solver::Solver;
use crate::stored::Stored;
use crate::work::{threads, watched};

/// Many targets and the limits of their solutions.
struct Rows<'a> {
    stored: &'a Stored,
    /// Each target, or the fault of its form.
    rows: Vec<std::result::Result<ArmTarget, Status>>,
    limits: JointLimits,
    threads: usize,
}

/// The result of a row, and its status.
type Row<T> = (Status, Option<T>);

impl<'a> Rows<'a> {
    fn new(
        stored: &'a Stored,
        object: &Bound<'_, PyAny>,
        limits: JointLimits,
        threads: usize,
        tolerance: Option<f64>,
    ) -> PyResult<Self> {
        let (rows, one) = targets(stored, object, tolerance)?;
        if one {
            return Err(bad_value("`targets` holds one target; give it an axis more: targets[None]"));
        }
        Ok(Rows { stored, rows, limits, threads })
    }

    /// The results of the valid targets, with those of the other rows between them. With `strict`, other rows are an error.
    fn merged<T>(&self, found: Vec<Result<T>>, is_strict: bool) -> PyResult<Vec<Row<T>>> {
        let mut found = found.into_iter();
        let row = |row: &std::result::Result<ArmTarget, Status>| match row.map(|_| found.next()) {
            Err(status) => (status, None),
            Ok(Some(Ok(own))) => (Status::Solved, Some(own)),
            Ok(Some(Err(error))) if error.kind() == ErrorKind::Unsupported => (Status::Open, None),
            Ok(_) => (Status::Unsettled, None),
        };
        let rows: Vec<Row<T>> = self.rows.iter().map(row).collect();
        if is_strict {
            let status: Vec<u8> = rows.iter().map(|(status, _)| *status as u8).collect();
            refuse(&status, |_, status| reason(status).to_owned())?;
        }
        Ok(rows)
    }

    fn valid(&self) -> Vec<ArmTarget> {
        self.rows.iter().filter_map(|row| row.ok()).collect()
    }

    /// The best solution of each arc by row.
    fn best_by_arc(&self, py: Python<'_>, criteria: Vec<Criterion>, is_strict: bool) -> PyResult<Vec<Row<BestByArc>>> {
        let targets = self.valid();
        let criteria: Vec<Criterion> = match criteria.len() {
            1 => criteria,
            _ => criteria.into_iter().zip(&self.rows).filter(|(_, row)| row.is_ok()).map(|(own, _)| own).collect(),
        };
        let arm = arm(self.stored)?;
        let found = watched(py, None, self.threads, |watch| {
            if targets.is_empty() {
                return Ok(Vec::new());
            }
            arm.best_by_arc_batch(&targets, &self.limits, &criteria, watch)
        })?;
        self.merged(found, is_strict)
    }

    fn joints(&self) -> usize {
        self.stored.program.joints.len()
    }
}

/// Results of targets, one row for each.
#[derive(Default)]
struct Columns {
    q: Vec<f64>,
    status: Vec<u8>,
    /// Bit `j` is set where joint `j` is beyond its limits.
    beyond: Vec<u32>,
    unsure: Vec<bool>,
}

impl Columns {
    /// Adds a row with joint values, which are NaN without a solution.
    fn add(&mut self, joints: usize, q: Option<&[f64]>, (own, absence, is_unsure): (Status, Option<&Absence>, bool)) {
        match q {
            Some(q) => self.q.extend_from_slice(q),
            None => self.q.extend(std::iter::repeat_n(f64::NAN, joints)),
        }
        let beyond = match absence {
            Some(Absence::Beyond(joints)) => joints.iter().fold(0, |bits, joint| bits | 1 << joint),
            _ => 0,
        };
        self.status.push(if own == Status::Solved { status(absence) } else { own } as u8);
        self.beyond.push(beyond);
        self.unsure.push(is_unsure);
    }

    /// The arrays q, status, beyond, unsure.
    fn arrays<'py>(self, py: Python<'py>, joints: usize) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let rows = self.status.len();
        Ok(vec![
            shaped(py, self.q, &[rows, joints])?,
            shaped(py, self.status, &[rows])?,
            shaped(py, self.beyond, &[rows])?,
            shaped(py, self.unsure, &[rows])?,
        ])
    }
}

/// One solution of each target: the arrays q, status, beyond, unsure.
#[pyfunction]
#[pyo3(name = "_any_within_batch")]
pub fn any_within_batch<'py>(
    py: Python<'py>,
    solver: &Bound<'py, PyAny>,
    targets: &Bound<'py, PyAny>,
    limits: Option<&Bound<'py, PyAny>>,
    threads: Option<i64>,
    strict: bool,
    tolerance: Option<f64>,
) -> PyResult<Bound<'py, PyTuple>> {
    let solver = solver_of(solver)?;
    let rows = Rows::new(&solver.0, targets, self::limits(&solver, limits)?, self::threads(threads)?, tolerance)?;
    let (arm, valid) = (arm(&solver.0)?, rows.valid());
    let found = watched(py, None, rows.threads, |watch| arm.any_within_batch(&valid, &rows.limits, watch))?;
    let mut columns = Columns::default();
    for (status, own) in rows.merged(found, strict)? {
        let own = own.as_ref();
        let absence = own.and_then(|own| own.absence.as_ref());
        let q = own.and_then(|own| own.q.as_deref());
        columns.add(rows.joints(), q, (status, absence, own.is_some_and(|own| own.is_unsure)));
    }
    PyTuple::new(py, columns.arrays(py, rows.joints())?)
}

/// The best solution of each target: the arrays q, status, beyond, unsure, value, arc, s.
#[pyfunction]
#[pyo3(name = "_best_batch")]
#[expect(clippy::too_many_arguments, reason = "the package calls it with all of them")]
pub fn best_batch<'py>(
    py: Python<'py>,
    solver: &Bound<'py, PyAny>,
    targets: &Bound<'py, PyAny>,
    limits: Option<&Bound<'py, PyAny>>,
    criterion: PassedCriterion,
    threads: Option<i64>,
    strict: bool,
    tolerance: Option<f64>,
) -> PyResult<Bound<'py, PyTuple>> {
    let solver = solver_of(solver)?;
    let rows = Rows::new(&solver.0, targets, self::limits(&solver, limits)?, self::threads(threads)?, tolerance)?;
    let criteria = criteria(criterion, rows.joints());
    if criteria.len() != 1 && criteria.len() != rows.rows.len() {
        let text =
            format!("`q0` has {} rows; give one, or one for each of {} targets", criteria.len(), rows.rows.len());
        return Err(bad_value(text));
    }
    let mut columns = Columns::default();
    let (mut values, mut arcs, mut distances) = (Vec::new(), Vec::new(), Vec::new());
    for (status, own) in rows.best_by_arc(py, criteria, strict)? {
        let own = own.as_ref();
        let best = own.and_then(|own| own.best.first());
        let absence = own.and_then(|own| own.absence.as_ref());
        columns.add(
            rows.joints(),
            best.map(|best| &best.q[..]),
            (status, absence, own.is_some_and(|own| own.is_unsure)),
        );
        values.push(best.map_or(f64::NAN, |best| best.value));
        arcs.push(best.map_or(-1, |best| best.arc as i64));
        distances.push(best.map_or(f64::NAN, |best| best.s));
    }
    let count = values.len();
    let mut arrays = columns.arrays(py, rows.joints())?;
    arrays.extend([shaped(py, values, &[count])?, shaped(py, arcs, &[count])?, shaped(py, distances, &[count])?]);
    PyTuple::new(py, arrays)
}

/// The arrays q, starts, residual, branch, free, status of the best solution of each arc, or with `near` of the nearest solution.
///
/// # Errors
/// As [`crate::many::solve_batch`].
pub fn solve_batch<'py>(
    py: Python<'py>,
    solver: &Solver,
    targets: &Bound<'py, PyAny>,
    wanted: &Wanted<'_, 'py>,
) -> PyResult<Bound<'py, PyTuple>> {
    let stored = &*solver.0;
    let rows = Rows::new(stored, targets, narrowed(stored, wanted.limits)?, wanted.threads, wanted.tolerance)?;
    let near = wanted.near.map(|near| reference(near, rows.joints())).transpose()?;
    check_rows(near.as_deref(), rows.joints(), rows.rows.len())?;
    let criteria = near.as_ref().map_or(vec![Criterion::Margin], |near| {
        near.chunks(rows.joints()).map(|q0| Criterion::nearest(q0.to_vec())).collect()
    });
    let (mut q, mut starts, mut status) = (Vec::new(), vec![0_i64], Vec::new());
    let (mut residual, mut branch) = (Vec::new(), Vec::new());
    for ((own, found), target) in rows.best_by_arc(py, criteria, wanted.strict)?.into_iter().zip(&rows.rows) {
        if let (Some(found), Ok(target)) = (&found, target) {
            for best in found.best.iter().take(if near.is_some() { 1 } else { usize::MAX }) {
                q.extend_from_slice(&best.q);
                residual.push(arm(stored)?.residual(target, &best.q));
                branch.push(best.arc as i32);
            }
        }
        starts.push(branch.len() as i64);
        status.push(batch_status(own, found.as_ref()) as u8);
    }
    let (count, targets) = (branch.len(), status.len());
    let arrays = [
        filled(py, q, count, rows.joints(), wanted.out)?,
        shaped(py, starts, &[targets + 1])?,
        shaped(py, residual, &[count])?,
        shaped(py, branch, &[count])?,
        shaped(py, vec![0_u32; count], &[count])?,
        shaped(py, status, &[targets])?,
    ];
    PyTuple::new(py, arrays)
}

/// The status of a row of solutions: `Unsettled` where others may be missing.
fn batch_status(own: Status, found: Option<&BestByArc>) -> Status {
    match found {
        Some(found) if found.is_unsure => Status::Unsettled,
        Some(found) => status(found.absence.as_ref()),
        None => own,
    }
}

/// Joint values as an array, or in the first rows of the caller's array.
fn filled<'py>(
    py: Python<'py>,
    q: Vec<f64>,
    rows: usize,
    joints: usize,
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let Some(out) = out else { return shaped(py, q, &[rows, joints]) };
    let out: Bound<'py, PyArray2<f64>> = room(out, joints)?;
    if out.shape()[0] < rows {
        return Err(bad_value(format!("`out` has too few rows for {rows} solutions")));
    }
    out.try_readwrite()?.as_slice_mut()?[..q.len()].copy_from_slice(&q);
    out.into_any().get_item(front(py, rows)?)
}
