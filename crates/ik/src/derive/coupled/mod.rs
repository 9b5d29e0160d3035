//! Chains that share actuators, such as two legs on one hip actuator: a solver for the targets of all chains together ([`Coupled`]).
//!
//! The chains are derived one after the other, each alone ([`super::sequential`]). A joint that an earlier chain has found is given for later ones. So no
//! solution is lost: each solution of all chains consists of one of the first chain, one of the next with the shared joints given, and so on. Shared joints of
//! two chains on which both must agree, or which neither determines alone, are found first, from both together ([`super::sequential::Simultaneous`]). The
//! programs are composed into one ([`crate::solver::Program::followed_by`]). It polishes and measures all equations together.
//!
#![doc = include_str!("../../../docs/coupled_toml.md")]

mod certificate;
mod explain;
mod method;
mod model;
mod origin;
mod reader;
mod titles;

pub use explain::{Disagreement, Explanation};
pub use method::{ChainStage, Coupled, CoupledView};
pub use model::{Actuator, CoupledChain, CoupledChains, CoupledParts, JointPlace};
