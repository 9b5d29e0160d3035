//! The recursions of dynamics over whatever is added and multiplied: doubles, floats, dual numbers, polynomials, code.

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

pub use articulated::{Articulation, Cause, Drive, Massless};
pub use articulated::{Resistance, Yielding};
pub use composite::Composite;
pub use data::{Data, Energy, Motion};
pub use data::{bias, pushed, unit};
pub use derivatives::Changes;
pub use derivatives::Derivatives;
pub use matrices::Matrices;
pub use matrices::Pushes;
pub use scalar::{Divisible, Dual, Scalar};
pub use six::{Frame, Mass, Matrix, Six};
pub use tree::{Body, Freedom, Place, Tree};
