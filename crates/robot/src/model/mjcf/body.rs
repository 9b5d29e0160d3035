//! The tree of bodies of an MJCF as links and joints. Main type: [`Reader`].

use std::collections::HashMap;

use num_traits::Zero;

use super::compiler::{Compiler, MassSource, double};
use super::defaults::{Classes, MAIN, Styled};
use super::frame::placement;
use super::geom::{self, Assets, Context};
use super::inertia;
use super::joint::{self, Axis};
use crate::document::shown;
use crate::model::assembly::{Step, assemble, attach};
use crate::model::names::Names;
use crate::model::urdf::xml::Element;
use crate::model::{Joint, JointType, Link, Meshes, Robot, RobotParts};
use crate::spatial::exact::{Placement, vector};
use crate::{ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// Elements of a body that are added by MuJoCo from other models or by a rule.
const MADE: [&str; 5] = ["attach", "replicate", "composite", "flexcomp", "plugin"];

/// An element of a body with the class that it inherits, and the frame of its `<frame>` in the body.
struct Part<'e> {
    element: &'e Element,
    class: usize,
    frame: Placement,
}

/// The elements of a body, also those in `<frame>` elements.
#[derive(Default)]
struct Content<'e> {
    bodies: Vec<Part<'e>>,
    joints: Vec<Part<'e>>,
    geoms: Vec<Part<'e>>,
    sites: Vec<Part<'e>>,
    inertials: Vec<Part<'e>>,
}

/// What has been read of a model.
pub struct Reader<'r, 'e> {
    pub(super) root: &'e Element,
    pub(super) compiler: &'r Compiler,
    pub(super) classes: &'r Classes<'e>,
    files: &'r Meshes,
    assets: Assets<'e>,
    names: Names,
    pub(super) parts: RobotParts,
    /// The value of each joint in the model's initial position \[rad or m\], by name.
    pub(super) references: HashMap<String, BigRational>,
    /// The number of bodies.
    count: usize,
}

impl<'r, 'e> Reader<'r, 'e> {
    /// A reader of the model `root`.
    ///
    /// # Errors
    /// Those of [`Assets::read`].
    pub fn new(root: &'e Element, compiler: &'r Compiler, classes: &'r Classes<'e>, files: &'r Meshes) -> Result<Self> {
        let name = root.attribute("model").map(str::trim).filter(|name| !name.is_empty()).unwrap_or("robot");
        let parts = RobotParts { name: name.to_owned(), ..RobotParts::default() };
        let assets = Assets::read(root, classes)?;
        let names = Names::of_mjcf(root);
        Ok(Reader { root, compiler, classes, files, assets, names, parts, references: HashMap::new(), count: 0 })
    }

    /// Adds a note about the whole model.
    pub fn note(&mut self, note: String) {
        self.parts.notes.push(note);
    }

    /// Reads the bodies of the world. A single body with a free joint is the root; otherwise the root is a link for the
    /// world.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] without bodies; those of the parts.
    pub fn read_world(&mut self) -> Result<()> {
        let mut content = Content::default();
        for world in self.root.children.iter().filter(|child| child.name == "worldbody") {
            self.gather(world, MAIN, &Placement::identity(), &mut content)?;
        }
        let bodies = std::mem::take(&mut content.bodies);
        if bodies.is_empty() {
            return Err(self.root.error(ErrorKind::MissingKey, "has no <body> in its <worldbody>; give at least one"));
        }
        let moves: Vec<bool> = bodies.iter().map(|body| has_joint(body.element)).collect();
        let movable = moves.iter().filter(|moves| **moves).count();
        let is_free = |body: &Part<'_>| self.free_joint(body).map(|joint| joint.is_some());
        let free = bodies.iter().map(is_free).collect::<Result<Vec<_>>>()?;
        if movable == 1 && free.contains(&true) {
            let scenery = bodies.len() - 1;
            if scenery > 0 {
                self.note(format!("{scenery} bodies of the world without joints are ignored"));
            }
            for (body, is_free) in bodies.iter().zip(free) {
                if is_free {
                    self.read_body(body, None)?;
                } else {
                    self.count += count(body.element);
                }
            }
            return Ok(());
        }
        let world = self.names.link("world");
        let mut link = Link::new(&world);
        self.read_geoms(&content.geoms, &mut link, false)?;
        // The floor and other objects of the world are no parts of the robot.
        link.notes.clear();
        self.parts.links.push(link);
        self.read_sites(&content.sites, &world)?;
        bodies.iter().try_for_each(|body| self.read_body(body, Some(&world)))
    }

    /// The robot.
    ///
    /// # Errors
    /// Those of [`Robot::with_faults`].
    pub fn finish(mut self) -> Result<Robot> {
        self.scale_masses();
        Robot::with_faults(self.parts)
    }

    /// Scales all masses to the compiler's total mass.
    fn scale_masses(&mut self) {
        let sum: BigRational = self.parts.links.iter().filter_map(|link| Some(&link.mass.as_ref()?.mass)).sum();
        let Some(total) = self.compiler.total_mass.and_then(BigRational::from_float) else { return };
        if sum.is_zero() {
            return;
        }
        let factor = total / sum;
        self.parts
            .links
            .iter_mut()
            .filter_map(|link| link.mass.as_mut())
            .for_each(|mass| inertia::scale(mass, &factor));
    }

    /// Adds the elements of a body, a `<worldbody>` or a `<frame>` to `content`.
    fn gather(&self, outer: &'e Element, class: usize, frame: &Placement, content: &mut Content<'e>) -> Result<()> {
        let class = self.classes.named(outer, "childclass")?.unwrap_or(class);
        for element in &outer.children {
            let part = || Part { element, class, frame: frame.clone() };
            match element.name.as_str() {
                "body" => content.bodies.push(part()),
                "joint" | "freejoint" => content.joints.push(part()),
                "geom" => content.geoms.push(part()),
                "site" => content.sites.push(part()),
                "inertial" => content.inertials.push(part()),
                "frame" => {
                    let own = placement(&Styled::plain(element), self.compiler)?;
                    self.gather(element, class, &frame.then(&own), content)?;
                }
                name if MADE.contains(&name) => {
                    let text =
                        "makes bodies by a rule, which is not read; save the model by MuJoCo's `mj_saveLastXML` first";
                    return Err(element.error(ErrorKind::Unsupported, text));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The free joint of a body, by `<freejoint>` or a joint of type `free`.
    fn free_joint(&self, body: &Part<'e>) -> Result<Option<&'e Element>> {
        let mut content = Content::default();
        self.gather(body.element, body.class, &Placement::identity(), &mut content)?;
        for joint in &content.joints {
            if joint.element.name == "freejoint"
                || self.classes.styled(joint.element, joint.class, &["joint"])?.attribute("type") == Some("free")
            {
                return Ok(Some(joint.element));
            }
        }
        Ok(None)
    }

    /// Reads a body below the link `parent`; without a parent it is the root.
    fn read_body(&mut self, body: &Part<'e>, parent: Option<&str>) -> Result<()> {
        self.count += 1;
        let element = body.element;
        let given = element.attribute("name").filter(|name| !name.is_empty()).map(str::to_owned);
        let name = given.unwrap_or_else(|| self.names.link(&format!("body{}", self.count)));
        let mut content = Content::default();
        self.gather(element, body.class, &Placement::identity(), &mut content)?;
        let named = |error: crate::Error| error.with_context(format_args!("body `{}`", shown(&name)));
        let at = body.frame.then(&placement(&Styled::plain(element), self.compiler).map_err(named)?);
        if let Some(parent) = parent {
            self.read_joints(&content.joints, parent, &name, at).map_err(named)?;
        }
        let mut link = Link { line: element.own_line(), ..Link::new(&name) };
        self.read_mass(&content, &mut link).map_err(named)?;
        self.parts.links.push(link);
        self.read_sites(&content.sites, &name)?;
        content.bodies.iter().try_for_each(|child| self.read_body(child, Some(&name)))
    }

    /// Reads the joints of a body, from the link `parent` to the link `body` at the frame `at` in it.
    fn read_joints(&mut self, joints: &[Part<'e>], parent: &str, body: &str, at: Placement) -> Result<()> {
        let mut axes: Vec<(Axis, String, Option<usize>)> = Vec::new();
        for part in joints {
            if self.is_free(part)? {
                return self.add_free(part, joints.len(), parent, body, at);
            }
            let styled = self.classes.styled(part.element, part.class, &["joint"])?;
            let own = part.element.attribute("name").filter(|name| !name.is_empty()).map(str::to_owned);
            let own = own.unwrap_or_else(|| self.names.joint(&format!("{body}_joint")));
            for axis in joint::read(&styled, self.compiler)? {
                axes.push((in_frame(axis, &part.frame), own.clone(), part.element.own_line()));
            }
        }
        let steps = axes.into_iter().map(|(axis, own, line)| self.step(axis, own, line)).collect();
        assemble(&mut self.parts, &mut self.names, [parent, body], at, steps);
        Ok(())
    }

    /// A joint with one degree of freedom. Its initial value is recorded.
    fn step(&mut self, axis: Axis, own: String, line: Option<usize>) -> Step {
        let name = if axis.suffix.is_empty() { own } else { self.names.joint(&(own + &axis.suffix)) };
        let joint = Joint {
            axis: axis.axis,
            limits: axis.limits,
            effort: axis.effort,
            damping: axis.damping,
            friction: axis.friction,
            armature: axis.armature,
            notes: axis.notes,
            line,
            ..Joint::new(&name, axis.kind, "", "")
        };
        self.references.insert(name, axis.reference);
        Step { joint, anchor: axis.anchor, zero: axis.zero }
    }

    fn is_free(&self, part: &Part<'e>) -> Result<bool> {
        let styled = self.classes.styled(part.element, part.class, &["joint"])?;
        Ok(part.element.name == "freejoint" || styled.attribute("type") == Some("free"))
    }

    /// Adds a free joint of a body that is not the root, as a floating joint.
    fn add_free(&mut self, part: &Part<'e>, count: usize, parent: &str, body: &str, at: Placement) -> Result<()> {
        if count > 1 || self.parts.links.first().is_none_or(|root| root.name != parent) {
            let text = "is a free joint; it must be the only joint of a body in the world";
            return Err(part.element.error(ErrorKind::BadValue, text));
        }
        let own = part.element.attribute("name").map(str::to_owned);
        let name = own.unwrap_or_else(|| self.names.joint(&format!("{body}_joint")));
        let joint = Joint::new(&name, JointType::Floating, parent, body);
        self.parts.joints.push(Joint { origin: at.into(), line: part.element.own_line(), ..joint });
        Ok(())
    }

    /// Reads the mass and the shapes of a body.
    fn read_mass(&mut self, content: &Content<'e>, link: &mut Link) -> Result<()> {
        let of_geoms = match self.compiler.masses {
            MassSource::Geoms => true,
            MassSource::Inertial => false,
            MassSource::Auto => content.inertials.is_empty(),
        };
        let masses = self.read_geoms(&content.geoms, link, of_geoms)?;
        link.mass = match content.inertials.as_slice() {
            _ if of_geoms => inertia::of_geoms(&masses),
            [] => None,
            [part] => Some(inertia::read(&Styled::plain(part.element), &part.frame, self.compiler)?),
            [_, second, ..] => {
                return Err(second.element.error(ErrorKind::BadValue, "is the second of this body; give one"));
            }
        };
        if let Some(mass) = &mut link.mass
            && inertia::raise(mass, self.compiler)
        {
            link.notes.push(
                "its mass or inertia is changed by the compiler's `boundmass`, `boundinertia` or `balanceinertia`"
                    .to_owned(),
            );
        }
        Ok(())
    }

    /// Adds the shapes of geoms to a link, and returns their masses if they are needed.
    fn read_geoms(&self, geoms: &[Part<'e>], link: &mut Link, weighs: bool) -> Result<Vec<crate::spatial::Inertia>> {
        let context = Context { compiler: self.compiler, assets: &self.assets, files: self.files, weighs };
        let mut masses = Vec::new();
        for part in geoms {
            let styled = self.classes.styled(part.element, part.class, &["geom"])?;
            let geom = geom::read(&styled, &part.frame, &context)?;
            masses.extend(geom.inertia);
            link.notes.extend(geom.note);
            if geom.collides { &mut link.collisions } else { &mut link.visuals }.extend(geom.shape);
        }
        Ok(masses)
    }

    /// Adds the named sites of a body as links at fixed joints.
    fn read_sites(&mut self, sites: &[Part<'e>], body: &str) -> Result<()> {
        for part in sites {
            let Some(given) = part.element.attribute("name").filter(|name| !name.is_empty()) else { continue };
            let styled = self.classes.styled(part.element, part.class, &["site"])?;
            let own = match styled.holder("fromto") {
                Some(_) => continue,
                None => placement(&styled, self.compiler)?,
            };
            let wanted = if self.names.has_link(given) { format!("{given}_site") } else { given.to_owned() };
            let name = self.names.link(&wanted);
            self.parts.links.push(Link { line: part.element.own_line(), ..Link::new(&name) });
            attach(&mut self.parts, &mut self.names, [body, &name], part.frame.then(&own));
        }
        Ok(())
    }
}

/// A joint's axis with its anchor and direction in the frame of the body, for a joint inside of `<frame>`.
fn in_frame(axis: Axis, frame: &Placement) -> Axis {
    if *frame == Placement::identity() {
        return axis;
    }
    let zero = match axis.kind {
        JointType::Prismatic => Placement { origin: frame.rotation.turn(&axis.zero.origin), ..Placement::identity() },
        _ => {
            let turned = Placement { origin: vector::zero(), ..frame.clone() };
            turned.then(&axis.zero).then(&turned.inverse())
        }
    };
    let anchor = vector::add(&frame.origin, &frame.rotation.turn(&axis.anchor));
    Axis { zero, anchor, axis: frame.rotation.turn(&axis.axis), ..axis }
}

/// Whether a body or one below it has a joint.
fn has_joint(element: &Element) -> bool {
    element.children.iter().any(|child| {
        ["joint", "freejoint"].contains(&child.name.as_str())
            || (["body", "frame"].contains(&child.name.as_str()) && has_joint(child))
    })
}

/// The number of bodies of an element: itself and those below it.
fn count(element: &Element) -> usize {
    usize::from(element.name == "body") + element.children.iter().map(count).sum::<usize>()
}

/// The law `value = offset + factor * leader` between joint values that are relative to the initial position, for joint
/// values.
pub fn absolute(offset: &BigRational, factor: &BigRational, own: &BigRational, leader: &BigRational) -> BigRational {
    offset + own - factor * leader
}

/// The largest magnitude of a range.
pub fn magnitude(range: &[BigRational; 2]) -> f64 {
    range.iter().map(|bound| double(bound).abs()).fold(0.0, f64::max)
}
