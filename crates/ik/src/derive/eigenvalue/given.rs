//! Six joints with given joints before, after and between them.
//!
//! The motions of given joints at the ends are removed from the target. `E1 E2 .. E7 M = T` with known E1 is `E2 .. E7 M = E1^-1 T`. With known E7 it is
//! `E1 .. E6 M = T (M^-1 E7^-1 M)`. A given joint between the others moves the axes after it at run time ([`groebot_runtime::six_axes::Given`]). So one
//! eigenvalue problem solves the six joints, for all given values.

use groebot_runtime::six_axes;

use super::line;
use crate::derive::equations::assemble::Assembler;
use crate::solver::Operand;
use crate::solver::eigenvalue::GivenLine;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{Chain, JointKind, Task};
use groebot_robot::spatial::{Axis, Screw};
use nalgebra::{Matrix3, Vector3};

/// The six joints that are found together, and the given ones.
pub(super) struct Six {
    /// The chain of the six joints, with the given joints at zero.
    pub chain: Chain,
    /// The index of each of the six joints in the whole chain.
    pub places: [usize; 6],
    /// The given joints between the six, from base to tip.
    pub between: Vec<Between>,
    /// The indices of the given joints before the six, and of those after them, ascending.
    ends: [Vec<usize>; 2],
}

/// A given joint between the six.
pub(super) struct Between {
    /// Its index in the whole chain.
    pub place: usize,
    /// Its exact axis.
    pub joint: groebot_robot::kinematics::Joint,
    /// Its axis.
    pub line: GivenLine,
}

impl Six {
    /// The six joints of `chain`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a task other than a pose, another number of joints that are not given, or more than eight given ones between them.
    pub fn of(chain: &Chain) -> Result<Six> {
        let given = chain.given();
        let unknown: Vec<usize> = (0..chain.joints().len()).filter(|joint| !given.contains(joint)).collect();
        let unsupported = |text: &str| Error::new(ErrorKind::Unsupported, text);
        let six: std::result::Result<[usize; 6], _> = unknown.try_into();
        let Some(places) = six.ok().filter(|_| chain.task() == Task::Pose) else {
            return Err(unsupported("the eigenvalue problem needs a pose and six joints; all others must be given"));
        };
        let (before, rest): (Vec<usize>, Vec<usize>) = given.into_iter().partition(|&joint| joint < places[0]);
        let (between, after): (Vec<usize>, Vec<usize>) = rest.into_iter().partition(|&joint| joint < places[5]);
        if between.len() > six_axes::Given::ROOM {
            return Err(unsupported("the eigenvalue problem allows at most 8 given joints between the six others"));
        }
        let between = between.into_iter().map(|place| Between::new(chain, place, &places)).collect();
        let mut parts = chain.parts().clone();
        parts.joints = places.iter().map(|&joint| parts.joints[joint].clone()).collect();
        parts.given.clear();
        Ok(Six { chain: Chain::new(parts)?, places, between, ends: [before, after] })
    }

    /// The target of the six joints: position, then rotation by rows.
    ///
    /// `target` contains the numbers of the whole chain's target. `value` returns the value of a given joint of `chain`: its cosine and sine, or its length.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for values of another type.
    pub fn target(
        &self,
        chain: &Chain,
        target: [Operand; 12],
        value: impl Fn(usize) -> Vec<Operand>,
        assembler: &mut Assembler,
    ) -> Result<[Operand; 12]> {
        let mut six = Motion {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| target[3 + 3 * i + j])),
            translation: [target[0], target[1], target[2]],
        };
        let [before, after] = &self.ends;
        for (&joint, is_before) in
            before.iter().map(|joint| (joint, true)).chain(after.iter().rev().map(|joint| (joint, false)))
        {
            let screw = chain.screws()[joint];
            let back =
                if is_before { Back::of(&screw) } else { Back::of(&screw.moved(&chain.base_from_tip().inverse())) };
            let Some(motion) = back.motion(&value(joint), assembler) else {
                return Err(Error::new(ErrorKind::Unsupported, "the value of a given joint has another type"));
            };
            six = if is_before { motion.times(&six, assembler) } else { six.times(&motion, assembler) };
        }
        let rows = six.rotation.concat();
        Ok(std::array::from_fn(|i| if i < 3 { six.translation[i] } else { rows[i - 3] }))
    }
}

impl Between {
    fn new(chain: &Chain, place: usize, places: &[usize; 6]) -> Self {
        let joint = chain.joints()[place].clone();
        let before = places.iter().filter(|&&other| other < place).count();
        let line = GivenLine { before, line: line(chain, place), slides: joint.kind == JointKind::Prismatic };
        Between { place, joint, line }
    }

    /// The operands of its value: cosine and sine, or its displacement and zero.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a value of another type.
    pub fn value(&self, value: &[Operand]) -> Result<[Operand; 2]> {
        match (value, self.line.slides) {
            ([cosine, sine], false) => Ok([*cosine, *sine]),
            ([length], true) => Ok([*length, Operand::Constant(0.0)]),
            _ => Err(Error::new(ErrorKind::Unsupported, "the value of a given joint has another type")),
        }
    }
}

/// The inverse motion of a joint: constants, coefficients of its cosine (or length), and coefficients of its sine.
struct Back {
    rotation: [Matrix3<f64>; 3],
    translation: [Vector3<f64>; 3],
    turns: bool,
}

impl Back {
    fn of(screw: &Screw) -> Back {
        match screw {
            Screw::Revolute(axis) => Back::turn(axis),
            Screw::Prismatic(direction) => Back {
                rotation: [Matrix3::identity(), Matrix3::zeros(), Matrix3::zeros()],
                translation: [Vector3::zeros(), -direction.into_inner(), Vector3::zeros()],
                turns: false,
            },
        }
    }

    /// Rodrigues' formula for the angle -q: `w w^T + (I - w w^T) cos q - [w] sin q`.
    fn turn(axis: &Axis) -> Back {
        let w = axis.direction();
        let along = w.into_inner() * w.transpose();
        let rotation = [along, Matrix3::identity() - along, -w.cross_matrix()];
        let point = axis.point().coords;
        let moved = |k: usize| if k == 0 { point - rotation[0] * point } else { -(rotation[k] * point) };
        Back { translation: [moved(0), moved(1), moved(2)], rotation, turns: true }
    }

    fn motion(&self, value: &[Operand], assembler: &mut Assembler) -> Option<Motion> {
        let zero = Operand::Constant(0.0);
        let values = match (value, self.turns) {
            ([cosine, sine], true) => [*cosine, *sine],
            ([length], false) => [*length, zero],
            _ => return None,
        };
        let mut sum = |parts: [f64; 3]| {
            let terms = [(parts[1], values[0]), (parts[2], values[1])];
            terms.into_iter().fold(Operand::Constant(parts[0]), |sum, (factor, value)| {
                let term = assembler.mul(Operand::Constant(factor), value);
                assembler.add(sum, term)
            })
        };
        Some(Motion {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| sum([0, 1, 2].map(|k| self.rotation[k][(i, j)])))),
            translation: [0, 1, 2].map(|i| sum([0, 1, 2].map(|k| self.translation[k][i]))),
        })
    }
}

/// A rigid motion whose entries are operands.
struct Motion {
    rotation: [[Operand; 3]; 3],
    translation: [Operand; 3],
}

impl Motion {
    fn times(&self, other: &Motion, assembler: &mut Assembler) -> Motion {
        let mut dot = |row: [Operand; 3], column: [Operand; 3], start: Operand| {
            row.into_iter().zip(column).fold(start, |sum, (a, b)| {
                let term = assembler.mul(a, b);
                assembler.add(sum, term)
            })
        };
        let zero = Operand::Constant(0.0);
        let column = |j: usize| [0, 1, 2].map(|i| other.rotation[i][j]);
        Motion {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(self.rotation[i], column(j), zero))),
            translation: [0, 1, 2].map(|i| dot(self.rotation[i], other.translation, self.translation[i])),
        }
    }
}
