//! One answer, as Python sees it. Main type: [`Solution`].

use groebot::kinematics;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// One answer: joint values that bring the tip to its target.
#[pyclass(frozen, module = "groebot", name = "Solution")]
pub struct Solution(pub kinematics::Solution);

#[pymethods]
impl Solution {
    /// The joint values, base to tip, in radians in (-pi, pi] or the solver's unit of length; shape (joints,). A new array at each call.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.q)
    }

    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    #[getter]
    fn residual(&self) -> f64 {
        self.0.residual
    }

    /// Which roots of which equations it comes from: a branch keeps its number from target to target.
    #[getter]
    fn branch(&self) -> usize {
        self.0.branch
    }

    /// The joints, from 0, that may take any value at this singular target, the others changing along.
    #[getter]
    fn free<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, &self.0.free)
    }

    /// Whether the source of the mechanism would choose this one.
    #[getter]
    fn chosen(&self) -> bool {
        self.0.chosen
    }

    fn __repr__(&self) -> String {
        let kinematics::Solution { q, residual, branch, free, .. } = &self.0;
        let free = if free.is_empty() { String::new() } else { format!(", free={free:?}") };
        format!("Solution(q={q:?}, residual={residual:e}, branch={branch}{free})")
    }
}
