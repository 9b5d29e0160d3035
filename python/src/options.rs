//! Options of one target, and what the methods of [`Solver`] have in common: targets, limits. Main type: [`TargetOptions`].

use std::sync::Arc;

use groebot::solver::TaskPlacement;
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{self, Numbers};
use crate::errors::{bad_value, raised};
use crate::given::GivenValues;
use crate::kernel::Answer;
use crate::rotation;
use crate::sink::Status;
use crate::solution::Solution;
use crate::solver::Solver;
use crate::stored::Stored;

/// Options of one target.
#[derive(Clone, Copy, Default)]
pub struct TargetOptions<'a, 'py> {
    /// The values of the given joints.
    pub given: Option<&'a Bound<'py, PyAny>>,
    pub limits: Option<&'a Bound<'py, PyAny>>,
    /// Largest deviation of a rotation that is projected.
    pub tolerance: Option<f64>,
    /// Whether solutions are returned as an array.
    pub as_array: bool,
}

impl Solver {
    pub fn of(stored: Stored) -> Self {
        Solver(Arc::new(stored))
    }

    /// The solutions of one target. Values of given joints are by default those of `q0`.
    pub fn found(
        &self,
        target: &Bound<'_, PyAny>,
        options: &TargetOptions<'_, '_>,
        q0: Option<&[f64]>,
        bounds: Option<&[[f64; 2]]>,
    ) -> PyResult<Vec<Solution>> {
        let numbers = self.one_target(target, options, q0, self.0.placement.as_ref())?;
        let (kernel, mut all) = (&self.0.kernel, Vec::with_capacity(8));
        let solved = match bounds {
            None => kernel.solve(&numbers, &mut |answer| all.push(answer.into())),
            Some(limits) => kernel
                .solve_within(&numbers, limits)
                .map(|found| all.extend(found.iter().map(|answer| Solution::from(Answer::from(answer))))),
        };
        solved.map(|()| all).map_err(|error| raised(&error))
    }

    /// The numbers of one target, converted by a placement. Values of given joints are by default those of `q0`.
    pub fn one_target(
        &self,
        target: &Bound<'_, PyAny>,
        options: &TargetOptions<'_, '_>,
        q0: Option<&[f64]>,
        placement: Option<&TaskPlacement>,
    ) -> PyResult<Vec<f64>> {
        let numbers = Numbers::of(target)?;
        let given = GivenValues::new(&self.0, options.given, q0)?;
        let tolerance = rotation::tolerance(options.tolerance, numbers.precision)?;
        let borrowed = numbers.array.try_readonly()?;
        let (shape, names) = (self.0.target_shape, || self.0.given_names());
        let (targets, one) = shape.targets(numbers.shape(), borrowed.as_slice()?, &given, tolerance, names)?;
        if !one {
            return Err(bad_value("`target` holds many targets; use solve_batch"));
        }
        let targets = targets.placed(placement);
        let mut out = vec![0.0; targets.inputs];
        match targets.row(0, &mut out) {
            Status::Solved => Ok(out),
            status => Err(bad_value(format!("the target {}", targets.reason(0, status as u8)))),
        }
    }

    /// The requested limits: those of an array, with `True` those of the description, or these with the pairs of a dict.
    ///
    /// # Errors
    /// `BadValueError` for `True` without described limits, and for an invalid array or dict.
    pub fn bounds(&self, limits: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Vec<[f64; 2]>>> {
        let Some(limits) = limits else { return Ok(None) };
        if let Ok(pairs) = limits.cast::<PyDict>() {
            let names: Vec<&str> = self.0.program.joints.iter().map(|joint| joint.name.as_str()).collect();
            return arrays::named_limits(pairs, &names, self.0.program.limits()).map(Some);
        }
        match limits.extract::<bool>() {
            Ok(true) => self.described_limits().map(Some),
            Ok(false) => Ok(None),
            Err(_) => arrays::limits(&Numbers::of(limits)?, self.0.program.joints.len()).map(Some),
        }
    }

    /// The limits of the description.
    fn described_limits(&self) -> PyResult<Vec<[f64; 2]>> {
        let limits = self.0.program.limits();
        if limits.iter().flatten().any(|limit| limit.is_finite()) {
            return Ok(limits);
        }
        let text = format!(
            "`limits=True`: the description of {} has no limits of joints; give an array ({}, 2), or a dict of joint names and pairs such as {{\"{}\": (-3.1, 3.1)}}",
            self.name(),
            limits.len(),
            self.0.program.joints.first().map_or("joint", |joint| &joint.name)
        );
        Err(bad_value(text))
    }
}
