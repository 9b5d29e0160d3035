//! One description of a robot: a tree of links and joints with its masses, shapes and limits. Main type: [`Robot`].
//!
//! Read from URDF ([`urdf`]) or TOML ([`toml`]), written as URDF
//! and MJCF ([`mjcf`]). Numbers that place axes and masses are exact, 0.1029 as
//! 1029/10000, with doubles beside them. A named frame, such as a sole or a hand, is a link without mass behind a fixed joint, as in a
//! URDF. A [`Chain`](crate::kinematics::Chain) is a path in a robot.

mod attributes;
mod check;
mod fault;
mod finite;
mod joint;
mod link;
mod mesh;
pub mod mjcf;
mod outline;
mod parts;
mod robot;
mod stl;
pub mod toml;
mod unit;
pub mod urdf;

pub(crate) use check::{is_plain, listing, some_among};
pub use fault::{Fault, Part};
pub use joint::{Actuator, Joint, JointType, Mimic, Origin};
pub use link::{Link, Mass, Shape, Solid};
pub use mesh::{MESH_LIMIT, Meshes, Surface};
pub use parts::RobotParts;
pub use robot::Robot;
pub use unit::LengthUnit;
