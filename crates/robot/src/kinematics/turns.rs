//! Joint values within limits: [`Placed`]. Solvers answer with angles in (-pi, pi]; a joint with limits of 0.4..6.3 rad has the same angle a
//! whole turn further.

use std::f64::consts::TAU;

/// How far a value may be beyond a limit \[rad or the length unit\]: limits and answers are rounded.
const ROUNDED: f64 = 1e-9;

/// A joint value that is moved into the joint's limits by whole turns, where some number of turns does it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The value \[rad or the length unit\].
    pub value: f64,
    /// Whether it is within the limits.
    pub is_within: bool,
}

impl Placed {
    /// A value that stays unchanged.
    pub fn fixed(value: f64, limits: Option<(f64, f64)>) -> Placed {
        let is_within = limits.is_none_or(|(low, high)| low - ROUNDED <= value && value <= high + ROUNDED);
        Placed { value, is_within }
    }

    /// An angle, moved by the fewest turns that bring it within `limits`; unchanged where none do.
    pub fn turned(angle: f64, limits: Option<(f64, f64)>) -> Placed {
        let unchanged = Placed::fixed(angle, limits);
        let Some((low, high)) = limits.filter(|_| !unchanged.is_within) else { return unchanged };
        let turns =
            if angle < low { ((low - ROUNDED - angle) / TAU).ceil() } else { -((angle - high - ROUNDED) / TAU).ceil() };
        let turned = Placed::fixed(angle + turns * TAU, limits);
        if turned.is_within { turned } else { unchanged }
    }
}
