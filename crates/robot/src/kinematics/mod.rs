//! Kinematics of serial chains: the validated exact model [`Chain`] and what is asked of it ([`Task`]), its file formats
//! ([`chain_toml`], [`dh_toml`], [URDF](crate::model::urdf)), forward kinematics ([`fk`]), how axes lie ([`geometry`]) or almost lie ([`ideal`]), the
//! screw solver ([`screw`]) and a numeric inverse ([`oracle`], [`numeric`]).

mod ball;
pub mod chain;
pub mod chain_toml;
pub mod dh;
pub mod dh_toml;
mod doubles;
pub mod fk;
mod frame;
pub mod geometry;
pub mod ideal;
mod inverse;
pub mod jacobian;
mod kept;
mod mimic;
pub mod numeric;
pub mod oracle;
mod parts;
mod path;
mod remote;
pub mod screw;
mod shares;
mod target;
mod task;
mod telescope;
mod tip;
mod turns;
pub mod upright;
mod validate;

pub use ball::Ball;
pub use chain::Chain;
pub use dh::{DhConvention, DhRow, DhTable};
pub use geometry::Geometry;
pub use inverse::{InverseKinematics, Solution};
pub use parts::{ChainParts, Choice, Joint, JointKind, Meant, Root, Tip, along_z};
pub use path::LinkPath;
pub use target::Target;
pub use task::{BaseAxis, Plane, Task};
pub use tip::TipChoice;
pub use turns::Placed;

pub use crate::model::{LengthUnit, Mimic};
pub use crate::spatial::exact::serde as exact_serde;
pub use crate::spatial::exact::{ExactMatrix, ExactRotation, ExactVector, Placement, Turn};
