//! The best solution within limits by a criterion, over all arcs ([`best`], [`optima`]).

use core::f64::consts::TAU;

use super::along::Journey;
use super::arcs::{Arc, constant};
use super::arm::{Arm, Limits, MOST_JOINTS, Q, Target};
use super::model::{Model, dot, farthest, plus};
use super::step::{Piece, Point};
use crate::arithmetic::Arithmetic;
use crate::solution::Error;
use crate::tolerances::{ACCEPTANCE, MERGING};

/// The number of samples on each piece of a curve.
const SAMPLES: usize = 6;
/// Iterations of golden section search on the cubics of pieces, and on a cubic close to an optimum.
const COARSE: usize = 12;
const FINE: usize = 40;
/// Half of the length of the cubic close to an optimum, relative to the distance of the samples beside it. It is moved at most so many times.
const CLOSE: f64 = 0.06;
const MOVES: usize = 8;
/// Samples differ from the curve by at most this.
const SAMPLED: f64 = 2e-3;
/// The golden ratio's inverse.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What is to be large along arcs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Criterion {
    /// The least distance of a joint to its limits (rad, where lengths are relative to [`Arm::length`]). If it is relative, each distance is divided by half of
    /// the joint's range, so that 1 is in the middle; not
    /// that of a joint with only one limit. Joints without limits, or with a range of at least one turn, do not count.
    Margin {
        /// Whether distances are divided by half of the range.
        is_relative: bool,
    },
    /// The distance to a reference, negative: `-sqrt(sum w (q - q0)^2)`. Angles whose range is at least one turn are compared up to whole turns.
    Nearest {
        /// The reference: rad, or the unit of lengths.
        q0: Q,
        /// The weights `w`.
        weights: Q,
    },
    /// `sqrt(det(J J^T))` of the task's Jacobian, where lengths are relative to [`Arm::length`] (T. Yoshikawa, Int. J. Robotics Research 4 (1985) 3-9).
    Manipulability,
    /// The difference of one joint from a value, as a negative magnitude.
    Change {
        /// The joint.
        joint: usize,
        /// The value: rad, or the unit of lengths.
        value: f64,
    },
}

/// An optimum on an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best {
    /// Joint values.
    pub q: Q,
    /// The value of the criterion.
    pub value: f64,
    /// The number of the arc.
    pub arc: usize,
    /// The length from the start of the arc.
    pub s: f64,
}

impl Best {
    /// An entry with which a buffer is filled.
    pub const NONE: Best = Best { q: [0.0; MOST_JOINTS], value: f64::NEG_INFINITY, arc: 0, s: 0.0 };
}

/// A difference of joint values in their own units.
fn difference(model: &Model<'_>, x: &Q, joint: usize, value: f64) -> f64 {
    let d = x[joint] * model.units[joint] - value;
    if model.turns[joint] { d - TAU * Arithmetic::round(d / TAU) } else { d }
}

/// The distance of a joint to its limits, relative to half the range if requested.
#[inline(always)]
fn distance_to_limits(model: &Model<'_>, x: &Q, joint: usize, is_relative: bool) -> f64 {
    let [low, high] = model.limits[joint];
    let distance = f64::min(x[joint] - low, high - x[joint]);
    let half = 0.5 * (high - low);
    if is_relative && half.is_finite() && half > 0.0 { distance / half } else { distance }
}

impl Criterion {
    /// The value at scaled joint values.
    fn value(&self, model: &Model<'_>, x: &Q) -> f64 {
        match self {
            Criterion::Margin { is_relative } => {
                let mut least = f64::INFINITY;
                for i in 0..model.count {
                    if !model.turns[i] {
                        least = f64::min(least, distance_to_limits(model, x, i, *is_relative));
                    }
                }
                least
            }
            Criterion::Nearest { q0, weights } => {
                let mut sum = 0.0;
                for i in 0..model.count {
                    let d = difference(model, x, i, q0[i]);
                    sum += weights[i] * d * d;
                }
                -Arithmetic::sqrt(sum)
            }
            Criterion::Manipulability => model.place(x).linear.volume,
            Criterion::Change { joint, value } => -difference(model, x, *joint, *value).abs(),
        }
    }

    /// The greatest rate of the value along an arc.
    fn rate(&self, model: &Model<'_>) -> f64 {
        let mut greatest = 0.0;
        match self {
            Criterion::Margin { is_relative: false } => greatest = 1.0,
            Criterion::Nearest { weights, .. } => {
                for i in 0..model.count {
                    greatest = f64::max(greatest, Arithmetic::sqrt(weights[i]) * model.units[i]);
                }
            }
            Criterion::Change { joint, .. } => greatest = model.units[*joint],
            Criterion::Margin { is_relative: true } | Criterion::Manipulability => greatest = f64::INFINITY,
        }
        greatest
    }

    /// An upper bound of the value along an arc: a joint that is constant keeps its distance to the limits, and elsewhere the value changes with the rate.
    fn ceiling(&self, model: &Model<'_>, arc: &Arc) -> f64 {
        let (start, end) = (model.scaled(&arc.start.q), model.scaled(&arc.end.q));
        let both = self.value(model, &start) + self.value(model, &end);
        let ceiling = 0.5 * (both + self.rate(model) * (arc.length + SAMPLED));
        match (self, constant(model.arm)) {
            (Criterion::Margin { is_relative }, Some(joint)) if !model.turns[joint] => {
                f64::min(ceiling, distance_to_limits(model, &start, joint, *is_relative))
            }
            _ => ceiling,
        }
    }
}

/// A sample on an arc.
#[derive(Clone, Copy)]
struct Sample {
    s: f64,
    value: f64,
}

/// The two latest pieces of an arc, with the length before each.
struct Stretch {
    pieces: [Piece; 2],
    before: [f64; 2],
    /// Whether samples are on the curve, and not only on the cubics.
    is_exact: bool,
}

impl Stretch {
    /// The piece at a length of the arc, and the share of its length.
    fn piece(&self, s: f64) -> (&Piece, f64) {
        let k = usize::from(s > self.before[1]);
        let piece = &self.pieces[k];
        let share = if piece.length > 0.0 { (s - self.before[k]) / piece.length } else { 0.0 };
        (piece, f64::min(f64::max(share, 0.0), 1.0))
    }

    /// Joint values at a length of the arc, by the cubic of the piece.
    fn near(&self, s: f64) -> Q {
        let (piece, share) = self.piece(s);
        piece.at(share)
    }

    /// The value at a length of the arc: on the curve, or by the cubic of the piece.
    fn sample(&self, model: &Model<'_>, criterion: &Criterion, s: f64) -> Sample {
        let x = if self.is_exact { self.point(model, s).x } else { self.near(s) };
        Sample { s, value: criterion.value(model, &x) }
    }

    /// The point of the curve at a length of the arc.
    fn point(&self, model: &Model<'_>, s: f64) -> Point {
        let (piece, share) = self.piece(s);
        Journey::point_on(model, piece, share)
    }
}

/// The best solution by a criterion over the arcs of a target; `None` if there are no arcs. The arcs must belong to this target and these limits.
///
/// Curves are sampled at six points for each step, and each sample that is better than its neighbours is refined. Two optima between neighbouring samples are
/// found as one.
///
/// # Errors
///
/// [`Error::Limits`].
pub fn best(
    arm: &Arm,
    target: &Target,
    limits: &Limits,
    arcs: &[Arc],
    criterion: &Criterion,
) -> Result<Option<Best>, Error> {
    let mut out = [Best::NONE; 1];
    let count = optima(arm, target, limits, (arcs, criterion), &mut out)?;
    Ok(if count > 0 { Some(out[0]) } else { None })
}

/// All local optima of a criterion over arcs, the best ones first. Returns their number; if there are more than the output's length, the worst ones are dropped.
///
/// # Errors
///
/// [`Error::Limits`].
pub fn optima(
    arm: &Arm,
    target: &Target,
    limits: &Limits,
    (arcs, criterion): (&[Arc], &Criterion),
    out: &mut [Best],
) -> Result<usize, Error> {
    let mut model = Model::new(arm, target, limits)?;
    let mut list = Sorted { out, count: 0, ceiling: 0.0 };
    let (mut first, mut highest) = (0, f64::NEG_INFINITY);
    for (k, arc) in arcs.iter().enumerate() {
        let ceiling = criterion.ceiling(&model, arc);
        first = if ceiling > highest { k } else { first };
        highest = f64::max(highest, ceiling);
    }
    // The most promising arc comes first, so that others need not be searched.
    for k in 0..arcs.len() {
        let number = if k == 0 {
            first
        } else if k <= first {
            k - 1
        } else {
            k
        };
        list.ceiling = criterion.ceiling(&model, &arcs[number]);
        if list.may_have_room(list.ceiling) {
            along(&mut model, &arcs[number], number, criterion, &mut list);
        }
    }
    Ok(list.count)
}

/// Optima in descending order.
struct Sorted<'o> {
    out: &'o mut [Best],
    count: usize,
    /// An upper bound of the criterion along the present arc.
    ceiling: f64,
}

impl Sorted<'_> {
    /// Whether an optimum with this value has room.
    fn has_room(&self, value: f64) -> bool {
        self.count < self.out.len() || self.count > 0 && value > self.out[self.count - 1].value
    }

    /// Whether an optimum with at most this value may have room. Where the value is constant, as of a joint that is, rounding makes no optima.
    fn may_have_room(&self, most: f64) -> bool {
        self.has_room(f64::min(most, self.ceiling) - ACCEPTANCE.residual)
    }

    fn insert(&mut self, best: Best) {
        if !self.has_room(best.value) {
            return;
        }
        if self.count < self.out.len() {
            self.count += 1;
        }
        let mut k = self.count - 1;
        while k > 0 && self.out[k - 1].value < best.value {
            self.out[k] = self.out[k - 1];
            k -= 1;
        }
        self.out[k] = best;
    }
}

/// The optima on one arc.
fn along(model: &mut Model<'_>, arc: &Arc, number: usize, criterion: &Criterion, list: &mut Sorted<'_>) {
    let x = model.scaled(&arc.start.q);
    let first = Sample { s: 0.0, value: criterion.value(model, &x) };
    let mut journey = Journey::new(model, arc);
    let mut stretch = Stretch { pieces: [journey.piece; 2], before: [0.0; 2], is_exact: false };
    let rate = criterion.rate(model);
    let (mut before, mut middle) = (Sample { s: 0.0, value: f64::NEG_INFINITY }, first);
    while journey.next(model, arc) {
        stretch.pieces = [stretch.pieces[1], journey.piece];
        stretch.before = [stretch.before[1], journey.before];
        for k in 1..=SAMPLES {
            let share = k as f64 / SAMPLES as f64;
            let s = f64::min(journey.before + share * journey.piece.length, arc.length);
            let value = criterion.value(model, &journey.piece.at(journey.share(s)));
            let most = middle.value + rate * (s - before.s + SAMPLED);
            if middle.value >= before.value && middle.value > value && list.may_have_room(most) {
                refine(model, &stretch, [before.s, s], None, (number, criterion), list);
            }
            (before, middle) = (middle, Sample { s, value });
            if s >= arc.length {
                break;
            }
        }
    }
    let end = Sample { s: arc.length, value: criterion.value(model, &model.scaled(&arc.end.q)) };
    let most = f64::max(end.value, middle.value + rate * (middle.s - before.s + SAMPLED));
    if middle.value >= before.value && list.may_have_room(most) {
        refine(model, &stretch, [before.s, middle.s], Some((end, &arc.end.q)), (number, criterion), list);
    }
}

/// The optimum between two lengths, both ends included, by golden section search (J. Kiefer, Proc. AMS 4 (1953) 502-506).
fn section(
    model: &Model<'_>,
    stretch: &Stretch,
    criterion: &Criterion,
    [mut low, mut high]: [f64; 2],
    count: usize,
) -> Sample {
    let sample = |s: f64| stretch.sample(model, criterion, s);
    let (first, last) = (sample(low), sample(high));
    let (mut a, mut b) = (sample(high - GOLDEN * (high - low)), sample(low + GOLDEN * (high - low)));
    for _ in 0..count {
        if a.value >= b.value {
            (high, b) = (b.s, a);
            a = sample(high - GOLDEN * (high - low));
        } else {
            (low, a) = (a.s, b);
            b = sample(low + GOLDEN * (high - low));
        }
    }
    let mut top = first;
    for other in [last, a, b] {
        if other.value > top.value {
            top = other;
        }
    }
    top
}

/// The optimum between two lengths, and the end of the arc if this is the last search on it. It is searched on the cubics of the pieces first, and then on the
/// cubic between two points of the curve that are close to it.
fn refine(
    model: &Model<'_>,
    stretch: &Stretch,
    [low, high]: [f64; 2],
    ending: Option<(Sample, &Q)>,
    (number, criterion): (usize, &Criterion),
    list: &mut Sorted<'_>,
) {
    let mut s = section(model, stretch, criterion, [low, high], COARSE).s;
    let mut x = [0.0; MOST_JOINTS];
    for _ in 0..MOVES {
        let width = CLOSE * (high - low);
        let (from, to) = (f64::max(low, s - width), f64::min(high, s + width));
        let piece = Piece::new(&stretch.point(model, from), &stretch.point(model, to));
        let close = Stretch { pieces: [piece; 2], before: [from; 2], is_exact: false };
        let last = from + piece.length;
        s = section(model, &close, criterion, [from, last], FINE).s;
        x = close.point(model, s).x;
        if farthest(&model.difference(&x, &close.near(s))) > MERGING.joints {
            // Next to a singular point the curve is no cubic.
            let exact = Stretch { is_exact: true, ..*stretch };
            s = section(model, &exact, criterion, [low, high], FINE).s;
            x = stretch.point(model, s).x;
            break;
        }
        if s > from && s < last || s == from && from == low || s == last && to == high {
            break;
        }
    }
    let value = criterion.value(model, &x);
    // Lengths are not exact: the search may not reach the very end, or pass it, beyond a limit.
    if let Some((end, q)) = ending
        && (end.value >= value || model.lift(&mut x.clone()) != 0)
    {
        list.insert(Best { q: *q, value: end.value, arc: number, s: end.s });
        return;
    }
    if list.has_room(value) {
        // The length on the pieces of the arc.
        let point = stretch.point(model, s);
        s = f64::min(f64::max(s + dot(&plus(&x, -1.0, &point.x), &point.t), low), high);
        list.insert(Best { q: model.unscaled(&x), value, arc: number, s });
    }
}
