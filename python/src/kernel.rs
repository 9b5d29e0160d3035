//! Kernels, which solve targets: [`crate::compiled`] code, or the interpreted program of a derived solver. Main trait: [`Kernel`].

use std::ops::Range;

use groebot::kinematics::Solution;
use groebot::solver::{Condition, JointValue, Program, Solved, Solver};
use groebot::{Error, ErrorKind, Result};

use crate::sink::{Sink, Status};
use crate::targets::Targets;

/// Number of targets per call of a program.
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

impl From<Answer<'_>> for Solution {
    fn from(answer: Answer<'_>) -> Self {
        let Answer { q, residual, branch, free, chosen, settled } = answer;
        let free = (0..q.len()).filter(|joint| free >> joint & 1 == 1).collect();
        Solution { q: q.to_vec(), residual, branch, free, chosen, settled }
    }
}

/// Callback for the end of a target: its number, the row of its first solution, and the reason if it has none.
pub type Ended<'e> = &'e mut dyn FnMut(&mut Sink<'_>, usize, usize, Status);

/// Adds a solution if there is a row for it.
#[inline]
pub fn add(sink: &mut Sink<'_>, answer: Answer<'_>) {
    if let Some(rows) = sink.more(1) {
        rows.q.copy_from_slice(answer.q);
        (rows.residual[0], rows.branch[0], rows.free[0]) = (answer.residual, answer.branch as i32, answer.free);
    }
}

/// The interpreted program of a derived solver.
pub struct Interpreted {
    solver: Solver,
    shape: Shape,
    has_rotation: bool,
    /// Whether the source of the mechanism selects a solution.
    has_preference: bool,
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
        let has_preference = program.preference.is_some();
        Interpreted { solver: program.solver(), shape, has_rotation, has_preference }
    }

    /// Adds the solutions of one target. Returns the reason if it has none, or not all.
    pub fn add(&self, target: &[f64], sink: &mut Sink<'_>) -> Status {
        match self.solver.solve_numbers(target) {
            Err(error) => self.why(target, &error),
            Ok(solutions) => {
                solutions.iter().for_each(|solution| add(sink, solution.into()));
                let are_settled = solutions.iter().all(|solution| solution.settled);
                if are_settled { Status::Unreachable } else { Status::Unsettled }
            }
        }
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
        if self.has_preference {
            self.solver.solve_numbers(target)?.iter().for_each(|solution| take(solution.into()));
            return Ok(());
        }
        // Without memory for each solution.
        let mut end = None;
        self.solver.solve_each(target, &mut |solved| match solved {
            Solved::Answer { q, residual, branch, free, settled } => {
                take(Answer { q, residual, branch, free, chosen: false, settled });
            }
            Solved::Target { refused } => end = refused,
        })?;
        end.map_or(Ok(()), Err)
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
            let mut each = |solved: Solved<'_>| match solved {
                Solved::Answer { q, residual, branch, free, settled } => {
                    are_settled &= settled;
                    add(sink, Answer { q, residual, branch, free, chosen: false, settled });
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
            if self.solver.solve_each(&numbers[..size * inputs], &mut each).is_err() {
                return;
            }
        }
    }
}
