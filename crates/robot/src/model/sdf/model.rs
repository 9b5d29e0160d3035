//! A model of an SDF with its nested models. Main type: [`Scope`].

use std::collections::HashMap;

use super::frames::{Fixed, Frames, MODEL, WORLD};
use super::include::Includes;
use super::joint::{self, Kind};
use super::link;
use super::values::pose_of;
use crate::document::shown;
use crate::model::assembly::{Step, assemble, attach};
use crate::model::names::Names;
use crate::model::urdf::xml::Element;
use crate::model::{Joint, JointType, Link, Robot, RobotParts};
use crate::{Error, ErrorKind, Result};

/// A joint whose links are not yet resolved.
struct Pending {
    /// Its full name, and the prefix of names in its model.
    name: String,
    prefix: String,
    element: Element,
}

/// What has been read of a model.
pub struct Scope {
    version: (u32, u32),
    pub parts: RobotParts,
    frames: Frames,
    names: Names,
    joints: Vec<Pending>,
    trees: Trees,
    /// The joint above each link.
    above: HashMap<String, String>,
    /// The full names of frames that become links, with their places in the file.
    tips: Vec<(String, Option<usize>, Error)>,
}

impl Scope {
    /// The scope of a file with this version.
    pub fn new(name: &str, version: (u32, u32)) -> Self {
        let parts = RobotParts { name: name.to_owned(), ..RobotParts::default() };
        let (frames, names) = (Frames::new(), Names::default());
        let (joints, trees, above, tips) = Default::default();
        Scope { version, parts, frames, names, joints, trees, above, tips }
    }

    /// Reads the outermost model.
    ///
    /// # Errors
    /// Those of its parts.
    pub fn read(&mut self, model: &Element, includes: &mut Includes) -> Result<()> {
        includes.open(model)?;
        self.read_model(model, "", WORLD.to_owned(), includes)?;
        includes.close(model);
        Ok(())
    }

    /// Reads a model. `prefix` is that of names in it, such as `arm::`, and `outer` the default reference of its pose.
    fn read_model(&mut self, model: &Element, prefix: &str, outer: String, includes: &mut Includes) -> Result<()> {
        let (pose, reference) = pose_of(model)?;
        let above = prefix.strip_suffix("::").and_then(|own| own.rfind("::")).map_or("", |end| &prefix[..end + 2]);
        let reference = reference.map_or(outer, |name| format!("{above}{name}"));
        let canonical = model.attribute("canonical_link").filter(|name| !name.is_empty());
        let first = || model.children.iter().find(|child| child.name == "link").and_then(|link| link.attribute("name"));
        let nested = || {
            let model = model.children.iter().find(|child| child.name == "model")?;
            Some(format!("{}::{MODEL}", model.attribute("name")?))
        };
        let fixed = canonical.or_else(first).map(str::to_owned).or_else(nested);
        let fixed = fixed.map_or(Fixed::Nothing, |name| Fixed::To(format!("{prefix}{name}")));
        let own = format!("{prefix}{MODEL}");
        self.frames.add(&own, reference, pose, fixed, place(model, "model"))?;
        if let Some(frame) = model.attribute("placement_frame").filter(|name| !name.is_empty()) {
            self.frames.place_by(format!("{prefix}{frame}"));
        }
        for child in &model.children {
            self.read_child(child, prefix, &own, includes)?;
        }
        Ok(())
    }

    fn read_child(&mut self, child: &Element, prefix: &str, model: &str, includes: &mut Includes) -> Result<()> {
        match child.name.as_str() {
            "link" => self.read_link(child, prefix, model),
            "joint" => self.read_joint(child, prefix),
            "frame" => self.read_frame(child, prefix, model),
            "model" => self.read_nested(child, prefix, model, includes),
            "include" => {
                let included = includes.load(child)?;
                includes.open(&included).map_err(|error| error.at_line(child.line))?;
                self.read_nested(&included, prefix, model, includes)?;
                includes.close(&included);
                Ok(())
            }
            "gripper" | "plugin" | "static" | "self_collide" | "allow_auto_disable" | "enable_wind" | "pose" => Ok(()),
            other => {
                self.parts.notes.push(format!("line {}: <{}> is ignored", child.line, shown(other)));
                Ok(())
            }
        }
    }

    fn read_nested(&mut self, model: &Element, prefix: &str, outer: &str, includes: &mut Includes) -> Result<()> {
        let name = name_of(model)?;
        if prefix.matches("::").count() >= 20 {
            return Err(model.error(ErrorKind::BadValue, "is nested in more than 20 models"));
        }
        self.read_model(model, &format!("{prefix}{name}::"), outer.to_owned(), includes)
    }

    fn read_link(&mut self, element: &Element, prefix: &str, model: &str) -> Result<()> {
        let name = format!("{prefix}{}", name_of(element)?);
        let (pose, reference) = pose_of(element)?;
        let reference = reference.map_or_else(|| model.to_owned(), |name| format!("{prefix}{name}"));
        self.frames.add(&name, reference, pose, Fixed::Itself, place(element, "link"))?;
        self.names.take_link(&name);
        self.parts.links.push(link::read(element, &name)?);
        Ok(())
    }

    fn read_joint(&mut self, element: &Element, prefix: &str) -> Result<()> {
        let name = format!("{prefix}{}", name_of(element)?);
        let (pose, reference) = pose_of(element)?;
        let child = format!("{prefix}{}", joint::end(element, "child")?);
        let reference = reference.map_or_else(|| child.clone(), |name| format!("{prefix}{name}"));
        self.frames.add(&name, reference, pose, Fixed::To(child), place(element, "joint"))?;
        self.names.take_joint(&name);
        self.joints.push(Pending { name, prefix: prefix.to_owned(), element: element.clone() });
        Ok(())
    }

    fn read_frame(&mut self, element: &Element, prefix: &str, model: &str) -> Result<()> {
        let name = format!("{prefix}{}", name_of(element)?);
        let (pose, reference) = pose_of(element)?;
        let attached = element.attribute("attached_to").filter(|name| !name.is_empty());
        let attached = attached.map_or_else(|| model.to_owned(), |name| format!("{prefix}{name}"));
        let reference = reference.map_or_else(|| attached.clone(), |name| format!("{prefix}{name}"));
        let at = place(element, "frame");
        self.frames.add(&name, reference, pose, Fixed::To(attached), at.clone())?;
        self.names.take_link(&name);
        self.tips.push((name, element.own_line(), at));
        Ok(())
    }

    /// The robot.
    ///
    /// # Errors
    /// Those of the joints and of [`Robot::with_faults`].
    pub fn finish(mut self) -> Result<Robot> {
        let mut has_world = false;
        for pending in std::mem::take(&mut self.joints) {
            let named = |error: Error| error.with_context(format_args!("joint `{}`", shown(&pending.name)));
            has_world |= self.connect(&pending).map_err(named)?;
        }
        if has_world {
            self.parts.links.insert(0, Link::new(WORLD));
        }
        for (name, line, at) in std::mem::take(&mut self.tips) {
            let link = self.frames.link_of(&name, &at)?;
            let pose = self.frames.between(&link, &name, &at)?;
            self.parts.links.push(Link { line, ..Link::new(&name) });
            attach(&mut self.parts, &mut self.names, [&link, &name], pose);
        }
        Robot::with_faults(self.parts)
    }

    /// Adds a joint between its links. Returns whether its parent is the world.
    fn connect(&mut self, pending: &Pending) -> Result<bool> {
        let Pending { name, prefix, element } = pending;
        let at = at(element, String::new());
        let kind = Kind::of(element)?;
        let Some(kind) = kind else {
            let text = format!(
                "line {}: joint `{}` is ignored: a gearbox is not a joint of a tree",
                element.line,
                shown(name)
            );
            self.parts.notes.push(text);
            return Ok(false);
        };
        let parent = joint::end(element, "parent")?;
        let is_world = parent == WORLD;
        let parent =
            if is_world { WORLD.to_owned() } else { self.frames.link_of(&format!("{prefix}{parent}"), &at)? };
        let child = format!("{prefix}{}", joint::end(element, "child")?);
        let child = self.frames.link_of(&child, &at)?;
        if !self.trees.join(&parent, &child) {
            let text = "closes a loop of links and is ignored: links form a tree without it";
            self.parts.notes.push(format!("line {}: joint `{}` {text}", element.line, shown(name)));
            return Ok(false);
        }
        if let Some(other) = self.above.insert(child.clone(), name.clone()) {
            let text = format!(
                "joint `{}`: its child `{}` is already the child of joint `{}`; a robot must be a tree: exchange parent and child of the joint that is reversed",
                shown(name),
                shown(&child),
                shown(&other)
            );
            return Err(self::at(element, text));
        }
        let pose = self.frames.between(&parent, &child, &at)?;
        if kind == Kind::Fixed {
            let joint = Joint::new(name, JointType::Fixed, &parent, &child);
            self.parts.joints.push(Joint { origin: pose.into(), line: element.own_line(), ..joint });
            return Ok(is_world);
        }
        let own = self.frames.between(&child, name, &at)?;
        let expressed = |frame: &str| {
            let frame = if frame == MODEL { format!("{prefix}{MODEL}") } else { format!("{prefix}{frame}") };
            self.frames.between(&child, &frame, &at)
        };
        let context = joint::Context { prefix, version: self.version, own: &own };
        let joints = joint::read(element, name, kind, &context, expressed)?;
        for joint in joints.iter().skip(1) {
            self.names.take_joint(&joint.name);
        }
        let step =
            |joint| Step { joint, anchor: own.origin.clone(), zero: crate::spatial::exact::Placement::identity() };
        let steps = joints.into_iter().map(step).collect();
        assemble(&mut self.parts, &mut self.names, [&parent, &child], pose, steps);
        Ok(is_world)
    }
}

/// The links that joints connect, in either direction.
#[derive(Default)]
struct Trees(HashMap<String, String>);

impl Trees {
    /// Connects two links. Returns whether they were in different trees.
    fn join(&mut self, parent: &str, child: &str) -> bool {
        let (above, below) = (self.root(parent), self.root(child));
        let is_new = above != below;
        if is_new {
            self.0.insert(below, above);
        }
        is_new
    }

    /// The link that stands for the tree of `link`. The links between them point to it afterwards, so that long chains stay fast.
    fn root(&mut self, link: &str) -> String {
        let mut passed = vec![link.to_owned()];
        while let Some(next) = passed.last().and_then(|link| self.0.get(link)) {
            passed.push(next.clone());
        }
        let root = passed.pop().expect("at least the link itself");
        self.0.extend(passed.into_iter().map(|link| (link, root.clone())));
        root
    }
}

/// The name of an element.
fn name_of(element: &Element) -> Result<&str> {
    let name = element.required("name")?;
    let fault = match name {
        "" => "an empty name",
        WORLD | MODEL => "a name that SDF reserves",
        _ if name.contains("::") => "a name with `::`, which separates the names of nested models",
        _ => return Ok(name),
    };
    Err(element.error(ErrorKind::BadValue, &format!("has {fault}, `{}`; give another one", shown(name))))
}

/// The place of an element in the file, as an error without a cause.
fn place(element: &Element, what: &str) -> Error {
    let name = element.attribute("name").unwrap_or("");
    at(element, format!("{what} `{}`", shown(name)))
}

/// The place of an element in the file, with the start of a message.
fn at(element: &Element, start: String) -> Error {
    let error = Error::new(ErrorKind::BadValue, start).at_line(element.line);
    if let Some(file) = &element.file { error.in_file(file) } else { error }
}
