//! A solution as a Python class. Main type: [`Solution`].

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use smallvec::SmallVec;

use crate::kernel::Answer;

/// One solution: joint values that move the tip to its target.
#[pyclass(frozen, freelist = 64, module = "groebot", name = "Solution")]
pub struct Solution {
    pub q: SmallVec<[f64; 7]>,
    residual: f64,
    branch: usize,
    free: u32,
    chosen: bool,
    settled: bool,
}

impl From<Answer<'_>> for Solution {
    fn from(answer: Answer<'_>) -> Self {
        let Answer { q, residual, branch, free, chosen, settled } = answer;
        Solution { q: SmallVec::from_slice(q), residual, branch, free, chosen, settled }
    }
}

#[pymethods]
impl Solution {
    /// The joint values, base to tip, in radians or the solver's unit of length; shape (joints,). Angles are in (-pi, pi], unless limits, `q0` or a redundant
    /// solver determine their turns. Each call returns a new array.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.q)
    }

    /// The largest residual of the equations at `q`, in their own unit.
    #[getter]
    fn residual(&self) -> f64 {
        self.residual
    }

    /// Branch number: which roots of which equations were used. A branch keeps its number from target to target. Of a redundant solver it is the index of the
    /// solution's arc among those of `arcs`.
    #[getter]
    fn branch(&self) -> usize {
        self.branch
    }

    /// The free joints (indices from 0) of a singular target: each can have any value, with other values of the other
    /// joints.
    #[getter]
    fn free<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.free_joints())
    }

    /// Whether the source of the mechanism would select this solution.
    #[getter]
    fn chosen(&self) -> bool {
        self.chosen
    }

    /// Whether all polishing steps were completed. If false, other solutions may be missing, and `residual` shows the accuracy of this one. Of a redundant
    /// solver it is false if the arcs of the target are unsure.
    #[getter]
    fn settled(&self) -> bool {
        self.settled
    }

    fn __repr__(&self) -> String {
        let free = self.free_joints();
        let free = if free.is_empty() { String::new() } else { format!(", free={free:?}") };
        format!("Solution(q={:?}, residual={:e}, branch={}{free})", self.q.as_slice(), self.residual, self.branch)
    }
}

impl Solution {
    fn free_joints(&self) -> Vec<usize> {
        (0..self.q.len()).filter(|joint| self.free >> joint & 1 == 1).collect()
    }
}
