//! Joint limits and turns: joint values that equal a solution up to whole turns.

use core::f64::consts::TAU;

use crate::arithmetic::Arithmetic;
use crate::effort::{MOST_STEPS, STRIDE, STRIDES};
use crate::joints::{is_in, moved};
use crate::mechanism::{Facts, Joint, Joints, Mechanism};
use crate::problem::Problem;
use crate::solution::Solution;
use crate::steps::Steps;
use crate::tolerances::ACCEPTANCE;

/// Maximal number of turns that are counted.
pub const MOST_TURNS: usize = 1_000_000;

impl Joint {
    /// The period of a joint: a full turn for an angle, 0 for a length.
    fn turn(self) -> f64 {
        if self.is_angle() { TAU } else { 0.0 }
    }

    /// The least and the greatest number of turns that bring the joint within its limits. The first is greater when none does.
    fn turns_within(self, value: f64, limit: [f64; 2]) -> (f64, f64) {
        let (low, high) = (limit[0] - ACCEPTANCE.input - value, limit[1] + ACCEPTANCE.input - value);
        if self.is_angle() {
            return (Arithmetic::ceil(low / TAU), Arithmetic::floor(high / TAU));
        }
        (0.0, if low <= 0.0 && 0.0 <= high { 0.0 } else { -1.0 })
    }
}

/// The number of turns between bounds that is nearest to a given one.
fn nearest_turn(turn: f64, first: f64, last: f64) -> f64 {
    f64::min(f64::max(turn, first), last) + 0.0
}

/// The bounds made finite and limited to a maximal distance.
fn finite_turns(mut first: f64, mut last: f64) -> (f64, f64) {
    if !first.is_finite() || !last.is_finite() {
        first = nearest_turn(0.0, first, last);
        last = first;
    }
    (first, f64::min(last, first + MOST_TURNS as f64))
}

/// Counts the combinations of turns of `q` within limits.
pub(crate) fn count_turns(facts: &Facts<'_>, q: &[f64], limits: &[[f64; 2]]) -> usize {
    let mut count = 1.0;
    for ((joint, value), limit) in facts.joints.iter().zip(q).zip(limits) {
        let (first, last) = joint.turns_within(*value, *limit);
        let is_reached = first <= last;
        if !is_reached {
            return 0;
        }
        let (first, last) = finite_turns(first, last);
        count = f64::min(count * (last - first + 1.0), MOST_TURNS as f64);
    }
    count as usize
}

/// Moves `q` to the combination of turns with this index.
pub(crate) fn turn(facts: &Facts<'_>, q: &mut [f64], limits: &[[f64; 2]], mut index: usize) {
    for ((joint, value), limit) in facts.joints.iter().zip(q).zip(limits).rev() {
        let (first, last) = joint.turns_within(*value, *limit);
        let (first, last) = finite_turns(first, last);
        let count = (last - first) as usize + 1;
        *value += joint.turn() * (first + (index % count) as f64);
        index /= count;
    }
}

/// Joints moved within limits by as few turns as possible. `None` when that is impossible.
pub(crate) fn turned_within<M: Mechanism>(
    facts: &Facts<'_>,
    q: &Joints<M>,
    limits: &Joints<M, [f64; 2]>,
) -> Option<Joints<M>> {
    let mut place = q.clone();
    for ((joint, value), limit) in facts.joints.iter().zip(place.as_mut()).zip(limits.as_ref()) {
        let (first, last) = joint.turns_within(*value, *limit);
        let is_reached = first <= last;
        if !is_reached {
            return None;
        }
        *value += joint.turn() * nearest_turn(0.0, first, last);
    }
    Some(place)
}

/// A member of a self-motion moved along it until it is within limits, with its residual. Free joints are moved one at a time in short steps. `None` when no
/// such place is found.
pub(crate) fn strides_within<M: Mechanism>(
    problem: &mut Problem<'_, M>,
    answer: &Solution<M>,
    limits: &Joints<M, [f64; 2]>,
) -> Option<(Joints<M>, f64)> {
    *problem.steps = Steps::at_most(MOST_STEPS);
    for i in (0..2 * problem.joints()).filter(|i| is_in(answer.free, i / 2)) {
        let mut q = answer.q.clone();
        for _ in 0..STRIDES {
            let delta = if i % 2 == 0 { STRIDE } else { -STRIDE };
            let (next, fit) = {
                let start = moved::<M>(&problem.facts(), &q, i / 2, delta);
                problem.polished(start, answer.free)
            };
            if !fit.accepted {
                break;
            }
            if let Some(place) = turned_within::<M>(&problem.facts(), &next, limits) {
                return Some((place, fit.residual));
            }
            q = next;
        }
    }
    None
}

/// Of a list of solutions, the one nearest to a reference after turns within limits.
pub(crate) fn nearest<M: Mechanism>(
    facts: &Facts<'_>,
    list: &[Solution<M>],
    reference: &Joints<M>,
    weights: &Joints<M>,
    limits: &Joints<M, [f64; 2]>,
) -> Option<(usize, Joints<M>)> {
    let mut least = f64::INFINITY;
    let mut best = None;
    for (k, answer) in list.iter().enumerate() {
        let (mut place, mut distance) = (answer.q.clone(), 0.0);
        for (i, joint) in facts.joints.iter().enumerate() {
            let (value, wanted) = (answer.q.as_ref()[i], reference.as_ref()[i]);
            let (first, last) = joint.turns_within(value, limits.as_ref()[i]);
            distance = if first <= last { distance } else { f64::INFINITY };
            let turn = if joint.is_angle() { Arithmetic::round((wanted - value) / TAU) } else { 0.0 };
            let moved = value + joint.turn() * nearest_turn(turn, first, last);
            place.as_mut()[i] = moved;
            distance += weights.as_ref()[i] * (moved - wanted) * (moved - wanted);
        }
        if distance < least {
            least = distance;
            best = Some((k, place));
        }
    }
    best
}
