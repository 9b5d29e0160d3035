//! Steps along a curve of solutions: predictor, corrector and their acceptance ([`Walk`]).
//!
//! The predictor continues the polynomial of degree four through the last piece. The corrector is the simplified Newton method. A step is accepted by an
//! affine-invariant estimate of the Newton-Kantorovich condition (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004, sections 2.1 and
//! 5.2): the second correction must be at most a quarter of the first one. The oriented direction must not turn back. Where it does, the step has left the curve
//! for another one that nearly crosses it.

use super::arm::{MOST_JOINTS, Q};
use super::model::{Model, Place, dot, norm, plus};
use crate::arithmetic::Arithmetic;
use crate::tolerances::{ACCEPTANCE, MERGING, PIVOTS};

/// The first and the longest step (rad, or relative to the characteristic length).
pub(super) const PACE: [f64; 2] = [0.2, 0.5];
/// The shortest step. Where a shorter one would be necessary, two curves cross.
const SHORTEST: f64 = 0.1 * MERGING.apart;
/// With steps shorter than this share of the longest one, the curvature is checked. It is wrong if its relative error is more than the second number.
const SMALL: f64 = 0.2;
const WRONG: f64 = 0.5;
/// Lengths of the steps across such a crossing.
const LEAPS: [f64; 4] = [MERGING.apart, 1e-3, 1e-2, 5e-2];
/// Maximal length of the first correction.
const CORRECTION: f64 = 2e-3;
/// Maximal ratio of the second correction to the first one.
const CONTRACTION: f64 = 0.25;
/// A point is on a piece when it is within this distance, relative to the piece's length.
pub(super) const ON: f64 = 0.02;
/// The least cosine of the angle between directions at both ends of a step.
const STRAIGHT: f64 = 0.8;

/// Maximal change of a piece's length, relative to it, by the term of degree four.
pub(super) const FOURTH: f64 = 1e-3;

/// A point on a curve.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// Scaled joint values.
    pub x: Q,
    /// The direction of travel, of length one.
    pub t: Q,
    /// The second derivative by the length.
    pub bend: Q,
}

impl Point {
    pub const NONE: Point = Point { x: [0.0; MOST_JOINTS], t: [0.0; MOST_JOINTS], bend: [0.0; MOST_JOINTS] };

    /// The point of a place whose direction of travel is the oriented one times `side`.
    pub fn of(place: &Place, side: f64, bend: &Q) -> Point {
        let mut t = place.linear.tangent;
        for value in &mut t {
            *value *= side;
        }
        Point { x: place.x, t, bend: *bend }
    }
}

/// A piece of a curve, from one step.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub from: Point,
    pub to: Point,
    pub length: f64,
}

impl Piece {
    pub fn new(from: &Point, to: &Point) -> Piece {
        Piece { from: *from, to: *to, length: length(from, to) }
    }

    /// The joint values at a share of the length, by the cubic with the positions and directions of both ends.
    pub fn at(&self, share: f64) -> Q {
        let mut x = [0.0; MOST_JOINTS];
        for i in 0..MOST_JOINTS {
            x[i] = self.value(i, share);
        }
        x
    }

    /// One joint's value at a share of the length.
    pub fn value(&self, joint: usize, share: f64) -> f64 {
        let [c, b, a] = self.cubic(joint);
        self.from.x[joint] + share * (c + share * (b + share * a))
    }

    /// The coefficients of the joint's cubic, without the constant one.
    pub fn cubic(&self, joint: usize) -> [f64; 3] {
        let rise = self.to.x[joint] - self.from.x[joint];
        let (first, last) = (self.length * self.from.t[joint], self.length * self.to.t[joint]);
        [first, 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise]
    }
}

/// The length of the curve between two points, by the slopes at both ends: that of a cubic, and for a circle up to the sixth power of the angle.
fn length(from: &Point, to: &Point) -> f64 {
    let chord = plus(&to.x, -1.0, &from.x);
    let square = dot(&chord, &chord);
    if square == 0.0 {
        return 0.0;
    }
    let distance = Arithmetic::sqrt(square);
    // The directions without their shares along the chord.
    let (first, last) = (dot(&from.t, &chord) / distance, dot(&to.t, &chord) / distance);
    let (a, b) = (1.0 - first * first, 1.0 - last * last);
    let both = dot(&from.t, &to.t) - first * last;
    // Squares of sines, made squares of angles.
    let mean = 0.5 * (a + b);
    let slopes = (2.0 * a + 2.0 * b - both) * (1.0 + mean / 3.0);
    let length = distance * (1.0 + slopes / 30.0 + 7.0 / 360.0 * mean * mean);
    // The polynomial of degree four with the curvature at the beginning differs from the cubic by `fourth u^2 (1 - u)^2`.
    let mut change = 0.0;
    for i in 0..MOST_JOINTS {
        let (first, last) = (length * from.t[i], length * to.t[i]);
        let fourth = 0.5 * length * length * from.bend[i] - (3.0 * chord[i] - 2.0 * first - last);
        change += (last - first) * fourth;
    }
    length - f64::min(f64::max(change / (30.0 * length), -FOURTH * length), FOURTH * length)
}

/// A walk along a curve.
pub(super) struct Walk {
    pub at: Point,
    /// The sign of the direction of travel against the oriented one.
    pub side: f64,
    /// The next step.
    pub pace: f64,
    longest: f64,
    /// The third and the fourth derivative by the length.
    third: Q,
    fourth: Q,
    /// Whether the walk has crossed a singular point, where curves meet.
    pub is_unsure: bool,
}

impl Walk {
    /// A walk from a point. Steps are divided by four at each level.
    pub fn new(at: &Point, side: f64, level: u32) -> Walk {
        let mut share = 1.0;
        for _ in 0..level {
            share *= 0.25;
        }
        Walk {
            at: *at,
            side,
            pace: PACE[0] * share,
            longest: PACE[1] * share,
            third: [0.0; MOST_JOINTS],
            fourth: [0.0; MOST_JOINTS],
            is_unsure: false,
        }
    }

    /// The next piece of the curve. The walk remains where it is until [`Walk::go`]. `None` where the curve cannot be followed.
    pub fn piece(&mut self, model: &Model<'_>) -> Option<Piece> {
        if self.pace < SMALL * self.longest {
            self.renew(model);
        }
        while self.pace >= SHORTEST {
            if let Some((piece, size)) = self.attempt(model, self.pace, self.side) {
                let grown = Arithmetic::sqrt(Arithmetic::sqrt(0.5 * CORRECTION / f64::max(size, ACCEPTANCE.residual)));
                self.pace = f64::min(self.longest, self.pace * f64::min(2.0, f64::max(0.5, grown)));
                return Some(piece);
            }
            self.pace *= 0.4;
        }
        self.leap(model)
    }

    /// Replaces the curvature if it is wrong. Its error remains from piece to piece: after a sharp turn, steps would remain short.
    fn renew(&mut self, model: &Model<'_>) {
        let (_, bend) = model.bent(&self.at.x);
        if norm(&plus(&bend, -1.0, &self.at.bend)) > WRONG * norm(&bend) {
            self.at.bend = bend;
            (self.third, self.fourth) = ([0.0; MOST_JOINTS], [0.0; MOST_JOINTS]);
        }
    }

    /// A step across a singular point. Beyond it the oriented direction is opposite to the direction of travel.
    #[cold]
    fn leap(&mut self, model: &Model<'_>) -> Option<Piece> {
        for leap in LEAPS {
            for side in [-self.side, self.side] {
                if let Some((piece, _)) = self.attempt(model, leap, side) {
                    self.side = side;
                    self.is_unsure = true;
                    self.pace = leap;
                    return Some(piece);
                }
            }
        }
        None
    }

    /// A step of a certain length: the piece, and the length of the correction. `None` if it is not accepted.
    fn attempt(&self, model: &Model<'_>, pace: f64, side: f64) -> Option<(Piece, f64)> {
        let mut x = self.at.x;
        for i in 0..MOST_JOINTS {
            x[i] += pace
                * (self.at.t[i]
                    + pace * (0.5 * self.at.bend[i] + pace * (self.third[i] / 6.0 + pace / 24.0 * self.fourth[i])));
        }
        let mut place = model.place(&x);
        if model.frozen.is_some() && side * dot(&place.linear.tangent, &self.at.t) < 0.0 {
            // One of the equations is left out, so that the orientation is not continuous.
            place.linear.reverse();
        }
        if place.linear.pivot <= PIVOTS.regular || side * dot(&place.linear.tangent, &self.at.t) < STRAIGHT {
            return None;
        }
        let first = place.linear.least(&place.values);
        let size = norm(&first);
        let is_short = size <= CORRECTION;
        if !is_short {
            return None;
        }
        x = plus(&x, -1.0, &first);
        let [values, rates] = model.moving(&x, &place.linear.tangent);
        let second = place.linear.least(&values);
        let is_contracting = norm(&second) <= CONTRACTION * size + ACCEPTANCE.residual;
        if !is_contracting {
            return None;
        }
        // The null vector of the derivatives at the corrected point, by one step of the same method.
        let turn = place.linear.least(&rates);
        let shrink = side / Arithmetic::sqrt(1.0 + dot(&turn, &turn));
        let mut to = Point { x: plus(&x, -1.0, &second), ..Point::NONE };
        for i in 0..MOST_JOINTS {
            to.t[i] = shrink * (place.linear.tangent[i] - turn[i]);
        }
        Some((Piece::new(&self.at, &to), size))
    }

    /// Moves the walk to the end of a piece. The next prediction continues the polynomial of degree four with the positions and directions of both ends and the
    /// curvature at the beginning.
    pub fn go(&mut self, piece: &Piece) {
        let bend = self.at.bend;
        self.at = piece.to;
        if piece.length > 0.0 {
            let inverse = 1.0 / piece.length;
            let square = piece.length * piece.length;
            for i in 0..MOST_JOINTS {
                let [_, b, a] = piece.cubic(i);
                let fourth = 0.5 * square * bend[i] - b;
                self.at.bend[i] = bend[i] + 6.0 * a * inverse * inverse;
                self.third[i] = (6.0 * a + 12.0 * fourth) * inverse * inverse * inverse;
                self.fourth[i] = 24.0 * fourth * inverse * inverse * inverse * inverse;
            }
        }
    }
}

/// Whether a point is on a piece.
pub(super) fn is_on(model: &Model<'_>, piece: &Piece, x: &Q) -> bool {
    let away = model.difference(x, &piece.from.x);
    if norm(&away) > 1.1 * piece.length {
        return false;
    }
    let chord = plus(&piece.to.x, -1.0, &piece.from.x);
    let share = dot(&away, &chord) / dot(&chord, &chord);
    if !(0.0..=1.0).contains(&share) {
        return false;
    }
    model.are_close(&piece.at(share), x, ON * piece.length + MERGING.joints)
}
