//! Redundant solvers: targets without the value of the given joint, and the functions of `groebot._arms` for one target. Main type: [`Question`].

use std::sync::Arc as Shared;

use groebot::solver::redundant::{Absence, ArmTarget, Best, Criterion, JointLimits, RedundantSolver};
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arcs::Arc;
use crate::arrays::{Numbers, TargetShape, finite, joint_rows, shaped};
use crate::batch::reason;
use crate::errors::{bad_value, raised, unsupported};
use crate::given::GivenValues;
use crate::kernel::Answer;
use crate::options::TargetOptions;
use crate::placed::PlacedSolver;
use crate::rotation;
use crate::scanned::ScanQuestion;
use crate::sink::Status;
use crate::solution::{Solution, answers};
use crate::solver::Solver;
use crate::stored::Stored;

/// A criterion as `groebot._arms` passes it: its name, rows of joint values, weights, the index of a joint, and its value.
pub type PassedCriterion = (String, Vec<f64>, Vec<f64>, usize, f64);

/// A target of a redundant solver, and the limits of its solutions.
pub struct Question {
    pub stored: Shared<Stored>,
    pub target: ArmTarget,
    pub limits: JointLimits,
}

impl Question {
    pub fn new(solver: &Solver, target: &Bound<'_, PyAny>, options: &TargetOptions<'_, '_>) -> PyResult<Self> {
        let target = one_target(&solver.0, target, options.tolerance)?;
        let limits = self::limits(solver, options.limits)?;
        Ok(Question { stored: Shared::clone(&solver.0), target, limits })
    }

    pub fn arm(&self) -> PyResult<&RedundantSolver> {
        arm(&self.stored)
    }

    /// The solution of joint values on the arc with this number.
    fn solution(&self, q: &[f64], arc: usize, is_unsure: bool) -> PyResult<Solution> {
        let residual = self.arm()?.residual(&self.target, q);
        Ok(Answer { q, residual, branch: arc, free: 0, chosen: true, settled: !is_unsure }.into())
    }
}

/// The redundant solver.
///
/// # Errors
/// An error of the kind `unsupported` for a solver that is not redundant, or with scanned joints.
pub fn arm(stored: &Stored) -> PyResult<&RedundantSolver> {
    let text = || {
        match stored.scanned()[..] {
        [] => "this solver is not redundant: `solve` returns all its solutions. Derive a chain with one joint more than its task determines, without `given`".to_owned(),
        ref scanned => format!(
            "the solutions of this solver are no curves: {} is scanned. There are no arcs, optima or batches; \
             use `solve`, `any_within`, `best`, `nearest` or `solve_path`",
            scanned.join(", ")
        ),
    }
    };
    stored.arm().ok_or_else(|| unsupported(text()))
}

/// One target, without the value of the given joint.
///
/// # Errors
/// As [`targets`]; `BadValueError` for several targets and for numbers that are no target.
pub fn one_target(stored: &Stored, target: &Bound<'_, PyAny>, tolerance: Option<f64>) -> PyResult<ArmTarget> {
    let (rows, one) = targets(stored, target, tolerance)?;
    if !one {
        return Err(bad_value("`target` holds many targets; use the function for batches"));
    }
    rows[0].map_err(|status| bad_value(format!("the target {}", reason(status as u8))))
}

/// Whether `target` is one of a redundant solver, without the value of the given joint.
pub fn lacks_given(stored: &Stored, target: &Bound<'_, PyAny>, given: Option<&Bound<'_, PyAny>>) -> PyResult<bool> {
    if stored.program.redundancy.is_none() || given.is_some() {
        return Ok(false);
    }
    let TargetShape { own, given, .. } = stored.target_shape;
    Ok(Numbers::of(target)?.shape().last() != Some(&(own + given)))
}

/// The targets in an array without values of the given joint, each with the fault of its form if it has one, and whether it is a single target.
///
/// # Errors
/// `BadValueError` with the allowed shapes; an error of the kind `unsupported` for a solver that is not redundant.
pub fn targets(
    stored: &Stored,
    object: &Bound<'_, PyAny>,
    tolerance: Option<f64>,
) -> PyResult<(Vec<Result<ArmTarget, Status>>, bool)> {
    let scan = stored.scan();
    let arm = if scan.is_none() { Some(arm(stored)?) } else { None };
    let checked = |numbers: &[f64]| match (scan, arm) {
        (Some(scan), _) => scan.target_of_numbers(numbers).ok(),
        (None, arm) => arm.and_then(|arm| arm.target_of_numbers(numbers).ok()),
    };
    let numbers = Numbers::of(object)?;
    let shape = TargetShape { given: 0, ..stored.target_shape };
    let borrowed = numbers.array.try_readonly()?;
    let (given, tolerance) = (GivenValues::default(), rotation::tolerance(tolerance, numbers.precision)?);
    let (rows, one) = shape.targets(numbers.shape(), borrowed.as_slice()?, &given, tolerance, Vec::new)?;
    let rows = rows.placed(stored.placement.as_ref());
    let mut out = vec![0.0; shape.own];
    let target = |row| match rows.row(row, &mut out) {
        Status::Solved => checked(&out).ok_or_else(|| fault(&shape, &out)),
        status => Err(status),
    };
    Ok(((0..rows.len()).map(target).collect(), one))
}

/// The fault of numbers that are no target.
fn fault(shape: &TargetShape, numbers: &[f64]) -> Status {
    if numbers.iter().any(|number| !number.is_finite()) {
        Status::NotFinite
    } else if shape.rotation.is_some() {
        Status::NotRotation
    } else {
        Status::NotUnit
    }
}

/// The described limits, narrowed to the requested ones.
///
/// # Errors
/// As [`Solver::bounds`] and [`RedundantSolver::limits_within`].
pub fn limits(solver: &Solver, limits: Option<&Bound<'_, PyAny>>) -> PyResult<JointLimits> {
    narrowed(&solver.0, solver.bounds(limits)?.as_deref())
}

/// The described limits, narrowed to these.
pub fn narrowed(stored: &Stored, limits: Option<&[[f64; 2]]>) -> PyResult<JointLimits> {
    let arm = arm(stored)?;
    limits.map_or(Ok(arm.limits()), |limits| arm.limits_within(limits)).map_err(|error| raised(&error))
}

/// One finite value for each joint.
///
/// # Errors
/// `BadValueError` for another shape and for values that are not finite.
pub fn joint_values(list: &Bound<'_, PyAny>, joints: usize, name: &str) -> PyResult<Vec<f64>> {
    let numbers = Numbers::of(list)?;
    if !joint_rows(&numbers, joints, name)? {
        return Err(bad_value(format!("`{name}` has many rows; give one")));
    }
    let list = numbers.to_vec()?;
    finite(&list, joints, name)?;
    Ok(list)
}

/// The criteria, one for each row of joint values.
pub fn criteria((name, q0, weights, joint, value): PassedCriterion, joints: usize) -> Vec<Criterion> {
    match name.as_str() {
        "relative_margin" => vec![Criterion::RelativeMargin],
        "manipulability" => vec![Criterion::Manipulability],
        "change" => vec![Criterion::Change { joint, value }],
        "nearest" => {
            let nearest = |q0: &[f64]| Criterion::Nearest { q0: q0.to_vec(), weights: weights.clone() };
            q0.chunks(joints).map(nearest).collect()
        }
        _ => vec![Criterion::Margin],
    }
}

/// The reason why there is no solution, as a `groebot.Reason`.
pub fn reason_of<'py>(
    py: Python<'py>,
    stored: &Stored,
    absence: Option<&Absence>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(absence) = absence else { return Ok(None) };
    let names: Vec<&str> = stored.program.joints.iter().map(|joint| joint.name.as_str()).collect();
    let beyond: Vec<&str> = match absence {
        Absence::Beyond(joints) => joints.iter().map(|joint| names[*joint]).collect(),
        _ => Vec::new(),
    };
    py.import("groebot._arms")?.getattr("reason_of")?.call1((status(Some(absence)) as u8, beyond)).map(Some)
}

/// The status of a target without solutions for this reason.
pub fn status(absence: Option<&Absence>) -> Status {
    match absence {
        None => Status::Solved,
        Some(Absence::Beyond(_)) => Status::BeyondLimits,
        Some(_) => Status::Unreachable,
    }
}

/// The best solution of each arc as `groebot.Solutions`: by the margin, or by the distance to `q0`.
///
/// # Errors
/// As [`Question::new`] and [`joint_values`].
pub fn solve<'py>(
    py: Python<'py>,
    solver: &Solver,
    target: &Bound<'py, PyAny>,
    q0: Option<&Bound<'py, PyAny>>,
    options: &TargetOptions<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let joints = solver.0.program.joints.len();
    let q0 = q0.map(|q0| joint_values(q0, joints, "q0")).transpose()?;
    if let Some(scan) = ScanQuestion::new(solver, target, options)? {
        return scan.solve(py, q0, options.as_array);
    }
    let question = Question::new(solver, target, options)?;
    let arm = question.arm()?;
    let criterion = q0.map_or(Criterion::Margin, Criterion::nearest);
    let found = py.detach(|| arm.best_by_arc(&question.target, &question.limits, &criterion));
    let found = found.map_err(|error| raised(&error))?;
    let solutions = found.best.iter().map(|best| question.solution(&best.q, best.arc, found.is_unsure));
    let solutions = answers(py, solutions.collect::<PyResult<Vec<_>>>()?, joints, options.as_array)?;
    if options.as_array {
        return Ok(solutions);
    }
    let reason = reason_of(py, &solver.0, found.absence.as_ref())?;
    py.import("groebot._arms")?.getattr("Solutions")?.call1((solutions, reason, found.is_unsure))
}

/// The solution nearest to `q0` on all arcs.
///
/// # Errors
/// As [`solve`].
pub fn nearest(
    py: Python<'_>,
    solver: &Solver,
    target: &Bound<'_, PyAny>,
    q0: &[f64],
    options: &TargetOptions<'_, '_>,
) -> PyResult<Option<Solution>> {
    if let Some(scan) = ScanQuestion::new(solver, target, options)? {
        return scan.nearest(py, q0);
    }
    let question = Question::new(solver, target, options)?;
    let (arm, criterion) = (question.arm()?, Criterion::nearest(q0.to_vec()));
    let found = py.detach(|| arm.best_by_arc(&question.target, &question.limits, &criterion));
    let found = found.map_err(|error| raised(&error))?;
    found.best.first().map(|best| question.solution(&best.q, best.arc, found.is_unsure)).transpose()
}

/// The solver of a `Solver` or a `PlacedSolver`.
pub fn solver_of(object: &Bound<'_, PyAny>) -> PyResult<Solver> {
    let stored = match object.cast::<PlacedSolver>() {
        Ok(placed) => &placed.get().inner.0,
        Err(_) => &object.cast::<Solver>()?.get().0,
    };
    Ok(Solver(Shared::clone(stored)))
}

/// One solution within limits, as a `groebot.Within`.
#[pyfunction]
#[pyo3(name = "_any_within")]
pub fn any_within<'py>(
    py: Python<'py>,
    solver: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
    limits: Option<&Bound<'py, PyAny>>,
    tolerance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let (solver, options) = (solver_of(solver)?, TargetOptions { limits, tolerance, ..TargetOptions::default() });
    if let Some(scan) = ScanQuestion::new(&solver, target, &options)? {
        return scan.any_within(py);
    }
    let question = Question::new(&solver, target, &options)?;
    let arm = question.arm()?;
    let found = py.detach(|| arm.any_within(&question.target, &question.limits)).map_err(|error| raised(&error))?;
    let q = found.q.map(|q| row(py, q)).transpose()?;
    let reason = reason_of(py, &question.stored, found.absence.as_ref())?;
    py.import("groebot._arms")?.getattr("Within")?.call1((q, reason, found.is_unsure))
}

/// All arcs of solutions within limits, as `groebot.Arcs`.
#[pyfunction]
#[pyo3(name = "_arcs")]
pub fn arcs<'py>(
    py: Python<'py>,
    solver: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
    limits: Option<&Bound<'py, PyAny>>,
    tolerance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let options = TargetOptions { limits, tolerance, ..TargetOptions::default() };
    let question = Shared::new(Question::new(&solver_of(solver)?, target, &options)?);
    let arm = question.arm()?;
    let found = py.detach(|| arm.arcs(&question.target, &question.limits)).map_err(|error| raised(&error))?;
    let arcs = found.arcs.into_iter().map(|arc| Bound::new(py, Arc::new(&question, arc)));
    let arcs = PyList::new(py, arcs.collect::<PyResult<Vec<_>>>()?)?;
    let reason = reason_of(py, &question.stored, found.absence.as_ref())?;
    let made = py.import("groebot._arms")?.getattr("Arcs")?;
    made.call1((arcs.to_tuple(), reason, found.is_unsure, found.is_surface, found.closed))
}

/// The best solution within limits by a criterion, as a `groebot.Best`; `None` without a solution.
#[pyfunction]
#[pyo3(name = "_best")]
pub fn best<'py>(
    py: Python<'py>,
    solver: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
    limits: Option<&Bound<'py, PyAny>>,
    criterion: PassedCriterion,
    tolerance: Option<f64>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let own = solver_of(solver)?;
    let options = TargetOptions { limits, tolerance, ..TargetOptions::default() };
    if let Some(scan) = ScanQuestion::new(&own, target, &options)? {
        return scan.best(py, &criteria(criterion, own.0.program.joints.len()).swap_remove(0));
    }
    Ok(optima(py, solver, target, limits, criterion, tolerance)?.iter().next())
}

/// The local optima on all arcs, each a `groebot.Best`, the best ones first.
#[pyfunction]
#[pyo3(name = "_optima")]
pub fn optima<'py>(
    py: Python<'py>,
    solver: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
    limits: Option<&Bound<'py, PyAny>>,
    criterion: PassedCriterion,
    tolerance: Option<f64>,
) -> PyResult<Bound<'py, PyList>> {
    let options = TargetOptions { limits, tolerance, ..TargetOptions::default() };
    let question = Question::new(&solver_of(solver)?, target, &options)?;
    let arm = question.arm()?;
    let criterion = criteria(criterion, arm.names().len()).swap_remove(0);
    let found = py.detach(|| arm.optima(&question.target, &question.limits, &criterion));
    let made = py.import("groebot._arms")?.getattr("Best")?;
    let best = |Best { q, value, arc, s, .. }: Best| made.call1((row(py, q)?, value, arc, s));
    let found = found.map_err(|error| raised(&error))?.into_iter().map(best);
    PyList::new(py, found.collect::<PyResult<Vec<_>>>()?)
}

/// Joint values as an array.
pub fn row(py: Python<'_>, q: Vec<f64>) -> PyResult<Bound<'_, PyAny>> {
    let count = q.len();
    shaped(py, q, &[count])
}
