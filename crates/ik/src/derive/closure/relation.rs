//! Invariants of rigid motions as equations of the loop: [`Relation`].
//!
//! The loop E1 ... En G^-1 = 1 is cut as run . A . tail . B = 1. Let the object a be invariant under the run, and b under the tail. Then measure(a, A b) =
//! measure(a, B^-1 b), which contains neither run nor tail. RH0 (2-14) and (2-15) are the cases of points.

use std::fmt;

use num_traits::Zero;
use serde::{Deserialize, Serialize};

use super::vector;
use groebot_robot::kinematics::{ExactVector, exact_serde};

/// A motion in a word. Joints are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Letter {
    /// E: the motion of a joint.
    Joint(usize),
    /// E^-1.
    Inverse(usize),
    /// G = T M^-1: the motion of the last body from the zero configuration to the target.
    Target,
    /// G^-1.
    TargetInverse,
}

impl Letter {
    /// The index of its joint.
    pub fn joint(self) -> Option<usize> {
        match self {
            Letter::Joint(joint) | Letter::Inverse(joint) => Some(joint),
            Letter::Target | Letter::TargetInverse => None,
        }
    }

    /// The inverse motion.
    #[must_use]
    pub fn inverse(self) -> Self {
        match self {
            Letter::Joint(joint) => Letter::Inverse(joint),
            Letter::Inverse(joint) => Letter::Joint(joint),
            Letter::Target => Letter::TargetInverse,
            Letter::TargetInverse => Letter::Target,
        }
    }
}

/// A product of motions; the last letter acts first.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Word(pub Vec<Letter>);

/// An object to which motions are applied, in the base frame in the zero configuration.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Object {
    /// A point.
    Point(#[serde(with = "exact_serde::vector")] ExactVector),
    /// A direction, of any length.
    Direction(#[serde(with = "exact_serde::vector")] ExactVector),
    /// A line through a point along a direction. For [`Measure::Offset`], the plane through the point with this normal.
    Line {
        /// A point of the line.
        #[serde(with = "exact_serde::vector")]
        point: ExactVector,
        /// The direction of the line.
        #[serde(with = "exact_serde::vector")]
        direction: ExactVector,
    },
}

/// An invariant of two objects: it does not change if one rigid motion moves both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// a.x of two directions.
    Angle,
    /// a.x of a fixed direction a and a moved point x. Or (a - x).v of a fixed point a and the moved plane through x with normal v.
    Offset,
    /// |a - x|^2 of two points.
    Distance,
    /// (a - x).(v x w) of two lines: the fixed one through a along w, the moved one through x along v.
    Moment,
    /// An unknown of a joint that follows another one, and its value by the law. The words are the follower and the leader. Both objects are the coordinate
    /// axis whose index is that of the unknown: c, s', d'.
    Follow,
}

/// The equation `measure(fixed, left moved) - measure(fixed, right moved) = 0`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Relation {
    /// The invariant.
    pub measure: Measure,
    /// The object that is invariant under the run.
    pub fixed: Object,
    /// The object that is invariant under the tail.
    pub moved: Object,
    /// A, the arc from the run to the tail.
    pub left: Word,
    /// B^-1, the other arc of the loop.
    pub right: Word,
}

impl Relation {
    /// The relations by which the joint `follower` follows `leader`: of c and s' for revolute joints, otherwise of d'.
    pub(super) fn following(follower: usize, leader: usize, turns: bool) -> Vec<Relation> {
        let unknown = |axis: usize| Relation {
            measure: Measure::Follow,
            fixed: Object::Direction(vector::unit(axis)),
            moved: Object::Direction(vector::unit(axis)),
            left: Word(vec![Letter::Joint(follower)]),
            right: Word(vec![Letter::Joint(leader)]),
        };
        let unknowns: &[usize] = if turns { &[0, 1] } else { &[2] };
        unknowns.iter().map(|&axis| unknown(axis)).collect()
    }

    /// For a joint that follows another one: its index, its leader, and the index of the unknown. 0 and 1 are c and s', 2 is d'.
    pub(crate) fn followed(&self) -> Option<[usize; 3]> {
        let (Measure::Follow, Object::Direction(axis)) = (self.measure, &self.fixed) else { return None };
        let [follower, leader] = [&self.left, &self.right].map(|word| word.0.first().and_then(|letter| letter.joint()));
        Some([follower?, leader?, axis.iter().position(|entry| !entry.is_zero())?])
    }

    /// The indices of the joints that occur, ascending.
    pub fn joints(&self) -> Vec<usize> {
        let mut joints: Vec<usize> =
            self.left.0.iter().chain(&self.right.0).filter_map(|letter| letter.joint()).collect();
        joints.sort_unstable();
        joints.dedup();
        joints
    }

    /// Whether the target occurs.
    pub(crate) fn has_target(&self) -> bool {
        self.left.0.iter().chain(&self.right.0).any(|letter| letter.joint().is_none())
    }
}

/// `E3`, `E3^-1`, `G`, `G^-1`: joints are counted from 1.
impl fmt::Display for Letter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Letter::Joint(joint) => write!(f, "E{}", joint + 1),
            Letter::Inverse(joint) => write!(f, "E{}^-1", joint + 1),
            Letter::Target => f.write_str("G"),
            Letter::TargetInverse => f.write_str("G^-1"),
        }
    }
}

/// The letters, separated by spaces; empty for the empty word.
impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters: Vec<String> = self.0.iter().map(Letter::to_string).collect();
        f.write_str(&letters.join(" "))
    }
}
