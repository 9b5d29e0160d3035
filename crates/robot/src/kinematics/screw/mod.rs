//! Inverse kinematics by screw theory (Paden-Kahan subproblems). It shares no solving code with the Groebner-derived
//! solvers and verifies them.
//!
//! [`ScrewSolver`] finds an order of subproblems from a chain's geometry, describes it as a [`Plan`], and solves with
//! it. If one of its steps degenerates at a pose that is not singular, it uses another order.

pub mod circles;
mod feature;
mod goal;
mod meeting;
mod model;
pub mod one_joint;
mod order;
mod parallel_pairs;
mod plan;
mod planes;
mod polish;
mod polynomial;
mod reduced;
mod refine;
mod search;
mod solver;
mod step;
pub mod three_joints;
mod trigonometric;
mod turn;
pub mod two_joints;
#[doc(hidden)]
pub mod two_link;
mod upright;
pub mod values;

pub use plan::{Plan, PlanStep, Subproblem};
pub use solver::ScrewSolver;

use super::Chain;
use crate::spatial::{Screw, angle};

/// Maximum distance of a solution's tip from its target, relative to the reach and in radians.
pub(crate) const ACCEPT: f64 = 2e-12;

/// Two solutions are equal when their joints differ by at most this value \[rad, or units of the reach\].
const MERGE: f64 = 1e-9;

impl Chain {
    /// The reach as the unit of length; one if it is zero.
    fn scale(&self) -> f64 {
        if self.reach() > 0.0 { self.reach() } else { 1.0 }
    }

    /// Whether two solutions are equal.
    fn are_one(&self, a: &[f64], b: &[f64]) -> bool {
        self.are_within(a, b, MERGE)
    }

    /// Whether joint values differ by at most this value \[rad, or units of the reach\].
    fn are_within(&self, a: &[f64], b: &[f64], most: f64) -> bool {
        let differ = |(screw, (a, b)): (&Screw, (&f64, &f64))| match screw {
            Screw::Revolute(_) => angle::difference(*a, *b).abs(),
            Screw::Prismatic(_) => (a - b).abs() / self.scale(),
        };
        self.screws().iter().zip(a.iter().zip(b)).map(differ).all(|difference| difference <= most)
    }
}
