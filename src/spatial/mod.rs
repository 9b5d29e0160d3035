//! Rigid motions and the conventions of angles, twists and screws. Metres and radians throughout.
//!
//! A rigid transform is a [`Pose`]; a joint is a [`Screw`]; its infinitesimal motion is a [`Twist`],
//! linear part first, as in RH0 (2-5).

pub mod angle;
pub mod line;
pub mod rotation;
mod screw;
mod twist;

pub use line::Relation;
pub use screw::{Axis, Screw};
pub use twist::Twist;

/// A rigid transform of SE(3), RH0 (2-1): unit quaternion and translation \[m\].
///
/// Named by its frames: `base_from_tool` takes coordinates in the tool frame to the base frame.
pub type Pose = nalgebra::Isometry3<f64>;
