//! Kinematics of serial chains: the validated exact model [`Chain`], its file format ([`chain_toml`]), forward
//! kinematics ([`fk`]), the screw solver ([`screw`]) and a numeric inverse ([`oracle`]).

pub mod chain;
pub mod chain_toml;
mod exact_serde;
pub mod fk;
pub mod jacobian;
pub mod oracle;
mod placement;
pub mod screw;
mod validate;

pub use chain::{
    Chain, ChainParts, Choice, ExactMatrix, ExactVector, Joint, JointKind, LengthUnit, Plane, Root, Task, Tip,
};
