//! Inverse kinematics by screw theory: a witness that shares no solving code with the Groebner-derived solvers.

pub mod paden_kahan;
pub mod two_link;
