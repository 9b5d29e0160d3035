//! Links of an SDF: masses and shapes.

use num_traits::{One, Zero};

use super::values::{floats, number, pose_of, required_text, text};
use crate::document::shown;
use crate::model::urdf::xml::Element;
use crate::model::{Link, Mass, Shape, Solid};
use crate::spatial::rotation;
use crate::{ErrorKind, Result};

/// The names of the moments, in the order of [`Mass::moments`].
const MOMENTS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];

/// Reads a `<link>` with its full name. A shape that is not of a link is a note.
///
/// # Errors
/// [`ErrorKind::BadValue`] for wrong numbers of the inertia.
pub fn read(element: &Element, name: &str) -> Result<Link> {
    let mut link = Link { line: element.own_line(), ..Link::new(name) };
    for child in &element.children {
        let shapes = match child.name.as_str() {
            "visual" => &mut link.visuals,
            "collision" => &mut link.collisions,
            _ => continue,
        };
        match read_shape(child) {
            Ok(shape) => shapes.push(shape),
            Err(error) => link.notes.push(format!("omitted: {error}")),
        }
    }
    match element.child("inertial")? {
        None => link.notes.push("it has no <inertial>; it has no mass here, and 1 kg in Gazebo".to_owned()),
        Some(inertial) if inertial.attribute("auto").is_some_and(super::values::is_true) => {
            link.notes.push("its mass is computed from its shapes by Gazebo; it is ignored".to_owned());
        }
        Some(inertial) => link.mass = Some(read_mass(inertial)?),
    }
    Ok(link)
}

/// Reads an `<inertial>`. A mass of 1 kg and moments of 1 kg m^2 are the defaults of the format.
fn read_mass(element: &Element) -> Result<Mass> {
    let (placement, reference) = pose_of(element)?;
    if reference.is_some() {
        return Err(element.error(ErrorKind::BadValue, "has a <pose> with `relative_to`; it is in the link's frame"));
    }
    let mass = number(element, "mass")?.unwrap_or_else(One::one);
    let inertia = element.child("inertia")?;
    let mut moments: [_; 6] = std::array::from_fn(|_| Zero::zero());
    for (place, name) in moments.iter_mut().zip(MOMENTS) {
        let given = inertia.map_or(Ok(None), |inertia| number(inertia, name))?;
        let is_diagonal = name.as_bytes()[1] == name.as_bytes()[2];
        *place = given.unwrap_or_else(|| if is_diagonal { One::one() } else { Zero::zero() });
    }
    Ok(Mass { mass, origin: placement.into(), moments })
}

fn read_shape(element: &Element) -> Result<Shape> {
    let geometry = element.child("geometry")?;
    let Some(kind) = geometry.and_then(|geometry| geometry.children.first()) else {
        return Err(element.error(ErrorKind::MissingKey, "has no <geometry>; it is required"));
    };
    let (placement, reference) = pose_of(element)?;
    if reference.is_some() {
        return Err(
            element.error(ErrorKind::Unsupported, "has a <pose> with `relative_to`, which is not read for shapes")
        );
    }
    let pose = placement.pose();
    let mut shape = Shape { name: element.attribute("name").map(str::to_owned), ..Shape::new(read_solid(kind)?) };
    (shape.xyz, shape.rpy) = (pose.translation.vector.into(), rotation::rpy(&pose.rotation));
    if let Some(material) = element.child("material")? {
        let colour = material.child("diffuse")?.or(material.child("ambient")?);
        shape.colour = colour.map_or(Ok(None), |colour| floats::<4>(colour).or(Ok::<_, crate::Error>(None)))?;
    }
    Ok(shape)
}

fn read_solid(element: &Element) -> Result<Solid> {
    let size = |name: &str| -> Result<f64> {
        let missing = || element.error(ErrorKind::MissingKey, &format!("has no <{name}>; it is required"));
        let child = element.child(name)?.ok_or_else(missing)?;
        floats::<1>(child)?.map(|[size]| size).ok_or_else(missing)
    };
    Ok(match element.name.as_str() {
        "box" => {
            let missing = || element.error(ErrorKind::MissingKey, "has no <size>; it is required");
            let child = element.child("size")?.ok_or_else(missing)?;
            Solid::Box { size: floats(child)?.ok_or_else(missing)? }
        }
        "cylinder" => Solid::Cylinder { radius: size("radius")?, length: size("length")? },
        "capsule" => Solid::Capsule { radius: size("radius")?, length: size("length")? },
        "sphere" => Solid::Sphere { radius: size("radius")? },
        "mesh" => {
            let path = required_text(element, "uri")?.to_owned();
            let scale = element.child("scale")?.map_or(Ok(None), floats::<3>)?.unwrap_or([1.0; 3]);
            if let Some(part) = text(element, "submesh")? {
                let text = format!("shows the part `{}` of a mesh only, which is not read", shown(part));
                return Err(element.error(ErrorKind::Unsupported, &text));
            }
            Solid::Mesh { path, scale }
        }
        other => {
            let text = format!("a {} is not a shape of a link", shown(other));
            return Err(element.error(ErrorKind::Unsupported, &text));
        }
    })
}
