//! Solvers whose generated code is compiled into the package. It solves ordinary targets; the interpreted program solves all others, so that the package has the
//! code for singular targets only once. Main type: [`Compiled`].

use std::ops::Range;

use groebot::Result;
use groebot::kinematics::Solution;
use groebot::solver::{MAX_JOINTS, Program, Solved};
use groebot_runtime::Solve;
use groebot_runtime::mechanism::Inputs;
use groebot_runtime::ordinary::{Candidate, Ordinary, Receiver};
use groebot_runtime::storage::Array;

use crate::choose::{Nearest, moved};
use crate::kernel::{Answer, Ended, Interpreted, Kernel, Shape, add};
use crate::sink::{Rows, Sink, Status};
use crate::targets::Targets;

/// Number of targets per call of the code.
const PIECE: usize = 64;
/// Maximum number of solutions of an ordinary target.
const CANDIDATES: usize = 16;
/// A reference whose equations have values below this may be a solution itself, and is left to the program. The values are relative to 1 m or 1 rad.
const BESIDE: f64 = 1e-4;

/// Generated code of a mechanism.
pub trait Code: Send + Sync {
    fn solve(&self, target: &[f64], writer: &mut Writer<'_, '_>);
    fn solve_batch(&self, targets: &[f64], writer: &mut Writer<'_, '_>);
    fn forward(&self, q: &[f64]) -> Option<Vec<f64>>;
    /// The largest magnitude among the equations' values.
    fn residual(&self, target: &[f64], q: &[f64]) -> f64;
}

impl<M: Ordinary + Send + Sync> Code for M {
    fn solve(&self, target: &[f64], writer: &mut Writer<'_, '_>) {
        self.solve_ordinary(&Array::by(target.len(), |i| target[i]), writer);
    }

    fn solve_batch(&self, targets: &[f64], writer: &mut Writer<'_, '_>) {
        let row = |row: &[f64]| Array::by(row.len(), |i| row[i]);
        let rows: Vec<Inputs<M>> = targets.chunks_exact(self.facts().inputs).map(row).collect();
        self.solve_ordinary_batch(&rows, writer);
    }

    fn forward(&self, q: &[f64]) -> Option<Vec<f64>> {
        Solve::forward(self, &Array::by(q.len(), |i| q[i])).map(|target| target.as_ref().to_vec())
    }

    fn residual(&self, target: &[f64], q: &[f64]) -> f64 {
        Solve::residual(self, &Array::by(target.len(), |i| target[i]), &Array::by(q.len(), |i| q[i]))
    }
}

/// Adds the solutions of ordinary targets to a sink.
pub struct Writer<'w, 'a> {
    sink: &'w mut Sink<'a>,
    /// Is called at the end of each target with its index, the row of its first solution, and whether it is ordinary.
    end: &'w mut dyn FnMut(&mut Sink<'_>, usize, usize, bool),
}

impl<M: Ordinary> Receiver<M> for Writer<'_, '_> {
    #[inline(always)]
    fn take(&mut self, target: usize, candidates: impl ExactSizeIterator<Item = Candidate<M>>) {
        let (begun, room) = (self.sink.taken, candidates.len());
        if self.sink.rows.len() - begun >= room {
            if let Some(rows) = self.sink.more(room) {
                let count = write(rows, candidates);
                self.sink.taken = begun + count;
            }
        } else {
            let answer = |Candidate { q, residual, branch, .. }: &Candidate<M>, sink: &mut Sink<'_>| {
                let (residual, branch) = (*residual, *branch);
                add(sink, Answer { q: q.as_ref(), residual, branch, free: 0, chosen: false, settled: true });
            };
            candidates.filter(|candidate| candidate.is_real).for_each(|candidate| answer(&candidate, self.sink));
        }
        (self.end)(self.sink, target, begun, true);
    }

    #[inline(always)]
    fn leave(&mut self, target: usize) {
        let begun = self.sink.taken;
        (self.end)(self.sink, target, begun, false);
    }
}

/// Writes the candidates that are real to the first rows, and returns their number. Every candidate is written, and overwritten if it is not real: this takes less
/// time than a branch.
#[inline(always)]
fn write<M: Ordinary>(rows: Rows<'_>, candidates: impl Iterator<Item = Candidate<M>>) -> usize {
    let mut count = 0;
    for Candidate { q, residual, branch, is_real, .. } in candidates {
        // Its length is a constant at compile time.
        let own = q.as_ref();
        rows.q[own.len() * count..][..own.len()].copy_from_slice(own);
        (rows.residual[count], rows.branch[count], rows.free[count]) = (residual, branch as i32, 0);
        count += usize::from(is_real);
    }
    count
}

/// A solver with generated code.
pub struct Compiled {
    code: Box<dyn Code>,
    program: Interpreted,
}

impl Compiled {
    pub fn new(code: Box<dyn Code>, program: &Program) -> Self {
        Compiled { code, program: Interpreted::new(program) }
    }

    /// Passes all solutions of a target to `take` if it is ordinary. Otherwise returns false.
    fn solve_ordinary(&self, target: &[f64], mut take: impl FnMut(Answer<'_>)) -> bool {
        let mut room = OneTarget::EMPTY;
        let mut sink = room.sink(self.shape().turns.len());
        let mut is_found = false;
        let mut end = |_: &mut Sink<'_>, _, _, is_ordinary| is_found = is_ordinary;
        self.code.solve(target, &mut Writer { sink: &mut sink, end: &mut end });
        if is_found {
            (0..sink.taken).for_each(|row| take(sink.answer(row)));
        }
        is_found
    }

    fn ordinary(&self, target: &[f64]) -> Option<Vec<Solution>> {
        let mut all = Vec::with_capacity(self.shape().usual);
        self.solve_ordinary(target, |answer| all.push(answer.into())).then_some(all)
    }
}

/// Rows for the solutions of one ordinary target.
struct OneTarget {
    q: [f64; CANDIDATES * MAX_JOINTS],
    residual: [f64; CANDIDATES],
    branch: [i32; CANDIDATES],
    free: [u32; CANDIDATES],
}

impl OneTarget {
    const EMPTY: Self = OneTarget {
        q: [0.0; CANDIDATES * MAX_JOINTS],
        residual: [0.0; CANDIDATES],
        branch: [0; CANDIDATES],
        free: [0; CANDIDATES],
    };

    fn sink(&mut self, joints: usize) -> Sink<'_> {
        let OneTarget { q, residual, branch, free } = self;
        Sink::new(joints, Rows { q, residual, branch, free }, &mut [], &mut [])
    }
}

impl Kernel for Compiled {
    fn shape(&self) -> &Shape {
        self.program.shape()
    }

    fn solve(&self, target: &[f64], take: &mut dyn FnMut(Answer<'_>)) -> Result<()> {
        if self.solve_ordinary(target, &mut *take) { Ok(()) } else { self.program.solve(target, take) }
    }

    fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        let Some(mut all) = self.ordinary(target) else { return self.program.solve_within(target, limits) };
        all.retain_mut(|solution| {
            let own = solution.q.clone();
            moved(&self.shape().turns, &own, &own, Some(limits), &mut solution.q)
        });
        Ok(all)
    }

    fn nearest_to(&self, target: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>> {
        let ordinary = self.ordinary(target).filter(|_| self.code.residual(target, q0) > BESIDE);
        let Some(all) = ordinary else { return self.program.nearest_to(target, q0, limits) };
        let mut nearest = Nearest::to(&self.shape().turns, q0, Some(limits));
        all.iter().enumerate().for_each(|(index, solution)| nearest.consider(index, &solution.q));
        Ok(nearest.found().map(|(index, q)| Solution { q: q.to_vec(), ..all[index].clone() }))
    }

    fn forward(&self, q: &[f64]) -> Option<Vec<f64>> {
        self.code.forward(q)
    }

    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()> {
        let inputs = self.shape().inputs;
        let mut room = OneTarget::EMPTY;
        for targets in targets.chunks(PIECE * inputs) {
            let mut end = |sink: &mut Sink<'_>, target: usize, begun, is_ordinary| {
                let mut pass = |Answer { q, residual, branch, free, settled, .. }: Answer<'_>| {
                    take(Solved::Answer { q, residual, branch, free, settled });
                };
                let refused = if is_ordinary {
                    (begun..sink.taken).for_each(|row| pass(sink.answer(row)));
                    None
                } else {
                    self.program.solve(&targets[target * inputs..][..inputs], &mut pass).err()
                };
                sink.taken = begun;
                take(Solved::Target { refused });
            };
            let mut sink = room.sink(self.shape().turns.len());
            self.code.solve_batch(targets, &mut Writer { sink: &mut sink, end: &mut end });
        }
        Ok(())
    }

    fn batch(&self, targets: &Targets<'_>, rows: Range<usize>, sink: &mut Sink<'_>, ended: Ended<'_>) {
        let inputs = self.shape().inputs;
        let (mut numbers, mut whole) = (vec![0.0; inputs * PIECE], [Status::Solved; PIECE]);
        for first in rows.clone().step_by(PIECE) {
            let size = PIECE.min(rows.end - first);
            for (row, (target, status)) in numbers.chunks_exact_mut(inputs).zip(&mut whole).take(size).enumerate() {
                *status = targets.row(first + row, target);
            }
            let mut end = |sink: &mut Sink<'_>, row: usize, begun, is_ordinary| {
                let target = &numbers[row * inputs..][..inputs];
                let why = if is_ordinary { Status::Unreachable } else { self.program.add(target, sink) };
                ended(sink, first + row, begun, if whole[row] == Status::Solved { why } else { whole[row] });
            };
            self.code.solve_batch(&numbers[..size * inputs], &mut Writer { sink, end: &mut end });
        }
    }
}
