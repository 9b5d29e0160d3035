//! The zeros of a trigonometric polynomial, from its values at equidistant angles.

use std::f64::consts::{PI, TAU};

use smallvec::SmallVec;

use crate::spatial::angle;
use groebot_algebra::roots::{MAX_DEGREE, TANGENT, real_roots};

/// The highest degree. A polynomial in the tangent of the half angle has twice as many roots.
pub(super) const MOST: usize = 8;

/// An extremum within this distance of a zero \[rad\] is not a separate candidate.
const APART: f64 = 1e-3;

/// The angles in (-pi, pi] at which `f`, a polynomial of degree `degree` in the cosine and sine, is zero or nearly
/// zero.
///
/// Tangencies are found too, as in [`real_roots`]. There the error of a zero is up to the square root of the rounding
/// error, and the caller refines and checks it.
pub(super) fn zeros(degree: usize, f: impl Fn(f64) -> f64) -> SmallVec<[f64; 16]> {
    zeros_to(degree, 0.0, f)
}

/// Same as [`zeros`], but includes extrema where `|f|` is at most `grain`, since rounding may hide a tangency when all
/// of `f` is small.
pub(super) fn zeros_to(degree: usize, grain: f64, f: impl Fn(f64) -> f64) -> SmallVec<[f64; 16]> {
    debug_assert!(degree <= MOST);
    let count = 2 * degree + 1;
    let at = |sample: usize| angle::wrap(TAU * sample as f64 / count as f64);
    let values: SmallVec<[f64; 17]> = (0..count).map(|sample| f(at(sample))).collect();
    // The tangent of the half angle is infinite opposite the origin, so `f` should be large there.
    let largest = (0..count).max_by(|&i, &j| values[i].abs().total_cmp(&values[j].abs())).unwrap_or(0);
    let origin = at(largest) - PI;
    let harmonics = harmonics(degree, &values, |sample| at(sample) - origin);
    let mut found = angles(degree, origin, &harmonics);
    if grain > TANGENT * values[largest].abs() {
        let slope: SmallVec<[(f64, f64); MOST + 1]> =
            harmonics.iter().enumerate().map(|(k, (a, b))| (k as f64 * b, -(k as f64) * a)).collect();
        for extremum in angles(degree, origin, &slope) {
            let is_new = found.iter().all(|&q| angle::difference(q, extremum).abs() > APART);
            if is_new && f(extremum).abs() <= grain {
                found.push(extremum);
            }
        }
    }
    found
}

/// The zeros of a sum of harmonics, with angles counted from `origin`.
fn angles(degree: usize, origin: f64, harmonics: &[(f64, f64)]) -> SmallVec<[f64; 16]> {
    let roots = real_roots::<MAX_DEGREE>(&in_half_tangent(degree, harmonics), 1.0);
    roots.as_slice().iter().map(|t| angle::wrap(origin + 2.0 * t.atan())).collect()
}

/// The coefficients `(a_k, b_k)` of `sum a_k cos(k x) + b_k sin(k x)`, k = 0 ... degree, from its values at `2 degree + 1`
/// equidistant angles.
fn harmonics(degree: usize, values: &[f64], at: impl Fn(usize) -> f64) -> SmallVec<[(f64, f64); MOST + 1]> {
    let share = 2.0 / values.len() as f64;
    let coefficient = |k: usize| {
        let (mut a, mut b) = (0.0, 0.0);
        for (sample, value) in values.iter().enumerate() {
            let (sine, cosine) = (k as f64 * at(sample)).sin_cos();
            a += value * cosine;
            b += value * sine;
        }
        if k == 0 { (a * share / 2.0, 0.0) } else { (a * share, b * share) }
    };
    (0..=degree).map(coefficient).collect()
}

/// The coefficients, constant term first, of the polynomial in t = tan(x / 2) times (1 + t^2)^degree:
/// e^(i k x) (1 + t^2)^n = (1 + i t)^(n + k) (1 - i t)^(n - k).
fn in_half_tangent(degree: usize, harmonics: &[(f64, f64)]) -> SmallVec<[f64; 2 * MOST + 1]> {
    let mut polynomial: SmallVec<[f64; 2 * MOST + 1]> = SmallVec::from_elem(0.0, 2 * degree + 1);
    for (k, (a, b)) in harmonics.iter().enumerate() {
        let mut term: SmallVec<[(f64, f64); 2 * MOST + 1]> = SmallVec::from_slice(&[(1.0, 0.0)]);
        for factor in 0..2 * degree {
            let sign = if factor < degree + k { 1.0 } else { -1.0 };
            term.push((0.0, 0.0));
            // Times 1 + sign i t, from the highest coefficient down.
            for j in (1..term.len()).rev() {
                let (re, im) = term[j - 1];
                term[j].0 -= sign * im;
                term[j].1 += sign * re;
            }
        }
        for (sum, (re, im)) in polynomial.iter_mut().zip(&term) {
            *sum += a * re + b * im;
        }
    }
    polynomial
}
