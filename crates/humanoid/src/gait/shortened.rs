//! A long walk without most of its equal steps. By preview control the phases depend on one another, so that a step cannot be tried alone: the shortened walk
//! shows how slow the phases have to be before the whole walk is solved. Main type: [`Shortened`].

use super::footprint::{Footprint, Footstep, Route, Side};
use super::request::Request;
use super::schedule::Action;
use crate::Result;
use groebot_robot::spatial::angle;

/// The greatest difference of equal steps \[m, rad\]: above the rounding errors of routes, and below the tolerance of
/// the centre of mass.
const EQUAL: f64 = 1e-9;
/// The number of steps that are kept at the beginning, and at the end, of equal steps. The motion depends on steps
/// farther away by less than its margins: they are more than two units of time of the pendulum each.
const KEPT: usize = 4;

/// A shortened walk, and the step in it that represents each step of the whole walk.
pub(super) struct Shortened {
    /// Its request.
    pub request: Request,
    steps: Vec<usize>,
}

impl Shortened {
    /// Shortens the walk of `request`; `None` if no steps can be left out.
    ///
    /// # Errors
    /// As [`Route::new`].
    pub fn of(request: &Request) -> Result<Option<Self>> {
        let route = &request.route;
        let own = moves(route);
        let represented = represented(&own);
        let kept: Vec<usize> = (0..own.len()).filter(|step| represented[*step] == *step).collect();
        if kept.len() == own.len() {
            return Ok(None);
        }
        let mut stance = own.first().map_or_else(Footprint::default, |(side, _)| route.start[side.other() as usize]);
        let step = |step: &usize| {
            let (side, relative) = own[*step];
            stance = stance.then(&relative);
            Footstep { side, print: stance }
        };
        let steps = kept.iter().map(step).collect();
        let short = |step: usize| kept.partition_point(|own| *own < represented[step]);
        Ok(Some(Shortened {
            request: Request { route: Route::new(route.start, steps)?, ..request.clone() },
            steps: (0..own.len()).map(short).chain([kept.len()]).collect(),
        }))
    }

    /// The factors of the whole walk's phases `actions`, from those of the phases of the shortened walk.
    pub fn expanded(&self, actions: &[Action], factors: &[f64]) -> Vec<f64> {
        let short = self.request.gait.actions(self.request.route.steps.len());
        let first = short.iter().zip(factors);
        let factor = |(place, action): (usize, &Action)| {
            let own = action.with_step(|step| self.steps[step]);
            // Of two rests the last one is that after the last step.
            let mut found = first.clone().filter(|(action, _)| **action == own).map(|(_, factor)| *factor);
            let factor = if place == 0 { found.next() } else { found.next_back() };
            factor.unwrap_or(1.0)
        };
        actions.iter().enumerate().map(factor).collect()
    }
}

/// Each step: its foot, and its print in the frame of the supporting foot.
fn moves(route: &Route) -> Vec<(Side, Footprint)> {
    let stands = route.stands();
    let relative = |(step, feet): (&Footstep, &[Footprint; 2])| {
        let stance = &feet[step.side.other() as usize];
        let at = stance.seen(&step.print.point());
        (step.side, Footprint { x: at.x, y: at.y, yaw: angle::difference(step.print.yaw, stance.yaw) })
    };
    route.steps.iter().zip(&stands).map(relative).collect()
}

/// For each step the one that represents it: itself, or an earlier step of the same foot among equal ones.
fn represented(own: &[(Side, Footprint)]) -> Vec<usize> {
    let equal = |step: usize| {
        let ((side, one), (same, other)) = (&own[step], &own[step - 2]);
        let off = [one.x - other.x, one.y - other.y, one.yaw - other.yaw];
        side == same && off.iter().all(|off| off.abs() <= EQUAL)
    };
    let mut steps: Vec<usize> = (0..own.len()).collect();
    let mut start = 0;
    for end in 1..=own.len() {
        // A run of equal pairs of steps is from `start` to `end`.
        if end < own.len() && (end < start + 2 || equal(end)) {
            continue;
        }
        let left_out = (end - start).saturating_sub(2 * KEPT) / 2 * 2;
        for (place, step) in steps.iter_mut().skip(start + KEPT).take(left_out).enumerate() {
            *step = start + KEPT - 2 + place % 2;
        }
        start = end - 1;
    }
    steps
}
