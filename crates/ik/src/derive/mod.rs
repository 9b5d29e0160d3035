//! From a description to polynomial equations, and on to a solver: the stages between kinematics and the solver.

mod assemble;
pub mod certificate;
pub mod certify;
mod check;
pub mod closure;
pub mod compile;
mod constants;
pub mod coupled;
pub mod derivation;
pub mod eigenvalue;
pub mod ends;
pub mod explain;
pub mod formulate;
mod generic;
mod grow;
pub mod input;
pub mod plan;
pub mod planner;
mod print;
pub mod proved;
mod prover;
mod radicals;
mod recount;
pub mod sequential;
pub mod setting;
pub mod stages;
pub mod strata;
mod system;
mod system_parts;
pub mod system_toml;
pub mod tree;
pub mod triangular;

pub use derivation::Derivation;
pub use ends::Ends;
pub use formulate::formulate;
pub use groebot_robot::kinematics::{Choice, LengthUnit, Root};
pub use grow::{derive_tree, describe};
pub use input::{Description, InputFile, Source};
pub use proved::Proved;
pub use prover::Orders;
pub use recount::Recount;
pub use system::System;
pub use system_parts::{
    Equation, Input, JointKindUnknown, JointUnknown, MAX_BITS, MAX_DEGREE, MAX_PARAMETERS, MAX_TERMS, MAX_UNKNOWNS,
    Parameter, ParameterSource, Quantity, SystemParts,
};
