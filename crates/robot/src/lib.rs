//! Robots: their descriptions, kinematics with screws, dynamics and control.

pub mod files;

pub mod document;

pub mod spatial;

pub mod model;

pub mod kinematics;

pub mod robots;

pub mod motion;

pub mod dynamics;

pub mod drawing;

pub mod control;

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
