//! Joint limits and turns: joint values that equal a solution up to whole turns.

use core::f64::consts::TAU;

use crate::arithmetic::Arithmetic;
use crate::effort::{MOST_STEPS, STRIDE, STRIDES};
use crate::joints::{is_in, moved};
use crate::mechanism::{Facts, Joint, Joints, Mechanism};
use crate::problem::Problem;
use crate::solution::Solution;
use crate::steps::Steps;
use crate::storage::Array;
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
        if self.is_angle() {
            return turns_between([value; 2], limit);
        }
        let (low, high) = (limit[0] - ACCEPTANCE.input - value, limit[1] + ACCEPTANCE.input - value);
        (0.0, if low <= 0.0 && 0.0 <= high { 0.0 } else { -1.0 })
    }

    /// A value that no turn brings within limits, at the turn nearest to their middle.
    fn beside(self, value: f64, limit: [f64; 2]) -> f64 {
        value + self.turn() * Arithmetic::round((0.5 * (limit[0] + limit[1]) - value) / TAU)
    }
}

/// The least and the greatest number of turns that bring angles between two values within limits. The first is greater when none does.
pub(crate) fn turns_between([least, greatest]: [f64; 2], [low, high]: [f64; 2]) -> (f64, f64) {
    let (low, high) = (low - ACCEPTANCE.input - least, high + ACCEPTANCE.input - greatest);
    (Arithmetic::ceil(low / TAU), Arithmetic::floor(high / TAU))
}

/// The number of turns between bounds that is nearest to a given one.
fn nearest_turn(turn: f64, first: f64, last: f64) -> f64 {
    f64::min(f64::max(turn, first), last) + 0.0
}

/// The bounds made finite and limited to a maximal distance.
pub(crate) fn finite_turns(mut first: f64, mut last: f64) -> (f64, f64) {
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

/// Reference joint values and limits for the choice of a solution.
pub(crate) struct Aim<'a, M: Mechanism> {
    pub reference: &'a Joints<M>,
    /// By joint, the non-negative weight of its squared difference.
    pub weights: &'a Joints<M>,
    pub limits: &'a Joints<M, [f64; 2]>,
}

/// Joint values after the turns within limits that are nearest to a reference.
pub(crate) struct Turned<M: Mechanism> {
    pub q: Joints<M>,
    /// The sum of the weighted squared differences from the reference.
    pub distance: f64,
    /// The sum of the distances from the limits of joints that no turn brings within them.
    pub excess: f64,
}

impl<M: Mechanism> Clone for Turned<M> {
    fn clone(&self) -> Self {
        Turned { q: self.q.clone(), ..*self }
    }
}

impl<M: Mechanism> Turned<M> {
    /// Whether these joint values are nearer to the limits than others, or equally near and nearer to the reference.
    pub fn is_better(&self, other: &Self) -> bool {
        self.excess < other.excess || (self.excess == other.excess && self.distance < other.distance)
    }

    /// The joint values with angles in (-pi, pi].
    pub fn wrapped(&self, facts: &Facts<'_>) -> Joints<M> {
        Array::by(facts.joints.len(), |i| facts.wrapped(i, self.q.as_ref()[i]))
    }
}

impl<M: Mechanism> Aim<'_, M> {
    /// Whether the reference and the weights are finite.
    pub fn is_finite(&self) -> bool {
        self.reference.as_ref().iter().chain(self.weights.as_ref()).all(|number| number.is_finite())
    }

    /// The nearest turn of joint values.
    pub fn turned(&self, facts: &Facts<'_>, q: &Joints<M>) -> Turned<M> {
        let mut turned: Turned<M> = Turned { q: q.clone(), distance: 0.0, excess: 0.0 };
        for (i, joint) in facts.joints.iter().enumerate() {
            let (value, wanted, limit) = (q.as_ref()[i], self.reference.as_ref()[i], self.limits.as_ref()[i]);
            let (first, last) = joint.turns_within(value, limit);
            let is_within = first <= last;
            let moved = if is_within {
                let turn = if joint.is_angle() { Arithmetic::round((wanted - value) / TAU) } else { 0.0 };
                value + joint.turn() * nearest_turn(turn, first, last)
            } else {
                joint.beside(value, limit)
            };
            if !is_within {
                turned.excess += excess(moved, limit);
            }
            turned.q.as_mut()[i] = moved;
            turned.distance += self.weights.as_ref()[i] * (moved - wanted) * (moved - wanted);
        }
        turned
    }

    /// Moves joints that no turn brings within their limits to the nearer limit. Returns these joints as a set.
    pub fn stop_at_limits(&self, facts: &Facts<'_>, q: &mut Joints<M>) -> u32 {
        let mut stopped = 0;
        for (i, joint) in facts.joints.iter().enumerate() {
            let (value, limit) = (q.as_ref()[i], self.limits.as_ref()[i]);
            let (first, last) = joint.turns_within(value, limit);
            let is_within = first <= last;
            if !is_within {
                let nearest = if joint.beside(value, limit) < limit[0] { limit[0] } else { limit[1] };
                q.as_mut()[i] = facts.wrapped(i, nearest);
                stopped |= 1 << i;
            }
        }
        stopped
    }
}

/// The distance of a value from its limits; infinite where these are not numbers.
fn excess(value: f64, limit: [f64; 2]) -> f64 {
    if value < limit[0] {
        limit[0] - value
    } else if value > limit[1] {
        value - limit[1]
    } else {
        f64::INFINITY
    }
}

/// Of a list of solutions, the one nearest to a reference after turns within limits.
pub(crate) fn nearest<M: Mechanism>(
    facts: &Facts<'_>,
    list: &[Solution<M>],
    aim: &Aim<'_, M>,
) -> Option<(usize, Turned<M>)> {
    let mut least = f64::INFINITY;
    let mut best = None;
    for (k, answer) in list.iter().enumerate() {
        let turned = aim.turned(facts, &answer.q);
        if turned.excess == 0.0 && turned.distance < least {
            least = turned.distance;
            best = Some((k, turned));
        }
    }
    best
}
