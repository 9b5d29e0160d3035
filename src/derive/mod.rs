//! From a description to polynomial equations, and on to a solver: the stages between kinematics and the solver.

mod assemble;
pub mod certify;
mod check;
pub mod compile;
mod constants;
pub mod plan;
mod print;
mod radicals;
pub mod setting;
pub mod strata;
mod system;
pub mod system_toml;
pub mod tree;
pub mod triangular;

pub use system::{
    Choice, Equation, Input, JointKindUnknown, JointUnknown, LengthUnit, MAX_BITS, MAX_PARAMETERS, MAX_TERMS,
    MAX_UNKNOWNS, Parameter, ParameterSource, Quantity, Root, System, SystemParts,
};
