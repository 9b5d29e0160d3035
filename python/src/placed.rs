//! A solver with a base and a tool, as Python sees it. Main type: [`PlacedSolver`].

use groebot::solver::Placement;
use groebot::spatial::Pose;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arrays::{self, Numbers};
use crate::errors::{bad_value, raised};
use crate::solution::Solution;
use crate::solver::Solver;
use crate::stored::Stored;

/// How far a rotation may be off, and the last row of a matrix from 0, 0, 0, 1.
const OFF: f64 = 1e-9;

/// A solver whose base is placed in a world frame, and whose tip has a tool: targets are those of the tool in the world frame, world_from_tool.
///
/// Its methods are those of `groebot.Solver`. It never changes, and any number of threads may use it.
#[pyclass(frozen, module = "groebot", name = "PlacedSolver")]
pub struct PlacedSolver {
    pub inner: Solver,
    base: [f64; 16],
    tool: [f64; 16],
}

impl PlacedSolver {
    pub fn new(
        stored: &Stored,
        base: Option<&Bound<'_, PyAny>>,
        tool: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<PlacedSolver> {
        let (base, world_from_base) = pose(base, "base")?;
        let (tool, tip_from_tool) = pose(tool, "tool")?;
        let placement = Placement::default().base(world_from_base).tool(tip_from_tool);
        let placed = stored.placed(&placement).map_err(|error| raised(&error))?;
        Ok(PlacedSolver { inner: Solver::of(placed), base, tool })
    }
}

#[pymethods]
impl PlacedSolver {
    fn __repr__(&self) -> String {
        format!("<groebot.PlacedSolver {}>", self.inner.0.program.name)
    }

    /// The pose world_from_base, (4, 4).
    #[getter]
    fn base<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        arrays::shaped(py, self.base.to_vec(), &[4, 4])
    }

    /// The pose tip_from_tool, (4, 4).
    #[getter]
    fn tool<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        arrays::shaped(py, self.tool.to_vec(), &[4, 4])
    }

    /// Same as `Solver.joints`.
    #[getter]
    fn joints(&self) -> Vec<String> {
        self.inner.joints()
    }

    /// Same as `Solver.is_redundant`.
    #[getter]
    fn is_redundant(&self) -> bool {
        self.inner.is_redundant()
    }

    /// Same as `Solver.solve`.
    #[pyo3(signature = (target, *, q0=None, given=None, limits=None))]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
        given: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyList>> {
        self.inner.solve(py, target, q0, given, limits)
    }

    /// Same as `Solver.nearest`.
    #[pyo3(signature = (target, q0, *, given=None, limits=None))]
    fn nearest(
        &self,
        py: Python<'_>,
        target: &Bound<'_, PyAny>,
        q0: &Bound<'_, PyAny>,
        given: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Option<Solution>> {
        self.inner.nearest(py, target, q0, given, limits)
    }

    /// Same as `Solver.solve_batch`.
    #[pyo3(signature = (targets, *, given=None, layout="ragged", limits=None, near=None, out=None, dtype=None, threads=None, strict=false))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn solve_batch<'py>(
        &self,
        py: Python<'py>,
        targets: &Bound<'py, PyAny>,
        given: Option<&Bound<'py, PyAny>>,
        layout: &str,
        limits: Option<&Bound<'py, PyAny>>,
        near: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        dtype: Option<&Bound<'py, PyAny>>,
        threads: Option<usize>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.solve_batch(py, targets, given, layout, limits, near, out, dtype, threads, strict)
    }

    /// Same as `Solver.closest`; the error is that of the tool.
    #[pyo3(signature = (target, *, length=None, given=None, limits=None))]
    fn closest<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        length: Option<f64>,
        given: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.closest(py, target, length, given, limits)
    }

    /// Same as `Solver.forward`: world_from_tool.
    fn forward<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.inner.forward(py, q)
    }

    /// Same as `Solver.solve_path`.
    #[pyo3(signature = (poses, q0=None, *, dt=None, times=None, speeds=None, limits=None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn solve_path<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
        dt: Option<f64>,
        times: Option<&Bound<'py, PyAny>>,
        speeds: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.solve_path(py, poses, q0, dt, times, speeds, limits)
    }
}

/// The pose of a matrix (4, 4); the identity without one.
fn pose(matrix: Option<&Bound<'_, PyAny>>, name: &str) -> PyResult<([f64; 16], Pose)> {
    let identity = std::array::from_fn(|i| if i % 5 == 0 { 1.0 } else { 0.0 });
    let Some(matrix) = matrix else { return Ok((identity, Pose::identity())) };
    let numbers = Numbers::of(matrix)?;
    if numbers.shape() != [4, 4] {
        return Err(bad_value(format!("`{name}` has the shape {:?}; give a matrix (4, 4)", numbers.shape())));
    }
    let list = numbers.to_vec()?;
    if let Some(value) = list.iter().find(|value| !value.is_finite()) {
        return Err(bad_value(format!("`{name}` has the value {value}; give finite numbers")));
    }
    if list[12..].iter().zip([0.0, 0.0, 0.0, 1.0]).any(|(value, wanted)| (value - wanted).abs() > OFF) {
        return Err(bad_value(format!("the last row of `{name}` is {:?}; give 0, 0, 0, 1", &list[12..])));
    }
    let turn = Matrix3::from_fn(|i, j| list[4 * i + j]);
    let off = (turn.transpose() * turn - Matrix3::identity()).amax();
    if off > OFF || turn.determinant() < 0.0 {
        let text = format!("the rotation of `{name}` is off by {off:.1e}; give a right-handed rotation within 1e-9");
        return Err(bad_value(text));
    }
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    let at = Translation3::new(list[3], list[7], list[11]);
    Ok((std::array::from_fn(|i| list[i]), Pose::from_parts(at, rotation)))
}
