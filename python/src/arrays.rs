//! Conversion of numpy arrays to targets, joint values and limits, and back.

use groebot::{Error, ErrorKind};
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{bad_value, raised};
use crate::given::{self, GivenValues};
use crate::sink::Status;
use crate::targets::{Form, Targets};

/// Doubles in contiguous rows.
pub struct Numbers<'py> {
    pub array: Bound<'py, PyArrayDyn<f64>>,
    /// The precision of rotations in an array of this type, if it is less than that of doubles; otherwise 0.
    pub precision: f64,
}

impl<'py> Numbers<'py> {
    /// Doubles of an array, or of an object that `groebot._arrays` converts.
    ///
    /// # Errors
    /// `BadValueError` for an object that is not an array of real numbers.
    pub fn of(object: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Ok(array) = object.cast::<PyArrayDyn<f64>>()
            && array.is_c_contiguous()
        {
            return Ok(Numbers { array: array.clone(), precision: 0.0 });
        }
        let (array, precision) =
            object.py().import("groebot._arrays")?.getattr("numbers")?.call1((object,))?.extract()?;
        Ok(Numbers { array, precision })
    }

    pub fn shape(&self) -> &[usize] {
        self.array.shape()
    }

    /// All numbers.
    pub fn to_vec(&self) -> PyResult<Vec<f64>> {
        Ok(self.array.readonly().as_slice()?.to_vec())
    }
}

/// The shape of a solver's targets.
#[derive(Clone, Copy, Debug)]
pub struct TargetShape {
    /// Numbers of a target, without the values of given joints.
    pub own: usize,
    /// Number of given joints.
    pub given: usize,
    /// Index of the first number of the rotation.
    pub rotation: Option<usize>,
    /// Whether a target is one pose of the tip.
    pub is_pose: bool,
}

impl TargetShape {
    /// The targets in an array of this shape, and whether it is a single target. `names` are those of the given joints.
    ///
    /// # Errors
    /// `BadValueError` with the allowed shapes, and for another number of given values.
    pub fn targets<'a>(
        &self,
        shape: &[usize],
        data: &'a [f64],
        given: &'a GivenValues,
        tolerance: f64,
        names: impl Fn() -> Vec<String>,
    ) -> PyResult<(Targets<'a>, bool)> {
        let whole = self.own + self.given;
        let of_width = |width: usize, one: bool| {
            let form = if width == whole || width == self.own {
                Form::Numbers
            } else if self.rotation.is_some() && width == self.own - 5 {
                Form::Quaternion
            } else {
                return None;
            };
            Some((form, width, one))
        };
        let found = match *shape {
            [4, 4] if self.is_pose => Some((Form::Matrix, 16, true)),
            [_, 4, 4] if self.is_pose => Some((Form::Matrix, 16, false)),
            [3, 3] if self.own == 9 && self.rotation == Some(0) => Some((Form::Numbers, 9, true)),
            [_, 3, 3] if self.own == 9 && self.rotation == Some(0) => Some((Form::Numbers, 9, false)),
            [width] => of_width(width, true),
            [_, width] => of_width(width, false),
            _ => None,
        };
        let (form, width, one) = found.ok_or_else(|| bad_value(self.refusal(shape)))?;
        let includes_given = form == Form::Numbers && width == whole;
        let targets = Targets {
            data,
            form,
            width,
            inputs: whole,
            rotation: self.rotation,
            given: &[],
            tolerance,
            placement: None,
        };
        let expected = if includes_given { 0 } else { self.given };
        let values = given.values(expected > 0);
        if values.len() == expected || (expected > 0 && values.len() == expected * targets.len()) {
            return Ok((Targets { given: values, ..targets }, one));
        }
        let names = names();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        Err(given::refusal(&names, values.len(), expected, targets.len()))
    }

    fn refusal(&self, shape: &[usize]) -> String {
        let mut forms = Vec::new();
        if self.is_pose {
            forms.push("(4, 4)".to_owned());
        }
        if self.own == 9 && self.rotation == Some(0) {
            forms.push("(3, 3)".to_owned());
        }
        forms.push(format!("({},)", self.own));
        if self.rotation.is_some() {
            forms.push(format!("({},) with a quaternion x, y, z, w", self.own - 5));
        }
        if self.given > 0 {
            forms.push(format!("({},) with the values of given joints", self.own + self.given));
        }
        let shape = shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        format!(
            "an array of shape ({shape}) holds no targets; one target has the shape {}, and many have one axis more before",
            forms.join(" or ")
        )
    }
}

/// The rows of an array of joint values with the shape (joints,) or (N, joints), and whether it is a single row.
///
/// # Errors
/// `BadValueError` for another shape.
pub fn joint_rows(numbers: &Numbers<'_>, joints: usize, name: &str) -> PyResult<bool> {
    match *numbers.shape() {
        [width] if width == joints => Ok(true),
        [_, width] if width == joints => Ok(false),
        _ => {
            Err(bad_value(format!("`{name}` has the shape {:?}; give ({joints},), or (N, {joints})", numbers.shape())))
        }
    }
}

/// The limits in an array of shape (joints, 2).
///
/// # Errors
/// `BadValueError` for another shape, NaN, and a lower limit above the upper one.
pub fn limits(numbers: &Numbers<'_>, joints: usize) -> PyResult<Vec<[f64; 2]>> {
    if numbers.shape() != [joints, 2] {
        return Err(bad_value(format!("`limits` has the shape {:?}; give ({joints}, 2)", numbers.shape())));
    }
    let pairs: Vec<[f64; 2]> = numbers.to_vec()?.chunks(2).map(|pair| [pair[0], pair[1]]).collect();
    match pairs.iter().position(|[low, high]| low.is_nan() || high.is_nan() || low > high) {
        None => Ok(pairs),
        Some(joint) => {
            Err(bad_value(format!("`limits[{joint}]` is {:?}; give the least value, then the greatest", pairs[joint])))
        }
    }
}

/// The limits in a dict of joint names and pairs. Other joints keep those of `described`.
///
/// # Errors
/// `BadValueError` for another value, NaN, and a lower limit above the upper one; of the kind `unknown_name` for another joint.
pub fn named_limits(
    pairs: &Bound<'_, PyDict>,
    names: &[&str],
    mut described: Vec<[f64; 2]>,
) -> PyResult<Vec<[f64; 2]>> {
    for (name, pair) in pairs {
        let name: String = name.extract().map_err(|_| bad_value("the keys of `limits` must be names of joints"))?;
        let Some(joint) = names.iter().position(|own| *own == name) else {
            let text = format!("`limits`: there is no joint `{name}`; the joints are {}", names.join(", "));
            return Err(raised(&Error::new(ErrorKind::UnknownName, text)));
        };
        described[joint] = match Numbers::of(&pair)?.to_vec()?[..] {
            [low, high] if low <= high => [low, high],
            ref other => {
                let text = format!("`limits` of `{name}` are {other:?}; give the least value, then the greatest");
                return Err(bad_value(text));
            }
        };
    }
    Ok(described)
}

/// Checks that all numbers are finite.
///
/// # Errors
/// `BadValueError` with the row.
pub fn finite(data: &[f64], width: usize, name: &str) -> PyResult<()> {
    match data.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => Err(bad_value(format!("`{name}`, row {}: {} is not finite", at / width.max(1), data[at]))),
    }
}

/// Converts a list to an array of this shape.
pub fn shaped<'py, T: Element>(py: Python<'py>, list: Vec<T>, shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let flat = PyArray1::from_vec(py, list);
    if shape.len() == 1 { Ok(flat.into_any()) } else { Ok(flat.reshape(shape.to_vec())?.into_any()) }
}

/// The first rows whose status marks an invalid target: their indices, and the number of all such rows.
pub fn no_targets(status: &[u8]) -> (Vec<usize>, usize) {
    let wrong = |status: &u8| {
        ![Status::Solved, Status::Unreachable, Status::BeyondLimits, Status::Unsettled]
            .map(|own| own as u8)
            .contains(status)
    };
    let rows: Vec<usize> = (0..status.len()).filter(|row| wrong(&status[*row])).collect();
    let count = rows.len();
    (rows.into_iter().take(10).collect(), count)
}
