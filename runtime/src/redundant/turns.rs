//! Joint values and arcs that differ by whole turns ([`Span`]).

use core::f64::consts::TAU;

use super::along::{Journey, turns_to};
use super::arcs::Arc;
use super::arm::{Arm, Limits, Q, Target};
use super::crossing::extrema;
use super::model::Model;
use crate::limits::{MOST_TURNS, finite_turns, turns_between};
use crate::solution::Error;

/// The least and the greatest value of each joint along an arc (rad, or the unit of lengths). Values are continuous from the start of the arc, so that angles
/// may be beyond limits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Span {
    /// The start of the arc.
    pub start: Q,
    /// The least values.
    pub low: Q,
    /// The greatest values.
    pub high: Q,
}

impl Span {
    /// The span of one solution.
    #[must_use]
    pub fn of(q: &Q) -> Span {
        Span { start: *q, low: *q, high: *q }
    }

    /// The span of an arc, within 1e-6. The arc must belong to this target and these limits.
    ///
    /// # Errors
    ///
    /// [`Error::Limits`].
    pub fn along(arm: &Arm, target: &Target, limits: &Limits, arc: &Arc) -> Result<Span, Error> {
        let mut model = Model::new(arm, target, limits)?;
        let mut span = Span::of(&arc.start.q);
        let mut journey = Journey::new(&mut model, arc);
        let mut last = arc.start.q;
        while journey.next(&model, arc) {
            let end = journey.share(arc.length);
            for joint in 0..model.count {
                let [c, b, a] = journey.piece.cubic(joint);
                let [first, second, _] = extrema(a, b, c);
                for share in [first, second] {
                    if share > 0.0 && share < end {
                        span.extend(joint, journey.at(&model, share)[joint] * model.units[joint]);
                    }
                }
                last[joint] = journey.piece.to.x[joint] * model.units[joint];
                if end == 1.0 {
                    span.extend(joint, last[joint]);
                }
            }
        }
        let turns = turns_to(arm, &last, &arc.end.q);
        for joint in 0..model.count {
            span.extend(joint, arc.end.q[joint] + turns[joint]);
        }
        Ok(span)
    }

    fn extend(&mut self, joint: usize, value: f64) {
        self.low[joint] = f64::min(self.low[joint], value);
        self.high[joint] = f64::max(self.high[joint], value);
    }

    /// The turns of a joint within limits: the first one, and their number.
    fn turns(&self, arm: &Arm, limits: &Limits, joint: usize) -> (f64, usize) {
        if arm.slides[joint] {
            return (0.0, 1);
        }
        let (first, last) = turns_between([self.low[joint], self.high[joint]], limits[joint]);
        let is_within = first <= last;
        if !is_within {
            return (0.0, 0);
        }
        let (first, last) = finite_turns(first, last);
        (first, (last - first) as usize + 1)
    }

    /// The number of arcs within limits that differ from this one by whole turns of its angles, itself included; of solutions for [`Span::of`]. Along each of
    /// them, joint values are continuous. 0 if the arc passes the limits of a joint whose range is at least one turn. An angle that lacks a limit counts once;
    /// at most 1,000,000.
    #[must_use]
    pub fn count_turns(&self, arm: &Arm, limits: &Limits) -> usize {
        let mut count = 1.0;
        for joint in 0..arm.count {
            let (_, turns) = self.turns(arm, limits, joint);
            count = f64::min(count * turns as f64, MOST_TURNS as f64);
        }
        count as usize
    }

    /// The start of the arc with this index, which must be below their number. The last joint changes fastest.
    #[must_use]
    pub fn turn(&self, arm: &Arm, limits: &Limits, mut index: usize) -> Q {
        let mut start = self.start;
        for joint in (0..arm.count).rev() {
            let (first, count) = self.turns(arm, limits, joint);
            let count = usize::max(count, 1);
            if !arm.slides[joint] {
                start[joint] += TAU * (first + (index % count) as f64);
            }
            index /= count;
        }
        start
    }
}
