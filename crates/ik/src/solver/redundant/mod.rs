//! All solutions within limits of a chain with one joint more than its task determines.

mod data;
mod limits;
mod solver;
mod target;

pub use data::{Redundancy, RedundantPart};
pub use limits::JointLimits;
pub use solver::RedundantSolver;
pub use target::ArmTarget;
