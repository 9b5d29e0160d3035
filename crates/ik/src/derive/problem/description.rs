//! The content of an input file, read from its text. Main type: [`Description`].

use std::path::Path;

use crate::Result;
use crate::derive::System;
use crate::derive::coupled::CoupledChains;
use groebot_robot::document::{DescriptionText, Document};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::{ReadOptions, Robot, XmlFormat, xacro};

/// The content of an input file.
#[derive(Clone, Debug, PartialEq)]
pub enum Description {
    /// One chain: `chain.toml` or a DH table.
    Chain(Box<Chain>),
    /// Equations.
    System(System),
    /// A robot with any number of chains: URDF, xacro, MJCF, SDF or TOML.
    Robot(Robot),
    /// Chains that share actuators.
    Coupled(Box<CoupledChains>),
}

/// Expands the xacro in `file`, and reads it as a robot; with the expansion.
pub(super) fn from_xacro(read: &DescriptionText, file: &Path, options: &ReadOptions) -> Result<(Description, String)> {
    let expanded = xacro::expand_text(&read.text, file, options)?;
    let robot = expanded.robot()?.with_notes(read.notes.clone());
    Ok((Description::Robot(robot), expanded.text))
}

/// Reads the robot in the XML of `file`, with its text in a mechanism's folder. That is URDF: an MJCF or SDF is
/// written as URDF and read again, because it may include other files.
pub(super) fn from_xml(read: &DescriptionText, file: &Path) -> Result<(Description, String)> {
    let robot = Robot::from_xml(&read.text, Some(file))?.with_notes(read.notes.clone());
    if XmlFormat::of(&read.text) == XmlFormat::Urdf {
        return Ok((Description::Robot(robot), read.text.clone()));
    }
    let urdf = robot.to_urdf();
    let again = Robot::from_urdf(&urdf).map_err(|error| error.with_context("as URDF"))?;
    let mut parts = again.parts().clone();
    // Messages are about the file itself. URDF has no gains of servos. A part with a fault is incomplete in `again`: its fault remains.
    parts.notes.clone_from(&robot.parts().notes);
    parts.faults.retain(|fault| robot.faults().iter().all(|own| own.part != fault.part));
    parts.faults.extend_from_slice(robot.faults());
    for (link, own) in parts.links.iter_mut().zip(robot.links()) {
        (link.line, link.notes) = (own.line, own.notes.clone());
    }
    for (joint, own) in parts.joints.iter_mut().zip(robot.joints()) {
        (joint.line, joint.notes, joint.servo) = (own.line, own.notes.clone(), own.servo);
    }
    let again = Robot::with_faults(parts)?;
    Ok((Description::Robot(again), urdf))
}

/// Reads the description in the text of `file`.
pub(super) fn from_toml(text: &str, file: &Path) -> Result<Description> {
    let has = {
        let document = Document::parse(text)?;
        ["link", "chain", "dh", "tip", "task"].map(|key| document.root().optional(key).is_some())
    };
    let boxed = |chain| Description::Chain(Box::new(chain));
    let folder = file.parent().unwrap_or(Path::new(""));
    match has {
        [true, ..] => Robot::from_toml(text).map(Description::Robot),
        [_, true, ..] => CoupledChains::from_toml(text, folder).map(|coupled| Description::Coupled(Box::new(coupled))),
        [_, _, true, ..] => Chain::from_dh_toml(text).map(boxed),
        [_, _, _, false, false] => System::from_toml(text).map(Description::System),
        _ => Chain::from_toml(text).map(boxed),
    }
}
