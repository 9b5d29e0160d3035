//! Masses that no body has: [`check_masses`].

use super::Model;
use crate::model::{Link, Robot};
use crate::spatial::Inertia;
use crate::{Error, ErrorKind, Result};

/// What is negligible of a link's mass and inertia, as a share of the robot's mass (and that times a square metre).
const NEGLIGIBLE: f64 = 1e-12;

/// Refuses what no body has: of the links that are fixed to one another the first that has it alone is named, else the first of all.
pub(super) fn check_masses(robot: &Robot, model: &Model) -> Result<()> {
    // Less is what rounding has left of nothing.
    let least = NEGLIGIBLE * model.mass().abs();
    let weighs = |inertia: &Inertia| inertia.generalised().iter().any(|entry| entry.abs() > least);
    let fault = |inertia: &Inertia| {
        let checked = Inertia::new(inertia.mass(), inertia.centre_of_mass(), inertia.rotational());
        weighs(inertia).then_some(checked.err()).flatten()
    };
    let told = |link: &Link, error: Error| error.with_context(format!("link `{}`", link.name));
    for (body, inertia) in model.bodies.iter().enumerate() {
        let links =
            || (0..robot.links().len()).filter(|&link| model.link(link).0 == body).map(|link| &robot.links()[link]);
        if let Some(link) = links().find(|link| link.inertia().mass() < 0.0) {
            let text = format!("mass {} kg: give one that is not below zero", link.inertia().mass());
            return Err(told(link, Error::new(ErrorKind::BadValue, text)));
        }
        if let Some(error) = fault(inertia) {
            let alone = links().find_map(|link| fault(&link.inertia()).map(|error| told(link, error)));
            let first = links().find(|link| weighs(&link.inertia()));
            return Err(alone.or_else(|| Some(told(first?, error.clone()))).unwrap_or(error));
        }
    }
    Ok(())
}
