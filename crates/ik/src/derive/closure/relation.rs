//! Invariants of rigid motions as equations of the loop: [`Relation`].
//!
//! The loop E1 ... En G^-1 = 1 is cut as run . A . tail . B = 1. What the run leaves in place (a) and what the tail leaves in place (b)
//! give measure(a, A b) = measure(a, B^-1 b), where neither run nor tail occurs: RH0 (2-14) and (2-15) are the cases of points.

use std::fmt;

use num_traits::Zero;
use serde::{Deserialize, Serialize};

use super::vector;
use groebot_robot::kinematics::{ExactVector, exact_serde};

/// A motion that a word is made of. Joints are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Letter {
    /// E: the motion of a joint.
    Joint(usize),
    /// E^-1.
    Inverse(usize),
    /// G = T M^-1: the motion of the last body from zero to the target.
    Target,
    /// G^-1.
    TargetInverse,
}

impl Letter {
    /// The place of its joint.
    pub fn joint(self) -> Option<usize> {
        match self {
            Letter::Joint(joint) | Letter::Inverse(joint) => Some(joint),
            Letter::Target | Letter::TargetInverse => None,
        }
    }

    /// The opposite motion.
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

/// What a motion is applied to, in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Object {
    /// A point.
    Point(#[serde(with = "exact_serde::vector")] ExactVector),
    /// A direction, of any length.
    Direction(#[serde(with = "exact_serde::vector")] ExactVector),
    /// A line through a point along a direction; for [`Measure::Offset`] the plane through the point normal to it.
    Line {
        /// A point of it.
        #[serde(with = "exact_serde::vector")]
        point: ExactVector,
        /// Its direction.
        #[serde(with = "exact_serde::vector")]
        direction: ExactVector,
    },
}

/// An invariant of two objects: it stays when both are moved alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// a.x of two directions.
    Angle,
    /// a.x of a fixed direction a and a moved point x; or (a - x).v of a fixed point a and the moved plane through x normal to v.
    Offset,
    /// |a - x|^2 of two points.
    Distance,
    /// (a - x).(v x w) of two lines: through a along w, moved: through x along v.
    Moment,
    /// An unknown of a joint that follows another one, and its value by the law that it follows. The words are the follower and the leader, both
    /// objects the coordinate axis whose number is that of the unknown: c, s', d'.
    Follow,
}

/// The equation `measure(fixed, left moved) - measure(fixed, right moved) = 0`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Relation {
    /// What is measured.
    pub measure: Measure,
    /// What the run leaves in place.
    pub fixed: Object,
    /// What the tail leaves in place.
    pub moved: Object,
    /// A, the arc from the run to the tail.
    pub left: Word,
    /// B^-1, the other way round the loop.
    pub right: Word,
}

impl Relation {
    /// The relations by which the joint `follower` follows `leader`: of c and s' where they turn, else of d'.
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

    /// Of a relation of a joint that follows another one: that joint, its leader, and the number of the unknown, 0 and 1 for c and s', 2 for d'.
    pub fn followed(&self) -> Option<[usize; 3]> {
        let (Measure::Follow, Object::Direction(axis)) = (self.measure, &self.fixed) else { return None };
        let [follower, leader] = [&self.left, &self.right].map(|word| word.0.first().and_then(|letter| letter.joint()));
        Some([follower?, leader?, axis.iter().position(|entry| !entry.is_zero())?])
    }

    /// The places of the joints that occur, ascending.
    pub fn joints(&self) -> Vec<usize> {
        let mut joints: Vec<usize> =
            self.left.0.iter().chain(&self.right.0).filter_map(|letter| letter.joint()).collect();
        joints.sort_unstable();
        joints.dedup();
        joints
    }

    /// Whether the target occurs.
    pub fn has_target(&self) -> bool {
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

/// The letters with blanks between them; nothing for the empty word.
impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters: Vec<String> = self.0.iter().map(Letter::to_string).collect();
        f.write_str(&letters.join(" "))
    }
}
