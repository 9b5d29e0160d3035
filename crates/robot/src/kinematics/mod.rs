//! Kinematics of serial chains. [`Chain`] is the validated exact model, and [`Task`] specifies the target of its tip.
//!
//! File formats are [`chain_toml`], [`dh_toml`] and [URDF](crate::model::urdf). [`fk`] is forward kinematics,
//! [`jacobian`] has the Jacobians, [`geometry`] the relations of joint axes, and [`ideal`] the nearest ideal robot.
//! Inverse kinematics: the screw solver ([`screw`]) and a numeric search ([`oracle`], [`numeric`]).

mod assumptions;
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
mod layout;
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
pub use layout::{Layout, Quantity, TargetNumber};
pub use parts::{ChainParts, Choice, Joint, JointKind, Meant, Root, Tip, along_z};
pub use path::LinkPath;
pub use target::Target;
pub use task::{BaseAxis, Plane, Stated, Task};
pub use tip::TipChoice;
pub use turns::Placed;

pub use crate::model::{LengthUnit, Mimic};
pub use crate::spatial::exact::serde as exact_serde;
pub use crate::spatial::exact::{ExactMatrix, ExactRotation, ExactVector, Placement, Turn};
