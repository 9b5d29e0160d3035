#![doc = include_str!("../README.md")]

pub mod codegen;
pub mod derive;
pub mod folder;
pub mod reach;
mod tolerances;
pub mod witness;

pub use derive::derive;
pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
#[doc(inline)]
pub use groebot_solver as solver;
