//! A prepared program: its code on one flat memory, with the run time that printed solvers call. Main type: [`Solver`].
//!
//! A single target is solved with plain numbers, many targets several at once: each instruction then runs over all of
//! them.

mod batch;
mod blocks;
mod code;
mod equations;
mod mechanism;
mod members;
mod ordinary;
mod outline;
mod parameters;
mod reached_numbers;
mod run;
mod shaped;
mod spare;
mod storage;

use groebot_runtime as runtime;
use groebot_runtime::redundant::Members;
use serde::Serialize;

pub use self::batch::{Batch, Solved};
pub(super) use self::outline::{JointOutline, Outline};
pub(super) use self::reached_numbers::ReachedNumbers;
use self::shaped::Shaped;
use self::storage::{Dynamic, SixJoints};
use super::program::Program;
use super::{Facts, Layout, Pairs};
use crate::{Error, Result};
use groebot_robot::kinematics::{InverseKinematics, Solution, Target};

/// A [`Program`] prepared for evaluation. It is made once and solves any number of targets, also from several threads
/// at once.
#[derive(Clone, Debug)]
pub struct Solver {
    shape: Shape,
    pub(super) outline: Outline,
}

/// The variants by the storage of numbers.
#[derive(Clone, Debug)]
enum Shape {
    /// A pose of six joints.
    SixJoints(Box<Shaped<SixJoints>>),
    /// Any other program.
    Dynamic(Box<Shaped<Dynamic>>),
}

/// Calls a method of either variant.
macro_rules! shaped {
    ($solver:expr, $shaped:ident => $call:expr) => {
        match &$solver.shape {
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
    /// The largest ratio of an equation's value to its size.
    pub relative: f64,
}

impl Solver {
    /// The solver of a valid program ([`Program::validate`]).
    pub fn new(program: &Program) -> Self {
        let layout = Layout::new(program);
        let facts = Facts::new(&layout);
        let shape = if Shaped::are_of_six_joints(&layout, &facts) {
            Shape::SixJoints(Box::new(Shaped::new(&layout, facts)))
        } else {
            Shape::Dynamic(Box::new(Shaped::new(&layout, facts)))
        };
        Solver { shape, outline: Outline::new(program) }
    }

    /// All real solutions for `target`, a pose or another [`Target`], by branch: empty when the target is unreachable. Lengths are in the program's unit.
    ///
    /// # Errors
    /// As [`Solver::solve_given`].
    pub fn solve(&self, target: impl Into<Target>) -> Result<Vec<Solution>> {
        self.solve_given(target, &[])
    }

    /// Same as [`Solver::solve`], but with the values `given` of the joints that the user gives.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`]; [`crate::ErrorKind::BadValue`] for a target of another task.
    pub fn solve_given(&self, target: impl Into<Target>, given: &[f64]) -> Result<Vec<Solution>> {
        self.solve_target(&target.into(), given)
    }

    fn solve_target(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        self.solve_numbers(&self.numbers_of(target, given)?)
    }

    /// The numbers of a target of the task, and the values of given joints after them.
    pub(super) fn numbers_of(&self, target: &Target, given: &[f64]) -> Result<Vec<f64>> {
        shaped!(self, shaped => shaped.target.numbers(target, given))
    }

    /// Same as [`Solver::solve`], but for a target as numbers: one per input, in order and unit of [`Program::inputs`].
    /// It is for programs of equations, which have parameters instead of a tip, and for targets from files.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for a wrong number of values, NaN or infinity, or a condition that does not hold
    /// ([`Program::conditions`]); [`crate::ErrorKind::Unsupported`] if the target is on a stratum that could not be derived.
    pub fn solve_numbers(&self, target: &[f64]) -> Result<Vec<Solution>> {
        shaped!(self, shaped => shaped.solve(target))
    }

    /// The solutions of [`Solver::solve_numbers`] by cosines and sines. At ordinary targets, where all candidates solve
    /// the equations within rounding and are distinct, no arc tangent is computed. At others they are the cosines and
    /// sines of the angles.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        shaped!(self, shaped => shaped.solve_pairs(target))
    }

    /// Same as [`Solver::solve_numbers`], but with the values of some joints added to `out`, for a redundant arm, without memory of its own.
    pub(super) fn add_members(
        &self,
        target: &[f64],
        joints: &[usize],
        out: &mut Members,
    ) -> std::result::Result<(), runtime::Error> {
        shaped!(self, shaped => shaped.add_members(target, joints, out))
    }

    /// The largest magnitude among the equations' values at joint values; NaN for a wrong number of values.
    pub(super) fn residual(&self, target: &[f64], q: &[f64]) -> f64 {
        shaped!(self, shaped => shaped.residual_at(target, q))
    }

    /// The error for a target of the right length that the run time refuses.
    pub(super) fn refused(&self, target: &[f64], error: runtime::Error) -> Error {
        shaped!(self, shaped => shaped.refused(target, error))
    }

    /// For a `target` without solution, the candidate with the least residual relative to the equations' size, after
    /// polishing; `None` without such a candidate.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn nearest(&self, target: &[f64]) -> Result<Option<Nearest>> {
        shaped!(self, shaped => shaped.nearest(target))
    }

    /// The solutions of [`Solver::solve_numbers`] that are within `limits` after adding whole turns, one pair per
    /// joint; each angle is moved by the fewest turns. A member of a self-motion is moved along it if it is not within
    /// limits itself.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`]; [`crate::ErrorKind::BadValue`] if the number of pairs differs from that of joints.
    pub fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        shaped!(self, shaped => shaped.solve_within(target, limits))
    }

    /// The solution nearest to the joint values `q0` after whole turns within `limits`, by the sum of squared differences, each times its weight (1 without
    /// `weights`). Its angles are not wrapped. `None` when no solution is within `limits`.
    ///
    /// At a singular target the self-motions are searched, too: where one is a curve, for its nearest place within limits; where it is a surface, for a local
    /// minimum of the distance.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`]; [`crate::ErrorKind::BadValue`] for a wrong number of values, a reference that is not finite, a negative weight, and limits
    /// in the wrong order.
    pub fn nearest_to(
        &self,
        target: &[f64],
        q0: &[f64],
        weights: Option<&[f64]>,
        limits: Option<&[[f64; 2]]>,
    ) -> Result<Option<Solution>> {
        shaped!(self, shaped => shaped.nearest_to(target, q0, weights, limits))
    }

    /// The target that joint values reach (radians, and the program's length unit), in the form for [`Solver::solve_numbers`].
    ///
    /// `None` for a wrong number of joint values, or for a program without forward kinematics: its equations do not compare each number of the target with an
    /// expression of the joints.
    pub fn reached(&self, q: &[f64]) -> Option<Vec<f64>> {
        shaped!(self, shaped => shaped.reached(q))
    }

    /// The numbers of the target that joint values reach, with derivatives on request.
    pub(super) fn reached_numbers(&self, q: &[f64], with_derivatives: bool) -> Option<ReachedNumbers> {
        shaped!(self, shaped => shaped.reached_numbers(q, with_derivatives))
    }

    /// The values of the program's parameters for a target, `p0` and so on in its code, and after them the magnitude,
    /// `m`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] for a wrong number of values.
    pub fn parameters(&self, target: &[f64]) -> Result<Vec<f64>> {
        shaped!(self, shaped => shaped.parameters_of(target))
    }

    /// By equation, the derivatives of its value by the joint values, at these: per radian, or per length unit of the
    /// program. `None` for a wrong number of joint values, and where equations read numbers that do not depend on a
    /// joint.
    ///
    /// # Errors
    /// As [`Solver::parameters`].
    pub fn derivatives(&self, target: &[f64], q: &[f64]) -> Result<Option<Vec<Vec<f64>>>> {
        shaped!(self, shaped => shaped.derivatives(target, q))
    }

    /// Computes all real solutions of many targets: `targets` has their numbers one after the other, each as for
    /// [`Solver::solve_numbers`].
    ///
    /// The work is shared among rayon's threads. The solutions are those of [`Solver::solve_numbers`], independent of
    /// the number of threads.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] if the number of values is not a multiple of the number of inputs. [`Batch::refused`]
    /// lists the targets that [`Solver::solve_numbers`] refuses.
    pub fn solve_batch(&self, targets: &[f64]) -> Result<Batch> {
        let mut batch = Batch::default();
        self.solve_batch_into(targets, &mut batch)?;
        Ok(batch)
    }

    /// Same as [`Solver::solve_batch`], but in the memory of `batch`: consecutive batches need no memory of their own.
    ///
    /// # Errors
    /// As [`Solver::solve_batch`]; `batch` is empty then.
    pub fn solve_batch_into(&self, targets: &[f64], batch: &mut Batch) -> Result<()> {
        shaped!(self, shaped => shaped.solve_batch_into(targets, batch))
    }

    /// Same as [`Solver::solve_batch`], but on the calling thread only, with all results passed to `take` in order: for
    /// callers with their own threads and arrays.
    ///
    /// # Errors
    /// As [`Solver::solve_batch`].
    pub fn solve_each(&self, targets: &[f64], take: &mut dyn FnMut(Solved<'_>)) -> Result<()> {
        shaped!(self, shaped => shaped.solve_each(targets, take))
    }
}

impl InverseKinematics for Solver {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve_target(target, given)?;
        Ok(())
    }

    fn nearest_to(&self, target: &Target, given: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>> {
        Solver::nearest_to(self, &self.numbers_of(target, given)?, q0, None, Some(limits))
    }

    fn uses_eigenvalues(&self) -> bool {
        self.outline.eigenvalues
    }
}
