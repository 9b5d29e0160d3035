//! Robots: reading of URDF and TOML, writing, and extraction of chains.

mod changed;
mod mesh;
mod mjcf;
mod mjcf_read;
mod read;
mod robot;
mod round_trip;
mod sdf;
mod toml;
mod urdf;
mod urdf_angles;
mod xacro;

use crate::kinematics::exact;
