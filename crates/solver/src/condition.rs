//! Conditions on a target: rotations and unit vectors.

use super::program::{Condition, Input};
use groebot_runtime::tolerances::ACCEPTANCE;

impl Condition {
    /// The index of the first input, and the number of inputs.
    pub(crate) fn inputs(&self) -> (usize, usize) {
        match *self {
            Condition::Rotation(first) => (first, 9),
            Condition::Unit(first) => (first, 3),
        }
    }

    /// The deviation of `values` from the condition: the largest magnitude in `R R^T - 1`, or `|v v^T - 1|`.
    fn deviation(&self, values: &[f64]) -> f64 {
        match self {
            Condition::Rotation(_) => {
                products(values).as_flattened().iter().fold(0.0, |most, value| value.abs().max(most))
            }
            Condition::Unit(_) => (dot(values, values) - 1.0).abs(),
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

/// The reason why a finite target of the right length violates a condition, if it does.
pub(super) fn conform(conditions: &[Condition], inputs: &[Input], target: &[f64]) -> Option<String> {
    conditions.iter().find_map(|condition| condition.refusal(inputs, target))
}

impl Condition {
    fn refusal(&self, inputs: &[Input], target: &[f64]) -> Option<String> {
        let (first, count) = self.inputs();
        let values = &target[first..first + count];
        let deviation = self.deviation(values);
        let mirrored = matches!(self, Condition::Rotation(_)) && determinant(values) < 0.0;
        let names = format!("`{}` to `{}`", inputs[first].name, inputs[first + count - 1].name);
        // A NaN deviation is refused too.
        let is_missed = mirrored || deviation.is_nan() || deviation > ACCEPTANCE.input;
        is_missed.then(|| match self {
            Condition::Rotation(_) if mirrored => {
                format!("{names} are not a rotation matrix: the determinant is negative; give a right-handed one")
            }
            Condition::Rotation(_) => format!(
                "{names} are not a rotation matrix: R R^T differs from one by {deviation:.1e}; {:e} is allowed",
                ACCEPTANCE.input
            ),
            Condition::Unit(_) => format!(
                "{names} are not a unit vector: the squared length differs from one by {deviation:.1e}; {:e} is allowed",
                ACCEPTANCE.input
            ),
        })
    }
}
