//! Inverse kinematics by screw theory: a witness that shares no solving code with the Groebner-derived solvers.
//!
//! [`ScrewSolver`] finds an order of subproblems from a chain's geometry, tells it as a [`Plan`], and solves by it; where one of its steps degenerates
//! and the chain does not, by another order.

pub mod circles;
mod feature;
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
mod target;
pub mod three_joints;
mod trigonometric;
mod turn;
pub mod two_joints;
pub mod two_link;
mod upright;
pub mod values;

pub use plan::{Plan, PlanStep, Subproblem};
pub use solver::{ACCEPT, ScrewSolver};
pub use target::{Solution, Target};
