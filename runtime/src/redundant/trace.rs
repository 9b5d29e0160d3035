//! From a point on a curve to where the curve ends ([`trace`]).

use super::arm::{Given, Q};
use super::crossing::Crossing;
use super::ends::{Ends, FREE};
use super::model::{Model, dot, farthest, plus};
use super::seeds::Seeds;
use super::step::{Piece, Point, Walk, is_on};
use crate::tolerances::{ACCEPTANCE, MERGING};

/// Maximal number of steps along a curve.
const MOST_PIECES: usize = 5000;
/// A crossing is not searched for with steps shorter than this.
const SHORTEST: f64 = 0.2 * MERGING.apart;
/// Newton steps to a crossing that is no known end point.
const LOCATING: usize = 12;
/// The least cosine of the angle between the directions of a curve and of an end point on it.
const ALIGNED: f64 = 0.7;

/// Where a curve ends.
pub(super) enum Stop {
    /// At the end point with this number.
    End(usize),
    /// At its beginning.
    Closed,
    /// It could not be followed from here on.
    Lost(Q),
}

/// A traced curve.
pub(super) struct Trace {
    pub stop: Stop,
    pub length: f64,
    pub is_unsure: bool,
}

/// The start of a trace: a point, the sign of its direction against the oriented one, and the joints that remain at their limits.
#[derive(Clone, Copy)]
pub(super) struct Start {
    pub at: Point,
    pub side: f64,
    pub tied: u32,
    pub level: u32,
    /// Whether the curve may be closed: the start is no end point.
    pub is_inside: bool,
}

/// Follows a curve. Solutions of the grid on it are removed.
pub(super) fn trace(model: &Model<'_>, start: &Start, ends: &mut Ends, seeds: &mut Seeds) -> Trace {
    let mut walk = Walk::new(&start.at, start.side, start.level);
    let mut length = 0.0;
    for count in 0..MOST_PIECES {
        let Some(mut piece) = walk.piece(model) else { break };
        if start.is_inside
            && count > 0
            && let Some(last) = closing(model, &piece, &start.at)
        {
            seeds.pass(model, &last);
            ends.pass(model, &last);
            let is_unsure = walk.is_unsure;
            return Trace { stop: Stop::Closed, length: length + last.length, is_unsure };
        }
        if let Some(crossing) = Crossing::first(model, &piece, start.tied) {
            let is_last = piece.length <= SHORTEST;
            if let Some(end) = arrive(model, &crossing, &piece, &walk, ends, is_last) {
                piece = last_piece(model, &piece.from, &ends.list[end].at, &piece.to);
                seeds.pass(model, &piece);
                ends.pass(model, &piece);
                let is_unsure = walk.is_unsure || is_last && ends.list[end].is_unsure;
                return Trace { stop: Stop::End(end), length: length + piece.length, is_unsure };
            }
            if !is_last {
                walk.pace = 0.4 * f64::min(piece.length, walk.pace);
                continue;
            }
            break;
        }
        seeds.pass(model, &piece);
        ends.pass(model, &piece);
        length += piece.length;
        walk.go(&piece);
    }
    Trace { stop: Stop::Lost(walk.at.x), length, is_unsure: true }
}

/// The piece from a point to a known one near `to`, in the direction of travel.
pub(super) fn last_piece(model: &Model<'_>, from: &Point, end: &Point, to: &Point) -> Piece {
    let mut last = *end;
    if dot(&end.t, &to.t) < 0.0 {
        for value in &mut last.t {
            *value = -*value;
        }
    }
    last.x = plus(&from.x, 1.0, &model.difference(&end.x, &from.x));
    Piece::new(from, &last)
}

/// The piece up to the beginning of the curve, if the beginning is on the piece.
fn closing(model: &Model<'_>, piece: &Piece, home: &Point) -> Option<Piece> {
    if dot(&piece.to.t, &home.t) < ALIGNED || !is_on(model, piece, &home.x) {
        return None;
    }
    let x = plus(&piece.from.x, 1.0, &model.difference(&home.x, &piece.from.x));
    Some(Piece::new(&piece.from, &Point { x, ..*home }))
}

/// The end point at which a curve reaches a limit. `None` where a shorter step is necessary to decide. Where the joint has no solver, or with the shortest step,
/// an end point is made.
fn arrive(
    model: &Model<'_>,
    crossing: &Crossing,
    piece: &Piece,
    walk: &Walk,
    ends: &mut Ends,
    is_last: bool,
) -> Option<usize> {
    let (point, size) = crossing.point(model, piece, walk.side)?;
    let mut nearest = (FREE, f64::INFINITY);
    for k in 0..ends.count {
        let end = &ends.list[k];
        if end.sides[crossing.side] & 1 << crossing.joint != 0 {
            let distance = farthest(&model.difference(&end.at.x, &point.x));
            if distance < nearest.1 {
                nearest = (k, distance);
            }
        }
    }
    if nearest.1 <= 0.25 * size + 10.0 * MERGING.joints {
        let end = &ends.list[nearest.0];
        let is_outward = -end.inward * dot(&end.at.t, &point.t) >= ALIGNED;
        let is_certain =
            end.is_singular || model.frozen.is_some() || is_outward && (-end.inward == walk.side || walk.is_unsure);
        if is_certain || is_last {
            ends.list[nearest.0].is_unsure |= !is_certain;
            return Some(nearest.0);
        }
        return None;
    }
    if is_last || model.arm.given[crossing.joint] != Given::Solved {
        return locate(model, crossing, &point, walk, ends);
    }
    None
}

/// Makes an end point of the point where a joint reaches its limit.
#[cold]
fn locate(model: &Model<'_>, crossing: &Crossing, near: &Point, walk: &Walk, ends: &mut Ends) -> Option<usize> {
    let mut point = *near;
    let mut size = f64::INFINITY;
    for _ in 0..LOCATING {
        (point, size) = crossing.corrected(model, &point.x, walk.side, 0.1)?;
        if size <= ACCEPTANCE.residual {
            break;
        }
    }
    let is_located = size <= MERGING.joints;
    if !is_located {
        return None;
    }
    let number = ends.add(model, &point.x)?;
    let end = &mut ends.list[number];
    if end.partner == FREE && end.inward == 0.0 {
        let (place, bend) = model.bent(&point.x);
        end.at = Point::of(&place, 1.0, &bend);
        end.inward = -walk.side;
        end.sides[crossing.side] |= 1 << crossing.joint;
        end.is_unsure = model.arm.given[crossing.joint] == Given::Solved;
    }
    Some(number)
}
