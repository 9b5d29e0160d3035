//! Where a piece of a curve reaches a limit ([`Crossing`]).

use super::arm::{MOST_JOINTS, Q};
use super::model::{Model, norm, plus};
use super::step::{Piece, Point};
use crate::arithmetic::Arithmetic;
use crate::tolerances::{ACCEPTANCE, PIVOTS};

/// Iterations for a root of a cubic.
const ROOT_STEPS: usize = 40;
/// Maximal length of the correction of a predicted crossing, relative to its piece.
const CORRECTION: f64 = 0.1;

/// A joint that reaches a limit on a piece.
#[derive(Clone, Copy)]
pub(super) struct Crossing {
    pub joint: usize,
    /// 0 for the lower limit, 1 for the upper one.
    pub side: usize,
    /// The share of the piece's length.
    pub share: f64,
}

impl Crossing {
    /// The first joint that exceeds a limit on the piece. Joints of `tied` remain at their limits.
    pub fn first(model: &Model<'_>, piece: &Piece, tied: u32) -> Option<Crossing> {
        let exceeds = exceeding(model, piece);
        let mut first: Option<Crossing> = None;
        for joint in 0..model.count {
            if exceeds[joint] <= ACCEPTANCE.input || !model.is_limited(joint) || tied & 1 << joint != 0 {
                continue;
            }
            for side in 0..2 {
                let Some(share) = crossed(piece, joint, side, model.limits[joint][side]) else { continue };
                let is_first = match first {
                    None => true,
                    Some(known) => share < known.share,
                };
                if is_first {
                    first = Some(Crossing { joint, side, share });
                }
            }
        }
        first
    }

    /// The point of the curve where the joint has the value of the limit, by one Newton step, and the length of this step. `None` where the step is too long
    /// for the crossing to be certain.
    pub fn point(&self, model: &Model<'_>, piece: &Piece, side: f64) -> Option<(Point, f64)> {
        self.corrected(model, &piece.at(self.share), side, CORRECTION * piece.length)
    }

    /// One Newton step to where the joint has the value of the limit.
    pub fn corrected(&self, model: &Model<'_>, x: &Q, side: f64, longest: f64) -> Option<(Point, f64)> {
        let limit = model.limits[self.joint][self.side];
        let mut place = model.place(x);
        let step = place.linear.with(&place.values, self.joint, x[self.joint] - limit)?;
        let size = norm(&step);
        let is_short = size <= longest;
        if !is_short || place.linear.pivot <= PIVOTS.regular {
            return None;
        }
        place.x = plus(x, -1.0, &step);
        Some((Point::of(&place, side, &[0.0; MOST_JOINTS]), size))
    }
}

/// By how much the control points of the joints' cubics, between which their values are, exceed limits.
#[inline(always)]
fn exceeding(model: &Model<'_>, piece: &Piece) -> Q {
    let mut exceeds = [0.0; MOST_JOINTS];
    let third = piece.length / 3.0;
    for i in 0..MOST_JOINTS {
        let (first, last) = (piece.from.x[i], piece.to.x[i]);
        let (second, third) = (first + third * piece.from.t[i], last - third * piece.to.t[i]);
        let (low, high) = (f64::min(f64::min(second, third), last), f64::max(f64::max(second, third), last));
        exceeds[i] = f64::max(model.limits[i][0] - low, high - model.limits[i][1]);
    }
    exceeds
}

/// The first share of the piece at which the joint exceeds the limit. That at the beginning of the piece does not count where the joint moves inwards.
fn crossed(piece: &Piece, joint: usize, side: usize, limit: f64) -> Option<f64> {
    let outward = if side == 0 { -1.0 } else { 1.0 };
    let [c, b, a] = piece.cubic(joint);
    let [c, b, a] = [outward * c, outward * b, outward * a];
    let start = outward * (piece.from.x[joint] - limit);
    // The control points of the cubic, between which its values are.
    let (second, third) = (start + c / 3.0, start + (2.0 * c + b) / 3.0);
    let last = outward * (piece.to.x[joint] - limit);
    if f64::max(f64::max(second, third), last) <= ACCEPTANCE.input {
        return None;
    }
    let value = |u: f64| start + u * (c + u * (b + u * a));
    let mut low = 0.0;
    for high in extrema(a, b, c) {
        if high > low && value(high) > ACCEPTANCE.input {
            return Some(root([start, c, b, a], low, high));
        }
        low = f64::max(low, high);
    }
    None
}

/// The shares between 0 and 1 where the cubic has an extremum, in increasing order, then 1. Where there are less than two, 0 comes first.
pub(super) fn extrema(a: f64, b: f64, c: f64) -> [f64; 3] {
    // 3 a u^2 + 2 b u + c = 0.
    let square = b * b - 3.0 * a * c;
    if square <= 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let q = -(b + if b < 0.0 { -Arithmetic::sqrt(square) } else { Arithmetic::sqrt(square) });
    let first = if a == 0.0 { 0.0 } else { q / (3.0 * a) };
    let second = if q == 0.0 { 0.0 } else { c / q };
    let inside = |u: f64| if u > 0.0 && u < 1.0 { u } else { 0.0 };
    let (first, second) = (inside(first), inside(second));
    [f64::min(first, second), f64::max(first, second), 1.0]
}

/// The root of a cubic between shares where it is at most zero and positive, by Newton's method with bisection.
fn root([d, c, b, a]: [f64; 4], mut low: f64, mut high: f64) -> f64 {
    let mut u = 0.5 * (low + high);
    for _ in 0..ROOT_STEPS {
        let value = d + u * (c + u * (b + u * a));
        if value > 0.0 {
            high = u;
        } else {
            low = u;
        }
        let slope = c + u * (2.0 * b + u * 3.0 * a);
        let newton = if slope == 0.0 { low } else { u - value / slope };
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - u).abs() <= ACCEPTANCE.residual || high - low <= ACCEPTANCE.residual {
            return next;
        }
        u = next;
    }
    u
}
