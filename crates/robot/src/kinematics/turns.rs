//! Joint values within limits: [`Placed`]. Solvers return angles in (-pi, pi]. A joint with limits of 0.4..6.3 rad
//! needs some of them increased by a whole turn.

use std::f64::consts::TAU;

/// Tolerance of limits \[rad or the length unit\], since limits and solutions are rounded.
const ROUNDED: f64 = 1e-9;

/// A joint value, moved into the joint's limits by whole turns if possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The value \[rad or the length unit\].
    pub value: f64,
    /// Whether it is within the limits.
    pub is_within: bool,
}

impl Placed {
    /// A value that is not moved.
    pub fn fixed(value: f64, limits: Option<(f64, f64)>) -> Placed {
        let is_within = limits.is_none_or(|(low, high)| low - ROUNDED <= value && value <= high + ROUNDED);
        Placed { value, is_within }
    }

    /// An angle, moved by the fewest turns into `limits`; unchanged if that is impossible.
    pub fn turned(angle: f64, limits: Option<(f64, f64)>) -> Placed {
        let unchanged = Placed::fixed(angle, limits);
        let Some((low, high)) = limits.filter(|_| !unchanged.is_within) else { return unchanged };
        let turns =
            if angle < low { ((low - ROUNDED - angle) / TAU).ceil() } else { -((angle - high - ROUNDED) / TAU).ceil() };
        let turned = Placed::fixed(angle + turns * TAU, limits);
        if turned.is_within { turned } else { unchanged }
    }
}
