//! Checks that numbers of a link or a joint are in the range of doubles. Descriptions have exact numbers such as 1e400.

use num_traits::ToPrimitive;

use super::{Joint, Link, Mass, Mimic, Origin, Shape, Solid};
use crate::document::shown;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// Checks that the numbers of a link are in the range of doubles.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the link, the quantity and the line.
pub fn check_link(link: &Link) -> Result<()> {
    let mass = link.mass.iter().flat_map(|mass| [("mass", masses(mass)), ("centre of mass", frame(&mass.origin))]);
    let shapes = link.visuals.iter().chain(&link.collisions).map(|shape| ("shape", shape_numbers(shape)));
    check(mass.chain(shapes)).map_err(|what| fault("link", &link.name, what, link.line))
}

/// Checks that the numbers of a joint are in the range of doubles.
///
/// # Errors
/// Those of [`check_link`].
pub fn check_joint(joint: &Joint) -> Result<()> {
    let limits = joint.limits.map_or(Vec::new(), |(lower, upper)| vec![lower, upper]);
    let law = joint.mimic.iter().flat_map(|mimic| [double(&mimic.multiplier), double(&mimic.offset)]);
    let motor =
        [joint.speed, joint.effort].into_iter().flatten().chain([joint.damping, joint.friction, joint.armature]);
    let motor = motor.chain(joint.servo.iter().flat_map(|servo| [servo.stiffness, servo.damping]));
    let numbers = [
        ("origin", frame(&joint.origin)),
        ("axis", joint.axis.iter().map(double).collect()),
        ("limits", limits),
        ("mimic", law.collect()),
        ("effort, velocity or dynamics", motor.collect()),
    ];
    check(numbers).map_err(|what| fault("joint", &joint.name, what, joint.line))
}

/// Checks that a link's inertia in its own frame is in the range of doubles.
///
/// # Errors
/// Those of [`check_link`].
pub fn check_inertia(link: &Link) -> Result<()> {
    let inertia = link.inertia();
    let numbers = inertia.rotational().iter().chain(inertia.centre_of_mass().iter()).copied().collect();
    check([("inertia", numbers)]).map_err(|what| fault("link", &link.name, what, link.line))
}

/// Checks that a joint's mimic law relative to its independent leader is in the range of doubles.
///
/// # Errors
/// Those of [`check_link`].
pub fn check_law(joint: &Joint, law: &Mimic) -> Result<()> {
    let found = check([("law by its leaders", law.law().to_vec())]);
    found.map_err(|what| fault("joint", &joint.name, what, joint.line))
}

/// The name of the first quantity with a number that is not finite, as an error.
fn check<'w>(numbers: impl IntoIterator<Item = (&'w str, Vec<f64>)>) -> std::result::Result<(), &'w str> {
    let is_bad = |(_, numbers): &(&str, Vec<f64>)| !numbers.iter().all(|number| number.is_finite());
    numbers.into_iter().find(is_bad).map_or(Ok(()), |(what, _)| Err(what))
}

fn fault(part: &str, name: &str, what: &str, line: Option<usize>) -> Error {
    let text =
        format!("{part} `{}`: its {what} has a number outside the range of doubles; give at most 1.7e308", shown(name));
    let error = Error::new(ErrorKind::BadValue, text);
    line.map_or(error.clone(), |line| error.at_line(line))
}

fn double(exact: &BigRational) -> f64 {
    exact.to_f64().unwrap_or(f64::NAN)
}

fn masses(mass: &Mass) -> Vec<f64> {
    std::iter::once(&mass.mass).chain(&mass.moments).map(double).collect()
}

fn frame(origin: &Origin) -> Vec<f64> {
    let place = origin.placement.origin.iter().map(double);
    place.chain(origin.rpy.iter().flatten().map(double)).collect()
}

fn shape_numbers(shape: &Shape) -> Vec<f64> {
    let size = match &shape.solid {
        Solid::Box { size } => size.to_vec(),
        Solid::Cylinder { radius, length } | Solid::Capsule { radius, length } => vec![*radius, *length],
        Solid::Sphere { radius } => vec![*radius],
        Solid::Mesh { scale, .. } => scale.to_vec(),
    };
    let frame = shape.xyz.iter().chain(&shape.rpy).chain(shape.colour.iter().flatten());
    size.into_iter().chain(frame.copied()).collect()
}
