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

/// The deviation of a matrix, row by row, from the orthogonal ones: the largest entry of R^T R - 1. NaN if a number is.
fn deviation(r: &[f64; 9]) -> f64 {
    let dot = |i: usize, j: usize| r[i] * r[j] + r[3 + i] * r[3 + j] + r[6 + i] * r[6 + j];
    let off = [dot(0, 0) - 1.0, dot(1, 1) - 1.0, dot(2, 2) - 1.0, dot(0, 1), dot(0, 2), dot(1, 2)].map(f64::abs);
    // `max` ignores NaN, a sum does not.
    if off.iter().sum::<f64>().is_nan() { f64::NAN } else { off.into_iter().fold(0.0, f64::max) }
}

/// The determinant of a matrix, row by row.
fn determinant(r: &[f64; 9]) -> f64 {
    r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6])
}

/// Replaces a matrix, row by row, by the nearest rotation if its deviation is at most `tolerance`. Returns whether it is a rotation; false for numbers that are
/// not finite. A matrix that is exact already is unchanged, to the last bit. The steps R (3 - R^T R) / 2 converge to the nearest orthogonal matrix (N. J. Higham,
/// SIAM Journal on Scientific and Statistical Computing 7, 1986).
#[inline]
pub fn project(entries: &mut [f64; 9], tolerance: f64) -> bool {
    let off = deviation(entries);
    if off.is_nan() || off > tolerance.max(EXACT) || determinant(entries) < 0.0 {
        return false;
    }
    if off > EXACT {
        *entries = nearest(entries);
    }
    true
}

/// The rotation nearest to a matrix, both row by row.
fn nearest(entries: &[f64; 9]) -> [f64; 9] {
    let mut turn = Matrix3::from_row_slice(entries);
    for _ in 0..STEPS {
        turn = turn * (Matrix3::identity() * 3.0 - turn.transpose() * turn) * 0.5;
    }
    std::array::from_fn(|i| turn[(i / 3, i % 3)])
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
    let entries = entries.try_into().ok()?;
    Some(deviation(entries)).filter(|off| *off <= MAX_TOLERANCE && determinant(entries) > 0.0)
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
