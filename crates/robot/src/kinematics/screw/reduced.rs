//! A chain whose known joints are absorbed: the loop that the screw solver makes smaller step by step.
//!
//! The joints that are still unknown satisfy `e^(S1 q1) ... e^(Sm qm) = T` (a pose), or the same applied to a point. A
//! joint that becomes known is moved to the nearer end of the product, where it changes the goal; the screws that it
//! passes are carried along: `g e^S = e^(g S) g`.

use std::borrow::Cow;

use nalgebra::Point3;
use smallvec::SmallVec;

use super::values::Reach;
use crate::spatial::{Half, Pose, Screw};

/// How far a step lets its target be out of reach, relative to the size of its subproblem: rounding in the joints solved
/// before adds up, a robot as described is off the ideal one by up to 1e-6, and forward kinematics judges every answer in the end.
pub(super) const LOOSE: f64 = 1e-5;

/// A joint that is still unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    /// Its index in the chain, from 0.
    pub joint: usize,
    /// Its screw in the reduced chain.
    pub screw: Screw,
}

/// Joints in a row.
pub(super) type Row = SmallVec<[Member; 6]>;

/// What the product of the unknown joints must do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// The product is this rigid transform.
    Pose(Pose),
    /// The product takes `from` to `to`.
    Point {
        /// The tip, all unknown joints at zero.
        from: Point3<f64>,
        /// Where it belongs.
        to: Point3<f64>,
    },
}

/// The unknown joints in their order, and their goal.
#[derive(Debug, PartialEq)]
pub(super) struct Reduced {
    pub row: Row,
    pub goal: Goal,
    /// How far steps let their targets be out of reach.
    pub loose: Reach,
}

impl Clone for Reduced {
    /// Copies the row as a whole, which a small vector's own `clone` does not.
    fn clone(&self) -> Self {
        Reduced { row: Row::from_slice(&self.row), goal: self.goal, loose: self.loose }
    }
}

impl Reduced {
    /// The loop with the joint at `place` known to be at `q`.
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

    /// Where the chain's joint number `joint` stands in the row.
    pub fn place(&self, joint: usize) -> Option<usize> {
        self.row.iter().position(|member| member.joint == joint)
    }

    /// The same loop cut elsewhere, so that the joints up to `end` come last: with the pose T as goal, the joints from
    /// `end` on come first, carried by T, and the goal stays T.
    pub fn cut_at(&self, end: usize) -> Cow<'_, [Member]> {
        match self.goal {
            Goal::Pose(pose) if end < self.row.len() => {
                let carried = |member: &Member| Member { screw: member.screw.moved(&pose), ..*member };
                self.row[end..].iter().map(carried).chain(self.row[..end].iter().copied()).collect()
            }
            _ => Cow::Borrowed(&self.row),
        }
    }

    /// The number, in the chain, of the joint at `place` of the row that is cut at `end`.
    pub fn joint_at(&self, end: usize, place: usize) -> usize {
        self.row[(end + place) % self.row.len()].joint
    }
}
