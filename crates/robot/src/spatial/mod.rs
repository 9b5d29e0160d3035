//! Rigid motions and the conventions of angles, twists and screws. Metres and radians throughout.
//!
//! A rigid transform is a [`Pose`]. A joint is a [`Screw`], and its infinitesimal motion is a [`Twist`], linear part
//! first, as in RH0 (2-5). A force with a torque is a [`Wrench`]. [`ScrewCoordinates`] are axis, pitch and magnitude of
//! twists and wrenches. A rigid body has an [`Inertia`].

pub mod angle;
pub mod exact;
mod inertia;
pub mod intersection;
pub mod line;
pub mod matrix;
mod moment;
pub mod pose;
pub mod roll_pitch_yaw;
pub mod rotation;
mod screw;
mod screw_coordinates;
mod twist;
mod wrench;

pub use inertia::Inertia;
pub(crate) use inertia::NEGLIGIBLE;
pub use line::Relation;
pub use roll_pitch_yaw::RollPitchYaw;
pub use rotation::{pitch_and_roll, vertical};
pub(crate) use screw::Half;
pub use screw::{Axis, Screw};
pub use screw_coordinates::ScrewCoordinates;
pub use twist::Twist;
pub use wrench::Wrench;

/// A rigid transform of SE(3), RH0 (2-1): unit quaternion and translation \[m\].
///
/// It is named by its frames: `base_from_tool` converts coordinates from the tool frame to the base frame.
pub type Pose = nalgebra::Isometry3<f64>;
