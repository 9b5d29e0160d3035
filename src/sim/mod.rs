//! RobManSim: a robot that walks through a furnished room while goal, furniture and the figures of its gait change. RH0 5.2, 5.4, 5.5.
//!
//! A [`Run`] goes step by step; between two steps its [`Figures`], its goal and the furniture may change, and the next step obeys. Metres, radians, seconds.

pub mod export;
mod figures;
mod run;

pub use figures::{FIGURES, Figure, Figures, PRESETS, Preset};
pub use run::{Next, Run, Start};
