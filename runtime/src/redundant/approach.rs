//! Solutions of targets next to the boundary of the workspace ([`approach`]). Their curves are narrower than a grid of values of one joint.

use core::f64::consts::{PI, TAU};

use super::arm::{MOST_JOINTS, Q};
use super::elimination::Rows;
use super::model::{Model, norm, plus};
use crate::arithmetic::Arithmetic;
use crate::tolerances::ACCEPTANCE;

/// The number of starts.
pub(super) const STARTS: usize = 8;
/// Maximal number of steps from a start, and of halvings of a step.
const STEPS: usize = 60;
const HALVINGS: usize = 6;
/// Maximal length of a step (rad, or relative to the characteristic length), and of one that is not shortened to it because the equations are singular.
const LONGEST: f64 = 0.7;
const SINGULAR: f64 = 1e6;
/// Starts are at multiples of these shares of the joints' ranges, modulo 1: of the first one, and what is added for each further joint.
const STRIDE: [f64; 2] = [0.618_033_988_749_894_9, 0.13];
/// The greatest distance of a start from 0, of a prismatic joint without limits.
const FARTHEST: f64 = 10.0;

/// The start with this number.
fn start(model: &Model<'_>, number: usize) -> Q {
    let mut x = [0.0; MOST_JOINTS];
    for i in 0..model.count {
        let most = if model.arm.slides[i] { FARTHEST } else { PI };
        let (low, high) = (f64::max(model.limits[i][0], -most), f64::min(model.limits[i][1], most));
        let share = 0.5 + number as f64 * (STRIDE[0] + STRIDE[1] * i as f64);
        x[i] = low + (share - Arithmetic::floor(share)) * (high - low);
    }
    x
}

/// Angles moved by whole turns next to 0.
fn wrapped(model: &Model<'_>, mut x: Q) -> Q {
    for i in 0..model.count {
        if !model.arm.slides[i] {
            x[i] -= TAU * Arithmetic::round(x[i] / TAU);
        }
    }
    x
}

fn size(values: &Rows, rows: usize) -> f64 {
    let mut sum = 0.0;
    for value in &values[..rows] {
        sum += value * value;
    }
    Arithmetic::sqrt(sum)
}

/// A solution, within limits or not, by Newton's method with least steps from a start within limits. A step is halved until the equations' values decrease.
/// `None` where that fails.
pub(super) fn approach(model: &Model<'_>, number: usize) -> Option<Q> {
    let rows = model.rows();
    let mut place = model.place(&start(model, number));
    let mut left = size(&place.values, rows);
    for _ in 0..STEPS {
        if left <= ACCEPTANCE.residual {
            return if model.is_toward(&place.x) { Some(wrapped(model, place.x)) } else { None };
        }
        let step = place.linear.least(&place.values);
        let length = norm(&step);
        let is_known = length <= SINGULAR;
        if !is_known {
            return None;
        }
        let mut share = if length > LONGEST { LONGEST / length } else { 1.0 };
        let mut is_less = false;
        for _ in 0..HALVINGS {
            let next = model.place(&plus(&place.x, -share, &step));
            let after = size(&next.values, rows);
            if after < left {
                (place, left, is_less) = (next, after, true);
                break;
            }
            share *= 0.5;
        }
        if !is_less {
            return None;
        }
    }
    None
}
