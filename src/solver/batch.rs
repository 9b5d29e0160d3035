//! Many targets at once, on all processors: [`Program::solve_batch`].

use rayon::prelude::*;

use super::program::Program;
use crate::kinematics::Solution;
use crate::{Error, ErrorKind, Result};

/// So many targets are one piece of work.
const PIECE: usize = 64;

/// The answers for many targets, as arrays: entry `i` of each array belongs to the same answer. The answers for one target stand
/// together, by branch, and targets follow one another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    /// Where each target's answers begin, and behind the last target the number of all answers: one number more than targets.
    starts: Vec<usize>,
    /// By joint, the values of all answers.
    joints: Vec<Vec<f64>>,
    residuals: Vec<f64>,
    branches: Vec<usize>,
    /// By answer: bit `j` is set where joint `j` is free.
    free: Vec<u32>,
    refused: Vec<(usize, Error)>,
}

impl Batch {
    /// The number of targets.
    pub fn targets(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The number of all answers.
    pub fn answers(&self) -> usize {
        self.residuals.len()
    }

    /// The entries of the arrays that are answers for the target with this index.
    ///
    /// # Panics
    /// For an index that is not below [`Batch::targets`].
    pub fn of_target(&self, index: usize) -> std::ops::Range<usize> {
        self.starts[index]..self.starts[index + 1]
    }

    /// The values of one joint: radians in (-pi, pi], or lengths in the program's unit.
    ///
    /// # Panics
    /// For an index that is no joint's.
    pub fn joint(&self, index: usize) -> &[f64] {
        &self.joints[index]
    }

    /// The residuals ([`Solution::residual`]).
    pub fn residuals(&self) -> &[f64] {
        &self.residuals
    }

    /// The branches ([`Solution::branch`]).
    pub fn branches(&self) -> &[usize] {
        &self.branches
    }

    /// By answer: bit `j` is set where joint `j` may take any value.
    pub fn free(&self) -> &[u32] {
        &self.free
    }

    /// The targets that are none, each with its index and the reason; they have no answers.
    pub fn refused(&self) -> &[(usize, Error)] {
        &self.refused
    }

    fn push(&mut self, answer: &Solution) {
        for (column, value) in self.joints.iter_mut().zip(&answer.q) {
            column.push(*value);
        }
        self.residuals.push(answer.residual);
        self.branches.push(answer.branch);
        self.free.push(answer.free.iter().fold(0, |bits, joint| bits | 1 << joint));
    }
}

impl Program {
    /// All real solutions for many targets: `targets` holds those of one after those of another, each as [`Program::solve_numbers`] takes it.
    ///
    /// The work is shared among rayon's threads. The answers are those of [`Program::solve_numbers`], whatever their number.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the count of numbers is no multiple of the inputs'. Targets that [`Program::solve_numbers`] refuses are
    /// told by [`Batch::refused`].
    pub fn solve_batch(&self, targets: &[f64]) -> Result<Batch> {
        let inputs = self.inputs.len();
        if inputs == 0 || !targets.len().is_multiple_of(inputs) {
            let text = format!("{} numbers are no targets of {inputs} each", targets.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let pieces: Vec<Vec<Result<Vec<Solution>>>> = targets
            .par_chunks(PIECE * inputs)
            .map(|piece| piece.chunks(inputs).map(|target| self.solve_numbers(target)).collect())
            .collect();
        let mut batch = Batch { joints: vec![Vec::new(); self.joints.len()], ..Batch::default() };
        for (index, solved) in pieces.into_iter().flatten().enumerate() {
            batch.starts.push(batch.answers());
            match solved {
                Ok(answers) => answers.iter().for_each(|answer| batch.push(answer)),
                Err(error) => batch.refused.push((index, error)),
            }
        }
        batch.starts.push(batch.answers());
        Ok(batch)
    }
}
