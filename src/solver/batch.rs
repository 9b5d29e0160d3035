//! Many targets at once, on all processors: [`Solver::solve_batch`].

use groebot_runtime as runtime;
use groebot_runtime::mechanism::Inputs;
use groebot_runtime::storage::Array;
use groebot_runtime::{Mechanism, Solve};
use rayon::prelude::*;

use super::Solver;
#[cfg(doc)]
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

    fn push(&mut self, answer: &runtime::Solution<Solver>) {
        for (column, value) in self.joints.iter_mut().zip(answer.q.as_ref()) {
            column.push(*value);
        }
        self.residuals.push(answer.residual);
        self.branches.push(answer.branch);
        self.free.push(answer.free);
    }
}

/// The answers of a piece, target by target, and how many each has.
type Piece = (Vec<runtime::Solution<Solver>>, Vec<std::result::Result<usize, runtime::Error>>);

impl Solver {
    /// All real solutions for many targets: `targets` holds those of one after those of another, each as [`Solver::solve_numbers`] takes it.
    ///
    /// The work is shared among rayon's threads. The answers are those of [`Solver::solve_numbers`], whatever their number.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the count of numbers is no multiple of the inputs'. Targets that [`Solver::solve_numbers`] refuses are
    /// told by [`Batch::refused`].
    pub fn solve_batch(&self, targets: &[f64]) -> Result<Batch> {
        let (inputs, joints) = (self.facts().inputs, self.facts().joints.len());
        if inputs == 0 || !targets.len().is_multiple_of(inputs) {
            let text = format!("{} numbers are no targets of {inputs} each", targets.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let pieces: Vec<Piece> = targets.par_chunks(PIECE * inputs).map(|piece| self.piece(piece, inputs)).collect();
        let mut batch = Batch { joints: vec![Vec::new(); joints], ..Batch::default() };
        let (mut index, mut numbers) = (0, targets.chunks(inputs));
        for (answers, counts) in pieces {
            let mut answers = answers.iter();
            for count in counts {
                batch.starts.push(batch.answers());
                let target = numbers.next().unwrap_or_default();
                match count {
                    Ok(count) => answers.by_ref().take(count).for_each(|answer| batch.push(answer)),
                    Err(error) => batch.refused.push((index, self.refused(target, error))),
                }
                index += 1;
            }
        }
        batch.starts.push(batch.answers());
        Ok(batch)
    }

    fn piece(&self, targets: &[f64], inputs: usize) -> Piece {
        let rows: Vec<Inputs<Self>> = targets.chunks(inputs).map(|row| Array::by(inputs, |i| row[i])).collect();
        let mut out = self.room(rows.len());
        let mut counts = vec![Ok(0); rows.len()];
        Solve::solve_batch(self, &rows, &mut out, &mut counts);
        (out, counts)
    }
}
