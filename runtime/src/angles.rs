//! Angles from cosines and sines. All operations round alike on every machine.
//!
//! The arc tangent of `|z| <= tan(pi/8)` is `z + z^3 P(z^2)`. `P` interpolates at Chebyshev points and was computed with 60 digits; the relative error of the
//! angle is 7e-18.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use crate::number::{Number, With};
use crate::tolerances::MERGING;

/// Coefficients of `P`, constant term first.
pub const SERIES: [f64; 11] = [
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
pub const EIGHTH: f64 = 0.41421356237309503;
/// Two angles differ by more than `tolerances::MERGING.blur` where the cosine of their difference is below this.
pub const FAR_APART: f64 = 1.0 - 0.52 * MERGING.blur * MERGING.blur;
/// Difference between `pi/4` and the nearest double.
pub const REST: f64 = 3.061616997868383e-17;
/// Differences between `pi/2`, `pi` and their nearest doubles.
const REST_OF: [f64; 2] = [2.0 * REST, 4.0 * REST];

/// The angle in [0, pi/2] of a non-negative cosine and a non-negative sine. NaN where both are zero.
#[inline(always)]
pub fn acute<N: Number>(across: N, up: N) -> N
where
    f64: With<N>,
{
    let steep = up.exceeds(across);
    let (low, high) = (across.or(up, steep), up.or(across, steep));
    let far = low.exceeds(EIGHTH * high);
    let where_far = |number: N| number.or(N::of(0.0), far);
    let z = (low - where_far(high)) / (high + where_far(low));
    let angle = z + z * (z * z) * series(z * z);
    let angle = where_far(N::of(FRAC_PI_4)) + (angle + where_far(N::of(REST)));
    (FRAC_PI_2 - (angle - REST_OF[0])).or(angle, steep)
}

/// The angle in (-pi, pi] of a cosine and a sine, given the acute angle of their magnitudes. Zero is never negative.
#[inline(always)]
pub fn unfold<N: Number>(acute: N, cosine: N, sine: N) -> N
where
    f64: With<N>,
{
    let angle = (PI - (acute - REST_OF[1])).or(acute, N::of(0.0).exceeds(cosine)).each(sine, f64::copysign);
    (angle + TAU).or(angle, angle.at_most(N::of(-PI))) + 0.0
}

/// `atan2(sine, cosine)` in (-pi, pi], within 5e-16 rad. Zero is never negative; NaN where both are zero.
#[inline]
pub fn angle<N: Number>(cosine: N, sine: N) -> N
where
    f64: With<N>,
{
    unfold(acute(cosine.abs(), sine.abs()), cosine, sine)
}

/// `P(u)`.
#[inline(always)]
fn series<N: Number>(u: N) -> N
where
    f64: With<N>,
{
    let c = &SERIES;
    let (square, fourth) = (u * u, u * u * (u * u));
    let first = c[0] + c[1] * u + (c[2] + c[3] * u) * square;
    let second = c[4] + c[5] * u + (c[6] + c[7] * u) * square;
    let third = c[8] + c[9] * u + c[10] * square;
    first + (second + third * fourth) * fourth
}
