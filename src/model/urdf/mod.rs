//! Robots as URDF: read by [`Robot::read_urdf`], [`Robot::from_urdf`], written by [`Robot::to_urdf`].
//!
#![doc = include_str!("../../../docs/urdf.md")]

mod joint;
mod link;
mod write;
mod xml;

use std::collections::HashMap;
use std::path::Path;

use super::{Actuator, Robot, RobotParts};
use crate::document::{did_you_mean, read_text};
use crate::{ErrorKind, Result};
use joint::read_joint;
use link::{colour_of, read_link};
use xml::Element;

/// The longest file that is read, in bytes.
pub const URDF_LIMIT: u64 = 4_000_000;

impl Robot {
    /// The robot that the URDF file at `path` describes.
    ///
    /// # Errors
    /// As [`read_text`], with a limit of four megabytes, and [`Robot::from_urdf`], with the file.
    pub fn read_urdf(path: &Path) -> Result<Robot> {
        Robot::from_urdf(&read_text(path, URDF_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// The robot that `text` describes in the format of [`crate::model::urdf`].
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not XML; [`ErrorKind::MissingKey`] for missing elements and attributes;
    /// [`ErrorKind::BadValue`] for another root element, wrong numbers, joint types that URDF does not know, elements given twice;
    /// [`ErrorKind::Unsupported`] for xacro; and as [`Robot::new`]. All have a line.
    pub fn from_urdf(text: &str) -> Result<Robot> {
        let root = Element::parse(text)?;
        check_root(&root)?;
        let is_recent = version(&root).is_some_and(|version| version >= (1, 2));
        let elements = |name| root.children.iter().filter(move |child| child.name == name);
        let mut colours = HashMap::new();
        for material in elements("material") {
            if let (Some(name), Some(colour)) = (material.attribute("name"), colour_of(material)?) {
                colours.insert(name, colour);
            }
        }
        let name = root.attribute("name").unwrap_or("robot").trim();
        let parts = RobotParts {
            name: if name.is_empty() { "robot".to_owned() } else { name.to_owned() },
            source: None,
            links: elements("link").map(|link| read_link(link, &colours)).collect::<Result<_>>()?,
            joints: elements("joint").map(|joint| read_joint(joint, is_recent)).collect::<Result<_>>()?,
            actuators: elements("transmission").filter_map(read_transmission).collect(),
        };
        Robot::new(parts).map_err(|error| error.at_line(root.line))
    }
}

/// An actuator of a `<transmission>` that moves several joints; those that are not of that kind are extensions.
fn read_transmission(element: &Element) -> Option<Actuator> {
    let all = |name| element.children.iter().filter(move |child| child.name == name);
    let mut actuators = all("actuator");
    let actuator = actuators.next().filter(|_| actuators.next().is_none())?;
    let joint = |joint: &Element| {
        let reduction = joint.child("mechanicalReduction").ok().flatten().and_then(|child| child.text.parse().ok());
        Some((joint.attribute("name")?.to_owned(), reduction.unwrap_or(1.0)))
    };
    let joints: Vec<(String, f64)> = all("joint").map(joint).collect::<Option<_>>()?;
    (joints.len() > 1).then_some(Actuator { name: actuator.attribute("name")?.to_owned(), joints })
}

/// Fails for a child whose name is nearly one of `parts`; other unknown ones are extensions.
fn refuse_slips(element: &Element, parts: &[&str]) -> Result<()> {
    for child in element.children.iter().filter(|child| !parts.contains(&child.name.as_str())) {
        let advice = did_you_mean(&child.name, parts);
        if !advice.is_empty() {
            let text = format!("is no element of a {}{advice}", element.name);
            return Err(child.error(ErrorKind::UnknownKey, &text));
        }
    }
    Ok(())
}

fn check_root(root: &Element) -> Result<()> {
    if let Some(macros) = root.children.iter().find(|child| child.name.starts_with("xacro:")) {
        let message = "is xacro, a language that makes URDF; run `xacro robot.urdf.xacro > robot.urdf` first";
        return Err(macros.error(ErrorKind::Unsupported, message));
    }
    if root.name != "robot" {
        return Err(root.error(ErrorKind::BadValue, "is the root element; a URDF has the root element <robot>"));
    }
    Ok(())
}

/// The version of the format, (1, 2) for "1.2".
fn version(root: &Element) -> Option<(u32, u32)> {
    let (major, minor) = root.attribute("version")?.trim().split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
