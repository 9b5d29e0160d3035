//! RobManSim: a robot walks through a furnished room while goal, furniture and the parameters of its gait change. RH0
//! 5.2, 5.4, 5.5.
//!
//! A [`Run`] proceeds step by step. Between two steps its [`Figures`], its goal and the furniture may change; the next
//! step takes them into account. A [`Comparison`] compares a walk with its physical simulation, RH0 6.2. Metres,
//! radians, seconds.

mod answer;
mod answer_picture;
#[cfg(feature = "clearance")]
mod clearance;
mod destination;
pub mod export;
mod figures;
#[cfg(feature = "clearance")]
mod full_task;
mod interior;
#[cfg(feature = "clearance")]
mod prism;
mod record;
mod rooms;
mod run;
mod usage;

pub use answer::{Comparison, Displacement, JointComparison, SIDES, soles};
pub use answer_picture::Quantity;
#[cfg(feature = "clearance")]
pub use clearance::{Clearance, Links};
pub use destination::Destination;
pub use figures::{FIGURES, Figure, Figures, PRESETS, Preset, with_fields};
#[cfg(feature = "clearance")]
pub use full_task::{Change, Checks, Performed, Stage, What, perform};
pub use interior::{Interior, Piece};
#[cfg(feature = "clearance")]
pub use prism::Thing;
pub use record::{RecordedStage, TaskRecord};
pub use rooms::{ROOMS, room};
pub use run::{Next, Run, Start};
pub use usage::{Greatest, Usage};
