//! The parts of a robot. Main type: [`RobotParts`].

use super::{Actuator, Fault, Joint, Link};

/// The plain data of a [`Robot`](super::Robot), not yet validated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotParts {
    /// Its name.
    pub name: String,
    /// Source of its numbers.
    pub source: Option<String>,
    /// The links.
    pub links: Vec<Link>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The actuators. A joint that none of them names has its own.
    pub actuators: Vec<Actuator>,
    /// Faults of single parts.
    pub faults: Vec<Fault>,
    /// Notes about ignored contents that belong to no part.
    pub notes: Vec<String>,
}
