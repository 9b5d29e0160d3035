//! Cosines and sines. All operations round alike on every machine; the inverse functions are in [`crate::angles`].
//!
//! The functions of C libraries are slow, and their last digits differ from one library to the next. The polynomials here interpolate at Chebyshev points and
//! were computed with 60 digits. Sine and cosine of `|x| <= pi/4` are `x + x^3 S(x^2)` and `1 - x^2/2 + x^4 C(x^2)`, with relative errors of 2e-17 and 1e-18.

use core::f64::consts::{FRAC_2_PI, PI, TAU};

use crate::arithmetic::Arithmetic;

/// Coefficients of `S`.
pub const SINE: [f64; 6] = [
    -0.16666666666666666,
    0.008333333333330948,
    -0.00019841269836758574,
    2.755731610255244e-06,
    -2.5051131845003624e-08,
    1.5918129294866608e-10,
];
/// Coefficients of `C`.
pub const COSINE: [f64; 6] = [
    0.041666666666666664,
    -0.0013888888888887398,
    2.480158729876569e-05,
    -2.7557317271729793e-07,
    2.08761462684032e-09,
    -1.1382632425521717e-11,
];
/// `pi/2` in parts, of which the first two have 33 bits.
pub const QUARTER: [f64; 3] = [1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21];
/// An angle beyond this is first reduced by whole turns \[rad\]; each of them adds an error of about 2e-16 rad.
const FAR: f64 = 1e6;

/// The angle moved by whole turns into (-pi, pi].
#[inline]
pub fn wrap(angle: f64) -> f64 {
    half_open(angle - TAU * Arithmetic::round(angle / TAU))
}

/// Same as [`wrap`], for an angle that is seldom out of range.
#[inline(always)]
pub(crate) fn in_turn(angle: f64) -> f64 {
    if angle.abs() < PI { angle } else { wrap(angle) }
}

fn half_open(angle: f64) -> f64 {
    if angle <= -PI { angle + TAU } else { angle }
}

/// The cosine of an angle in rad, within one unit of its last place up to a million rad.
pub fn cosine(angle: f64) -> f64 {
    let (quarters, x, rest) = reduced(angle);
    match quarters & 3 {
        0 => cosine_of(x, rest),
        1 => -sine_of(x, rest),
        2 => -cosine_of(x, rest),
        _ => sine_of(x, rest),
    }
}

/// The sine of an angle in rad, within one unit of its last place up to a million rad.
pub fn sine(angle: f64) -> f64 {
    let (quarters, x, rest) = reduced(angle);
    match quarters & 3 {
        0 => sine_of(x, rest),
        1 => cosine_of(x, rest),
        2 => -sine_of(x, rest),
        _ => -cosine_of(x, rest),
    }
}

/// The cosine and the sine of an angle in rad. They are equal to [`cosine`] and [`sine`], and take two thirds of the time.
pub fn cosine_and_sine(angle: f64) -> [f64; 2] {
    let (quarters, x, rest) = reduced(angle);
    let (c, s) = (cosine_of(x, rest), sine_of(x, rest));
    match quarters & 3 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

/// The nearest number of quarter turns, and the remaining angle in two numbers.
#[inline]
fn reduced(angle: f64) -> (i64, f64, f64) {
    let angle = if angle.abs() > FAR { angle % TAU } else { angle };
    let quarters = Arithmetic::round(angle * FRAC_2_PI);
    // Products of the first two parts are exact, and so is the first difference.
    let (first, second) = (angle - quarters * QUARTER[0], quarters * QUARTER[1]);
    let sum = first - second;
    let lost = first - sum;
    let lost = (first - (sum + lost)) + (lost - second);
    let third = lost - quarters * QUARTER[2];
    let x = sum + third;
    (quarters as i64, x, (sum - x) + third)
}

/// The sine of `x + rest` for `|x| <= pi/4`.
#[inline]
fn sine_of(x: f64, rest: f64) -> f64 {
    let (u, c) = (x * x, &SINE);
    let high = c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5])));
    x + (x * u * (c[0] + u * high) + rest * (1.0 - 0.5 * u))
}

/// The cosine of `x + rest` for `|x| <= pi/4`.
#[inline]
fn cosine_of(x: f64, rest: f64) -> f64 {
    let (u, c) = (x * x, &COSINE);
    let high = c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * (c[4] + u * c[5]))));
    let half = 0.5 * u;
    let first = 1.0 - half;
    first + (((1.0 - first) - half) + (u * u * high - x * rest))
}
