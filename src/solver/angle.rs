//! The angle of a cosine and a sine, by operations that round alike everywhere.
//!
//! The C library's `atan2` is slow and differs in the last digit from one library to the next. Here the arc tangent of
//! `|z| <= tan(pi/8)` is `z + z^3 P(z^2)`, where `P` interpolates `(atan(z) / z - 1) / z^2` at eleven Chebyshev points of `z^2` (found
//! with 60 digits; its share of the angle is off by 7e-18).

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// Coefficients of `P`, constant term first.
pub(crate) const SERIES: [f64; 11] = [
    -0.3333333333333333,
    0.1999999999999552,
    -0.14285714284666542,
    0.11111111015256361,
    -0.09090904578123903,
    0.07692183190826087,
    -0.06664511447381948,
    0.0585814891280221,
    -0.05085449737940259,
    0.03923165829558718,
    -0.019176887119062243,
];
/// `tan(pi/8)`.
pub(crate) const EIGHTH: f64 = 0.41421356237309503;
/// What the double nearest to `pi/4` lacks.
pub(crate) const REST: f64 = 3.061616997868383e-17;

/// `atan2(sine, cosine)` in (-pi, pi], within 5e-16 rad, and zero never negative; not a number where both are zero.
pub(crate) fn angle(cosine: f64, sine: f64) -> f64 {
    let (across, up) = (cosine.abs(), sine.abs());
    let steep = up > across;
    let (low, high) = if steep { (across, up) } else { (up, across) };
    let far = low > EIGHTH * high;
    let (top, bottom) = if far { (low - high, low + high) } else { (low, high) };
    let z = top / bottom;
    let mut angle = z + z * (z * z) * series(z * z);
    if far {
        angle = FRAC_PI_4 + (angle + REST);
    }
    if steep {
        angle = FRAC_PI_2 - (angle - 2.0 * REST);
    }
    if cosine < 0.0 {
        angle = PI - (angle - 4.0 * REST);
    }
    half_open(angle.copysign(sine)) + 0.0
}

/// The angle in (-pi, pi]: -pi, which atan2 gives for a negative zero sine, becomes pi.
fn half_open(angle: f64) -> f64 {
    if angle <= -PI { angle + TAU } else { angle }
}

/// The angle moved by whole turns into (-pi, pi].
pub(super) fn wrap(angle: f64) -> f64 {
    half_open(angle - TAU * (angle / TAU).round())
}

/// `P(u)`.
fn series(u: f64) -> f64 {
    let c = &SERIES;
    let (square, fourth) = (u * u, u * u * (u * u));
    let first = c[0] + c[1] * u + (c[2] + c[3] * u) * square;
    let second = c[4] + c[5] * u + (c[6] + c[7] * u) * square;
    let third = c[8] + c[9] * u + c[10] * square;
    first + (second + third * fourth) * fourth
}
