//! The two forms of a program's target: its inputs, or with each rotation matrix replaced by a quaternion.

use super::columns::{Columns, Field, Measure};
use crate::{Error, ErrorKind, Result};
use groebot_ik::solver::{Condition, Program, Unit};
use groebot_robot::spatial::rotation::{UNIT, rows_of_quaternion};

/// The forms of a program's targets.
pub struct Forms {
    /// Names of the inputs.
    full: Vec<String>,
    /// Names with `qx`, `qy`, `qz`, `qw` instead of `r11` to `r33`.
    short: Vec<String>,
    /// The index of the first input of each rotation, ascending.
    rotations: Vec<usize>,
}

impl Forms {
    /// The forms of targets of `program`.
    pub fn new(program: &Program) -> Self {
        let full: Vec<String> = program.inputs.iter().map(|input| input.name.clone()).collect();
        let rotation = |condition: &Condition| match condition {
            Condition::Rotation(first) => Some(*first),
            Condition::Unit(_) => None,
        };
        let mut rotations: Vec<usize> = program.conditions.iter().filter_map(rotation).collect();
        rotations.sort_unstable();
        let mut short = Vec::new();
        let mut next = 0;
        for &first in &rotations {
            short.extend_from_slice(&full[next..first]);
            let start = full[first].strip_suffix("r11").map_or_else(|| format!("{}_", full[first]), str::to_owned);
            short.extend(["qx", "qy", "qz", "qw"].map(|name| format!("{start}{name}")));
            next = first + 9;
        }
        short.extend_from_slice(&full[next..]);
        Forms { full, short, rotations }
    }

    /// The names of each form, the inputs first.
    pub fn names(&self) -> Vec<Vec<&str>> {
        let forms = if self.rotations.is_empty() { vec![&self.full] } else { vec![&self.full, &self.short] };
        forms.into_iter().map(|names| names.iter().map(String::as_str).collect()).collect()
    }

    /// The columns of a table of targets of `program`: either form, in the units of its inputs.
    pub fn columns(&self, program: &Program, degrees: bool) -> Columns {
        let measure = |name: &str| match program.inputs.iter().find(|input| input.name == name).map(|input| input.unit)
        {
            Some(Unit::Metre | Unit::Millimetre) => Measure::Length,
            Some(Unit::Radian) => Measure::Angle,
            Some(Unit::One) | None => Measure::Plain,
        };
        let field = |name: &str| Field { name: name.to_owned(), measure: measure(name) };
        let units = program.inputs.iter().map(|input| input.unit).chain(program.joints.iter().map(|joint| joint.unit));
        Columns {
            forms: self.names().into_iter().map(|names| names.into_iter().map(field).collect()).collect(),
            joints: program.joints.iter().map(|joint| joint.name.clone()).collect(),
            millimetres: units.into_iter().any(|unit| unit == Unit::Millimetre),
            degrees,
            skips_unsolved: false,
        }
    }

    /// Converts numbers in either form to the inputs.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a quaternion that is not of length one, or a wrong number of values where there are
    /// two forms.
    pub fn inputs(&self, numbers: Vec<f64>) -> Result<Vec<f64>> {
        if self.rotations.is_empty() || numbers.len() == self.full.len() {
            return Ok(numbers);
        }
        if numbers.len() != self.short.len() {
            let text = format!(
                "{} numbers given; give {} ({}), or {} with quaternions ({})",
                numbers.len(),
                self.full.len(),
                self.full.join(", "),
                self.short.len(),
                self.short.join(", ")
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let (mut inputs, mut next) = (Vec::new(), 0);
        for (index, &first) in self.rotations.iter().enumerate() {
            let start = first - 5 * index;
            inputs.extend_from_slice(&numbers[next..start]);
            inputs.extend(self.rotation(&numbers, start)?);
            next = start + 4;
        }
        inputs.extend_from_slice(&numbers[next..]);
        Ok(inputs)
    }

    /// The rotation matrix by rows of the quaternion `x, y, z, w` that begins at `start`.
    fn rotation(&self, numbers: &[f64], start: usize) -> Result<[f64; 9]> {
        let given = [numbers[start], numbers[start + 1], numbers[start + 2], numbers[start + 3]];
        rows_of_quaternion(given).map_err(|length| {
            let (first, last) = (&self.short[start], &self.short[start + 3]);
            let text =
                format!("the quaternion `{first}` to `{last}` has length {length}; 1 within {UNIT:e} is allowed");
            Error::new(ErrorKind::BadValue, text)
        })
    }
}
