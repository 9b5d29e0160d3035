//! The solver: a small straight-line program with branches ([`Program`]), and its evaluator.
//!
//! A program is plain data: it prints and serialises, and every language of [`crate::codegen`] is printed from it.

mod about;
mod closest;
mod compose;
mod condition;
mod demand;
pub mod eigenvalue;
mod evaluate;
pub(crate) mod facts;
mod forward;
mod instruction;
mod joint;
mod json;
mod layout;
pub(crate) mod mirror;
mod pairs;
mod placed;
mod prepared;
mod program;
mod prune;
pub mod redundant;
mod rule;
mod target;
mod tips;
mod tolerant;
mod validate;

pub use about::About;
pub use closest::{Closest, ClosestOptions, ErrorWeights};
pub(crate) use demand::{Demand, ParameterDemand};
pub(crate) use facts::Facts;
pub use forward::{Forward, Reached};
pub use instruction::{Instruction, Operand, Operation};
pub use joint::{Joint, JointValue, Unit};
pub(crate) use layout::Layout;
pub use pairs::Pairs;
pub use placed::{PlacedSolver, Placement, TaskPlacement};
pub use prepared::{Batch, Nearest, Solved, Solver};
pub(crate) use program::square;
pub use program::{
    Block, Case, Checks, ClosedSearch, Condition, Described, Guard, Input, MOST_SCANNED, MOST_SECTIONS, Pivot,
    Preference, Program, Redundancy, RedundantPart, Section, Short, Step,
};
pub use rule::{Following, ParameterRule, Rule};
pub use tips::{GivenJoint, TipTask};

/// The maximum number of joints of a program.
pub const MAX_JOINTS: usize = groebot_algebra::limits::SOLVER_JOINTS;
