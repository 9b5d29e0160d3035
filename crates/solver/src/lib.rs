#![doc = include_str!("../README.md")]

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
mod tolerances;
mod tolerant;
mod validate;

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};

pub use about::About;
pub use closest::{Closest, ClosestOptions, ErrorWeights};
#[doc(hidden)]
pub use demand::{Demand, ParameterDemand};
#[doc(hidden)]
pub use facts::Facts;
pub use forward::{Forward, Reached};
pub use instruction::{Instruction, Operand, Operation};
pub use joint::{Joint, JointValue, Unit};
#[doc(hidden)]
pub use layout::Layout;
pub use pairs::Pairs;
pub use placed::{PlacedSolver, Placement, TaskPlacement};
pub use prepared::{Batch, Nearest, Solved, Solver};
#[doc(hidden)]
pub use program::square;
pub use program::{
    Block, Case, Checks, ClosedSearch, Condition, Described, Guard, Input, MOST_SCANNED, MOST_SECTIONS, Pivot,
    Preference, Program, Redundancy, RedundantPart, Section, Short, Step,
};
pub use rule::{Following, ParameterRule, Rule};
pub use tips::{GivenJoint, TipTask};

/// The maximum number of joints of a program.
pub const MAX_JOINTS: usize = groebot_algebra::limits::SOLVER_JOINTS;
