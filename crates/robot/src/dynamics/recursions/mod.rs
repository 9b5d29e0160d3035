//! Recursive algorithms of rigid-body dynamics (RNEA, CRBA, ABA) over any scalar type: doubles, floats, dual numbers,
//! polynomials, code.

mod articulated;
mod composite;
mod data;
mod derivatives;
mod jacobian;
mod matrices;
mod regressor;
mod scalar;
mod six;
mod tree;

pub use articulated::{ArticulatedBodies, Cause, Drive, Massless};
pub use articulated::{ArticulatedInertia, ArticulatedJoint};
pub use composite::Composite;
pub use data::{Data, Energy, Motion};
pub use data::{bias, net_force, unit};
pub use derivatives::Derivatives;
pub use derivatives::ForceDerivatives;
pub use matrices::Matrices;
pub use matrices::UnitForces;
pub use regressor::Regressor;
pub use scalar::{Divisible, Dual, Scalar};
pub use six::{Frame, Mass, Matrix, Six};
pub use tree::{Body, Freedom, Place, Tree};
