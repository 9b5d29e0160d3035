//! Six joints with axes in general position, solved together: a step of a program ([`SixAxes`]), and their axes
//! ([`Layout`]) for the run time ([`groebot_runtime::six_axes`], which describes the method).

mod formulation;
mod layout;
mod six_axes;

pub use formulation::Formulation;
pub use layout::{GivenLine, Layout, Line};
pub use six_axes::{GivenAxis, SixAxes, SixAxesParts};
