//! A chain with its known joints absorbed: the loop that the screw solver reduces step by step.
//!
//! The joints that are still unknown satisfy `e^(S1 q1) ... e^(Sm qm) = T` (a pose), or this product applied to a
//! point. A joint that becomes known is moved to the nearer end of the product, where it changes the goal. The screws
//! that it passes are transformed: `g e^S = e^(g S) g`.

use std::borrow::Cow;

use nalgebra::Point3;
use smallvec::SmallVec;

use super::values::Reach;
use crate::spatial::{Half, Pose, Screw};

/// Tolerance of a step's target out of reach, relative to the size of its subproblem. Rounding errors of the joints
/// solved before add up, and a described robot differs from the ideal one by up to 1e-6. Forward kinematics checks
/// every solution at the end.
pub(super) const LOOSE: f64 = 1e-5;

/// An unknown joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    /// Its index in the chain, from 0.
    pub joint: usize,
    /// Its screw in the reduced chain.
    pub screw: Screw,
}

/// Consecutive joints.
pub(super) type Row = SmallVec<[Member; 6]>;

/// The required product of the unknown joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// The product is this rigid transform.
    Pose(Pose),
    /// The product moves `from` to `to`.
    Point {
        /// The tip, with all unknown joints at zero.
        from: Point3<f64>,
        /// The target point.
        to: Point3<f64>,
    },
}

/// The unknown joints in their order, and their goal.
#[derive(Debug, PartialEq)]
pub(super) struct Reduced {
    pub row: Row,
    pub goal: Goal,
    /// Tolerance of steps whose targets are out of reach.
    pub loose: Reach,
}

impl Clone for Reduced {
    /// Copies the row as a block of memory, which a small vector's own `clone` does not.
    fn clone(&self) -> Self {
        Reduced { row: Row::from_slice(&self.row), goal: self.goal, loose: self.loose }
    }
}

impl Reduced {
    /// Absorbs the joint at `place` with the known value `q`.
    pub fn absorb(&mut self, place: usize, q: Half) {
        let motion = self.row[place].screw.exp_half(q);
        let after = self.row.len() - 1 - place;
        self.row.remove(place);
        match (&mut self.goal, place <= after) {
            (Goal::Pose(pose), true) => *pose = motion.inverse() * *pose,
            (Goal::Point { to, .. }, true) => *to = motion.inverse_transform_point(to),
            (Goal::Pose(pose), false) => *pose *= motion.inverse(),
            (Goal::Point { from, .. }, false) => *from = motion * *from,
        }
        if place <= after {
            let back = motion.inverse();
            self.row[..place].iter_mut().for_each(|member| member.screw = member.screw.moved(&back));
        } else {
            self.row[place..].iter_mut().for_each(|member| member.screw = member.screw.moved(&motion));
        }
    }

    /// The position in the row of the chain's joint `joint`.
    pub fn place(&self, joint: usize) -> Option<usize> {
        self.row.iter().position(|member| member.joint == joint)
    }

    /// The loop cut at another position, so that the joints up to `end` come last. With the pose T as goal, the joints
    /// from `end` on come first, transformed by T, and the goal is T again.
    pub fn cut_at(&self, end: usize) -> Cow<'_, [Member]> {
        match self.goal {
            Goal::Pose(pose) if end < self.row.len() => {
                let carried = |member: &Member| Member { screw: member.screw.moved(&pose), ..*member };
                self.row[end..].iter().map(carried).chain(self.row[..end].iter().copied()).collect()
            }
            _ => Cow::Borrowed(&self.row),
        }
    }

    /// The index in the chain of the joint at `place` of the row cut at `end`.
    pub fn joint_at(&self, end: usize, place: usize) -> usize {
        self.row[(end + place) % self.row.len()].joint
    }
}
