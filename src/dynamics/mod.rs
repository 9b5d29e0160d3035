//! Dynamics of serial chains by Lie groups, RH0 2.4: the matrices `M` and `C` of `M q'' + C q' + N = torques`, (2-41).
//!
//! A [`Manipulator`] is screws with a [`Body`] behind each; what a body weighs is its [`LinkInertia`]. A [`Multibody`] is a tree of
//! bodies on a base that moves freely: where its centre of mass is, and its [`Momentum`].

mod coriolis;
mod inertia;
mod manipulator;
mod momentum;
mod multibody;

pub use inertia::{ASYMMETRY, LinkInertia, ROUNDING};
pub use manipulator::{Body, Manipulator};
pub use momentum::Momentum;
pub use multibody::{Limb, Multibody, Placed};
