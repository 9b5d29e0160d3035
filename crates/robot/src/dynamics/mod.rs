//! Dynamics of robots by Lie groups, RH0 2.4: the matrices `M` and `C` of `M q'' + C q' + N = torques`, (2-41), centre of mass and momentum.
//!
//! A [`Model`] is a [`Robot`](crate::model::Robot) in doubles: a base, which may move freely, and a body behind each joint. [`Placed`] is a
//! model in a configuration: where its bodies and its centre of mass are, and its [`Momentum`]. [`Clearance`] tells which links touch.

mod chains;
mod clearance;
mod equations;
pub mod exact;
mod lagrange;
mod masses;
mod model;
mod momentum;
mod placed;
pub mod recursions;

pub use clearance::{Clearance, Touch};
pub use equations::identify::{Consistency, Estimate, Finding, FindingKind, Identification, Logged};
pub use equations::pull;
pub use equations::{Base, Equations, Formal, FormalState, State, Value, Workspace};
pub use model::{Model, ModelJoint};
pub use momentum::Momentum;
pub use placed::Placed;
pub use recursions::{
    Articulation, Body, Cause, Data, Derivatives, Divisible, Drive, Dual, Energy, Frame, Freedom, Mass, Massless,
    Matrices, Motion, Place, Scalar, Six, Tree,
};
