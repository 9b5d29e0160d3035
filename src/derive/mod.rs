//! From a description to polynomial equations, and on to a solver: the stages between kinematics and the solver.

mod check;
mod constants;
mod print;
mod radicals;
pub mod setting;
pub mod strata;
mod system;
pub mod system_toml;

pub use system::{
    Choice, Equation, Input, JointKindUnknown, JointUnknown, LengthUnit, MAX_BITS, MAX_PARAMETERS, MAX_TERMS,
    MAX_UNKNOWNS, Parameter, ParameterSource, Quantity, Root, System, SystemParts,
};
