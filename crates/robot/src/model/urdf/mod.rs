//! Robots as URDF: read by [`Robot::read`], [`Robot::from_urdf`], written by [`Robot::to_urdf`].
//!
#![doc = include_str!("../../../docs/urdf.md")]

mod joint;
mod link;
mod transmission;
mod write;
mod xacro;
pub(super) mod xml;

use std::collections::HashMap;

use super::{Fault, Part, Robot, RobotParts};
use crate::document::did_you_mean;
use crate::{ErrorKind, Result};
use joint::read_joint;
use link::{colour_of, read_link};
use transmission::{add_rotors, read_transmission};
use xml::Element;

impl Robot {
    /// The robot that `text` describes in the format of [`crate::model::urdf`]. What is wrong with a single link or joint is kept in [`Robot::faults`]:
    /// [`Robot::chain`] refuses it in a chain, and [`Robot::check`] in the whole robot.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not XML; [`ErrorKind::MissingKey`] for links and joints without a name,
    /// and joints without links; [`ErrorKind::BadValue`] for another root element; [`ErrorKind::Unsupported`] for
    /// xacro; those of [`Robot::with_faults`]. All have a line.
    pub fn from_urdf(text: &str) -> Result<Robot> {
        let root = Element::parse(text)?;
        let mut notes = xacro::unused(&root)?;
        if root.name != "robot" {
            return Err(root.error(
                ErrorKind::BadValue,
                "is the root element; that of a URDF is <robot>, of an MJCF <mujoco>, of an SDF <sdf>",
            ));
        }
        let is_recent = version(&root).is_some_and(|version| version >= (1, 2));
        let elements = |name| root.children.iter().filter(move |child| child.name == name);
        let mut faults = Vec::new();
        let mut links = Vec::new();
        let colours = colours(&root, &mut notes);
        for element in elements("link") {
            let (link, error) = read_link(element, &colours)?;
            faults.extend(error.map(|error| Fault { part: Part::Link(link.name.clone()), error }));
            links.push(link);
        }
        let mut joints = Vec::new();
        for element in elements("joint") {
            let (joint, error) = read_joint(element, is_recent)?;
            faults.extend(error.map(|error| Fault { part: Part::Joint(joint.name.clone()), error }));
            joints.push(joint);
        }
        let name = root.attribute("name").unwrap_or("robot").trim();
        let name = if name.is_empty() { "robot".to_owned() } else { name.to_owned() };
        let actuators = elements("transmission").filter_map(read_transmission).collect();
        faults.extend(add_rotors(elements("transmission"), &mut joints));
        let parts = RobotParts { name, source: None, links, joints, actuators, faults, notes };
        let line_of = |part: &Part| {
            let Part::Actuator(name) = part else { return None };
            let is_own = |child: &Element| child.name == "actuator" && child.attribute("name") == Some(name);
            elements("transmission").find(|element| element.children.iter().any(is_own)).map(|element| element.line)
        };
        Ok(Robot::with_faults(parts).map_err(|error| error.at_line(root.line))?.with_lines(line_of))
    }
}

/// The colours of the robot's materials. An invalid one is ignored with a note.
fn colours<'e>(root: &'e Element, notes: &mut Vec<String>) -> HashMap<&'e str, [f64; 4]> {
    let mut colours = HashMap::new();
    for material in root.children.iter().filter(|child| child.name == "material") {
        match (material.attribute("name"), colour_of(material)) {
            (Some(name), Ok(Some(colour))) => {
                colours.insert(name, colour);
            }
            (_, Err(error)) => notes.push(format!("omitted: {error}")),
            _ => {}
        }
    }
    colours
}

/// Refuses a child whose name is similar to one of `parts`, as a typing error. Other unknown children are extensions.
fn refuse_slips(element: &Element, parts: &[&str]) -> Result<()> {
    for child in element.children.iter().filter(|child| !parts.contains(&child.name.as_str())) {
        let advice = did_you_mean(&child.name, parts);
        if !advice.is_empty() {
            let text = format!("is not an element of a {}{advice}", element.name);
            return Err(child.error(ErrorKind::UnknownKey, &text));
        }
    }
    Ok(())
}

/// The version of the format, (1, 2) for "1.2".
fn version(root: &Element) -> Option<(u32, u32)> {
    let (major, minor) = root.attribute("version")?.trim().split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
