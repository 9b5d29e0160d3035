//! Dynamics of serial chains by Lie groups, RH0 2.4: the matrices `M` and `C` of `M q'' + C q' + N = torques`, (2-41).
//!
//! A [`Manipulator`] is screws with a [`Body`] behind each; what a body weighs is its [`LinkInertia`].

mod coriolis;
mod inertia;
mod manipulator;

pub use inertia::{ASYMMETRY, LinkInertia, ROUNDING};
pub use manipulator::{Body, Manipulator};
