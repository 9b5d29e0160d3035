//! Robots as MJCF, the format of MuJoCo: read by [`Robot::read`], [`Robot::from_mjcf`], written by [`Robot::to_mjcf`].
//!
//! A body becomes a link with the body's frame, so that poses are MuJoCo's `xpos` and `xquat`. Several joints of a body
//! become a chain of links. A joint's value is MuJoCo's `qpos`.

mod actuator;
mod body;
mod compiler;
mod defaults;
mod equality;
mod frame;
mod geom;
mod include;
mod inertia;
mod joint;
mod write;

use std::path::Path;

use super::urdf::xml::Element;
use super::{Meshes, Robot};
use crate::document::shown;
use crate::{ErrorKind, Result};
use body::Reader;
use compiler::Compiler;
use defaults::Classes;

/// The sections of a model that have no influence on its links, joints and shapes.
const IRRELEVANT: [&str; 17] = [
    "compiler",
    "option",
    "size",
    "visual",
    "statistic",
    "default",
    "asset",
    "worldbody",
    "contact",
    "equality",
    "actuator",
    "sensor",
    "keyframe",
    "custom",
    "include",
    "tendon",
    "deformable",
];

impl Robot {
    /// The robot that the MJCF `text` describes. `file` is its path, for included files and for the meshes whose masses
    /// are computed; a text without a path includes no files.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not XML; [`ErrorKind::BadValue`] for another root element and wrong
    /// numbers; [`ErrorKind::UnknownName`] for a class or mesh that does not exist; [`ErrorKind::Unsupported`] for
    /// global coordinates and for bodies that MuJoCo makes from other models; [`ErrorKind::Io`] for an included file; those of
    /// [`Robot::with_faults`]. All have a line.
    pub fn from_mjcf(text: &str, file: Option<&Path>) -> Result<Robot> {
        let root = Element::parse_whole(text)?;
        if root.name != "mujoco" {
            return Err(root.error(ErrorKind::BadValue, "is the root element; an MJCF has the root element <mujoco>"));
        }
        let root = include::expand(root, file)?;
        let compiler = Compiler::read(&root)?;
        let classes = Classes::read(&root)?;
        let meshes = file.map_or_else(Meshes::default, Meshes::beside);
        let mut reader = Reader::new(&root, &compiler, &classes, &meshes)?;
        reader.read_world()?;
        reader.read_tendons();
        reader.read_equalities()?;
        reader.read_actuators()?;
        for section in root.children.iter().filter(|section| !IRRELEVANT.contains(&section.name.as_str())) {
            reader.note(format!("line {}: <{}> is ignored", section.line, shown(&section.name)));
        }
        reader.finish().map_err(|error| error.at_line(root.line))
    }
}
