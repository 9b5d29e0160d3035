//! The best solution within limits by a criterion, over all arcs ([`best`], [`optima`]).

use core::f64::consts::TAU;

use super::along::Journey;
use super::arcs::Arc;
use super::arm::{Arm, Limits, MOST_JOINTS, Q, Target};
use super::model::Model;
use super::step::{Piece, Point};
use crate::arithmetic::Arithmetic;
use crate::solution::Error;

/// The number of samples on each piece of a curve.
const SAMPLES: usize = 6;
/// Iterations of golden section search.
const SECTIONS: usize = 44;
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

impl Criterion {
    /// The value at scaled joint values.
    fn value(&self, model: &Model<'_>, x: &Q) -> f64 {
        match self {
            Criterion::Margin { is_relative } => {
                let mut least = f64::INFINITY;
                for i in 0..model.count {
                    let [low, high] = model.limits[i];
                    if !model.turns[i] {
                        let distance = f64::min(x[i] - low, high - x[i]);
                        let half = 0.5 * (high - low);
                        let share =
                            if *is_relative && half.is_finite() && half > 0.0 { distance / half } else { distance };
                        least = f64::min(least, share);
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
}

impl Stretch {
    /// Joint values at a length of the arc.
    fn at(&self, model: &Model<'_>, s: f64) -> Q {
        let k = usize::from(s > self.before[1]);
        let piece = &self.pieces[k];
        let share = if piece.length > 0.0 { (s - self.before[k]) / piece.length } else { 0.0 };
        Journey::on(model, piece, f64::min(f64::max(share, 0.0), 1.0))
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
    let mut list = Sorted { out, count: 0 };
    for (number, arc) in arcs.iter().enumerate() {
        along(&mut model, arc, number, criterion, &mut list);
    }
    Ok(list.count)
}

/// Optima in descending order.
struct Sorted<'o> {
    out: &'o mut [Best],
    count: usize,
}

impl Sorted<'_> {
    /// Whether an optimum with this value has room.
    fn has_room(&self, value: f64) -> bool {
        self.count < self.out.len() || self.count > 0 && value > self.out[self.count - 1].value
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
    let home = Piece::new(&Point { x, ..Point::NONE }, &Point { x, ..Point::NONE });
    let mut stretch = Stretch { pieces: [home; 2], before: [0.0; 2] };
    let (mut before, mut middle) = (Sample { s: 0.0, value: f64::NEG_INFINITY }, first);
    while journey.next(model, arc) {
        stretch.pieces = [stretch.pieces[1], journey.piece];
        stretch.before = [stretch.before[1], journey.before];
        for k in 1..=SAMPLES {
            let share = k as f64 / SAMPLES as f64;
            let s = f64::min(journey.before + share * journey.piece.length, arc.length);
            let value = criterion.value(model, &journey.piece.at(journey.share(s)));
            if middle.value >= before.value && middle.value > value {
                refine(model, &stretch, [before.s, s], None, (number, criterion), list);
            }
            (before, middle) = (middle, Sample { s, value });
            if s >= arc.length {
                break;
            }
        }
    }
    if middle.value >= before.value {
        refine(model, &stretch, [before.s, middle.s], Some(arc), (number, criterion), list);
    }
}

/// The optimum between two lengths, by golden section search (J. Kiefer, Proc. AMS 4 (1953) 502-506) and comparison with both ends, and with the end of the arc
/// if this is the last search on it.
fn refine(
    model: &Model<'_>,
    stretch: &Stretch,
    [mut low, mut high]: [f64; 2],
    ending: Option<&Arc>,
    (number, criterion): (usize, &Criterion),
    list: &mut Sorted<'_>,
) {
    let value = |s: f64| criterion.value(model, &stretch.at(model, s));
    let mut top = Sample { s: low, value: value(low) };
    let last = Sample { s: high, value: value(high) };
    if last.value > top.value {
        top = last;
    }
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (value(a), value(b));
    for _ in 0..SECTIONS {
        if at_a >= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = value(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = value(b);
        }
    }
    for sample in [Sample { s: a, value: at_a }, Sample { s: b, value: at_b }] {
        if sample.value > top.value {
            top = sample;
        }
    }
    if let Some(arc) = ending {
        // Lengths are not exact: the search may not reach the very end, or pass it, beyond a limit.
        let is_beyond = model.lift(&mut stretch.at(model, top.s)) != 0;
        let at_end = criterion.value(model, &model.scaled(&arc.end.q));
        if at_end >= top.value || is_beyond {
            list.insert(Best { q: arc.end.q, value: at_end, arc: number, s: arc.length });
            return;
        }
    }
    if list.has_room(top.value) {
        list.insert(Best { q: model.unscaled(&stretch.at(model, top.s)), value: top.value, arc: number, s: top.s });
    }
}
