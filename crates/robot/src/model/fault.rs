//! Faults: errors of single parts of a description that is otherwise usable. Main type: [`Fault`].

use crate::Error;

/// A part of a robot, by its name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// A link.
    Link(String),
    /// A joint.
    Joint(String),
    /// An actuator, which is ignored.
    Actuator(String),
}

/// A fault of one part. A caller that uses the part gets this error. A chain elsewhere in the robot is usable and gets
/// a note.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Fault {
    /// The part.
    pub part: Part,
    /// The error, with the name of the part and its line.
    pub error: Error,
}
