//! How far a solver's formulas may be off on the chain that answers are measured on: [`Slack`].

use groebot_algebra::roots::TANGENT;

/// How many times the difference of a chain and its ideal the symbols may be off.
const OFF: f64 = 20.0;

/// How far the formulas may be off, beyond rounding: where they are those of an ideal chain, by the tolerance \[rad, or m\] within which
/// it is the one that answers are measured on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slack(f64);

impl Slack {
    /// The formulas are exact.
    pub const NONE: Slack = Slack(0.0);

    /// The formulas are those of an ideal chain within `tolerance`.
    pub fn within(tolerance: f64) -> Self {
        Slack(OFF * tolerance)
    }

    /// The share of a size below which what is told by `least` is nothing.
    pub fn share(self, least: f64) -> f64 {
        least.max(self.0)
    }

    /// By how much an unknown's typical size is multiplied, so that a polynomial of this degree that misses the axis by this slack has
    /// a double root.
    pub fn typical(self, degree: usize) -> f64 {
        (self.0 / TANGENT).powf(1.0 / degree as f64).max(1.0)
    }
}
