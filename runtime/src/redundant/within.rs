//! One solution within limits ([`any_within`]).

use core::f64::consts::{PI, TAU};

use super::arcs::{Arc, arcs};
use super::arm::{Given, Limits, Members, Q, Redundant, Target};
use super::ends::Beyond;
use super::model::Model;
use super::seeds::range;
use crate::solution::Error;

/// Shares of the scanned joint's range, in the order in which values are tried.
const TRIED: [f64; 7] = [0.5, 0.375, 0.625, 0.25, 0.75, 0.125, 0.875];
/// The number of values in the whole turn of the scanned joint, from which it follows whether the target is reachable at all.
const AROUND: usize = 32;

/// The result of [`any_within`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Within {
    /// A solution within limits: joint values.
    Solution(Q),
    /// There are solutions, but none within limits.
    Beyond {
        /// The joints that are beyond their limits in the solution that exceeds limits least, as bits.
        joints: u32,
        /// Whether a solution within limits may have been missed.
        is_unsure: bool,
    },
    /// No solution was found, whatever the limits: neither with a joint at a limit, nor for a grid of values of the scanned joint.
    Unreachable {
        /// Whether a solution may have been missed.
        is_unsure: bool,
    },
}

/// One solution within limits: first from a few values of the scanned joint, then from the end points of arcs, then from the search for closed curves.
///
/// # Errors
///
/// Those of [`Redundant::solve_given`], and [`Error::Limits`].
pub fn any_within(robot: &dyn Redundant, target: &Target, limits: &Limits) -> Result<Within, Error> {
    let arm = robot.arm();
    let model = Model::new(arm, target, limits)?;
    let mut members = Members::NONE;
    let mut beyond = Beyond::NONE;
    let [low, high] = range(&model, arm.scanned);
    for share in TRIED {
        let value = low + share * (high - low);
        if let Some(q) = first(robot, &model, target, arm.scanned, value, &mut members, &mut beyond)? {
            return Ok(Within::Solution(q));
        }
    }
    for joint in 0..model.count {
        if model.turns[joint] || arm.given[joint] != Given::Solved {
            continue;
        }
        for limit in model.limits[joint] {
            if !limit.is_finite() {
                continue;
            }
            if let Some(q) = first(robot, &model, target, joint, limit, &mut members, &mut beyond)? {
                return Ok(Within::Solution(q));
            }
        }
    }
    let mut out = [Arc::NONE; 1];
    let outcome = arcs(robot, target, limits, &mut out)?;
    if outcome.count > 0 {
        return Ok(Within::Solution(out[0].start.q));
    }
    if outcome.is_reachable {
        return Ok(Within::Beyond { joints: outcome.beyond, is_unsure: outcome.is_unsure });
    }
    // Beyond the limits of the scanned joint.
    for k in 0..AROUND {
        let share = (k as f64 + 0.5) / AROUND as f64;
        let value = if arm.slides[arm.scanned] { low + (3.0 * share - 1.0) * (high - low) } else { TAU * share - PI };
        first(robot, &model, target, arm.scanned, value, &mut members, &mut beyond)?;
    }
    if beyond.is_reachable {
        return Ok(Within::Beyond { joints: beyond.joints, is_unsure: outcome.is_unsure });
    }
    Ok(Within::Unreachable { is_unsure: outcome.is_unsure })
}

/// The first solution within limits of the problem with a joint given.
fn first(
    robot: &dyn Redundant,
    model: &Model<'_>,
    target: &Target,
    joint: usize,
    value: f64,
    members: &mut Members,
    beyond: &mut Beyond,
) -> Result<Option<Q>, Error> {
    members.clear();
    robot.solve_given(target, joint, value * model.units[joint], members)?;
    for member in members.as_slice() {
        let mut x = model.scaled(&member.q);
        x[joint] = value;
        let joints = model.lift(&mut x);
        if joints == 0 {
            return Ok(Some(model.unscaled(&x)));
        }
        beyond.pass(model, &x, joints);
    }
    Ok(None)
}
