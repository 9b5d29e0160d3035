//! Motions in time: a walk, an arm's path, a recording. Main type: [`Trajectory`], samples. [`Spline`] is continuous.
//!
//! A trajectory is written as a CSV table ([`table`]) and as JSON, and both are read back. [`findings`] checks one for
//! limits, speeds, jumps and margins. [`follow`] computes one through poses, on a continuous branch of the solutions.

mod check;
mod follow;
mod json;
mod members;
mod path_request;
mod spline;
mod states;
pub mod table;
mod trajectory;

pub use table::pose_numbers;

pub use check::{Bounds, Fault, Finding, beyond_limit, findings, too_fast};
pub use follow::{Followed, Jump, follow};
pub use path_request::{Pace, PathRequest};
pub use spline::Spline;
pub use states::{StateRow, StateTable};
pub use trajectory::{Contact, Figure, JointTrack, Track, Trajectory};
