//! Dynamics of robots by Lie groups, RH0 2.4: the matrices `M` and `C` of `M q'' + C q' + N = torques`, (2-41), centre of mass and momentum.
//!
//! A [`Model`] is a [`Robot`](crate::model::Robot) in doubles: a base, which may move freely, and a body behind each joint. [`Placed`] is a
//! model in a configuration: where its bodies and its centre of mass are, and its [`Momentum`]. [`Clearance`] tells which links touch.

mod articulated;
mod clearance;
mod data;
mod equations;
mod lagrange;
mod masses;
mod model;
mod momentum;
mod placed;
mod scalar;
mod six;
mod tree;

pub use articulated::{Articulation, Cause, Drive, Massless};
pub use clearance::{Clearance, Touch};
pub use data::{Data, Matrices, Motion};
pub use equations::{Base, Equations, State, Workspace};
pub use model::{Model, ModelJoint};
pub use momentum::Momentum;
pub use placed::Placed;
pub use scalar::{Divisible, Dual, Scalar};
pub use six::{Frame, Mass, Six};
pub use tree::{Body, Freedom, Place, Tree};
