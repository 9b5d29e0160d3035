//! Angles on the circle, in radians, each in (-pi, pi].

use std::f64::consts::{PI, TAU};

/// The angle of (-pi, pi] that differs from `angle` by whole turns of the double `TAU`, without rounding.
///
/// NaN when `angle` is not finite.
pub fn wrap(angle: f64) -> f64 {
    let remainder = angle % TAU;
    if remainder > PI {
        remainder - TAU
    } else if remainder <= -PI {
        remainder + TAU
    } else {
        remainder
    }
}

/// The smallest turn that leads from `from` to `to`, in (-pi, pi]; a half turn is positive.
///
/// NaN when either angle is not finite.
pub fn difference(to: f64, from: f64) -> f64 {
    wrap(wrap(to) - wrap(from))
}
