//! What is wrong with one part of a description while the rest is sound. Main type: [`Fault`].

use crate::Error;

/// A part of a robot, by its name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// A link.
    Link(String),
    /// A joint.
    Joint(String),
    /// An actuator, which is left out.
    Actuator(String),
}

/// A fault of one part. Who uses the part refuses it with this error; a chain elsewhere in the robot is sound, and has a note.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The part.
    pub part: Part,
    /// What is wrong, with the name of the part and its line.
    pub error: Error,
}
