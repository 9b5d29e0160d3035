//! The joint values whose target has the least error, as Python sees them.

use groebot::kinematics::Target;
use groebot::solver::ClosestOptions;
use pyo3::prelude::*;

use crate::arrays;
use crate::errors::raised;
use crate::solver::Solver;

/// The closest joint values as a `groebot.Closest`.
///
/// # Errors
/// `BadValueError` for a wrong target, length or limits; of the kind `unsupported` for a solver that is not of one tip.
pub fn closest<'py>(
    py: Python<'py>,
    solver: &Solver,
    target: &Bound<'py, PyAny>,
    length: Option<f64>,
    given: Option<&Bound<'py, PyAny>>,
    limits: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let stored = &solver.0;
    let numbers = solver.one_target(target, given, None)?;
    let mut options = ClosestOptions::default();
    options.length = length;
    options.limits = solver.bounds(limits)?;
    let found = py.detach(|| match &stored.placement {
        None => stored.library().closest_numbers(&numbers, &options),
        Some(placement) => stored.library().placed(placement.placement())?.closest_numbers(&numbers, &options),
    });
    let found = found.map_err(|error| raised(&error))?;
    let q = arrays::shaped(py, found.q.clone(), &[found.q.len()])?;
    let reached = match found.reached {
        Target::Pose(pose) => arrays::shaped(py, pose.to_homogeneous().transpose().as_slice().to_vec(), &[4, 4])?,
        other => {
            let numbers = stored.program.tip().and_then(|tip| tip.layout().values(&other).ok()).unwrap_or_default();
            let count = numbers.len();
            arrays::shaped(py, numbers, &[count])?
        }
    };
    let arguments =
        (q, reached, found.distance, found.angle, found.reachable, found.is_minimum, found.starts, found.agreeing);
    py.import("groebot._records")?.getattr("Closest")?.call1(arguments)
}
