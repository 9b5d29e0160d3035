//! Numeric checks of a derived program by independent witnesses:
//! * the original equations in floating point;
//! * joint values that made the target;
//! * forward kinematics;
//! * the exact number of real roots (Sturm);
//! * the screw solver;
//! * a numeric oracle.

mod accuracy;
pub mod chain;
mod check;
mod derivation;
mod equations;
mod exact;
mod model;
mod newton;
mod report;
mod screws;
mod targets;

pub use accuracy::{Accuracy, Class};
pub use check::{ByScrews, Solver};
pub use derivation::{check, check_round};
pub use equations::check_equations;
pub use report::{Fault, Kind, Report, Row, Summary, Verdict};

/// The extent of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The number of targets.
    pub targets: usize,
    /// The number of rows, from the first, at which the numeric oracle is used.
    pub oracle: usize,
    /// The number of rows, from the first, at which real solutions are counted exactly.
    pub exact: usize,
    /// The random seed. Equal seeds give equal reports.
    pub seed: u64,
    /// The kinds of targets.
    pub draws: Draws,
}

/// The kinds of targets of a check.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Draws {
    /// All kinds in turn.
    #[default]
    All,
    /// Only round targets. The numeric oracle searches all of them, unless [`Options::oracle`] is zero.
    Round,
}

impl Default for Options {
    /// 500 targets, 20 with the oracle, 50 with exact counts.
    fn default() -> Self {
        Options { targets: 500, oracle: 20, exact: 50, seed: 1, draws: Draws::All }
    }
}
