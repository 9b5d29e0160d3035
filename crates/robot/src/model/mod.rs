//! The description of a robot: a tree of links and joints with masses, shapes and limits. Main type: [`Robot`].
//!
//! It is read from URDF ([`urdf`]), MJCF ([`mjcf`]), SDF ([`sdf`]) or TOML ([`toml`]), and written as URDF, MJCF and SDF. Positions, directions
//! and masses are exact (0.1029 is 1029/10000), and available as doubles. A named frame, such as a sole or a hand, is a
//! link without mass at a fixed joint, as in a URDF. A [`Chain`](crate::kinematics::Chain) is a path in a robot.

mod assembly;
mod attributes;
mod changed;
mod check;
mod fault;
mod finite;
mod include_budget;
mod joint;
mod link;
mod mesh;
pub mod mjcf;
mod names;
mod options;
mod outline;
mod package_folders;
mod parts;
mod read;
mod robot;
pub mod sdf;
mod stl;
pub mod toml;
mod unit;
pub mod urdf;
pub mod xacro;
mod xml_format;

pub(crate) use check::{is_plain, listing, some_among};
pub use fault::{Fault, Part};
pub use joint::{Actuator, Joint, JointType, Mimic, Origin, Servo};
pub use link::{Link, Mass, Shape, Solid};
pub use mesh::{Meshes, Surface};
pub use options::ReadOptions;
pub use parts::RobotParts;
pub use robot::Robot;
pub use unit::LengthUnit;
pub use xml_format::XmlFormat;
