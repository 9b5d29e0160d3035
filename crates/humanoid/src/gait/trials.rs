//! Trials of the steps of a long walk, each as a short walk of its own: they show how slow its phases have to be before the whole walk is solved. Equal steps are
//! tried once. Main function: [`slowed`].

use std::collections::{HashMap, HashSet};

use super::footprint::{Footprint, Route, Side};
use super::request::Request;
use super::schedule::Action;
use crate::Result;

/// The greatest difference of equal footprints \[m, rad\]. It is above the rounding errors of routes, and below the
/// tolerance of the centre of mass.
const EQUAL: f64 = 1e-9;
/// Trials save time if a walk has at least this many times as many steps.
const REPEATED: usize = 2;

/// A step of a walk, with its neighbours.
struct Part {
    /// The step before it, the step, and the step after it.
    route: Route,
    /// The phases of the step, which refer to `route`.
    actions: Vec<Action>,
}

/// The geometry of a part, independent of its place on the floor.
type Key = (Vec<Action>, Vec<Side>, Vec<[i64; 3]>);

/// The factors on the durations of a walk's phases that trials of its steps need. `trial` returns those of a short
/// walk. Walks with few equal steps are not tried; their factors are 1.
///
/// # Errors
/// Those of `trial`.
pub(super) fn slowed(
    request: &Request,
    actions: &[Action],
    trial: impl Fn(&Request, &[Action]) -> Result<Vec<f64>>,
) -> Result<Vec<f64>> {
    let parts = parts(&request.route, actions);
    let keys: Vec<Key> = parts.iter().map(Part::key).collect();
    if parts.is_empty() || parts.len() < REPEATED * keys.iter().collect::<HashSet<_>>().len() {
        return Ok(vec![1.0; actions.len()]);
    }
    let mut known: HashMap<&Key, Vec<f64>> = HashMap::new();
    let mut slowed = Vec::with_capacity(actions.len());
    for (part, key) in parts.into_iter().zip(&keys) {
        if !known.contains_key(key) {
            let short = Request { route: part.route, ..request.clone() };
            known.insert(key, trial(&short, &part.actions)?);
        }
        slowed.extend(&known[key]);
    }
    Ok(slowed)
}

/// The steps of a walk with their phases. The phases before the first step and after the last one belong to these.
fn parts(route: &Route, actions: &[Action]) -> Vec<Part> {
    let Some(last) = route.steps.len().checked_sub(1) else { return Vec::new() };
    let stands = route.stands();
    let mut steps = Vec::with_capacity(actions.len());
    for action in actions {
        steps.push(action.step().map_or(steps.last().copied().unwrap_or(0), |step| step.min(last)));
    }
    let own: Vec<(usize, Action)> = steps.into_iter().zip(actions.iter().copied()).collect();
    let part = |own: &[(usize, Action)]| {
        let (from, to) = (own[0].0.saturating_sub(1), (own[0].0 + 1).min(last));
        let actions = own.iter().map(|(_, action)| action.with_step(|step| step - from)).collect();
        let rests = route.rests.iter().skip(from).take(to + 2 - from).copied().collect();
        let steps = route.steps[from..=to].to_vec();
        Part { route: Route { start: stands[from], steps, rests }, actions }
    };
    own.chunk_by(|a, b| a.0 == b.0).map(part).collect()
}

impl Part {
    fn key(&self) -> Key {
        let Route { start: [left, right], steps, rests } = &self.route;
        let seen = |print: &Footprint| {
            let (at, yaw) = (left.seen(&print.point()), print.yaw - left.yaw);
            [at.x, at.y, yaw].map(|value| (value / EQUAL).round() as i64)
        };
        let prints = [right].into_iter().chain(steps.iter().map(|step| &step.print)).chain(rests);
        (self.actions.clone(), steps.iter().map(|step| step.side).collect(), prints.map(seen).collect())
    }
}
