//! Transmissions of a URDF: actuators of several joints, and the rotors of single ones.

use std::collections::HashMap;

use super::xml::Element;
use crate::document::shown;
use crate::model::{Actuator, Fault, Joint, Part};
use crate::{Error, ErrorKind, Result};

/// The children of an element with this name.
fn all<'e>(element: &'e Element, name: &'e str) -> impl Iterator<Item = &'e Element> {
    element.children.iter().filter(move |child| child.name == name)
}

/// Reads a `<transmission>` whose actuator moves several joints. Others are extensions.
pub fn read_transmission(element: &Element) -> Option<Actuator> {
    let mut actuators = all(element, "actuator");
    let actuator = actuators.next().filter(|_| actuators.next().is_none())?;
    let joint = |joint: &Element| {
        let reduction = joint.child("mechanicalReduction").ok().flatten().and_then(|child| child.text.parse().ok());
        Some((joint.attribute("name")?.to_owned(), reduction.unwrap_or(1.0)))
    };
    let joints: Vec<(String, f64)> = all(element, "joint").map(joint).collect::<Option<_>>()?;
    (joints.len() > 1).then_some(Actuator { name: actuator.attribute("name")?.to_owned(), joints })
}

/// Reads the reflected rotor inertia in Drake's extension, in a `<joint>` or in the `<actuator>` of a `<transmission>`:
/// `rotor_inertia` times the square of `gear_ratio` \[kg m^2 or kg\]; zero by default.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a value that is not a finite number, with its line.
pub fn reflected_rotor(element: &Element) -> Result<f64> {
    let value = |name: &str| element.child(name)?.map_or(Ok(None), |child| child.float("value"));
    let ratio = value("drake:gear_ratio")?.unwrap_or(1.0);
    let reflected = value("drake:rotor_inertia")?.unwrap_or(0.0) * ratio * ratio;
    let beyond = || {
        element.error(
            ErrorKind::BadValue,
            "has a rotor whose inertia times the squared gear ratio exceeds the range of doubles",
        )
    };
    if reflected.is_finite() { Ok(reflected) } else { Err(beyond()) }
}

/// Adds the rotor inertias of all transmissions to their joints. An error becomes a fault of the actuator.
pub fn add_rotors<'e>(transmissions: impl Iterator<Item = &'e Element>, joints: &mut [Joint]) -> Vec<Fault> {
    let places: HashMap<String, usize> =
        joints.iter().enumerate().map(|(at, joint)| (joint.name.clone(), at)).collect();
    let mut faults = Vec::new();
    for element in transmissions {
        for actuator in all(element, "actuator") {
            if let Err(error) = add_rotor(element, actuator, &places, joints) {
                let name = actuator.attribute("name").or(element.attribute("name")).unwrap_or("actuator");
                let error = error.with_context(format_args!("actuator `{}`", shown(name)));
                faults.push(Fault { part: Part::Actuator(name.to_owned()), error });
            }
        }
    }
    faults
}

fn add_rotor(
    element: &Element,
    actuator: &Element,
    places: &HashMap<String, usize>,
    joints: &mut [Joint],
) -> Result<()> {
    let rotor = reflected_rotor(actuator)?;
    if rotor == 0.0 {
        return Ok(());
    }
    let fault = |text: &str| Err(actuator.error(ErrorKind::BadValue, text));
    let mut moved = all(element, "joint");
    let (Some(joint), None) = (moved.next(), moved.next()) else {
        return fault("has a rotor, and its transmission does not move one joint; a rotor belongs to one joint");
    };
    match joint.attribute("name").and_then(|name| places.get(name)) {
        Some(place) => {
            joints[*place].armature += rotor;
            Ok(())
        }
        None => Err::<(), Error>(
            joint.error(ErrorKind::UnknownName, "is not a joint of the robot, but an actuator has a rotor for it"),
        ),
    }
}
