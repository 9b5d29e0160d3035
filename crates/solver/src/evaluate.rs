//! One-off evaluation of a [`Program`]; [`Program::solver`] prepares it for many targets.

use super::program::Program;
use super::{Batch, Nearest, Pairs, Solver};
use crate::Result;
use groebot_robot::kinematics::{InverseKinematics, Solution, Target};

/// The program must be valid ([`Program::validate`]).
impl Program {
    /// Prepares the program for evaluation.
    pub fn solver(&self) -> Solver {
        Solver::new(self)
    }

    /// Same as [`Solver::solve_numbers`]. For many targets, a prepared [`Solver`] takes a tenth of the time.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn solve_numbers(&self, target: &[f64]) -> Result<Vec<Solution>> {
        self.solver().solve_numbers(target)
    }

    /// Same as [`Solver::solve_pairs`].
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        self.solver().solve_pairs(target)
    }

    /// Same as [`Solver::nearest`].
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn nearest(&self, target: &[f64]) -> Result<Option<Nearest>> {
        self.solver().nearest(target)
    }

    /// Same as [`Solver::solve_batch`].
    ///
    /// # Errors
    /// As [`Solver::solve_batch`].
    pub fn solve_batch(&self, targets: &[f64]) -> Result<Batch> {
        self.solver().solve_batch(targets)
    }

    /// Same as [`Solver::reached`].
    pub fn reached(&self, q: &[f64]) -> Option<Vec<f64>> {
        self.solver().reached(q)
    }
}

impl InverseKinematics for Program {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        self.solver().solve_given(target, given).map(|solutions| *out = solutions)
    }

    fn nearest_to(&self, target: &Target, given: &[f64], q0: &[f64], limits: &[[f64; 2]]) -> Result<Option<Solution>> {
        InverseKinematics::nearest_to(&self.solver(), target, given, q0, limits)
    }

    fn uses_eigenvalues(&self) -> bool {
        self.has_six_axes()
    }
}
