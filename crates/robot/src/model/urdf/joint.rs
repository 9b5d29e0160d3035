//! Joints of a URDF.

use num_traits::ToPrimitive;

use super::refuse_slips;
use super::transmission::reflected_rotor;
use super::xml::Element;
use crate::document::{one_among, shown};
use crate::model::{Joint, JointType, Mimic, Origin};
use crate::spatial::exact::surd::recognised;
use crate::spatial::exact::{ExactRotation, ExactVector, Placement, Turn};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The allowed child elements of a joint.
const PARTS: [&str; 9] =
    ["parent", "child", "origin", "axis", "limit", "calibration", "dynamics", "mimic", "safety_controller"];

/// Reads a `<joint>`. Returns the joint and its error, if there is one. In that case only its type and links are valid.
///
/// # Errors
/// [`ErrorKind::MissingKey`] without a name or a link, which the tree needs.
pub fn read_joint(element: &Element, is_recent: bool) -> Result<(Joint, Option<Error>)> {
    let name = element.required("name")?;
    let named = |error: Error| error.with_context(format_args!("joint `{}`", shown(name))).at_line(element.line);
    let slip = |error: Error| refuse_slips(element, &PARTS).err().unwrap_or(error);
    let bare = read_bare_joint(element, name).map_err(|error| named(slip(error)))?;
    Ok(match read_whole_joint(element, bare.clone(), is_recent) {
        Ok(joint) => (joint, None),
        Err(error) => (bare, Some(named(error))),
    })
}

/// Reads the joint's name, type and links. A type that URDF does not define is `fixed`.
fn read_bare_joint(element: &Element, name: &str) -> Result<Joint> {
    let link = |part: &str| -> Result<&str> {
        let missing =
            || element.error(ErrorKind::MissingKey, &format!("has no <{part} link=\"...\"/>; it is required"));
        element.child(part)?.ok_or_else(missing)?.required("link")
    };
    let kind = read_kind(element).unwrap_or(JointType::Fixed);
    Ok(Joint { line: Some(element.line), ..Joint::new(name, kind, link("parent")?, link("child")?) })
}

fn read_whole_joint(element: &Element, bare: Joint, is_recent: bool) -> Result<Joint> {
    refuse_slips(element, &PARTS)?;
    let kind = read_kind(element)?;
    let (origin, mut notes) =
        element.child("origin")?.map_or_else(|| Ok((Origin::identity(), Vec::new())), read_origin)?;
    let axis = read_axis(element.child("axis")?)?;
    if recognised(&axis).is_some() {
        notes.push(
            "solvers are derived with its axis as the unit vector with 1/2, sqrt 2 / 2 or sqrt 3 / 2 that these decimals approximate"
                .to_owned(),
        );
    }
    let limit = |key: &str| element.child("limit")?.map_or(Ok(None), |limit| limit.float(key));
    let dynamics = |key: &str| {
        Ok::<_, Error>(element.child("dynamics")?.map_or(Ok(None), |child| child.float(key))?.unwrap_or(0.0))
    };
    Ok(Joint {
        origin,
        axis,
        limits: read_limits(element, kind, is_recent)?,
        // Many descriptions write zero for unknown values, since the attributes are required.
        speed: limit("velocity")?.filter(|speed| *speed != 0.0),
        effort: limit("effort")?.filter(|effort| *effort != 0.0),
        damping: dynamics("damping")?,
        friction: dynamics("friction")?,
        armature: dynamics("armature")? + reflected_rotor(element)?,
        mimic: element.child("mimic")?.map(read_mimic).transpose()?,
        notes,
        ..bare
    })
}

fn read_kind(element: &Element) -> Result<JointType> {
    let text = element.required("type")?;
    JointType::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| {
        let names = JointType::ALL.map(JointType::name);
        element.error(ErrorKind::BadValue, &format!("has the type `{}`{}", shown(text), one_among(text, &names)))
    })
}

/// Reads a frame, and notes about its rotation.
pub fn read_origin(element: &Element) -> Result<(Origin, Vec<String>)> {
    let xyz = element.numbers("xyz")?.unwrap_or_default();
    let (rpy, quaternion) = (element.numbers::<3>("rpy")?, element.numbers::<4>("quat_xyzw")?);
    let (turned, notes) = match (&rpy, quaternion) {
        (Some(_), Some(_)) => {
            return Err(element.error(ErrorKind::BadValue, "has both `rpy` and `quat_xyzw`; give one of them"));
        }
        (Some(rpy), None) => read_rpy(element, rpy)?,
        (None, Some(xyzw)) => {
            let zero =
                || element.error(ErrorKind::BadValue, "has `quat_xyzw` = 0 0 0 0; give a quaternion that is not zero");
            let rotation = ExactRotation::from_quaternion(&xyzw).ok_or_else(zero)?;
            (Placement { rotation, ..Placement::identity() }, Vec::new())
        }
        (None, None) => (Placement::identity(), Vec::new()),
    };
    Ok((Origin { placement: Placement { origin: xyz, ..turned }, rpy }, notes))
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
                let interpretation =
                    if turn.is_exact() { "exactly" } else { "when a solver is derived; poses use the number" };
                notes.push(format!("{name} {angle} rad is interpreted as {degrees} deg {interpretation}"));
            }
            None => {
                let note = "has no exact sine; its rotation is exactly orthogonal, with an error of 1e-15";
                notes.push(format!("{name} {angle} rad {note}"));
            }
        }
    }
    Ok((Placement::turned(std::array::from_fn(|i| turns[i])), notes))
}

/// Reads the direction; (1, 0, 0) by default.
fn read_axis(element: Option<&Element>) -> Result<ExactVector> {
    let default = || [1, 0, 0].map(|x| BigRational::from_integer(x.into()));
    let Some(element) = element else { return Ok(default()) };
    element.required("xyz")?;
    Ok(element.numbers("xyz")?.unwrap_or_else(default))
}

/// Reads the limits. Before version 1.2 a missing limit is zero; since then it is absent.
fn read_limits(joint: &Element, kind: JointType, is_recent: bool) -> Result<Option<(f64, f64)>> {
    if !matches!(kind, JointType::Revolute | JointType::Prismatic) {
        return Ok(None);
    }
    let Some(element) = joint.child("limit")? else { return Ok(None) };
    match (read_limit(element, "lower")?, read_limit(element, "upper")?) {
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

/// Reads a limit. An infinite limit is read too, and refused by the robot's checks.
fn read_limit(element: &Element, name: &str) -> Result<Option<f64>> {
    let value = element.attribute(name).and_then(|text| text.trim().parse().ok());
    if let Some(infinite) = value.filter(|value: &f64| value.is_infinite()) {
        return Ok(Some(infinite));
    }
    Ok(element.number(name)?.map(|value| value.to_f64().unwrap_or(f64::INFINITY)))
}

fn read_mimic(element: &Element) -> Result<Mimic> {
    let whole = |n: i64| BigRational::from_integer(n.into());
    Ok(Mimic {
        leader: element.required("joint")?.to_owned(),
        multiplier: element.number("multiplier")?.unwrap_or_else(|| whole(1)),
        offset: element.number("offset")?.unwrap_or_else(|| whole(0)),
    })
}
