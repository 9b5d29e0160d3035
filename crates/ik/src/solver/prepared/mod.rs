//! A program made ready to run: its code on one flat memory, on the run time that printed solvers call. Main type: [`Solver`].
//!
//! One target is solved number by number, many by several at once: each instruction then runs over all of them.

mod batch;
mod blocks;
mod code;
mod equations;
mod mechanism;
mod parameters;
mod run;
mod shaped;
mod spare;
mod storage;

use serde::Serialize;

pub use self::batch::{Batch, Solved};
use self::shaped::Shaped;
use self::storage::{Dynamic, SixJoints};
use super::program::Program;
use super::{Facts, Layout, Pairs};
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::{InverseKinematics, Solution, Target};

/// A [`Program`] made ready to run. It is made once and solves any number of targets, from several threads at once.
#[derive(Clone, Debug)]
pub struct Solver(Shape);

/// By where its numbers stand.
#[derive(Clone, Debug)]
enum Shape {
    /// A pose of six joints.
    SixJoints(Box<Shaped<SixJoints>>),
    /// Anything else.
    Dynamic(Box<Shaped<Dynamic>>),
}

/// Calls what both have.
macro_rules! shaped {
    ($solver:expr, $shaped:ident => $call:expr) => {
        match &$solver.0 {
            Shape::SixJoints($shaped) => $call,
            Shape::Dynamic($shaped) => $call,
        }
    };
}

/// A candidate that does not solve the equations.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Nearest {
    /// Joint values in the program's joint order.
    pub q: Vec<f64>,
    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    pub residual: f64,
    /// The largest share of an equation's value in its size.
    pub relative: f64,
}

impl Solver {
    /// The solver of a valid program ([`Program::validate`]).
    pub fn new(program: &Program) -> Self {
        let layout = Layout::new(program);
        let facts = Facts::new(&layout);
        Solver(if Shaped::are_of_six_joints(&layout, &facts) {
            Shape::SixJoints(Box::new(Shaped::new(&layout, facts)))
        } else {
            Shape::Dynamic(Box::new(Shaped::new(&layout, facts)))
        })
    }

    /// All real solutions for `target` and the values `given` of the joints that the user gives, by branch: empty when the target is unreachable. Lengths
    /// are in the program's unit.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`]; [`ErrorKind::BadValue`] for a target of another task.
    pub fn solve(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        let (numbers, inputs) = (target.numbers(), shaped!(self, shaped => &shaped.inputs));
        let named = inputs.iter().take(numbers.len()).all(|input| target.has(&input.name));
        if inputs.len() != numbers.len() + given.len() || !named {
            let names: Vec<&str> = inputs.iter().map(|input| input.name.as_str()).collect();
            let text = format!(
                "a target of {} numbers and {} given values; the solver asks for {}",
                numbers.len(),
                given.len(),
                names.join(", ")
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        self.solve_numbers(&[&numbers[..], given].concat())
    }

    /// The same for a target in numbers: one an input, in order and unit of [`Program::inputs`]; for programs of equations, which have parameters in
    /// place of a tip, and for targets from files.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong count of numbers, NaN or infinity, or a condition that does not hold
    /// ([`Program::conditions`]); [`ErrorKind::Unsupported`] when the target lies on a stratum that could not be derived.
    pub fn solve_numbers(&self, target: &[f64]) -> Result<Vec<Solution>> {
        shaped!(self, shaped => shaped.solve(target))
    }

    /// The answers of [`Solver::solve_numbers`] by cosines and sines. Where all candidates solve the equations within rounding and are apart, as
    /// at ordinary targets, these are the numbers that angles are taken of, and no arc tangent is; else they are those of the angles.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        shaped!(self, shaped => shaped.solve_pairs(target))
    }

    /// Where `target` has no solution: of the candidates the one that misses the equations by the least share of their size, as far as polishing brings
    /// it; none when there is no such candidate.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn nearest(&self, target: &[f64]) -> Result<Option<Nearest>> {
        shaped!(self, shaped => shaped.nearest(target))
    }

    /// The solutions of [`Solver::solve_numbers`] that have a turn within `limits`, one pair a joint: each is moved there by as few turns of each angle
    /// as can be. A member of a self-motion is moved along it where it is not within limits itself.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`]; [`ErrorKind::BadValue`] for another number of pairs than joints.
    pub fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        shaped!(self, shaped => shaped.solve_within(target, limits))
    }

    /// The target that joint values reach (radians, and the program's length unit): the one that [`Solver::solve_numbers`] takes. None for a program whose
    /// equations do not compare each number of the target with something that only the joints have, or for another number of joint values.
    pub fn reached(&self, q: &[f64]) -> Option<Vec<f64>> {
        shaped!(self, shaped => shaped.reached(q))
    }

    /// What a target's numbers become before anything else: the values of the program's parameters, `p0` and so on in its code, and behind them the
    /// magnitude, `m`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong count of numbers.
    pub fn parameters(&self, target: &[f64]) -> Result<Vec<f64>> {
        shaped!(self, shaped => shaped.parameters_of(target))
    }

    /// By equation, the derivatives of its value by the joint values, at these: by radian, or by the program's length unit. None for another number of
    /// joint values, and where equations read numbers that follow from no joint.
    ///
    /// # Errors
    /// As [`Solver::parameters`].
    pub fn derivatives(&self, target: &[f64], q: &[f64]) -> Result<Option<Vec<Vec<f64>>>> {
        shaped!(self, shaped => shaped.derivatives(target, q))
    }

    /// All real solutions for many targets: `targets` holds those of one after those of another, each as [`Solver::solve_numbers`] takes it.
    ///
    /// The work is shared among rayon's threads. The answers are those of [`Solver::solve_numbers`], whatever their number.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the count of numbers is no multiple of the inputs'. Targets that [`Solver::solve_numbers`] refuses are
    /// told by [`Batch::refused`].
    pub fn solve_batch(&self, targets: &[f64]) -> Result<Batch> {
        let mut batch = Batch::default();
        self.solve_batch_into(targets, &mut batch)?;
        Ok(batch)
    }

    /// As [`Solver::solve_batch`], in the room that `batch` has: batches that follow one another need no memory of their own.
    ///
    /// # Errors
    /// As [`Solver::solve_batch`]; `batch` is empty then.
    pub fn solve_batch_into(&self, targets: &[f64], batch: &mut Batch) -> Result<()> {
        shaped!(self, shaped => shaped.solve_batch_into(targets, batch))
    }

    /// As [`Solver::solve_batch`], on the calling thread alone, and all that comes of it is handed to `take` in turn: for callers that have threads and arrays of
    /// their own. (It is compiled where it is called, with what that crate is compiled with.)
    ///
    /// # Errors
    /// As [`Solver::solve_batch`].
    pub fn solve_each(&self, targets: &[f64], mut take: impl FnMut(Solved<'_>)) -> Result<()> {
        shaped!(self, shaped => shaped.solve_each(targets, &mut take))
    }
}

impl InverseKinematics for Solver {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve(target, given)?;
        Ok(())
    }
}
