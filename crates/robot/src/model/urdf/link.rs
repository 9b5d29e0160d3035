//! Links of a URDF: masses and shapes.

use std::collections::HashMap;

use super::joint::read_origin;
use super::refuse_slips;
use super::xml::Element;
use crate::document::shown;
use crate::model::{Link, Mass, Origin, Shape, Solid};
use crate::spatial::rotation;
use crate::{Error, ErrorKind, Result};

/// The allowed child elements of a link.
const PARTS: [&str; 3] = ["inertial", "visual", "collision"];
/// The names of the moments, in the order of [`Mass::moments`].
const MOMENTS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

/// Reads a `<link>`. Returns the link and its error, if there is one. `colours` are those of the robot's materials. An
/// invalid shape is ignored with a note.
///
/// # Errors
/// [`ErrorKind::MissingKey`] without a name.
pub fn read_link(element: &Element, colours: &HashMap<&str, [f64; 4]>) -> Result<(Link, Option<Error>)> {
    let name = element.required("name")?;
    let mut link = Link { line: Some(element.line), ..Link::new(name) };
    for child in &element.children {
        let shapes = match child.name.as_str() {
            "visual" => &mut link.visuals,
            "collision" => &mut link.collisions,
            _ => continue,
        };
        match read_shape(child, colours) {
            Ok(shape) => shapes.extend(shape),
            // A description with an invalid visual shape is still usable.
            Err(error) => link.notes.push(format!("omitted: {error}")),
        }
    }
    let mut inertials = element.children.iter().filter(|child| child.name == "inertial");
    let inertial = inertials.next();
    // urdfdom, the most common URDF parser, uses the first one.
    let extra = |second: &Element| format!("<inertial> of line {} is ignored: the first one is used", second.line);
    link.notes.extend(inertials.map(extra));
    let mass = || refuse_slips(element, &PARTS).and_then(|()| inertial.map(read_mass).transpose());
    let named = |error: Error| error.with_context(format_args!("link `{}`", shown(name))).at_line(element.line);
    let fault = match mass() {
        Ok(mass) => {
            link.mass = mass;
            None
        }
        Err(error) => Some(named(error)),
    };
    Ok((link, fault))
}

fn read_mass(element: &Element) -> Result<Mass> {
    let no_mass = || element.error(ErrorKind::MissingKey, "has no <mass value=\"...\"/>; it is required");
    let mass = element.child("mass")?.ok_or_else(no_mass)?;
    mass.required("value")?;
    let origin =
        element.child("origin")?.map_or_else(|| Ok(Origin::identity()), |origin| Ok(read_origin(origin)?.0))?;
    let inertia = element.child("inertia")?;
    let moment = |name: &str| inertia.map_or(Ok(None), |inertia| inertia.number(name));
    let mut moments: [_; 6] = Default::default();
    for (place, name) in moments.iter_mut().zip(MOMENTS) {
        *place = moment(name)?.unwrap_or_default();
    }
    Ok(Mass { mass: mass.number("value")?.unwrap_or_default(), origin, moments })
}

/// Reads a shape; `None` when its geometry is an extension.
fn read_shape(element: &Element, colours: &HashMap<&str, [f64; 4]>) -> Result<Option<Shape>> {
    let Some(geometry) = element.child("geometry")? else {
        return Err(element.error(ErrorKind::MissingKey, "has no <geometry>; it is required"));
    };
    let Some(solid) = geometry.children.iter().find_map(|child| read_solid(child).transpose()).transpose()? else {
        return Ok(None);
    };
    let mut shape = Shape { name: element.attribute("name").map(str::to_owned), ..Shape::new(solid) };
    if let Some(origin) = element.child("origin")? {
        shape.xyz = origin.floats("xyz")?.unwrap_or_default();
        let quaternion = origin.floats::<4>("quat_xyzw")?.map(|[x, y, z, w]| nalgebra::Quaternion::new(w, x, y, z));
        let turned = quaternion.map(|quaternion| rotation::rpy(&nalgebra::UnitQuaternion::new_normalize(quaternion)));
        shape.rpy = origin.floats("rpy")?.or(turned).unwrap_or_default();
    }
    if let Some(material) = element.child("material")? {
        let named = material.attribute("name").and_then(|name| colours.get(name)).copied();
        shape.colour = colour_of(material)?.or(named);
    }
    Ok(Some(shape))
}

fn read_solid(element: &Element) -> Result<Option<Solid>> {
    let number = |name: &str| {
        element.required(name)?;
        Ok::<f64, Error>(element.float(name)?.unwrap_or_default())
    };
    Ok(Some(match element.name.as_str() {
        "box" => {
            element.required("size")?;
            Solid::Box { size: element.floats("size")?.unwrap_or_default() }
        }
        "cylinder" => Solid::Cylinder { radius: number("radius")?, length: number("length")? },
        "capsule" => Solid::Capsule { radius: number("radius")?, length: number("length")? },
        "sphere" => Solid::Sphere { radius: number("radius")? },
        "mesh" => {
            let path = element.required("filename")?.to_owned();
            Solid::Mesh { path, scale: element.floats("scale")?.unwrap_or([1.0; 3]) }
        }
        _ => return Ok(None),
    }))
}

/// The colour of a `<material>`, if it has its own.
pub fn colour_of(material: &Element) -> Result<Option<[f64; 4]>> {
    material.child("color")?.map_or(Ok(None), |colour| colour.floats("rgba"))
}
