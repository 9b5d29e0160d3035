//! Kinematics of serial chains: the validated exact model [`Chain`] and what is asked of it ([`Task`]), its file formats
//! ([`chain_toml`], [`dh_toml`], [`urdf`]), forward kinematics ([`fk`]), how axes lie ([`geometry`]) or almost lie ([`ideal`]), the
//! screw solver ([`screw`]) and a numeric inverse ([`oracle`], [`numeric`]).

pub mod chain;
pub mod chain_toml;
pub mod dh;
pub mod dh_toml;
mod exact_rotation;
pub(crate) mod exact_serde;
mod exact_vector;
pub mod fk;
mod frame;
pub mod geometry;
pub mod ideal;
pub mod jacobian;
mod mimic;
pub mod numeric;
pub mod oracle;
mod placement;
pub mod screw;
mod shares;
mod surd;
mod task;
pub mod tree;
pub mod upright;
pub mod urdf;
mod validate;

pub use chain::{
    Chain, ChainParts, Choice, ExactMatrix, ExactVector, Joint, JointKind, LengthUnit, Meant, Root, Tip, along_z,
};
pub use dh::{DhConvention, DhRow, DhTable};
pub use exact_rotation::{ExactRotation, Turn};
pub use geometry::Geometry;
pub use mimic::Mimic;
pub use placement::Placement;
pub use task::{Plane, Task};
pub use tree::Tree;
