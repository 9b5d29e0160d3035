//! Six joints with given joints before or after them: the motions of the given joints are removed from the target.
//!
//! `E1 E2 .. E7 M = T` with known E1 is `E2 .. E7 M = E1^-1 T`. With known E7 it is `E1 .. E6 M = T (M^-1 E7^-1 M)`. So one eigenvalue problem solves the six
//! joints in between, for all given values.

use crate::derive::equations::assemble::Assembler;
use crate::solver::Operand;
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{Chain, Task};
use groebot_robot::spatial::{Axis, Screw};
use nalgebra::{Matrix3, Vector3};

/// The six joints that are found together, and the given ones.
pub(super) struct Six {
    /// The chain of the six joints, with the given joints at zero.
    pub chain: Chain,
    /// The number of given joints before the six.
    before: usize,
    /// The indices of the given joints, ascending.
    given: Vec<usize>,
}

impl Six {
    /// The six joints of `chain`.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a task other than a pose, another number of joints, or a given joint between others.
    pub fn of(chain: &Chain) -> Result<Six> {
        let given = chain.given();
        let unknown: Vec<usize> = (0..chain.joints().len()).filter(|joint| !given.contains(joint)).collect();
        let is_row = unknown.windows(2).all(|pair| pair[1] == pair[0] + 1);
        if chain.task() != Task::Pose || unknown.len() != 6 || !is_row {
            let text = "the eigenvalue problem needs a pose and six consecutive joints; all joints before and after them must be given";
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        let mut parts = chain.parts().clone();
        parts.joints = unknown.iter().map(|&joint| parts.joints[joint].clone()).collect();
        parts.given.clear();
        Ok(Six { chain: Chain::new(parts)?, before: unknown[0], given })
    }

    /// The index of each of the six joints in the whole chain.
    pub fn places(&self) -> [usize; 6] {
        std::array::from_fn(|place| self.before + place)
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
        let (before, after) = self.given.split_at(self.before);
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
