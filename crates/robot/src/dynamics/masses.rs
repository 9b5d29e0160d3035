//! Check of physically impossible inertias: [`check_masses`].

use super::Model;
use crate::document::shown;
use crate::model::{Link, Robot};
use crate::spatial::{Inertia, NEGLIGIBLE};
use crate::{Error, ErrorKind, Result};

/// Refuses physically impossible masses and inertias. The error names the first of the fixed links that is impossible
/// by itself, else the first link. Returns notes about values that were treated as rounding errors.
pub(super) fn check_masses(robot: &Robot, model: &Model) -> Result<Vec<String>> {
    // A smaller value is zero up to rounding.
    let least = NEGLIGIBLE * model.mass().abs();
    let weighs = |inertia: &Inertia| inertia.generalised().iter().any(|entry| entry.abs() > least);
    let fault = |inertia: &Inertia, least: f64| inertia.check(least).err().filter(|_| weighs(inertia));
    let located = |link: &Link, error: Error| error.with_context(format!("link `{}`", shown(&link.name)));
    let mut notes = Vec::new();
    for (body, inertia) in model.bodies.iter().enumerate() {
        let links =
            || (0..robot.links().len()).filter(|&link| model.link(link).0 == body).map(|link| &robot.links()[link]);
        if let Some(link) = links().find(|link| link.inertia().mass() < 0.0) {
            let text = format!("mass {} kg: give a nonnegative one", link.inertia().mass());
            return Err(located(link, Error::new(ErrorKind::BadValue, text)));
        }
        let named = |error: Error, least: f64| {
            let alone = links().find_map(|link| fault(&link.inertia(), least).map(|error| located(link, error)));
            let first = links().find(|link| weighs(&link.inertia()));
            alone.or_else(|| Some(located(first?, error.clone()))).unwrap_or(error)
        };
        if let Some(error) = fault(inertia, least) {
            return Err(named(error, least));
        }
        if let Some(error) = fault(inertia, 0.0) {
            notes.push(format!(
                "{}; the deviation is below {least:.0e} kg m^2 and is treated as a rounding error",
                named(error, 0.0).message()
            ));
        }
    }
    Ok(notes)
}
