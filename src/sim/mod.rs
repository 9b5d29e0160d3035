//! RobManSim: a robot that walks through a furnished room while goal, furniture and the figures of its gait change. RH0 5.2, 5.4, 5.5.
//!
//! A [`Run`] goes step by step; between two steps its [`Figures`], its goal and the furniture may change, and the next step obeys. What a walk comes to when physics plays it
//! is a [`Comparison`], RH0 6.2. Metres, radians, seconds.

mod answer;
mod answer_picture;
mod figures;
mod run;

pub use answer::{Comparison, JointComparison, SIDES, Way, soles};
pub use answer_picture::Quantity;
pub use figures::{FIGURES, Figure, Figures, PRESETS, Preset};
pub use run::{Next, Run, Start};
