//! Closed-form inverse kinematics that is complete and proven.

pub mod solver;

pub mod derive;

pub mod witness;

pub mod codegen;

pub mod reach;

pub mod folder;

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
