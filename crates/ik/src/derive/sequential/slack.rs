//! The error bound of a solver's formulas on the chain on which solutions are measured: [`Slack`].

use groebot_algebra::roots::TANGENT;

/// The factor from the difference between a chain and its ideal to the error bound of the symbols.
const OFF: f64 = 20.0;

/// The error bound of the formulas beyond rounding. For formulas of an ideal chain it follows from the tolerance \[rad, or m\] between the ideal and the
/// described chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slack(f64);

impl Slack {
    /// The formulas are exact.
    pub const NONE: Slack = Slack(0.0);

    /// The formulas are those of an ideal chain, which differs by at most `tolerance`.
    pub fn within(tolerance: f64) -> Self {
        Slack(OFF * tolerance)
    }

    /// The fraction of its size below which a value counts as zero; at least `least`.
    pub fn share(self, least: f64) -> f64 {
        least.max(self.0)
    }

    /// The factor on an unknown's typical size. With it, a polynomial of this degree that misses a double root by this error still has one.
    pub fn typical(self, degree: usize) -> f64 {
        (self.0 / TANGENT).powf(1.0 / degree as f64).max(1.0)
    }
}
