//! Rigid-body dynamics: inertia matrix (CRBA), inverse dynamics (RNEA), forward dynamics (ABA), Coriolis matrix,
//! regressor, identification.
//!
//! [`Equations`] has all of these for a robot with a fixed or a floating base. [`Model`] is a robot in doubles: a base,
//! and a body moved by each joint, with the matrices of `M q'' + C q' + N = torques` by Lie groups, RH0 2.4, (2-41).
//! [`Placed`] is a model in a configuration: its poses, its centre of mass and its [`Momentum`]. [`Clearance`] finds
//! links that touch one another.

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
    ArticulatedBodies, Body, Cause, Data, Derivatives, Divisible, Drive, Dual, Energy, Frame, Freedom, Mass, Massless,
    Matrices, Motion, Place, Scalar, Six, Tree,
};
