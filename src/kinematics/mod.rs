//! Kinematics of chains of joints.

pub mod oracle;
pub mod screw;
//! Kinematics of serial chains: the validated exact model [`Chain`], its file format ([`chain_toml`]) and numeric
//! forward kinematics ([`fk`]).

pub mod chain;
pub mod chain_toml;
mod exact_serde;
pub mod fk;
mod placement;
mod validate;

pub use chain::{
    Chain, ChainParts, Choice, ExactMatrix, ExactVector, Joint, JointKind, LengthUnit, Plane, Root, Task, Tip,
};
pub use fk::Pose;
