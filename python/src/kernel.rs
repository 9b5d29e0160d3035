//! Kernels, which solve targets: a generated solver, or the interpreted program of a derived one. Main trait:
//! [`Kernel`].

use std::ops::Range;

use groebot::kinematics::Solution;
use groebot::solver::{Condition, JointValue, Program, Solved, Solver};
use groebot::{Error, ErrorKind, Result};
use groebot_runtime as runtime;
use groebot_runtime::mechanism::{Answered, Inputs};
use groebot_runtime::storage::Array;
use groebot_runtime::{Mechanism, Solve};

use crate::sink::{Rows, Sink, Status};
use crate::targets::Targets;

/// Number of targets per call of a generated solver, and of a program.
const PIECE: usize = 64;
const MANY: usize = 256;

/// Properties of all targets of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Number of inputs of a target.
    pub inputs: usize,
    /// Whether each joint is revolute.
    pub turns: Vec<bool>,
    /// Maximum number of solutions of an ordinary target.
    pub usual: usize,
    /// Maximum number of solutions of any target.
    pub capacity: usize,
}

/// A solver of many targets. All implementations return bitwise identical solutions.
pub trait Kernel: Send + Sync {
    fn shape(&self) -> &Shape;

    /// Passes all solutions of one target to `take`.
    fn solve(&self, target: &[f64], take: &mut dyn FnMut(Answer<'_>)) -> Result<()>;

    /// The solutions within limits, each moved by as few whole turns as possible.
    fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>>;

    /// The solution nearest to `q0` after whole turns within limits, on self-motions too.
    fn nearest_to(&self, target: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>>;

    /// Forward kinematics of joint values; `None` if the equations do not determine it.
    fn forward(&self, q: &[f64]) -> Option<Vec<f64>>;

    /// Passes the solutions of all targets to `take`, each target's followed by its end.
    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()>;

    /// Adds the solutions of these targets. `ended` is called for each target with its number and the row of its first
    /// solution.
    fn batch(&self, targets: &Targets<'_>, rows: Range<usize>, sink: &mut Sink<'_>, ended: Ended<'_>);
}

/// A solution, as it is passed on.
#[derive(Clone, Copy, Debug)]
pub struct Answer<'a> {
    pub q: &'a [f64],
    pub residual: f64,
    pub branch: usize,
    /// Bit `j` is set where joint `j` is free.
    pub free: u32,
    pub chosen: bool,
    pub settled: bool,
}

impl<'a> From<&'a Solution> for Answer<'a> {
    fn from(solution: &'a Solution) -> Self {
        let Solution { q, residual, branch, free, chosen, settled } = solution;
        let free = free.iter().fold(0, |bits, joint| bits | 1 << joint);
        Answer { q, residual: *residual, branch: *branch, free, chosen: *chosen, settled: *settled }
    }
}

impl<'a, M: Mechanism> From<&'a runtime::Solution<M>> for Answer<'a> {
    fn from(solution: &'a runtime::Solution<M>) -> Self {
        let &runtime::Solution { ref q, residual, branch, free, chosen, settled, .. } = solution;
        Answer { q: q.as_ref(), residual, branch, free, chosen, settled }
    }
}

impl From<Answer<'_>> for Solution {
    fn from(answer: Answer<'_>) -> Self {
        let Answer { q, residual, branch, free, chosen, settled } = answer;
        let free = (0..q.len()).filter(|joint| free >> joint & 1 == 1).collect();
        Solution { q: q.to_vec(), residual, branch, free, chosen, settled }
    }
}

/// Callback for the end of a target: its number, the row of its first solution, and the reason if it has none.
pub type Ended<'e> = &'e mut dyn FnMut(&mut Sink<'_>, usize, usize, Status);

/// A generated solver.
pub struct Printed<M> {
    mechanism: M,
    shape: Shape,
}

impl<M: Mechanism> Printed<M> {
    pub fn new(mechanism: M) -> Self {
        let facts = mechanism.facts();
        let shape = Shape {
            inputs: facts.inputs,
            turns: facts.joints.iter().map(|joint| matches!(joint, runtime::Joint::Angle(_))).collect(),
            usual: facts.candidates.max(facts.isolated.unwrap_or(0)).min(facts.capacity),
            capacity: facts.capacity,
        };
        Printed { mechanism, shape }
    }

    fn row(&self, target: &[f64]) -> Inputs<M> {
        Array::by(self.shape.inputs, |i| target[i])
    }
}

impl<M: Mechanism + Send + Sync> Kernel for Printed<M> {
    fn shape(&self) -> &Shape {
        &self.shape
    }

    fn solve(&self, target: &[f64], take: &mut dyn FnMut(Answer<'_>)) -> Result<()> {
        let mut room: Answered<M, runtime::Solution<M>> =
            Array::by(self.shape.capacity, |_| runtime::Solution::empty(&self.mechanism));
        let room = room.as_mut();
        let count = self.mechanism.solve(&self.row(target), room).map_err(refused)?;
        room[..count].iter().for_each(|answer| take(answer.into()));
        Ok(())
    }

    fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        let limits = Array::by(limits.len(), |i| limits[i]);
        let mut room = vec![runtime::Solution::empty(&self.mechanism); self.shape.capacity];
        let count = self.mechanism.solve_within(&self.row(target), &limits, &mut room).map_err(refused)?;
        Ok(room[..count].iter().map(|answer| Answer::from(answer).into()).collect())
    }

    fn nearest_to(&self, target: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>> {
        let limits = Array::by(limits.len(), |i| limits[i]);
        let [q0, weights] = [Array::by(q0.len(), |i| q0[i]), Array::by(q0.len(), |_| 1.0)];
        let mut room = vec![runtime::Solution::empty(&self.mechanism); self.shape.capacity];
        let found = self.mechanism.nearest_to(&self.row(target), &q0, &weights, &limits, &mut room).map_err(refused)?;
        Ok(found.map(|(nearest, _)| Answer::from(&nearest).into()))
    }

    fn forward(&self, q: &[f64]) -> Option<Vec<f64>> {
        self.mechanism.forward(&Array::by(q.len(), |i| q[i])).map(|target| target.as_ref().to_vec())
    }

    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()> {
        let Shape { usual, capacity, inputs, .. } = self.shape;
        let mut room = vec![runtime::Solution::empty(&self.mechanism); PIECE * usual + capacity];
        let mut piece: Vec<Inputs<M>> = Vec::with_capacity(PIECE);
        let mut counts = [Ok(0); PIECE];
        for numbers in targets.chunks(PIECE * inputs) {
            piece.clear();
            piece.extend(numbers.chunks_exact(inputs).map(|row| self.row(row)));
            let mut done = 0;
            while done < piece.len() {
                let solved = self.mechanism.solve_batch(&piece[done..], &mut room, &mut counts);
                let mut answers = room.iter();
                for count in &counts[..solved] {
                    for answer in answers.by_ref().take(count.unwrap_or(0)) {
                        let &runtime::Solution { ref q, residual, branch, free, settled, .. } = answer;
                        take(Solved::Answer { q: q.as_ref(), residual, branch, free, settled });
                    }
                    take(Solved::Target { refused: count.err().map(refused) });
                }
                done += solved;
            }
        }
        Ok(())
    }

    fn batch(&self, targets: &Targets<'_>, rows: Range<usize>, sink: &mut Sink<'_>, ended: Ended<'_>) {
        let Shape { usual, capacity, inputs, .. } = self.shape;
        let mut room = vec![runtime::Solution::empty(&self.mechanism); PIECE * usual + capacity];
        let mut piece: Vec<Inputs<M>> = vec![Array::by(inputs, |_| 0.0); PIECE];
        let (mut whole, mut counts) = ([Status::Solved; PIECE], [Ok(0); PIECE]);
        for first in rows.clone().step_by(PIECE) {
            let size = PIECE.min(rows.end - first);
            for (row, (target, status)) in piece[..size].iter_mut().zip(&mut whole).enumerate() {
                *status = targets.row(first + row, target.as_mut());
            }
            let mut done = 0;
            while done < size {
                let solved = self.mechanism.solve_batch(&piece[done..size], &mut room, &mut counts);
                let mut answers = room.iter();
                for (row, count) in (done..).zip(&counts[..solved]) {
                    let (begun, found) = (sink.taken, count.unwrap_or(0));
                    let of_target = answers.as_slice().get(..found).unwrap_or(&[]);
                    let are_settled = of_target.iter().all(|answer| answer.settled);
                    if let Some(rows) = sink.more(found) {
                        write(rows, answers.by_ref().take(found));
                    }
                    let solved = count.and(if are_settled { Ok(()) } else { Err(runtime::Error::Unsettled) });
                    ended(sink, first + row, begun, why(whole[row], solved));
                }
                done += solved;
            }
        }
    }
}

/// Writes the solutions of a target.
#[inline]
fn write<'m, M: Mechanism + 'm>(rows: Rows<'_>, answers: impl Iterator<Item = &'m runtime::Solution<M>>) {
    let Rows { mut q, residual, branch, free } = rows;
    let status_of = residual.iter_mut().zip(branch).zip(free);
    for (answer, ((residual, branch), free)) in answers.zip(status_of) {
        // Its length is a constant at compile time.
        let own = answer.q.as_ref();
        let Some((row, rest)) = q.split_at_mut_checked(own.len()) else { return };
        row.copy_from_slice(own);
        q = rest;
        (*residual, *branch, *free) = (answer.residual, answer.branch as i32, answer.free);
    }
}

/// The reason why a target has no solutions, or not all: the fault of its form, else the error of the solver.
fn why(form: Status, solved: std::result::Result<(), runtime::Error>) -> Status {
    match (form, solved) {
        (Status::Solved, Ok(())) => Status::Unreachable,
        (Status::Solved, Err(runtime::Error::NotFinite)) => Status::NotFinite,
        (Status::Solved, Err(runtime::Error::NotRotation)) => Status::NotRotation,
        (Status::Solved, Err(runtime::Error::NotUnit)) => Status::NotUnit,
        (Status::Solved, Err(runtime::Error::Unsettled)) => Status::Unsettled,
        (Status::Solved, Err(_)) => Status::Open,
        (form, _) => form,
    }
}

fn refused(error: runtime::Error) -> Error {
    let kind = match error {
        runtime::Error::OpenStratum(_) => ErrorKind::Unsupported,
        runtime::Error::Unsettled => ErrorKind::Budget,
        _ => ErrorKind::BadValue,
    };
    Error::new(kind, error.to_string())
}

/// The interpreted program of a derived solver.
pub struct Interpreted {
    solver: Solver,
    shape: Shape,
    has_rotation: bool,
}

impl Interpreted {
    pub fn new(program: &Program) -> Self {
        let turns = program.joints.iter().map(|joint| matches!(joint.value, JointValue::Angle { .. }));
        let shape = Shape {
            inputs: program.inputs.len(),
            turns: turns.collect(),
            usual: program.isolated.unwrap_or(program.bound()).clamp(1, program.capacity.max(1)),
            capacity: program.capacity,
        };
        let has_rotation = program.conditions.iter().any(|condition| matches!(condition, Condition::Rotation(_)));
        Interpreted { solver: program.solver(), shape, has_rotation }
    }

    /// The reason why a target is refused.
    fn why(&self, target: &[f64], error: &Error) -> Status {
        match error.kind() {
            ErrorKind::Unsupported => Status::Open,
            ErrorKind::Budget => Status::Unsettled,
            _ if !target.iter().all(|number| number.is_finite()) => Status::NotFinite,
            _ if self.has_rotation => Status::NotRotation,
            _ => Status::NotUnit,
        }
    }
}

impl Kernel for Interpreted {
    fn shape(&self) -> &Shape {
        &self.shape
    }

    fn solve(&self, target: &[f64], take: &mut dyn FnMut(Answer<'_>)) -> Result<()> {
        self.solver.solve_numbers(target)?.iter().for_each(|solution| take(solution.into()));
        Ok(())
    }

    fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        self.solver.solve_within(target, limits)
    }

    fn nearest_to(&self, target: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>> {
        self.solver.nearest_to(target, q0, None, Some(limits))
    }

    fn forward(&self, q: &[f64]) -> Option<Vec<f64>> {
        self.solver.reached(q)
    }

    fn each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()> {
        self.solver.solve_each(targets, take)
    }

    fn batch(&self, targets: &Targets<'_>, rows: Range<usize>, sink: &mut Sink<'_>, ended: Ended<'_>) {
        let inputs = self.shape.inputs;
        let mut numbers = vec![0.0; inputs * MANY];
        let mut whole = [Status::Solved; MANY];
        for first in rows.clone().step_by(MANY) {
            let size = MANY.min(rows.end - first);
            for (row, (target, status)) in numbers.chunks_mut(inputs).zip(&mut whole).take(size).enumerate() {
                *status = targets.row(first + row, target);
            }
            let (mut row, mut begun, mut are_settled) = (0, sink.taken, true);
            let each = |solved: Solved<'_>| match solved {
                Solved::Answer { q, residual, branch, free, settled } => {
                    are_settled &= settled;
                    if let Some(rows) = sink.more(1) {
                        rows.q.copy_from_slice(q);
                        (rows.residual[0], rows.branch[0], rows.free[0]) = (residual, branch as i32, free);
                    }
                }
                Solved::Target { refused } => {
                    let status_of = |error: Error| self.why(&numbers[row * inputs..][..inputs], &error);
                    let why = if whole[row] == Status::Solved {
                        refused.map_or(if are_settled { Status::Unreachable } else { Status::Unsettled }, status_of)
                    } else {
                        whole[row]
                    };
                    ended(sink, first + row, begun, why);
                    (row, begun, are_settled) = (row + 1, sink.taken, true);
                }
            };
            if self.solver.solve_each(&numbers[..size * inputs], each).is_err() {
                return;
            }
        }
    }
}
