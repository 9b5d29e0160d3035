//! Reading of robots from URDF: [`Tree::read_urdf`], [`Tree::from_urdf`].
//!
#![doc = include_str!("../../../docs/urdf.md")]

mod xml;

use std::path::Path;

use num_traits::ToPrimitive;

use super::Mimic;
use super::surd::recognised;
use super::tree::{Tree, TreeJoint, TreeJointKind, TreeLink};
use super::{ExactRotation, ExactVector, Placement, Turn};
use crate::document::{did_you_mean, one_among, read_text, shown};
use crate::number::BigRational;
use crate::{Error, ErrorKind, Result};
use xml::Element;

/// The longest file that is read, in bytes.
pub const URDF_LIMIT: u64 = 4_000_000;

/// The elements of a joint.
const PARTS: [&str; 9] =
    ["parent", "child", "origin", "axis", "limit", "calibration", "dynamics", "mimic", "safety_controller"];

const KINDS: [TreeJointKind; 6] = [
    TreeJointKind::Revolute,
    TreeJointKind::Continuous,
    TreeJointKind::Prismatic,
    TreeJointKind::Fixed,
    TreeJointKind::Floating,
    TreeJointKind::Planar,
];

impl Tree {
    /// The robot that the URDF file at `path` describes.
    ///
    /// # Errors
    /// As [`read_text`], with a limit of four megabytes, and [`Tree::from_urdf`], with the file.
    pub fn read_urdf(path: &Path) -> Result<Tree> {
        Tree::from_urdf(&read_text(path, URDF_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// The robot that `text` describes in the format of [`crate::kinematics::urdf`].
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not XML; [`ErrorKind::MissingKey`] for missing elements and attributes;
    /// [`ErrorKind::BadValue`] for another root element, wrong numbers, joint types that URDF does not know, elements given twice;
    /// [`ErrorKind::Unsupported`] for xacro; and as [`Tree::new`]. All have a line.
    pub fn from_urdf(text: &str) -> Result<Tree> {
        let root = Element::parse(text)?;
        check_root(&root)?;
        let (mut links, mut joints) = (Vec::new(), Vec::new());
        let is_recent = version(&root).is_some_and(|version| version >= (1, 2));
        for element in &root.children {
            match element.name.as_str() {
                "link" => links.push(TreeLink { name: element.required("name")?.to_owned(), line: Some(element.line) }),
                "joint" => joints.push(read_joint(element, is_recent)?),
                _ => {}
            }
        }
        let name = root.attribute("name").unwrap_or("robot").trim();
        Tree::new(if name.is_empty() { "robot".to_owned() } else { name.to_owned() }, links, joints)
            .map_err(|error| error.at_line(root.line))
    }
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

fn read_joint(element: &Element, is_recent: bool) -> Result<TreeJoint> {
    let name = element.required("name")?;
    read_named_joint(element, name, is_recent)
        .map_err(|error| error.with_context(format_args!("joint `{}`", shown(name))).at_line(element.line))
}

fn read_named_joint(element: &Element, name: &str, is_recent: bool) -> Result<TreeJoint> {
    refuse_slips(element)?;
    let kind = read_kind(element)?;
    let link = |part: &str| -> Result<String> {
        let missing =
            || element.error(ErrorKind::MissingKey, &format!("has no <{part} link=\"...\"/>; it is required"));
        Ok(element.child(part)?.ok_or_else(missing)?.required("link")?.to_owned())
    };
    let (origin, mut notes) =
        element.child("origin")?.map_or_else(|| Ok((Placement::identity(), Vec::new())), read_origin)?;
    let axis = read_axis(element.child("axis")?)?;
    if recognised(&axis).is_some() {
        notes.push(
            "its axis is taken as the unit vector with 1/2, sqrt 2 / 2 or sqrt 3 / 2 that it is the decimal of, where solvers are derived"
                .to_owned(),
        );
    }
    Ok(TreeJoint {
        name: name.to_owned(),
        kind,
        parent: link("parent")?,
        child: link("child")?,
        origin,
        axis,
        limits: read_limits(element, kind, is_recent)?,
        mimic: element.child("mimic")?.map(read_mimic).transpose()?,
        notes,
        line: Some(element.line),
    })
}

/// Fails for an element whose name is nearly that of a joint's element; other unknown ones are extensions.
fn refuse_slips(joint: &Element) -> Result<()> {
    for child in joint.children.iter().filter(|child| !PARTS.contains(&child.name.as_str())) {
        let advice = did_you_mean(&child.name, &PARTS);
        if !advice.is_empty() {
            return Err(child.error(ErrorKind::UnknownKey, &format!("is no element of a joint{advice}")));
        }
    }
    Ok(())
}

fn read_kind(element: &Element) -> Result<TreeJointKind> {
    let text = element.required("type")?;
    KINDS.into_iter().find(|kind| kind.name() == text).ok_or_else(|| {
        let names = KINDS.map(TreeJointKind::name);
        element.error(ErrorKind::BadValue, &format!("has the type `{}`{}", shown(text), one_among(text, &names)))
    })
}

/// A frame, and what is to be said about its rotation.
fn read_origin(element: &Element) -> Result<(Placement, Vec<String>)> {
    let mut placement = Placement::identity();
    if let Some(xyz) = element.numbers("xyz")? {
        placement.origin = xyz;
    }
    let (rpy, quaternion) = (element.numbers::<3>("rpy")?, element.numbers::<4>("quat_xyzw")?);
    let mut notes = Vec::new();
    match (rpy, quaternion) {
        (Some(_), Some(_)) => {
            return Err(element.error(ErrorKind::BadValue, "has both `rpy` and `quat_xyzw`; give one of them"));
        }
        (Some(rpy), None) => {
            let (turned, told) = read_rpy(element, &rpy)?;
            (placement, notes) = (Placement { origin: placement.origin, ..turned }, told);
        }
        (None, Some(xyzw)) => {
            let zero =
                || element.error(ErrorKind::BadValue, "has `quat_xyzw` = 0 0 0 0; give a quaternion that is not zero");
            placement.rotation = ExactRotation::from_quaternion(&xyzw).ok_or_else(zero)?;
        }
        (None, None) => {}
    }
    Ok((placement, notes))
}

fn read_rpy(element: &Element, rpy: &ExactVector) -> Result<(Placement, Vec<String>)> {
    let turns: Vec<Turn> = rpy
        .iter()
        .map(|angle| Turn::from_radians(angle).map_err(|error| element.error(error.kind(), error.message())))
        .collect::<Result<_>>()?;
    let mut notes = Vec::new();
    for ((name, angle), turn) in ["roll", "pitch", "yaw"].into_iter().zip(rpy).zip(&turns) {
        let angle = angle.to_f64().unwrap_or(f64::NAN);
        match turn.meant().degrees() {
            Some(_) if angle == 0.0 => {}
            Some(degrees) => {
                let whole = (angle / std::f64::consts::TAU - f64::from(degrees) / 360.0).round();
                let degrees = f64::from(degrees) + 360.0 * whole;
                let told = if turn.is_exact() {
                    "exactly"
                } else {
                    "where solvers are derived; poses are those of the number"
                };
                notes.push(format!("{name} {angle} rad is taken as {degrees} deg {told}"));
            }
            None => {
                let note = "has no exact sine; its rotation is exactly orthogonal, right to 1e-15";
                notes.push(format!("{name} {angle} rad {note}"));
            }
        }
    }
    Ok((Placement::turned(std::array::from_fn(|i| turns[i])), notes))
}

/// The direction; (1, 0, 0) when there is none.
fn read_axis(element: Option<&Element>) -> Result<ExactVector> {
    let default = || [1, 0, 0].map(|x| BigRational::from_integer(x.into()));
    let Some(element) = element else { return Ok(default()) };
    element.required("xyz")?;
    Ok(element.numbers("xyz")?.unwrap_or_else(default))
}

/// Limits; before version 1.2 one that is left out is zero, since then there is none.
fn read_limits(joint: &Element, kind: TreeJointKind, is_recent: bool) -> Result<Option<(f64, f64)>> {
    if !matches!(kind, TreeJointKind::Revolute | TreeJointKind::Prismatic) {
        return Ok(None);
    }
    let Some(element) = joint.child("limit")? else { return Ok(None) };
    let read = |name: &str| -> Result<Option<f64>> {
        let value = element.number(name)?;
        Ok(value.map(|value| value.to_f64().unwrap_or(f64::INFINITY)))
    };
    match (read("lower")?, read("upper")?) {
        (None, None) if is_recent => Err(Error::new(
            ErrorKind::BadValue,
            "<limit> has no `lower` and no `upper`; give both, or the type `continuous`",
        )),
        (None, Some(_)) | (Some(_), None) if is_recent => {
            Err(element.error(ErrorKind::BadValue, "has only one of `lower` and `upper`; give both"))
        }
        (lower, upper) => Ok(Some((lower.unwrap_or(0.0), upper.unwrap_or(0.0)))),
    }
}

fn read_mimic(element: &Element) -> Result<Mimic> {
    let whole = |n: i64| BigRational::from_integer(n.into());
    Ok(Mimic {
        leader: element.required("joint")?.to_owned(),
        multiplier: element.number("multiplier")?.unwrap_or_else(|| whole(1)),
        offset: element.number("offset")?.unwrap_or_else(|| whole(0)),
    })
}
