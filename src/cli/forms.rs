//! The two forms of a program's target: its inputs, or with each rotation matrix replaced by a quaternion.

use super::columns::{Columns, Field};
use crate::{Error, ErrorKind, Result};
use groebot_ik::solver::{Condition, Program, Unit};
use groebot_robot::kinematics::Quantity;
use groebot_robot::spatial::rotation::{UNIT, rows_of_quaternion};

/// The forms of a program's targets.
pub struct Forms {
    /// The inputs.
    full: Vec<Field>,
    /// The inputs with `qx`, `qy`, `qz`, `qw` instead of `r11` to `r33`.
    short: Vec<Field>,
    /// The index of the first input of each rotation, ascending.
    rotations: Vec<usize>,
}

impl Forms {
    /// The forms of targets of `program`.
    pub fn new(program: &Program) -> Self {
        let full = fields(program);
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
            let prefix = prefix(program, first);
            let part = |name: &str| Field::new(&format!("{prefix}{name}"), Quantity::Number);
            short.extend(["qx", "qy", "qz", "qw"].map(part));
            next = first + 9;
        }
        short.extend_from_slice(&full[next..]);
        Forms { full, short, rotations }
    }

    fn forms(&self) -> Vec<&Vec<Field>> {
        if self.rotations.is_empty() { vec![&self.full] } else { vec![&self.full, &self.short] }
    }

    /// The names of each form, the inputs first.
    pub fn names(&self) -> Vec<Vec<&str>> {
        self.forms().into_iter().map(|form| form.iter().map(|field| field.name.as_str()).collect()).collect()
    }

    /// The columns of a table of targets of `program`: either form, in the units of its inputs.
    pub fn columns(&self, program: &Program, degrees: bool) -> Columns {
        let units = program.inputs.iter().map(|input| input.unit).chain(program.joints.iter().map(|joint| joint.unit));
        Columns {
            forms: self.forms().into_iter().cloned().collect(),
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
                self.names()[0].join(", "),
                self.short.len(),
                self.names()[1].join(", ")
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
            let (first, last) = (&self.short[start].name, &self.short[start + 3].name);
            let text =
                format!("the quaternion `{first}` to `{last}` has length {length}; 1 within {UNIT:e} is allowed");
            Error::new(ErrorKind::BadValue, text)
        })
    }
}

/// The inputs of a program, with their quantities.
fn fields(program: &Program) -> Vec<Field> {
    let quantity = |unit: Unit| match unit {
        Unit::Metre | Unit::Millimetre => Quantity::Length,
        Unit::Radian => Quantity::Angle,
        Unit::One => Quantity::Number,
    };
    let mut fields: Vec<Field> =
        program.inputs.iter().map(|input| Field::new(&input.name, quantity(input.unit))).collect();
    if let Some(tip) = program.tip() {
        for (input, number) in tip.inputs().zip(tip.layout().numbers()) {
            fields[input].number = Some(*number);
        }
    }
    fields
}

/// The prefix of the names of a rotation's entries, the first of which is the input with this index.
fn prefix(program: &Program, first: usize) -> String {
    let name = &program.inputs[first].name;
    let tip = program.tasks.iter().find(|tip| tip.inputs().contains(&first));
    let number = tip.map(|tip| tip.layout().numbers()[first - tip.first_input].name());
    let prefix = number.and_then(|number| name.strip_suffix(&number));
    prefix.map_or_else(|| format!("{name}_"), str::to_owned)
}
