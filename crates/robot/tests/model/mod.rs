//! Robots: reading of URDF and TOML, writing, and extraction of chains.

mod changed;
mod mesh;
mod mjcf;
mod read;
mod robot;
mod round_trip;
mod toml;
mod urdf;
mod urdf_angles;
mod xacro;

use crate::kinematics::exact;
