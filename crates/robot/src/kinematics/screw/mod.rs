//! Inverse kinematics by screw theory: a witness that shares no solving code with the Groebner-derived solvers.
//!
//! [`ScrewSolver`] finds an order of subproblems from a chain's geometry, describes it as a [`Plan`], and solves by it; where one of its steps degenerates
//! and the chain does not, by another order.

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
pub mod two_link;
mod upright;
pub mod values;

pub use plan::{Plan, PlanStep, Subproblem};
pub use solver::ScrewSolver;

use super::Chain;
use crate::spatial::{Screw, angle};

/// How far, relative to the reach and in radians, an answer's tip may be from its target.
pub const ACCEPT: f64 = 2e-12;

/// Two answers are one when their joints differ by at most this much \[rad, or reaches\].
const MERGE: f64 = 1e-9;

impl Chain {
    /// The reach, in which lengths are measured; one unit where it is zero.
    fn scale(&self) -> f64 {
        if self.reach() > 0.0 { self.reach() } else { 1.0 }
    }

    /// Whether two answers are one.
    fn are_one(&self, a: &[f64], b: &[f64]) -> bool {
        self.are_within(a, b, MERGE)
    }

    /// Whether joints differ by this much at most \[rad, or reaches\].
    fn are_within(&self, a: &[f64], b: &[f64], most: f64) -> bool {
        let differ = |(screw, (a, b)): (&Screw, (&f64, &f64))| match screw {
            Screw::Revolute(_) => angle::difference(*a, *b).abs(),
            Screw::Prismatic(_) => (a - b).abs() / self.scale(),
        };
        self.screws().iter().zip(a.iter().zip(b)).map(differ).all(|difference| difference <= most)
    }
}
