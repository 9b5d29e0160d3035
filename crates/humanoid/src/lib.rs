#![doc = include_str!("../README.md")]

pub mod gait;

pub mod stabilizer;

pub mod walkers;

pub mod nav;

pub mod task;

pub mod sim;

pub mod view;

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
