//! Conditions on a target: rotation matrices and unit vectors are checked, and rounding errors in them are corrected.

use crate::mechanism::Condition;
use crate::number::{Number, With};
use crate::solution::Error;
use crate::tolerances::ACCEPTANCE;

/// Projects a target onto its conditions; an error if it is farther from them than the tolerance.
#[inline(always)]
pub(crate) fn conform(conditions: &[Condition], target: &mut [f64]) -> Result<(), Error> {
    if !target.iter().all(|value| value.is_finite()) {
        return Err(Error::NotFinite);
    }
    for condition in conditions {
        if !fulfil(*condition, target) {
            return Err(match condition {
                Condition::Rotation(_) => Error::NotRotation,
                Condition::Unit(_) => Error::NotUnit,
            });
        }
    }
    Ok(())
}

/// Projects several targets onto their conditions. True where their numbers are finite and near the conditions.
#[inline(always)]
pub fn are_fulfilled<N: Number>(conditions: &[Condition], target: &mut [N]) -> N::Truth
where
    f64: With<N>,
{
    let mut fine = N::of(0.0).at_most(N::of(0.0));
    for value in target.iter() {
        fine = fine & value.abs().at_most(N::of(f64::MAX));
    }
    for condition in conditions {
        fine = fine & fulfil(*condition, target);
    }
    fine
}

/// Takes one Newton step towards a condition. False when the target is far from it.
#[inline(always)]
pub(crate) fn fulfil<N: Number>(condition: Condition, target: &mut [N]) -> N::Truth
where
    f64: With<N>,
{
    match condition {
        Condition::Rotation(first) => make_rotation(&mut target[first..first + 9]),
        Condition::Unit(first) => make_unit(&mut target[first..first + 3]),
    }
}

/// Takes one Newton step from a matrix by rows towards the nearest rotation, `R - (R R^T - 1) R / 2` (N. Higham, "Computing the polar decomposition - with
/// applications", 1986). False when the matrix is far from a rotation or is a reflection.
#[inline(always)]
fn make_rotation<N: Number>(r: &mut [N]) -> N::Truth
where
    f64: With<N>,
{
    let mut excess = [[N::of(0.0); 3]; 3];
    let mut deviation = N::of(0.0);
    for i in 0..3 {
        for j in 0..3 {
            excess[i][j] = dot(&r[3 * i..], &r[3 * j..]) - if i == j { 1.0 } else { 0.0 };
            deviation = deviation.greater(excess[i][j].abs());
        }
    }
    let determinant =
        r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
    let given: [N; 9] = core::array::from_fn(|i| r[i]);
    for i in 0..9 {
        let (row, column) = (excess[i / 3], i % 3);
        let moved = row[0] * given[column] + row[1] * given[column + 3] + row[2] * given[column + 6];
        r[i] = r[i] - 0.5 * moved;
    }
    N::of(0.0).at_most(determinant) & deviation.at_most(N::of(ACCEPTANCE.input))
}

/// Takes one Newton step towards the nearest unit vector. False when the vector is far from it.
#[inline(always)]
fn make_unit<N: Number>(v: &mut [N]) -> N::Truth
where
    f64: With<N>,
{
    let excess = dot(v, v) - 1.0;
    for value in v {
        *value = *value - 0.5 * (excess * *value);
    }
    excess.abs().at_most(N::of(ACCEPTANCE.input))
}

#[inline(always)]
fn dot<N: Number>(a: &[N], b: &[N]) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
