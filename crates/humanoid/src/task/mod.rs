//! The whole task: from a map to a path, to footsteps, to joint angles, every sample checked. RH0 4.4, 5.4, 5.5 and
//! 6.3.
//!
//! A [`Pilot`] is a walker with its [`Body`] and its step limits, [`Reach`]. On a [`Floor`] it finds a [`Course`] to
//! its [`Goal`], and follows it step by step in a [`Journey`]. Each step is a walk of its own by one step goal (OSG;
//! UPA in the thesis), so that goal and obstacles may change between two steps. A [`Plan`] can walk the same footsteps
//! without rests; a [`Navigator`] plans so. The world has z up and the floor at 0; metres, seconds, radians.

mod blend;
mod body;
mod course;
mod drawing;
mod floor;
mod follow;
mod journey;
mod lattice;
mod navigator;
mod pilot;
mod plan;
mod reach;
mod refusal;
mod search;
mod stance;

pub use body::Body;
pub use course::{Blocked, Course, Goal, Method, Search};
pub use floor::Floor;
pub use journey::Journey;
pub use navigator::Navigator;
pub use pilot::Pilot;
pub use plan::Plan;
pub use reach::Reach;
pub use refusal::{Obstacle, Reason, Refusal};
