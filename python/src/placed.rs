//! A solver with a base and a tool, as Python sees it. Main type: [`PlacedSolver`].

use groebot::solver::Placement;
use groebot::spatial::Pose;
use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};
use pyo3::prelude::*;

use crate::arrays::{self, Numbers};
use crate::errors::{bad_value, raised};
use crate::rotation;
use crate::solution::Solution;
use crate::solver::Solver;
use crate::stored::Stored;

/// How far the last row of a matrix may be off 0, 0, 0, 1.
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
        tolerance: Option<f64>,
    ) -> PyResult<PlacedSolver> {
        let (base, world_from_base) = pose(base, "base", tolerance)?;
        let (tool, tip_from_tool) = pose(tool, "tool", tolerance)?;
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

    /// Same as `Solver.name`.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// Same as `Solver.task`.
    #[getter]
    fn task(&self) -> String {
        self.inner.task()
    }

    /// Same as `Solver.inputs`.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        self.inner.inputs()
    }

    /// Same as `Solver.given`.
    #[getter]
    fn given(&self) -> Vec<String> {
        self.inner.given()
    }

    /// Same as `Solver.limits`.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.inner.limits(py)
    }

    #[expect(clippy::type_complexity, reason = "what pickle wants")]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, Bound<'py, PyAny>, Bound<'py, PyAny>))> {
        let again = py.import("groebot._records")?.getattr("_placed")?;
        Ok((again, (self.inner.to_json(), self.base(py)?, self.tool(py)?)))
    }

    /// Same as `Solver.is_redundant`.
    #[getter]
    fn is_redundant(&self) -> bool {
        self.inner.is_redundant()
    }

    /// Same as `Solver.solve`.
    #[pyo3(signature = (target, *, q0=None, given=None, limits=None, tolerance=None, as_array=false))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
        given: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
        tolerance: Option<f64>,
        as_array: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.solve(py, target, q0, given, limits, tolerance, as_array)
    }

    /// Same as `Solver.nearest`.
    #[pyo3(signature = (target, q0, *, given=None, limits=None, tolerance=None))]
    fn nearest(
        &self,
        py: Python<'_>,
        target: &Bound<'_, PyAny>,
        q0: &Bound<'_, PyAny>,
        given: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Option<Solution>> {
        self.inner.nearest(py, target, q0, given, limits, tolerance)
    }

    /// Same as `Solver.solve_batch`.
    #[pyo3(signature = (targets, *, given=None, layout="ragged", limits=None, near=None, out=None, dtype=None, threads=None, strict=false, tolerance=None))]
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
        threads: Option<i64>,
        strict: bool,
        tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.solve_batch(py, targets, given, layout, limits, near, out, dtype, threads, strict, tolerance)
    }

    /// Same as `Solver.closest`; the error is that of the tool.
    #[pyo3(signature = (target, *, length=None, given=None, limits=None, tolerance=None))]
    fn closest<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        length: Option<f64>,
        given: Option<&Bound<'py, PyAny>>,
        limits: Option<&Bound<'py, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.closest(py, target, length, given, limits, tolerance)
    }

    /// Same as `Solver.forward`: world_from_tool.
    fn forward<'py>(&self, py: Python<'py>, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.inner.forward(py, q)
    }

    /// Same as `Solver.solve_path`.
    #[pyo3(signature = (poses, q0=None, *, dt=None, times=None, speeds=None, limits=None, given=None, tolerance=None))]
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
        given: Option<&Bound<'py, PyAny>>,
        tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.inner.solve_path(py, poses, q0, dt, times, speeds, limits, given, tolerance)
    }
}

/// The pose of a matrix (4, 4), or of a position and a quaternion (7,); the identity without one.
fn pose(given: Option<&Bound<'_, PyAny>>, name: &str, tolerance: Option<f64>) -> PyResult<([f64; 16], Pose)> {
    let identity = std::array::from_fn(|i| if i % 5 == 0 { 1.0 } else { 0.0 });
    let Some(given) = given else { return Ok((identity, Pose::identity())) };
    let numbers = Numbers::of(given)?;
    let (list, tolerance) = (numbers.to_vec()?, rotation::tolerance(tolerance, numbers.precision)?);
    if let Some(value) = list.iter().find(|value| !value.is_finite()) {
        return Err(bad_value(format!("`{name}` has the value {value}; give finite numbers")));
    }
    let (at, turn) = match *numbers.shape() {
        [4, 4] => of_matrix(&list, name, tolerance)?,
        [7] => of_quaternion(&list, name, tolerance)?,
        ref shape => {
            let text = format!("`{name}` has the shape {shape:?}; give a matrix (4, 4), or a position and a rotation");
            return Err(bad_value(text));
        }
    };
    let matrix = std::array::from_fn(|i| match (i / 4, i % 4) {
        (3, j) => {
            if j == 3 {
                1.0
            } else {
                0.0
            }
        }
        (i, 3) => at[i],
        (i, j) => turn[3 * i + j],
    });
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_row_slice(&turn));
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    Ok((matrix, Pose::from_parts(Translation3::from(at), rotation)))
}

/// The position and the rotation, row by row, of the 16 entries of a matrix.
fn of_matrix(list: &[f64], name: &str, tolerance: f64) -> PyResult<([f64; 3], [f64; 9])> {
    if list[12..].iter().zip([0.0, 0.0, 0.0, 1.0]).any(|(value, wanted)| (value - wanted).abs() > OFF) {
        return Err(bad_value(format!("the last row of `{name}` is {:?}; give 0, 0, 0, 1", &list[12..])));
    }
    let mut turn = std::array::from_fn(|i| list[4 * (i / 3) + i % 3]);
    if rotation::project(&mut turn, tolerance) {
        return Ok(([list[3], list[7], list[11]], turn));
    }
    let text = match rotation::matrix_deviation(&turn) {
        Some(off) => format!("`{name}` has {}", rotation::refusal(off, tolerance)),
        None => format!("the rotation of `{name}` is off by more than 0.1; give a right-handed rotation matrix"),
    };
    Err(bad_value(text))
}

/// The position and the rotation, row by row, of a position and a quaternion x, y, z, w.
fn of_quaternion(list: &[f64], name: &str, tolerance: f64) -> PyResult<([f64; 3], [f64; 9])> {
    let turn = rotation::matrix_of_quaternion([list[3], list[4], list[5], list[6]], tolerance).ok_or_else(|| {
        bad_value(match rotation::quaternion_deviation(&list[3..]) {
            Some(off) => format!("`{name}` has {}", rotation::refusal(off, tolerance)),
            None => format!("the quaternion of `{name}` is off by more than 0.1; give x, y, z, w of length one"),
        })
    })?;
    Ok(([list[0], list[1], list[2]], turn))
}
