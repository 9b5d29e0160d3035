//! Vectors of three coordinates ([`Vector`]) and of six; several angles at once.

use core::array::from_fn;
use core::f64::consts::FRAC_2_PI;

use crate::angles::angle;
use crate::arithmetic::Arithmetic;
use crate::lanes::Lanes;
use crate::trigonometry::{COSINE, QUARTER, SINE};

/// Three coordinates.
pub type Vector = [f64; 3];

#[inline(always)]
pub(crate) fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub(crate) fn add(a: &Vector, b: &Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale(a: &Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// The angle of a cosine and a sine; zero where both are zero.
#[inline(always)]
pub(super) fn turn(cosine: f64, sine: f64) -> f64 {
    if cosine == 0.0 && sine == 0.0 { 0.0 } else { angle(cosine, sine) }
}

#[inline(always)]
pub(super) fn product<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>()
}

#[inline(always)]
pub(super) fn norm(v: &[f64; 6]) -> f64 {
    Arithmetic::sqrt(product(v, v))
}

/// The largest magnitude in rows, or `least` if that is greater; NaN is ignored.
#[inline(always)]
pub(super) fn largest<const N: usize>(least: f64, rows: &[[f64; N]]) -> f64 {
    let mut most = [least; N];
    for row in rows {
        most.iter_mut()
            .zip(row)
            .for_each(|(most, entry)| *most = if entry.abs() > *most { entry.abs() } else { *most });
    }
    let (pairs, rest) = most.as_chunks::<4>();
    let four = pairs.iter().fold([least; 4], |a, b| from_fn(|k| if b[k] > a[k] { b[k] } else { a[k] }));
    four.iter().chain(rest).fold(least, |most, entry| if *entry > most { *entry } else { most })
}

/// The largest magnitude; NaN where one component is NaN.
#[inline(always)]
pub(super) fn size(v: &[f64; 6]) -> f64 {
    v.iter().fold(0.0, |most, entry| if entry.abs() > most || entry.is_nan() { entry.abs() } else { most })
}

/// Adding this number to another one rounds that one to an integer, which is then in the last bits.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// The cosines and the sines of angles up to a million rad. They are bitwise equal to those of [`crate::trigonometry`], except where an angle is half-way
/// between two quarter turns.
#[inline(always)]
pub(crate) fn cosines_and_sines<const N: usize>(angles: &[f64; N]) -> [[f64; N]; 2] {
    let shifted = Lanes(*angles) * FRAC_2_PI + WHOLE;
    let [c, s] = within_quarter(Lanes(*angles), shifted - WHOLE);
    let (mut cosines, mut sines) = ([0.0; N], [0.0; N]);
    for k in 0..N {
        let (quarters, c, s) = (shifted.0[k].to_bits(), c.0[k].to_bits(), s.0[k].to_bits());
        let odd = 0_u64.wrapping_sub(quarters & 1);
        cosines[k] = f64::from_bits(((c & !odd) | (s & odd)) ^ ((quarters.wrapping_add(1) & 2) << 62));
        sines[k] = f64::from_bits(((s & !odd) | (c & odd)) ^ ((quarters & 2) << 62));
    }
    [cosines, sines]
}

/// Cosines and sines of the angles minus so many quarter turns.
#[inline(always)]
fn within_quarter<const N: usize>(angles: Lanes<N>, quarters: Lanes<N>) -> [Lanes<N>; 2] {
    // Products of the first two parts are exact, and so is the first difference.
    let (first, second) = (angles - quarters * QUARTER[0], quarters * QUARTER[1]);
    let sum = first - second;
    let lost = first - sum;
    let third = (first - (sum + lost)) + (lost - second) - quarters * QUARTER[2];
    let x = sum + third;
    let (rest, u, half) = ((sum - x) + third, x * x, 0.5 * (x * x));
    let series =
        |c: &[f64; 6], degree: usize| c[..degree].iter().rev().fold(Lanes([c[degree]; N]), |sum, c| *c + u * sum);
    let sine = x + (x * u * (SINE[0] + u * (series(&SINE_REST, 4))) + rest * (1.0 - half));
    let first = 1.0 - half;
    let cosine = first + (((1.0 - first) - half) + (u * u * series(&COSINE, 5) - x * rest));
    [cosine, sine]
}

/// The coefficients of the sine but the first.
const SINE_REST: [f64; 6] = [SINE[1], SINE[2], SINE[3], SINE[4], SINE[5], 0.0];
