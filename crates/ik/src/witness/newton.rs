//! Gauss-Newton with least-norm steps and central differences, for systems of any shape.

use crate::tolerances::WITNESS;
use nalgebra::{DMatrix, DVector, SVD};

const ITERATIONS: usize = 60;
const HALVINGS: usize = 8;

/// Dimensionless functions of `x` that are zero at a solution.
pub(super) type Residual<'a> = dyn Fn(&[f64]) -> Vec<f64> + 'a;

/// The final point of the iteration from `start`, and the largest magnitude of the residual there. `scales` contains the typical size of each variable.
pub(super) fn newton(start: Vec<f64>, scales: &[f64], residual: &Residual<'_>) -> (Vec<f64>, f64) {
    let mut x = start;
    let mut norm = largest(&residual(&x));
    for _ in 0..ITERATIONS {
        if norm == 0.0 {
            break;
        }
        let Some(step) = step(&x, scales, residual) else { break };
        let shorter = (0..HALVINGS).find_map(|halvings| {
            let share = 0.5_f64.powi(halvings as i32);
            let next: Vec<f64> = x.iter().zip(&step).map(|(x, step)| x - share * step).collect();
            let size = largest(&residual(&next));
            (size < norm).then_some((next, size))
        });
        let Some(better) = shorter else { break };
        (x, norm) = better;
    }
    (x, norm)
}

/// The largest magnitude; infinite if an entry is NaN.
pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| if value.is_nan() { f64::INFINITY } else { value.abs().max(largest) })
}

/// Central differences of the residual; column `j` is by `x[j] / scales[j]`.
pub(super) fn jacobian(x: &[f64], scales: &[f64], residual: &Residual<'_>) -> DMatrix<f64> {
    // The cube root of the machine precision balances truncation and rounding.
    let width = f64::EPSILON.cbrt();
    let columns: Vec<DVector<f64>> = (0..x.len())
        .map(|j| {
            let moved = |by: f64| {
                let mut x = x.to_vec();
                x[j] += by * scales[j];
                DVector::from_vec(residual(&x))
            };
            (moved(width) - moved(-width)) / (2.0 * width)
        })
        .collect();
    DMatrix::from_columns(&columns)
}

fn step(x: &[f64], scales: &[f64], residual: &Residual<'_>) -> Option<Vec<f64>> {
    if x.is_empty() {
        return None;
    }
    let matrix = jacobian(x, scales, residual);
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let svd = SVD::try_new(matrix, true, true, f64::EPSILON, 200)?;
    let step = svd.solve(&DVector::from_vec(residual(x)), WITNESS.member * svd.singular_values.max()).ok()?;
    Some(step.iter().zip(scales).map(|(step, scale)| step * scale).collect())
}
