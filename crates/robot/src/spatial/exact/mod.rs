//! Exact geometry: vectors, rotations and frames in rational numbers (0.1029 is 1029/10000). Main type: [`Placement`].

mod decimal;
mod placement;
pub(crate) mod rotation;
pub mod serde;
pub(crate) mod surd;
pub mod vector;

pub use placement::Placement;
pub use placement::{normalized, point, rotation as numeric_rotation};
pub use rotation::{ExactRotation, Turn};

use groebot_algebra::number::BigRational;

/// Three exact coordinates.
pub type ExactVector = [BigRational; 3];
/// An exact 3x3 matrix, row by row.
pub type ExactMatrix = [[BigRational; 3]; 3];
