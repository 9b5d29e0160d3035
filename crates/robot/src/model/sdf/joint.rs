//! Joints of an SDF.

use num_traits::{One, Zero};

use super::values::{float, is_true, number, numbers, required_text};
use crate::document::{one_among, shown};
use crate::model::urdf::xml::Element;
use crate::model::{Joint, JointType, Mimic};
use crate::spatial::exact::{ExactVector, Placement, vector};
use crate::{ErrorKind, Result};

/// A limit of at least this size is none.
const INFINITE: f64 = 1e16;
/// The half range of a prismatic joint without limits \[m\]. A robot's prismatic joint has finite limits.
const UNLIMITED: f64 = 1000.0;
/// The types of joints.
const TYPES: [&str; 9] =
    ["revolute", "continuous", "prismatic", "fixed", "ball", "universal", "revolute2", "gearbox", "screw"];

/// The type of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Fixed,
    Revolute,
    Prismatic,
    /// Three hinges about x, y and z.
    Ball,
    /// Two hinges about `axis` and `axis2`.
    Two,
}

impl Kind {
    /// The type of a joint; `None` for a gearbox.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for an unknown type; [`ErrorKind::Unsupported`] for a screw.
    pub fn of(element: &Element) -> Result<Option<Kind>> {
        let text = element.required("type")?;
        Ok(Some(match text {
            "fixed" => Kind::Fixed,
            "revolute" | "continuous" => Kind::Revolute,
            "prismatic" => Kind::Prismatic,
            "ball" => Kind::Ball,
            "universal" | "revolute2" => Kind::Two,
            "gearbox" => return Ok(None),
            "screw" => return Err(element.error(ErrorKind::Unsupported, "is a screw joint, which is not read")),
            _ => {
                let text = format!("has the type `{}`{}", shown(text), one_among(text, &TYPES));
                return Err(element.error(ErrorKind::BadValue, &text));
            }
        }))
    }
}

/// The name in `<parent>` or `<child>`: a text, or the text of a `<link>` in old files.
///
/// # Errors
/// [`ErrorKind::MissingKey`] without a name.
pub fn end<'e>(element: &'e Element, which: &str) -> Result<&'e str> {
    required_text(element, which)
}

/// The model and the frame of a joint.
pub struct Context<'a> {
    /// The prefix of names in its model.
    pub prefix: &'a str,
    /// The version of the file.
    pub version: (u32, u32),
    /// The joint's frame in the child link's.
    pub own: &'a Placement,
}

/// Reads the joints with one degree of freedom of a joint. `expressed` is the frame of a name in the
/// child link's frame. The axes are in the child link's frame.
///
/// # Errors
/// [`ErrorKind::BadValue`] for wrong numbers and a zero axis; those of `expressed`.
pub fn read(
    element: &Element,
    name: &str,
    kind: Kind,
    context: &Context<'_>,
    expressed: impl Fn(&str) -> Result<Placement>,
) -> Result<Vec<Joint>> {
    let line = element.own_line();
    if kind == Kind::Ball {
        let hinge = |index: usize| {
            let axis = context.own.rotation.turn(&vector::unit(index));
            let name = format!("{name}_{}", ["x", "y", "z"][index]);
            Joint { axis, line, ..Joint::new(&name, JointType::Continuous, "", "") }
        };
        let mut hinges: Vec<Joint> = (0..3).map(hinge).collect();
        hinges[0].notes.push("a ball joint is read as three hinges about x, y and z".to_owned());
        return Ok(hinges);
    }
    let axes = if kind == Kind::Two { &["axis", "axis2"][..] } else { &["axis"][..] };
    let one = |which: &&str| {
        let name = if kind == Kind::Two { format!("{name}_{which}") } else { name.to_owned() };
        let joint = Joint { line, ..Joint::new(&name, JointType::Continuous, "", "") };
        match element.child(which)? {
            Some(axis) => read_axis(axis, joint, kind, context, &expressed),
            None => {
                let text =
                    format!("has no <{which}>; a {} needs it", shown(element.attribute("type").unwrap_or("joint")));
                Err(element.error(ErrorKind::MissingKey, &text))
            }
        }
    };
    axes.iter().map(one).collect()
}

fn read_axis(
    element: &Element,
    bare: Joint,
    kind: Kind,
    context: &Context<'_>,
    expressed: &impl Fn(&str) -> Result<Placement>,
) -> Result<Joint> {
    let axis = direction(element, context.version, context.own, expressed)?;
    let mut joint = Joint { axis, ..bare };
    let limit = element.child("limit")?;
    let value = |name: &str| limit.map_or(Ok(None), |limit| float(limit, name));
    let bounds = (value("lower")?.unwrap_or(-INFINITE), value("upper")?.unwrap_or(INFINITE));
    let is_open = bounds.0 <= -INFINITE || bounds.1 >= INFINITE;
    (joint.kind, joint.limits) = match kind {
        Kind::Prismatic if is_open => {
            joint.notes.push(format!("it has no limits; {UNLIMITED} m in both directions are taken"));
            (JointType::Prismatic, Some((bounds.0.max(-UNLIMITED), bounds.1.min(UNLIMITED))))
        }
        Kind::Prismatic => (JointType::Prismatic, Some(bounds)),
        _ if is_open => {
            if bounds.0 > -INFINITE || bounds.1 < INFINITE {
                joint.notes.push("it has a limit on one side only, which is ignored".to_owned());
            }
            (JointType::Continuous, None)
        }
        _ => (JointType::Revolute, Some(bounds)),
    };
    // A negative number means without limit.
    let bounded = |value: Option<f64>| value.filter(|value| *value > 0.0 && value.is_finite());
    (joint.effort, joint.speed) = (bounded(value("effort")?), bounded(value("velocity")?));
    let dynamics = element.child("dynamics")?;
    let value = |name: &str| dynamics.map_or(Ok(None), |dynamics| float(dynamics, name));
    joint.damping = value("damping")?.unwrap_or(0.0);
    joint.friction = value("friction")?.unwrap_or(0.0);
    if value("spring_stiffness")?.is_some_and(|stiffness| stiffness != 0.0) {
        joint.notes.push("its spring (spring_stiffness) is ignored".to_owned());
    }
    joint.mimic = element.child("mimic")?.map(|mimic| read_mimic(mimic, context.prefix)).transpose()?;
    Ok(joint)
}

/// The direction of an axis in the child link's frame.
fn direction(
    element: &Element,
    version: (u32, u32),
    own: &Placement,
    expressed: &impl Fn(&str) -> Result<Placement>,
) -> Result<ExactVector> {
    let xyz = element.child("xyz")?;
    let axis = xyz.map_or(Ok(None), numbers::<3>)?.unwrap_or_else(|| vector::unit(2));
    if vector::is_zero(&axis) {
        return Err(element.error(ErrorKind::BadValue, "has `xyz` 0 0 0; give a direction"));
    }
    let frame = xyz.and_then(|xyz| xyz.attribute("expressed_in")).filter(|name| !name.is_empty());
    let old = element.child("use_parent_model_frame")?.map(|child| is_true(&child.text));
    // Before version 1.5 axes are in the model's frame.
    let is_in_model = old.unwrap_or(version < (1, 5));
    let rotation = match frame {
        Some(frame) => expressed(frame)?.rotation,
        None if is_in_model => expressed(super::frames::MODEL)?.rotation,
        None => own.rotation.clone(),
    };
    Ok(rotation.turn(&axis))
}

/// Reads `<mimic joint="..." axis="...">`: value = multiplier * (leader - reference) + offset.
fn read_mimic(element: &Element, prefix: &str) -> Result<Mimic> {
    let leader = element.required("joint")?;
    let suffix = if element.attribute("axis") == Some("axis2") { "_axis2" } else { "" };
    let multiplier = number(element, "multiplier")?.unwrap_or_else(One::one);
    let reference = number(element, "reference")?.unwrap_or_else(Zero::zero);
    let offset = number(element, "offset")?.unwrap_or_else(Zero::zero) - &multiplier * reference;
    Ok(Mimic { leader: format!("{prefix}{leader}{suffix}"), multiplier, offset })
}
