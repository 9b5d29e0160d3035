//! Joint values: distances, displacements, and the numbers that the equations read of them.

use core::f64::consts::{PI, TAU};

use crate::mechanism::{Facts, Joint, Joints, Mechanism, Places};
use crate::storage::Array;
use crate::trigonometry::{cosine_and_sine, wrap};

/// Whether bit `joint` of a set of joints is set.
#[inline(always)]
pub(crate) fn is_in(set: u32, joint: usize) -> bool {
    set >> joint & 1 != 0
}

/// A difference of two angles, reduced to (-pi, pi].
#[inline(always)]
fn shorter(difference: f64) -> f64 {
    if difference > PI {
        difference - TAU
    } else if difference < -PI {
        difference + TAU
    } else {
        difference
    }
}

impl Joint {
    #[inline(always)]
    pub(crate) fn is_angle(self) -> bool {
        matches!(self, Joint::Angle(_))
    }
}

impl Facts<'_> {
    /// A difference of two values of a joint; of angles, reduced to (-pi, pi].
    #[inline(always)]
    fn shortest(&self, joint: usize, difference: f64) -> f64 {
        if self.joints[joint].is_angle() { shorter(difference) } else { difference }
    }

    /// The unit of a joint's differences: 1 for an angle, the magnitude of a length.
    #[inline(always)]
    fn span(&self, joint: usize, value: f64) -> f64 {
        if self.joints[joint].is_angle() { 1.0 } else { f64::max(self.scale, value.abs()) }
    }

    /// The value of a joint, an angle in (-pi, pi].
    #[inline(always)]
    pub(crate) fn wrapped(&self, joint: usize, value: f64) -> f64 {
        if self.joints[joint].is_angle() { wrap(value) } else { value }
    }

    /// Whether joint values differ by at most `tolerance`. Joints that are found last are compared first, because they differ most often.
    #[inline(always)]
    pub(crate) fn is_within(&self, a: &[f64], b: &[f64], tolerance: f64) -> bool {
        self.last_first.iter().all(|&i| self.shortest(i, a[i] - b[i]).abs() <= tolerance * self.span(i, a[i]))
    }

    /// The largest difference of a joint: an angle, or relative to the magnitude of a length.
    pub(crate) fn farthest(&self, a: &[f64], b: &[f64]) -> f64 {
        let delta = |i: usize| self.shortest(i, a[i] - b[i]).abs() / self.span(i, a[i]);
        (0..self.joints.len()).fold(0.0, |farthest, i| f64::max(farthest, delta(i)))
    }

    /// Whether joint values differ by at most `tolerance`, the joints of a set left out.
    pub(crate) fn is_close(&self, a: &[f64], b: &[f64], left_out: u32, tolerance: f64) -> bool {
        let is_close = |i: usize| self.shortest(i, a[i] - b[i]).abs() <= tolerance * self.span(i, a[i]);
        (0..self.joints.len()).all(|i| is_in(left_out, i) || is_close(i))
    }

    /// The largest movement of a joint in a step: an angle, or relative to the length scale.
    pub(crate) fn longest(&self, step: &[f64]) -> f64 {
        let delta = |i: usize| if self.joints[i].is_angle() { step[i].abs() } else { step[i].abs() / self.scale };
        (0..self.joints.len()).fold(0.0, |longest, i| f64::max(longest, delta(i)))
    }
}

/// `a - b` joint by joint, angles reduced to (-pi, pi].
pub(crate) fn differences<M: Mechanism>(facts: &Facts<'_>, a: &Joints<M>, b: &Joints<M>) -> Joints<M> {
    Array::by(facts.joints.len(), |i| facts.shortest(i, a.as_ref()[i] - b.as_ref()[i]))
}

/// `q - step`, angles in (-pi, pi].
pub(crate) fn stepped<M: Mechanism>(facts: &Facts<'_>, q: &Joints<M>, step: &Joints<M>) -> Joints<M> {
    Array::by(facts.joints.len(), |i| facts.wrapped(i, q.as_ref()[i] - step.as_ref()[i]))
}

/// `q + delta`, angles in (-pi, pi].
pub(crate) fn shifted<M: Mechanism>(facts: &Facts<'_>, q: &Joints<M>, delta: &Joints<M>) -> Joints<M> {
    Array::by(facts.joints.len(), |i| facts.wrapped(i, q.as_ref()[i] + delta.as_ref()[i]))
}

/// `q` with one joint moved: an angle by `delta`, a length by `delta` times its magnitude.
pub(crate) fn moved<M: Mechanism>(facts: &Facts<'_>, q: &Joints<M>, joint: usize, delta: f64) -> Joints<M> {
    let (mut next, value) = (q.clone(), q.as_ref()[joint]);
    next.as_mut()[joint] = facts.wrapped(joint, value + delta * facts.span(joint, value));
    next
}

/// Linear extrapolation from `a` through `b`, by `ahead` times their distance.
pub(crate) fn beyond<M: Mechanism>(facts: &Facts<'_>, a: &Joints<M>, b: &Joints<M>, ahead: f64) -> Joints<M> {
    let delta = differences::<M>(facts, b, a);
    Array::by(facts.joints.len(), |i| b.as_ref()[i] + ahead * delta.as_ref()[i])
}

/// The numbers that the equations read of joint values. `like` provides the numbers that follow from no joint.
pub(crate) fn place<M: Mechanism>(facts: &Facts<'_>, q: &Joints<M>, like: Option<&Places<M>>) -> Places<M> {
    let mut at: Places<M> = like.cloned().unwrap_or_else(|| Array::by(facts.places, |_| 0.0));
    for (joint, value) in facts.joints.iter().zip(q.as_ref()) {
        match *joint {
            Joint::Angle([c, s]) => [at.as_mut()[c], at.as_mut()[s]] = cosine_and_sine(*value),
            Joint::Length(place) => at.as_mut()[place] = *value,
        }
    }
    at
}
