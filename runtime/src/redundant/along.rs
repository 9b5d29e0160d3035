//! Joint values along an arc ([`at`], [`sample`], [`sample_from`]).

use core::f64::consts::TAU;

use super::arcs::{Arc, constant};
use super::arm::{Arm, Limits, MOST_JOINTS, Q, Target};
use super::model::{Model, dot, norm, plus};
use super::step::{FOURTH, Piece, Point, Walk};
use super::trace::last_piece;
use crate::arithmetic::Arithmetic;
use crate::solution::Error;
use crate::tolerances::ACCEPTANCE;

/// Newton steps from the cubic of a piece to the curve.
const CORRECTIONS: usize = 8;

/// A walk along an arc, from its start to its end.
pub(super) struct Journey {
    walk: Walk,
    /// The present piece, and the length of the arc before it.
    pub piece: Piece,
    pub before: f64,
    is_over: bool,
}

impl Journey {
    /// A walk from the start of an arc.
    pub fn new(model: &mut Model<'_>, arc: &Arc) -> Journey {
        model.frozen = if arc.is_frozen { constant(model.arm) } else { None };
        let (place, bend) = model.bent(&model.scaled(&arc.start.q));
        let at = Point::of(&place, arc.side, &bend);
        let walk = Walk::new(&at, arc.side, arc.level);
        Journey { walk, piece: Piece::new(&at, &at), before: 0.0, is_over: arc.length == 0.0 }
    }

    /// Goes on to the next piece. Returns whether there is one.
    pub fn next(&mut self, model: &Model<'_>, arc: &Arc) -> bool {
        if self.is_over {
            return false;
        }
        self.before += self.piece.length;
        let Some(piece) = self.walk.piece(model) else {
            self.is_over = true;
            return false;
        };
        self.walk.go(&piece);
        self.piece = piece;
        self.is_over = self.before + piece.length >= arc.length;
        if self.is_over {
            self.shorten(model, arc);
        }
        true
    }

    /// Ends the present piece at the end of the arc, as the trace did, if they have the same length.
    fn shorten(&mut self, model: &Model<'_>, arc: &Arc) {
        let (place, bend) = model.bent(&model.scaled(&arc.end.q));
        let last = last_piece(model, &self.piece.from, &Point::of(&place, arc.side, &bend), &self.piece.to);
        if (self.before + last.length - arc.length).abs() <= FOURTH * self.piece.length {
            self.piece = last;
        }
    }

    /// The scaled joint values of the curve at a share of the present piece.
    pub fn at(&self, model: &Model<'_>, share: f64) -> Q {
        Journey::on(model, &self.piece, share)
    }

    /// The scaled joint values of the curve at a share of a piece.
    pub fn on(model: &Model<'_>, piece: &Piece, share: f64) -> Q {
        Journey::point_on(model, piece, share).x
    }

    /// The point of the curve at a share of a piece, with the direction of travel.
    pub fn point_on(model: &Model<'_>, piece: &Piece, share: f64) -> Point {
        let mut point = Point { x: piece.at(share), ..piece.from };
        for _ in 0..CORRECTIONS {
            let place = model.place(&point.x);
            let step = place.linear.least(&place.values);
            point.x = plus(&point.x, -1.0, &step);
            point.t = place.linear.tangent;
            if norm(&step) <= ACCEPTANCE.residual || dot(&step, &step) > 1.0 {
                break;
            }
        }
        if dot(&point.t, &piece.from.t) < 0.0 {
            for value in &mut point.t {
                *value = -*value;
            }
        }
        point
    }

    /// Writes samples at equal distances. The first one is given, the last one is left to the caller. Returns the number of samples so far.
    fn sample(
        &mut self,
        model: &Model<'_>,
        (arc, start): (&Arc, &Q),
        out: &mut [Q],
        values: impl Fn(&Q) -> Q,
    ) -> usize {
        let count = out.len();
        let mut k = usize::min(count, 1);
        out[..k].fill(*start);
        while k + 1 < count && self.next(model, arc) {
            while k + 1 < count {
                let s = arc.length * k as f64 / (count - 1) as f64;
                if s > self.before + self.piece.length {
                    break;
                }
                out[k] = values(&self.at(model, self.share(s)));
                k += 1;
            }
        }
        k
    }

    /// The share of the present piece at a length of the arc.
    pub fn share(&self, s: f64) -> f64 {
        let share = (s - self.before) / self.piece.length;
        f64::min(f64::max(share, 0.0), 1.0)
    }
}

/// Joint values at a length `s` from the start of an arc (rad, where lengths are relative to [`Arm::length`]). `s` is limited to the arc. The arc must belong to
/// this target and these limits. Angles whose range is at least one turn are moved within their limits.
///
/// # Errors
///
/// [`Error::Limits`].
pub fn at(arm: &Arm, target: &Target, limits: &Limits, arc: &Arc, s: f64) -> Result<Q, Error> {
    let mut model = Model::new(arm, target, limits)?;
    if s <= 0.0 {
        return Ok(arc.start.q);
    }
    if s >= arc.length {
        return Ok(arc.end.q);
    }
    let mut journey = Journey::new(&mut model, arc);
    while journey.next(&model, arc) {
        if s <= journey.before + journey.piece.length {
            return Ok(model.unscaled(&journey.at(&model, journey.share(s))));
        }
    }
    Ok(arc.end.q)
}

/// Joint values at equal distances along an arc, from its start to its end, equal within 1e-3 of a distance. An output of one entry receives the start.
///
/// # Errors
///
/// [`Error::Limits`].
pub fn sample(arm: &Arm, target: &Target, limits: &Limits, arc: &Arc, out: &mut [Q]) -> Result<(), Error> {
    let mut model = Model::new(arm, target, limits)?;
    let mut journey = Journey::new(&mut model, arc);
    let count = journey.sample(&model, (arc, &arc.start.q), out, |x| model.unscaled(x));
    out[count..].fill(arc.end.q);
    Ok(())
}

/// Same as [`sample`], but joint values are continuous along the arc from `start`, which differs from the arc's start by whole turns ([`super::Span::turn`]).
///
/// # Errors
///
/// [`Error::Limits`].
pub fn sample_from(
    arm: &Arm,
    target: &Target,
    limits: &Limits,
    (arc, start): (&Arc, &Q),
    out: &mut [Q],
) -> Result<(), Error> {
    let mut model = Model::new(arm, target, limits)?;
    let mut journey = Journey::new(&mut model, arc);
    let shift = turns_to(arm, start, &arc.start.q);
    let values = |x: &Q| {
        let mut q = shift;
        for i in 0..model.count {
            q[i] += x[i] * model.units[i];
        }
        q
    };
    let count = journey.sample(&model, (arc, start), out, values);
    while journey.next(&model, arc) {}
    let end = plus(&arc.end.q, 1.0, &turns_to(arm, &values(&journey.piece.to.x), &arc.end.q));
    out[count..].fill(end);
    Ok(())
}

/// The whole turns that bring angles next to others.
pub(super) fn turns_to(arm: &Arm, to: &Q, from: &Q) -> Q {
    let mut shift = [0.0; MOST_JOINTS];
    for i in 0..arm.count {
        if !arm.slides[i] {
            shift[i] = TAU * Arithmetic::round((to[i] - from[i]) / TAU);
        }
    }
    shift
}
