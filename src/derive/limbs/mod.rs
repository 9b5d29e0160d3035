//! Limbs that share motors, such as two legs on one hip motor: a solver for the targets of all limbs together ([`DerivedLimbs`]).
//!
//! The limbs are derived one after the other as chains ([`super::lift`]); a joint that a limb before has found is given for those
//! behind it. So no solution is lost: each solution of all limbs is one of the first limb, continued by one of the next with the
//! shared joints held where they are. Shared joints of two limbs on which both must agree, or which neither determines alone, are found
//! first, from both at once ([`super::lift::Coupled`]). The programs are composed into one, which polishes and measures all equations together
//! ([`crate::solver::Program::followed_by`]).
//!
#![doc = include_str!("../../../docs/limbs_toml.md")]

mod certificate;
mod derived;
mod explain;
mod model;
mod reader;
mod stages;

pub use derived::{DerivedLimbs, LimbStage};
pub use explain::{Disagreement, Explanation};
pub use model::{JointPlace, Limb, Limbs, LimbsParts, Motor};
