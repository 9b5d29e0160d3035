//! What a robot is made of. Main type: [`RobotParts`].

use super::{Actuator, Fault, Joint, Link};

/// The plain data of a [`Robot`](super::Robot), not yet checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotParts {
    /// Its name.
    pub name: String,
    /// Where its figures come from.
    pub source: Option<String>,
    /// The links.
    pub links: Vec<Link>,
    /// The joints.
    pub joints: Vec<Joint>,
    /// The actuators; a joint that none of them names has its own.
    pub actuators: Vec<Actuator>,
    /// What is wrong with single parts.
    pub faults: Vec<Fault>,
    /// What the reader ignored that belongs to no part.
    pub notes: Vec<String>,
}
