//! Robots as SDF 1.5 to 1.12, the format of Gazebo: read by [`Robot::read`], [`Robot::from_sdf`], written by
//! [`Robot::to_sdf`].
//!
//! A link keeps its frame. If a joint is beside the origin of its child link, a link without mass is between them. Named
//! frames become links without mass. Names in nested models are `model::link`.

mod frames;
mod include;
mod joint;
mod link;
mod model;
mod values;
mod write;

use std::path::Path;

use super::Robot;
use super::urdf::xml::Element;
use crate::document::shown;
use crate::{ErrorKind, Result};
use include::Includes;
use model::Scope;

/// The oldest and the newest version that is read.
const VERSIONS: [(u32, u32); 2] = [(1, 4), (1, 12)];

impl Robot {
    /// The robot that the SDF `text` describes: its only model. `file` is its path, for included models; a text without
    /// a path includes no files.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not XML; [`ErrorKind::BadValue`] for another root element, wrong numbers,
    /// and not exactly one model; [`ErrorKind::UnknownName`] for a frame that does not exist; [`ErrorKind::Unsupported`] for
    /// another version, for screw joints and for models on servers; [`ErrorKind::Io`] for an included file; those of
    /// [`Robot::with_faults`]. All have a line.
    pub fn from_sdf(text: &str, file: Option<&Path>) -> Result<Robot> {
        let root = Element::parse_whole(text)?;
        if root.name != "sdf" {
            return Err(root.error(ErrorKind::BadValue, "is the root element; an SDF has the root element <sdf>"));
        }
        let version = version(&root)?;
        let mut includes = Includes::new(file);
        includes.count(&root)?;
        let mut notes = Vec::new();
        let models = models(&root, &mut includes, &mut notes)?;
        let [model] = models.as_slice() else {
            let text = format!("has {} models; give a file with one", models.len());
            return Err(root.error(ErrorKind::BadValue, &text));
        };
        let name = model.required("name")?;
        let mut scope = Scope::new(name, version);
        scope.parts.notes = notes;
        scope.read(model, &mut includes)?;
        scope.finish().map_err(|error| error.at_line(model.line))
    }
}

/// The models of a file and of its worlds, with those that worlds include.
fn models(root: &Element, includes: &mut Includes, notes: &mut Vec<String>) -> Result<Vec<Element>> {
    let worlds = root.children.iter().filter(|child| child.name == "world");
    let mut models = Vec::new();
    for child in root.children.iter().chain(worlds.flat_map(|world| &world.children)) {
        match child.name.as_str() {
            "model" => models.push(child.clone()),
            "include" => models.push(includes.load(child)?),
            _ => {}
        }
    }
    // A ground or a building is static, and has no joints.
    let moves = |model: &Element| {
        model.children.iter().any(|child| ["joint", "model", "include"].contains(&child.name.as_str()))
    };
    if models.len() > 1 && models.iter().filter(|model| moves(model)).count() == 1 {
        let still = models.iter().filter(|model| !moves(model));
        notes.extend(still.map(|model| format!("line {}: a model without joints is ignored", model.line)));
        models.retain(moves);
    }
    Ok(models)
}

/// The version of the format, (1, 9) for "1.9".
fn version(root: &Element) -> Result<(u32, u32)> {
    let text = root.required("version")?;
    let parsed =
        text.trim().split_once('.').and_then(|(major, minor)| Some((major.parse().ok()?, minor.parse().ok()?)));
    parsed.filter(|version| (VERSIONS[0]..=VERSIONS[1]).contains(version)).ok_or_else(|| {
        let text = format!("has the version `{}`; versions 1.4 to 1.12 are read", shown(text));
        root.error(ErrorKind::Unsupported, &text)
    })
}
