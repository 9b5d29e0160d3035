//! Inverse kinematics by screw theory: a witness that shares no solving code with the Groebner-derived solvers.

pub mod circles;
mod descent;
mod elimination;
mod motion;
pub mod one_joint;
mod quartic;
pub mod three_joints;
pub mod two_joints;
pub mod two_link;
pub mod values;
