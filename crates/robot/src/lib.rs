#![doc = include_str!("../README.md")]

// The modules in dependency order: each uses only those above it.

// Atomic writing of files.
pub mod files;
// TOML with line numbers and exact numbers.
pub mod document;

// Rigid motions: twists, wrenches, screws, inertias.
pub mod spatial;
// The description of a robot: a tree of links and joints.
pub mod model;
// Serial chains: forward and inverse kinematics, Jacobians, ideal robots.
pub mod kinematics;
// Robots by name.
pub mod robots;

// Motions in time.
pub mod motion;
// Rigid-body dynamics: RNEA, CRBA, ABA, regressor, identification.
pub mod dynamics;

// SVG pictures.
pub mod drawing;
// Control laws and their simulation.
pub mod control;

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
/// Version of nalgebra whose types the interface has.
pub use nalgebra;
