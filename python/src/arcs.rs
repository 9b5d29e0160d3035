//! An arc of solutions as a Python class. Main type: [`Arc`].

use std::sync::Arc as Shared;

use groebot::solver::redundant::{self, ArcEnd};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::arrays::{Numbers, finite, shaped};
use crate::errors::{bad_value, raised};
use crate::redundant::{Question, row};

/// The maximum number of samples.
const MOST_SAMPLES: usize = 1_000_000;

/// A maximal connected curve of solutions within limits. It never changes, and any number of threads may use it.
#[pyclass(frozen, module = "groebot", name = "Arc")]
pub struct Arc {
    question: Shared<Question>,
    arc: redundant::Arc,
}

impl Arc {
    pub fn new(question: &Shared<Question>, arc: redundant::Arc) -> Self {
        Arc { question: Shared::clone(question), arc }
    }

    /// The names of the joints.
    fn names(&self) -> PyResult<Vec<&str>> {
        Ok(self.question.arm()?.names())
    }

    fn end_of<'py>(&self, py: Python<'py>, end: &ArcEnd) -> PyResult<Bound<'py, PyAny>> {
        let names = self.names()?;
        let joint = end.joint.map(|joint| names[joint]);
        let limit = end.joint.map(|_| if end.is_upper { "upper" } else { "lower" });
        py.import("groebot._arms")?.getattr("ArcEnd")?.call1((row(py, end.q.clone())?, joint, limit))
    }
}

#[pymethods]
impl Arc {
    /// Where it begins: see `groebot.ArcEnd`. For a closed curve, a point on it.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.end_of(py, &self.arc.start)
    }

    /// Where it ends: see `groebot.ArcEnd`.
    #[getter]
    fn end<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.end_of(py, &self.arc.end)
    }

    /// The length in the space of joint values [rad]. Lengths of prismatic joints are divided by the characteristic length of the solver.
    #[getter]
    fn length(&self) -> f64 {
        self.arc.length
    }

    /// Whether the curve is closed and reaches no limit.
    #[getter]
    fn is_closed(&self) -> bool {
        self.arc.is_closed
    }

    /// Whether something was not decided, such as which curve continues where two cross.
    #[getter]
    fn is_unsure(&self) -> bool {
        self.arc.is_unsure
    }

    /// Returns the joint values at distances `s` from the start, in the unit of `length`: shape (joints,) for a number, (N, joints) for N numbers. A distance is
    /// limited to the arc. Each call follows the arc again: for many distances, `sample` is faster.
    fn at<'py>(&self, py: Python<'py>, s: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let numbers = Numbers::of(s)?;
        if numbers.shape().len() > 1 {
            return Err(bad_value(format!("`s` has the shape {:?}; give a number, or (N,)", numbers.shape())));
        }
        let distances = numbers.to_vec()?;
        finite(&distances, 1, "s")?;
        let (arm, question) = (self.question.arm()?, &self.question);
        let q = py.detach(|| {
            let at = |s: &f64| arm.at(&question.target, &question.limits, &self.arc, *s);
            distances.iter().map(at).collect::<groebot::Result<Vec<_>>>()
        });
        let q = q.map_err(|error| raised(&error))?.concat();
        let joints = arm.names().len();
        if numbers.shape().is_empty() { row(py, q) } else { shaped(py, q, &[distances.len(), joints]) }
    }

    /// Returns the joint values at `n` nearly equal distances along the arc, the ends included: shape (n, joints). An angle whose range is at least one turn may
    /// differ by whole turns between neighbours. `n` is from 1 to 1,000,000.
    fn sample<'py>(&self, py: Python<'py>, n: usize) -> PyResult<Bound<'py, PyAny>> {
        if !(1..=MOST_SAMPLES).contains(&n) {
            return Err(bad_value(format!("`n` is {n}; give 1 to {MOST_SAMPLES}")));
        }
        let (arm, question) = (self.question.arm()?, &self.question);
        let q = py.detach(|| arm.samples(&question.target, &question.limits, &self.arc, n));
        shaped(py, q.map_err(|error| raised(&error))?.concat(), &[n, arm.names().len()])
    }

    /// Raises an exception, because an arc belongs to its solver.
    fn __reduce__(&self) -> PyResult<()> {
        let text = "an Arc cannot be pickled: it refers to its solver; \
                    pickle the solver and the target, or the joint values of `sample`";
        Err(PyTypeError::new_err(text))
    }

    fn __repr__(&self) -> PyResult<String> {
        let names = self.names()?;
        let ends = match (self.arc.is_closed, self.arc.start.joint, self.arc.end.joint) {
            (true, ..) => "closed".to_owned(),
            (false, None, None) => "ends not known".to_owned(),
            _ => format!("{} to {}", self.arc.start.limit_text(&names), self.arc.end.limit_text(&names)),
        };
        let unsure = if self.arc.is_unsure { ", unsure" } else { "" };
        Ok(format!("<groebot.Arc {ends}, length {:.6}{unsure}>", self.arc.length))
    }
}
