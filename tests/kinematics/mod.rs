//! Kinematics.

mod oracle;
mod screw;
