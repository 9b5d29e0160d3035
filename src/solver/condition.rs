//! What a target must fulfil: rotations and unit vectors, checked and freed from their last digits' error.

use super::CONSISTENT;
use super::program::{Condition, Program};
use crate::{Error, ErrorKind, Result};

impl Condition {
    /// Index of the first input, and how many there are.
    pub fn inputs(&self) -> (usize, usize) {
        match *self {
            Condition::Rotation(first) => (first, 9),
            Condition::Unit(first) => (first, 3),
        }
    }

    /// How far `values` are from what they must be: the largest magnitude in `R R^T - 1`, or `|v v^T - 1|`.
    fn deviation(&self, values: &[f64]) -> f64 {
        match self {
            Condition::Rotation(_) => {
                products(values).as_flattened().iter().fold(0.0, |most, value| value.abs().max(most))
            }
            Condition::Unit(_) => (dot(values, values) - 1.0).abs(),
        }
    }

    /// One Newton step towards the nearest rotation, `R - (R R^T - 1) R / 2` (N. Higham, "Computing the polar decomposition -
    /// with applications", 1986), or the nearest unit vector: the square of the deviation is left.
    fn correct(&self, values: &mut [f64]) {
        match self {
            Condition::Rotation(_) => {
                let excess = products(values);
                let given: [f64; 9] = std::array::from_fn(|index| values[index]);
                for (index, value) in values.iter_mut().enumerate() {
                    let (row, column) = (excess[index / 3], index % 3);
                    *value -= 0.5 * (row[0] * given[column] + row[1] * given[column + 3] + row[2] * given[column + 6]);
                }
            }
            Condition::Unit(_) => {
                let excess = dot(values, values) - 1.0;
                values.iter_mut().for_each(|value| *value -= 0.5 * (excess * *value));
            }
        }
    }
}

/// `R R^T - 1` for a matrix by rows.
fn products(matrix: &[f64]) -> [[f64; 3]; 3] {
    let row = |index: usize| &matrix[3 * index..3 * index + 3];
    std::array::from_fn(|i| std::array::from_fn(|j| dot(row(i), row(j)) - if i == j { 1.0 } else { 0.0 }))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn determinant(m: &[f64]) -> f64 {
    m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6])
}

impl Program {
    /// Checks the conditions on a target of the right length, and moves it onto them.
    pub(super) fn conform(&self, target: &mut [f64]) -> Result<()> {
        for condition in &self.conditions {
            let (first, count) = condition.inputs();
            let values = &mut target[first..first + count];
            let deviation = condition.deviation(values);
            let mirrored = matches!(condition, Condition::Rotation(_)) && determinant(values) < 0.0;
            // A deviation that is not a number is refused too.
            if mirrored || deviation.is_nan() || deviation > CONSISTENT {
                return Err(self.refused(condition, deviation, mirrored));
            }
            condition.correct(values);
        }
        Ok(())
    }

    fn refused(&self, condition: &Condition, deviation: f64, mirrored: bool) -> Error {
        let (first, count) = condition.inputs();
        let names = format!("`{}` to `{}`", self.inputs[first].name, self.inputs[first + count - 1].name);
        let text = match condition {
            Condition::Rotation(_) if mirrored => {
                format!("{names} are no rotation matrix: the determinant is negative; give a right-handed one")
            }
            Condition::Rotation(_) => format!(
                "{names} are no rotation matrix: R R^T differs from one by {deviation:.1e}; {CONSISTENT:e} is allowed"
            ),
            Condition::Unit(_) => format!(
                "{names} are no unit vector: the squared length differs from one by {deviation:.1e}; {CONSISTENT:e} is allowed"
            ),
        };
        Error::new(ErrorKind::BadValue, text)
    }
}
