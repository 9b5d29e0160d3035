//! The stages between kinematics and the solver: from a description to a proved solver.

pub mod closure;
pub mod coupled;
mod derivation;
pub mod eigenvalue;
pub mod equations;
mod options;
pub mod planner;
pub mod problem;
mod recount;
pub mod report;
mod samples;
pub mod sequential;
mod view;

pub use derivation::{AnyView, Derivation, Method, redundant};
pub use equations::grow::derive_tree;
pub(crate) use equations::grow::describe;
pub use equations::prover::Orders;
pub use groebot_robot::kinematics::{Choice, LengthUnit, Root};
pub use options::{Options, derive};
pub use problem::ends::Ends;
pub use problem::formulate::formulate;
pub use problem::input::{Description, InputFile, Source};
pub use problem::system::System;
pub use problem::system_parts::{
    Equation, Input, JointKindUnknown, JointUnknown, Parameter, ParameterSource, Quantity, SystemParts,
};
pub use problem::{ChainProblem, Problem};
pub use recount::Recount;
pub use view::View;
