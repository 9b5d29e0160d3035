//! Chains that share actuators, such as two legs on one hip actuator: a solver for the targets of all chains together ([`Coupled`]).
//!
//! The chains are derived one after the other, each by itself ([`super::sequential`]); a joint that a chain before has found is given for those
//! behind it. So no solution is lost: each solution of all chains is one of the first chain, continued by one of the next with the
//! shared joints held where they are. Shared joints of two chains on which both must agree, or which neither determines alone, are found
//! first, from both at once ([`super::sequential::Simultaneous`]). The programs are composed into one, which polishes and measures all equations together
//! ([`crate::solver::Program::followed_by`]).
//!
#![doc = include_str!("../../../docs/coupled_toml.md")]

mod certificate;
mod explain;
mod method;
mod model;
mod reader;
mod titles;

pub use explain::{Disagreement, Explanation};
pub use method::{ChainStage, Coupled, CoupledView};
pub use model::{Actuator, CoupledChain, CoupledChains, CoupledParts, JointPlace};
