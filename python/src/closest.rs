//! The joint values whose target has the least error, as Python sees them.

use groebot::kinematics::Target;
use groebot::solver::{Closest, ClosestOptions, ErrorWeights};
use pyo3::prelude::*;

use crate::arrays;
use crate::errors::raised;
use crate::options::TargetOptions;
use crate::redundant::{self, arm, lacks_given, one_target};
use crate::solver::Solver;
use crate::stored::Stored;

/// The closest joint values as a `groebot.Closest`.
///
/// # Errors
/// `BadValueError` for a wrong target, length or limits; of the kind `unsupported` for a solver that is not of one tip.
pub fn closest<'py>(
    py: Python<'py>,
    solver: &Solver,
    target: &Bound<'py, PyAny>,
    length: Option<f64>,
    wanted: &TargetOptions<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let stored = &solver.0;
    if lacks_given(stored, target, wanted.given)? {
        return made(py, stored, of_all_joints(py, solver, target, length, wanted)?);
    }
    let numbers = solver.one_target(target, wanted, None, None)?;
    let mut options = ClosestOptions::default();
    options.length = length;
    options.limits = solver.bounds(wanted.limits)?;
    let found = py.detach(|| match &stored.placement {
        None => stored.library().closest_numbers(&numbers, &options),
        Some(placement) => stored.library().placed(placement.placement())?.closest_numbers(&numbers, &options),
    });
    made(py, stored, found.map_err(|error| raised(&error))?)
}

/// The closest joint values of a redundant solver within limits.
fn of_all_joints(
    py: Python<'_>,
    solver: &Solver,
    target: &Bound<'_, PyAny>,
    length: Option<f64>,
    wanted: &TargetOptions<'_, '_>,
) -> PyResult<Closest> {
    let (stored, limits) = (&solver.0, wanted.limits);
    let target = one_target(stored, target, wanted.tolerance)?;
    let mut weights = ErrorWeights::default();
    weights.length = length;
    if let Some(placement) = stored.placement.as_ref().filter(|_| stored.target_shape.is_pose) {
        weights = weights.tool(placement.placement().tip_from_tool.translation.vector.into());
    }
    let found = if let Some(scan) = stored.scan() {
        let limits = solver.bounds(limits)?;
        py.detach(|| scan.closest(&target, limits.as_deref(), &weights))
    } else {
        let (arm, limits) = (arm(stored)?, redundant::limits(solver, limits)?);
        py.detach(|| arm.closest(&target, &limits, &weights))
    };
    let mut found = found.map_err(|error| raised(&error))?;
    if let (Some(placement), Some(tip)) = (&stored.placement, stored.program.tip()) {
        let layout = tip.layout();
        let world = layout.values(&found.reached).and_then(|mut numbers| {
            placement.to_world(&mut numbers);
            layout.target(&numbers)
        });
        found.reached = world.map_err(|error| raised(&error))?;
    }
    Ok(found)
}

/// A `groebot.Closest`.
fn made<'py>(py: Python<'py>, stored: &Stored, found: Closest) -> PyResult<Bound<'py, PyAny>> {
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
