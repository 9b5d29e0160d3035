//! Angles on the circle, in radians, each in (-pi, pi].

use std::f64::consts::{PI, TAU};

/// Converts radians per second to revolutions per minute.
pub const RPM: f64 = 30.0 / PI;

/// The angle of (-pi, pi] that differs from `angle` by whole turns of the double `TAU`, without rounding.
///
/// NaN when `angle` is not finite.
pub fn wrap(angle: f64) -> f64 {
    // Within three half turns one turn is enough, and exact. The remainder of a division takes longer.
    if angle.abs() <= 3.0 * PI {
        return if angle > PI {
            angle - TAU
        } else if angle <= -PI {
            angle + TAU
        } else {
            angle
        };
    }
    let remainder = angle % TAU;
    if remainder > PI {
        remainder - TAU
    } else if remainder <= -PI {
        remainder + TAU
    } else {
        remainder
    }
}

/// The smallest rotation from `from` to `to`, in (-pi, pi]. A half turn is positive.
///
/// NaN when either angle is not finite.
pub fn difference(to: f64, from: f64) -> f64 {
    wrap(wrap(to) - wrap(from))
}
