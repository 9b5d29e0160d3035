//! Kinematics of chains of joints.

pub mod oracle;
pub mod screw;
