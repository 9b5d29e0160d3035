//! How far answers are from one another, and whether two next to each other are one.

use super::angle::wrap;
use super::answers::{Answer, Answers};
use super::joint::JointValue;
use super::refine::{self, NONE_FREE, difference};
use super::{ALIKE, BLUR, DISTINCT, MAX_JOINTS, ROUNDING};
use crate::kinematics::Solution;

impl Answers<'_> {
    /// The farthest that a joint is moved from `a` to `b`: an angle, or a share of a length's size.
    pub(super) fn way(&self, a: &[f64], b: &[f64]) -> f64 {
        let way = |joint: usize| difference(self.program, joint, a, b).abs() / self.size(joint, a[joint]);
        (0..self.program.joints.len()).map(way).fold(0.0, f64::max)
    }

    /// What a joint's differences are shares of: one for an angle, a length's size.
    pub(super) fn size(&self, joint: usize, value: f64) -> f64 {
        match self.program.joints[joint].value {
            JointValue::Angle { .. } => 1.0,
            JointValue::Plain(_) => self.program.scale.max(value.abs()),
        }
    }

    /// The value of a joint moved by `way`: an angle by that, a length by that share of its size.
    pub(super) fn displaced(&self, value: f64, joint: usize, way: f64) -> f64 {
        let moved = value + way * self.size(joint, value);
        match self.program.joints[joint].value {
            JointValue::Angle { .. } => wrap(moved),
            JointValue::Plain(_) => moved,
        }
    }

    pub(super) fn are_near(&self, a: &[f64], b: &[f64], tolerance: f64) -> bool {
        (0..self.program.joints.len()).all(|joint| self.is_near(joint, a, b, tolerance))
    }

    pub(super) fn close(&self, a: &Solution, b: &Solution, tolerance: f64) -> bool {
        let left_out = |joint: usize| a.free.contains(&joint) || b.free.contains(&joint);
        (0..a.q.len()).all(|joint| left_out(joint) || self.is_near(joint, &a.q, &b.q, tolerance))
    }

    fn is_near(&self, joint: usize, a: &[f64], b: &[f64], tolerance: f64) -> bool {
        difference(self.program, joint, a, b).abs() <= tolerance * self.size(joint, a[joint])
    }

    /// Whether two answers next to each other are one at a singular configuration, where the equations leave the joints open beyond
    /// [`MERGE`]: they hold half-way too, as well as at the worse of the two.
    pub(super) fn blurred(&mut self, other: usize, answer: &Answer) -> bool {
        let bound = self.list[other].relative.max(answer.relative).max(ALIKE);
        let q = self.list[other].solution.q.clone();
        if bound <= ROUNDING && self.way(&q, &answer.solution.q) <= BLUR && self.is_distinct(&answer.solution.q) {
            return false;
        }
        self.are_joined(&q, &answer.solution.q, bound, &NONE_FREE)
    }

    /// Whether joints that solve the equations are far from singular.
    fn is_distinct(&mut self, joints: &[f64]) -> bool {
        let mut q = [0.0; MAX_JOINTS];
        q[..joints.len()].copy_from_slice(joints);
        refine::regularity(self.program, &q, &mut self.frame) > DISTINCT
    }

    /// Whether the equations hold half-way between two places next to each other, on a way that may be bent, within `bound`.
    pub(super) fn are_joined(&mut self, a: &[f64], b: &[f64], bound: f64, held: &[bool; MAX_JOINTS]) -> bool {
        if self.way(a, b) > BLUR {
            return false;
        }
        let mut middle = [0.0; MAX_JOINTS];
        for (joint, slot) in middle.iter_mut().enumerate().take(b.len()) {
            *slot = b[joint] + 0.5 * difference(self.program, joint, a, b);
        }
        refine::nearly_holds(self.program, &middle, bound, held, &mut self.frame)
    }
}
