//! Rotations that are off by rounding, and the `tolerance=` of all functions that read them.

use groebot::spatial::rotation::rows_of_quaternion;
use nalgebra::Matrix3;
use pyo3::prelude::*;

use crate::errors::bad_value;

/// Default tolerance: rotations in single precision, and quaternions with six decimals.
pub const TOLERANCE: f64 = 1e-5;
/// Largest tolerance. The projection converges far beyond it.
const MAX_TOLERANCE: f64 = 0.1;
/// Deviation below which a matrix is used unchanged: a tenth of what solvers accept.
const EXACT: f64 = 1e-10;
/// Steps of the projection: each squares the deviation, so that 0.1 is below the rounding of doubles after five.
const STEPS: usize = 6;

/// The deviation of a matrix from the orthogonal ones: the largest entry of R^T R - 1.
fn deviation(turn: &Matrix3<f64>) -> f64 {
    let mut most = 0.0_f64;
    for i in 0..3 {
        for j in 0..=i {
            let dot = turn.column(i).dot(&turn.column(j)) - if i == j { 1.0 } else { 0.0 };
            most = most.max(dot.abs());
        }
    }
    most
}

/// Replaces a matrix, row by row, by the nearest rotation if its deviation is at most `tolerance`. Returns whether it is a rotation. A matrix that is exact
/// already is unchanged, to the last bit. The steps R (3 - R^T R) / 2 converge to the nearest orthogonal matrix (N. J. Higham, SIAM Journal on Scientific and
/// Statistical Computing 7, 1986).
pub fn project(entries: &mut [f64], tolerance: f64) -> bool {
    let mut turn = Matrix3::from_row_slice(entries);
    let off = deviation(&turn);
    if off.is_nan() || off > tolerance.max(EXACT) || turn.determinant() < 0.0 {
        return false;
    }
    if off <= EXACT {
        return true;
    }
    for _ in 0..STEPS {
        turn = turn * (Matrix3::identity() * 3.0 - turn.transpose() * turn) * 0.5;
    }
    entries.copy_from_slice(turn.transpose().as_slice());
    true
}

/// The matrix of a quaternion x, y, z, w, row by row; `None` if its length differs from one by more than `tolerance`.
pub fn matrix_of_quaternion(quaternion: [f64; 4], tolerance: f64) -> Option<[f64; 9]> {
    let length = quaternion.iter().map(|value| value * value).sum::<f64>().sqrt();
    if length.is_nan() || (length - 1.0).abs() > tolerance.max(EXACT) {
        return None;
    }
    rows_of_quaternion(quaternion.map(|value| value / length)).ok()
}

/// The deviation of a right-handed matrix, row by row, that a greater tolerance can accept.
pub fn matrix_deviation(entries: &[f64]) -> Option<f64> {
    let turn = Matrix3::from_row_slice(entries);
    Some(deviation(&turn)).filter(|off| *off <= MAX_TOLERANCE && turn.determinant() > 0.0)
}

/// The difference of a quaternion's length from one that a greater tolerance can accept.
pub fn quaternion_deviation(quaternion: &[f64]) -> Option<f64> {
    let length = quaternion.iter().map(|value| value * value).sum::<f64>().sqrt();
    Some((length - 1.0).abs()).filter(|off| *off <= MAX_TOLERANCE)
}

/// The text for a rotation that is off by more than the tolerance, with the tolerance that accepts it.
pub fn refusal(off: f64, tolerance: f64) -> String {
    // Rounded up to two digits.
    let digit = 10_f64.powf(off.log10().floor() - 1.0);
    let enough = ((off / digit).floor() + 1.0) * digit;
    format!(
        "a rotation that is off by {off:.1e}, more than the tolerance {tolerance:.0e}; `tolerance={enough:.1e}` replaces it by the nearest rotation"
    )
}

/// The requested tolerance; by default [`TOLERANCE`], or `precision` if it is greater, which is that of the array's type.
///
/// # Errors
/// `BadValueError` outside 0 to 0.1.
pub fn tolerance(requested: Option<f64>, precision: f64) -> PyResult<f64> {
    match requested {
        None => Ok(TOLERANCE.max(precision)),
        Some(value) if (0.0..=MAX_TOLERANCE).contains(&value) => Ok(value),
        Some(value) => Err(bad_value(format!("`tolerance` is {value}; give 0 to {MAX_TOLERANCE}"))),
    }
}
