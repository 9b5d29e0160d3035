//! Robots: read from URDF and TOML, written, and cut into chains.

mod mesh;
mod mjcf;
mod robot;
mod round_trip;
mod toml;
mod urdf;
mod urdf_angles;

use crate::kinematics::exact;
