//! Joint values along an arc ([`at`], [`sample`]).

use super::arcs::{Arc, constant};
use super::arm::{Arm, Limits, Q, Target};
use super::model::{Model, dot, norm, plus};
use super::step::{Piece, Point, Walk};
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
        true
    }

    /// The scaled joint values of the curve at a share of the present piece.
    pub fn at(&self, model: &Model<'_>, share: f64) -> Q {
        Journey::on(model, &self.piece, share)
    }

    /// The scaled joint values of the curve at a share of a piece.
    pub fn on(model: &Model<'_>, piece: &Piece, share: f64) -> Q {
        let mut x = piece.at(share);
        for _ in 0..CORRECTIONS {
            let place = model.place(&x);
            let step = place.linear.least(&place.values);
            x = plus(&x, -1.0, &step);
            if norm(&step) <= ACCEPTANCE.residual || dot(&step, &step) > 1.0 {
                break;
            }
        }
        x
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
    let count = out.len();
    let mut journey = Journey::new(&mut model, arc);
    let mut k = 0;
    while k + 1 < count && journey.next(&model, arc) {
        while k + 1 < count {
            let s = arc.length * k as f64 / (count - 1) as f64;
            if s > journey.before + journey.piece.length {
                break;
            }
            out[k] = if k == 0 { arc.start.q } else { model.unscaled(&journey.at(&model, journey.share(s))) };
            k += 1;
        }
    }
    while k < count {
        out[k] = if k == 0 { arc.start.q } else { arc.end.q };
        k += 1;
    }
    Ok(())
}
