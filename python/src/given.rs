//! The values of given joints, as numbers in the order of `Solver.given` or by name. Main type: [`GivenValues`].

use numpy::PyUntypedArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use groebot::{Error, ErrorKind};

use crate::arrays::Numbers;
use crate::errors::{bad_value, raised};
use crate::stored::Stored;

/// The values of given joints: one row for all targets, or one row for each.
#[derive(Default)]
pub struct GivenValues {
    /// The requested values.
    own: Option<Vec<f64>>,
    /// The values of the reference joint values, for targets without requested ones.
    default: Vec<f64>,
}

impl GivenValues {
    /// The requested values, and those of `q0` (one or several rows of all joints) as their default.
    ///
    /// # Errors
    /// `BadValueError` for values that are not numbers, and for a dict without the value of a given joint; of the kind `unknown_name` for other joints.
    pub fn new(stored: &Stored, given: Option<&Bound<'_, PyAny>>, q0: Option<&[f64]>) -> PyResult<Self> {
        let Some(given) = given else {
            let joints = stored.program.joints.len();
            let default = q0.filter(|_| stored.target_shape.given > 0).map(|q0| of_rows(stored, q0, joints));
            return Ok(GivenValues { own: None, default: default.unwrap_or_default() });
        };
        let own = match given.cast::<PyDict>() {
            Ok(values) => by_name(values, &stored.given())?,
            Err(_) => Numbers::of(given)?.to_vec()?,
        };
        Ok(GivenValues { own: Some(own), default: Vec::new() })
    }

    /// The values for targets that need some or none.
    pub fn values(&self, are_needed: bool) -> &[f64] {
        match &self.own {
            Some(own) => own,
            None if are_needed => &self.default,
            None => &[],
        }
    }
}

/// The values of the given joints in rows of all joints.
fn of_rows(stored: &Stored, rows: &[f64], joints: usize) -> Vec<f64> {
    let given = &stored.program.given_joints;
    rows.chunks(joints).flat_map(|q| given.iter().map(|given| q[given.joint])).collect()
}

/// The values in a dict of names and numbers, or arrays of shape (N,).
fn by_name(values: &Bound<'_, PyDict>, names: &[&str]) -> PyResult<Vec<f64>> {
    let mut columns: Vec<Option<Vec<f64>>> = vec![None; names.len()];
    for (name, value) in values {
        let name: String = name.extract().map_err(|_| bad_value("the keys of `given` must be names of joints"))?;
        let Some(place) = names.iter().position(|own| *own == name) else {
            let text = format!("`given`: joint `{name}` is not given in this solver; {}", needed(names));
            return Err(raised(&Error::new(ErrorKind::UnknownName, text)));
        };
        let numbers = Numbers::of(&value)?;
        if numbers.array.ndim() > 1 {
            return Err(bad_value(format!(
                "`given[\"{name}\"]` has the shape {:?}; give a number, or (N,)",
                numbers.shape()
            )));
        }
        columns[place] = Some(numbers.to_vec()?);
    }
    let missing = || names.iter().zip(&columns).filter(|(_, column)| column.is_none()).map(|(name, _)| *name);
    if let Some(name) = missing().next() {
        return Err(bad_value(format!("`given` has no value of joint `{name}`; {}", needed(names))));
    }
    let columns: Vec<Vec<f64>> = columns.into_iter().flatten().collect();
    let rows = columns.iter().map(Vec::len).max().unwrap_or(0);
    match columns.iter().position(|column| column.len() != rows && column.len() != 1) {
        None => Ok((0..rows).flat_map(|row| columns.iter().map(move |column| column[row % column.len()])).collect()),
        Some(joint) => {
            let text =
                format!("`given[\"{}\"]` has {} values and another joint {rows}", names[joint], columns[joint].len());
            Err(bad_value(format!("{text}; give one for all targets, or one for each")))
        }
    }
}

/// The given joints, in words.
pub fn needed(names: &[&str]) -> String {
    match names {
        [] => "this solver has no given joints".to_owned(),
        names => format!("the given joints are {}", names.join(", ")),
    }
}

/// The error for a number of values that does not fit.
pub fn refusal(names: &[&str], values: usize, expected: usize, targets: usize) -> PyErr {
    let [first, ..] = names else { return bad_value(format!("`given` has {values} values; {}", needed(names))) };
    if expected == 0 {
        return bad_value(format!("the targets include the values of {}; do not give `given=`", names.join(", ")));
    }
    let text = match values {
        0 => format!("the solver needs the value of joint {} with each target", names.join(" and of joint ")),
        _ => format!("`given` has {values} values for {targets} targets and the joints {}", names.join(", ")),
    };
    bad_value(format!(
        "{text}; give {expected} for all or as many for each, such as `given={{\"{first}\": 0.5}}`, or `q0=`"
    ))
}
