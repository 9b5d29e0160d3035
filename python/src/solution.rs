//! A solution as a Python class. Main type: [`Solution`].

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use smallvec::SmallVec;

use crate::arrays::shaped;
use crate::errors::bad_value;
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
    /// solver determine their turns. The array is read-only; `solution.q.copy()` and `numpy.array(solution)` can be changed.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let q = PyArray1::from_slice(py, &self.q);
        q.readwrite().make_nonwriteable();
        q
    }

    /// The joint values as a new array, so that numpy's functions take a solution, or a list of solutions.
    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__<'py>(
        &self,
        py: Python<'py>,
        dtype: Option<&Bound<'py, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if copy == Some(false) {
            return Err(bad_value("a solution becomes an array by a copy; do not give copy=False"));
        }
        let q = PyArray1::from_slice(py, &self.q).into_any();
        dtype.map_or(Ok(q.clone()), |dtype| q.call_method1("astype", (dtype,)))
    }

    #[expect(clippy::type_complexity, reason = "what pickle wants")]
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, (Vec<f64>, f64, usize, u32, bool, bool))> {
        let again = py.import("groebot._groebot")?.getattr("_solution")?;
        Ok((again, (self.q.to_vec(), self.residual, self.branch, self.free, self.chosen, self.settled)))
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

/// The solution with these values, as pickle stores them. Bit `j` of `free` is set where joint `j` is free.
#[pyfunction]
#[pyo3(name = "_solution")]
pub fn solution(q: Vec<f64>, residual: f64, branch: usize, free: u32, chosen: bool, settled: bool) -> Solution {
    Solution { q: SmallVec::from_vec(q), residual, branch, free, chosen, settled }
}

/// A list of solutions, or their joint values as an array (solutions, joints).
pub fn answers(py: Python<'_>, found: Vec<Solution>, joints: usize, as_array: bool) -> PyResult<Bound<'_, PyAny>> {
    if as_array {
        let rows: Vec<f64> = found.iter().flat_map(|solution| solution.q.iter().copied()).collect();
        return shaped(py, rows, &[found.len(), joints]);
    }
    let list = found.into_iter().map(|answer| Bound::new(py, answer)).collect::<PyResult<Vec<_>>>()?;
    Ok(PyList::new(py, list)?.into_any())
}
