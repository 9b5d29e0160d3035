//! Many targets at once, on all processors: [`Solver::solve_batch`].

use groebot_runtime as runtime;
use groebot_runtime::mechanism::Inputs;
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::{Mechanism, Solve};
use rayon::prelude::*;

#[cfg(doc)]
use super::Solver;
use super::shaped::Shaped;
use crate::{Error, ErrorKind, Result};
#[cfg(doc)]
use groebot_robot::kinematics::Solution;

/// The number of targets in one piece of work.
const PIECE: usize = 64;

/// The solutions of many targets, as arrays: entry `i` of each array belongs to the same solution. The solutions of one
/// target are consecutive, by branch, and targets follow one another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    /// The index of each target's first solution, and after the last target the number of all solutions: one number
    /// more than targets.
    starts: Vec<usize>,
    /// By joint, the values of all solutions.
    joints: Vec<Vec<f64>>,
    residuals: Vec<f64>,
    branches: Vec<usize>,
    /// By solution, bit `j` is set where joint `j` is free.
    free: Vec<u32>,
    settled: Vec<bool>,
    refused: Vec<(usize, Error)>,
}

/// The results of many targets in order: the solutions of a target, by branch, then its end.
#[derive(Clone, Debug, PartialEq)]
pub enum Solved<'a> {
    /// A solution.
    Answer {
        /// Joint values in the program's joint order.
        q: &'a [f64],
        /// [`Solution::residual`].
        residual: f64,
        /// [`Solution::branch`].
        branch: usize,
        /// Bit `j` is set where joint `j` may have any value.
        free: u32,
        /// [`Solution::settled`].
        settled: bool,
    },
    /// The end of a target.
    Target {
        /// The reason why it is invalid.
        refused: Option<Error>,
    },
}

impl Batch {
    /// The number of targets.
    pub fn targets(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The number of all solutions.
    pub fn answers(&self) -> usize {
        self.residuals.len()
    }

    /// The entries of the arrays that are solutions of the target with this index.
    ///
    /// # Panics
    /// For an index that is not below [`Batch::targets`].
    pub fn of_target(&self, index: usize) -> std::ops::Range<usize> {
        self.starts[index]..self.starts[index + 1]
    }

    /// The values of one joint: radians in (-pi, pi], or lengths in the program's unit.
    ///
    /// # Panics
    /// For an index that is not a joint's.
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

    /// By solution, bit `j` is set where joint `j` may have any value.
    pub fn free(&self) -> &[u32] {
        &self.free
    }

    /// By solution, whether the solver completed its work on the target ([`Solution::settled`]).
    pub fn settled(&self) -> &[bool] {
        &self.settled
    }

    /// The invalid targets, each with its index and the reason; they have no solutions.
    pub fn refused(&self) -> &[(usize, Error)] {
        &self.refused
    }

    /// Removes all solutions, and keeps the memory for others with this number of joints.
    fn clear(&mut self, joints: usize) {
        self.starts.clear();
        self.starts.push(0);
        self.joints.resize(joints, Vec::new());
        self.joints.iter_mut().for_each(Vec::clear);
        self.residuals.clear();
        self.branches.clear();
        self.free.clear();
        self.settled.clear();
        self.refused.clear();
    }

    fn reserve(&mut self, targets: usize, answers: usize) {
        self.starts.reserve(targets);
        self.joints.iter_mut().for_each(|column| column.reserve(answers));
        self.residuals.reserve(answers);
        self.branches.reserve(answers);
        self.free.reserve(answers);
        self.settled.reserve(answers);
    }

    fn push(&mut self, solved: Solved<'_>) {
        match solved {
            Solved::Answer { q, residual, branch, free, settled } => {
                self.joints.iter_mut().zip(q).for_each(|(column, value)| column.push(*value));
                self.residuals.push(residual);
                self.branches.push(branch);
                self.free.push(free);
                self.settled.push(settled);
            }
            Solved::Target { refused } => {
                self.refused.extend(refused.map(|error| (self.targets(), error)));
                self.starts.push(self.answers());
            }
        }
    }

    /// Appends the solutions of the following targets.
    fn append(&mut self, next: Batch) {
        let (targets, answers) = (self.targets(), self.answers());
        self.starts.extend(next.starts[1..].iter().map(|start| answers + start));
        self.joints.iter_mut().zip(&next.joints).for_each(|(column, values)| column.extend_from_slice(values));
        self.residuals.extend_from_slice(&next.residuals);
        self.branches.extend_from_slice(&next.branches);
        self.free.extend_from_slice(&next.free);
        self.settled.extend_from_slice(&next.settled);
        self.refused.extend(next.refused.into_iter().map(|(index, error)| (targets + index, error)));
    }
}

impl<S: Storage + 'static> Shaped<S> {
    /// Same as [`Solver::solve_batch_into`].
    pub fn solve_batch_into(&self, targets: &[f64], batch: &mut Batch) -> Result<()> {
        let (inputs, threads) = (self.facts().inputs, rayon::current_num_threads());
        batch.clear(self.facts().joints.len());
        self.check_count(targets)?;
        if threads == 1 {
            self.share(targets, batch);
            return Ok(());
        }
        // Several parts per thread balance their costs.
        let share = (targets.len() / inputs).div_ceil(8 * threads).next_multiple_of(PIECE);
        let shares = targets.par_chunks(share.max(PIECE) * inputs).map(|targets| {
            let mut batch = Batch::default();
            batch.clear(self.facts().joints.len());
            self.share(targets, &mut batch);
            batch
        });
        let shares: Vec<Batch> = shares.collect();
        batch.reserve(targets.len() / inputs, shares.iter().map(Batch::answers).sum());
        shares.into_iter().for_each(|share| batch.append(share));
        Ok(())
    }

    /// Adds the solutions of these targets, piece by piece.
    fn share(&self, targets: &[f64], batch: &mut Batch) {
        let facts = self.facts();
        let count = targets.len() / facts.inputs;
        batch.reserve(count, count * facts.candidates);
        targets.chunks(PIECE * facts.inputs).for_each(|piece| self.piece(piece, &mut |solved| batch.push(solved)));
    }

    /// Same as [`Solver::solve_each`].
    pub fn solve_each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()> {
        self.check_count(targets)?;
        if targets.len() == self.facts().inputs {
            self.single(targets, take);
        } else {
            targets.chunks(PIECE * self.facts().inputs).for_each(|piece| self.piece(piece, take));
        }
        Ok(())
    }

    fn check_count(&self, targets: &[f64]) -> Result<()> {
        let inputs = self.facts().inputs;
        if inputs > 0 && targets.len().is_multiple_of(inputs) {
            return Ok(());
        }
        let text =
            format!("{} numbers are given, which is not a multiple of {inputs}, the length of a target", targets.len());
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// Reports the solutions of these targets.
    fn piece(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) {
        match &self.ordinary {
            Some(own) => self.solve_bundles(own, targets, take),
            None if self.facts().nearby.is_some() => self.bundles(targets, take),
            None => targets.chunks(self.facts().inputs).for_each(|target| self.single(target, take)),
        }
    }

    /// Reports the solutions of these targets, by the run time's code for many targets.
    fn bundles(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) {
        let facts = self.facts();
        let rows: Vec<Inputs<Self>> =
            targets.chunks(facts.inputs).map(|row| Array::by(facts.inputs, |i| row[i])).collect();
        let mut counts = vec![Ok(0); rows.len()];
        let mut done = 0;
        while done < rows.len() {
            self.with_room(facts.candidates * rows.len() + facts.capacity, |room| {
                let solved = Solve::solve_batch(self, &rows[done..], room, &mut counts);
                let mut answers = room.iter();
                for (count, target) in counts[..solved].iter().zip(targets[done * facts.inputs..].chunks(facts.inputs))
                {
                    for answer in answers.by_ref().take(count.unwrap_or(0)) {
                        let &runtime::Solution { ref q, residual, branch, free, settled, .. } = answer;
                        take(Solved::Answer { q: q.as_ref(), residual, branch, free, settled });
                    }
                    take(Solved::Target { refused: count.err().map(|error| self.refused(target, error)) });
                }
                done += solved;
            });
        }
    }

    /// Reports the solutions of one target.
    #[inline(never)]
    pub(super) fn single(&self, target: &[f64], take: &mut dyn FnMut(Solved<'_>)) {
        let row: Inputs<Self> = Array::by(target.len(), |i| target[i]);
        self.with_room(self.facts().capacity, |room| {
            let found = Solve::solve(self, &row, room);
            for answer in &room[..found.unwrap_or(0)] {
                let &runtime::Solution { ref q, residual, branch, free, settled, .. } = answer;
                take(Solved::Answer { q: q.as_ref(), residual, branch, free, settled });
            }
            take(Solved::Target { refused: found.err().map(|error| self.refused(target, error)) });
        });
    }
}
