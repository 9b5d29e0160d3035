//! Running a [`Program`]: the target becomes parameters, the blocks propose candidates, and what solves the equations remains.

use super::answers::{Answers, Nearest};
use super::frame::Frame;
use super::pairs::{Pairs, UsualPairs};
use super::program::Program;
use super::rule::Rule;
use super::walk::Walk;
use super::{MERGE, refine};
use crate::kinematics::{InverseKinematics, Solution, Target};
use crate::{Error, ErrorKind, Result};

impl Program {
    /// All real solutions for `target` and the values `given` of the joints that the user gives, by branch: empty when the target is unreachable. Lengths
    /// are in the program's unit. The program must be valid ([`Program::validate`]).
    ///
    /// # Errors
    /// As [`Program::solve_numbers`]; [`ErrorKind::BadValue`] for a target of another task.
    pub fn solve(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        let numbers = target.numbers();
        let named = self.inputs.iter().take(numbers.len()).all(|input| target.has(&input.name));
        if self.inputs.len() != numbers.len() + given.len() || !named {
            let names: Vec<&str> = self.inputs.iter().map(|input| input.name.as_str()).collect();
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
        let mut solutions = self.walk(target, UsualPairs::unwanted(), |answers| answers.into_solutions())?;
        solutions.sort_by_key(|solution| solution.branch);
        self.mark_choice(&mut solutions);
        Ok(solutions)
    }

    /// The answers of [`Program::solve_numbers`] by cosines and sines. Where all candidates solve the equations within rounding and are apart, as
    /// at ordinary targets, these are the numbers that angles are taken of, and printed solvers take none; else they are those of
    /// the angles.
    ///
    /// # Errors
    /// As [`Program::solve_numbers`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        let usual = if self.compares_tip() { UsualPairs::none_yet() } else { UsualPairs::unwanted() };
        let mut pairs = self.walk(target, usual, |answers| answers.into_pairs())?;
        pairs.sort_by_key(|pairs| pairs.branch);
        Ok(pairs)
    }

    /// Of the candidates for `target` that are no solution, the one that misses the equations by the least share of their size, as
    /// far as polishing brings it; none when there is no such candidate.
    ///
    /// # Errors
    /// As [`Program::solve_numbers`].
    pub fn nearest(&self, target: &[f64]) -> Result<Option<Nearest>> {
        self.walk(target, UsualPairs::unwanted(), |answers| answers.into_nearest())
    }

    /// What is taken of the answers for a target; they are noted as `pairs` too, if these are wanted.
    fn walk<T>(&self, target: &[f64], pairs: UsualPairs, take: impl Fn(Answers<'_>) -> T) -> Result<T> {
        self.check_target(target)?;
        let mut target = target.to_vec();
        self.conform(&mut target)?;
        let parameters = self.parameter_values(&target);
        let magnitude = parameters.iter().fold(self.scale, |largest, value| largest.max(value.abs()));
        let frame = Frame::new(&parameters, magnitude, self.unknowns.len(), self.checks.code.len());
        Walk::new(self, &parameters, magnitude, Answers::new(self, frame, pairs)).run().map(take)
    }

    fn check_target(&self, target: &[f64]) -> Result<()> {
        let names = || self.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>().join(", ");
        if target.len() != self.inputs.len() {
            let text = format!("{} numbers given, {} expected: {}", target.len(), self.inputs.len(), names());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        match self.inputs.iter().zip(target).find(|(_, value)| !value.is_finite()) {
            Some((input, value)) => {
                let text = format!("`{}` is {value}; give a finite number", input.name);
                Err(Error::new(ErrorKind::BadValue, text))
            }
            None => Ok(()),
        }
    }

    /// The parameters' values for a checked target.
    fn parameter_values(&self, target: &[f64]) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(self.parameters.len());
        for parameter in &self.parameters {
            let value = match &parameter.rule {
                Rule::Input(index) => target[*index],
                Rule::Cosine(index) => target[*index].cos(),
                Rule::Sine(index) => target[*index].sin(),
                Rule::Following(law) => law.value(target),
                Rule::CosineFollowing(law) => law.value(target).cos(),
                Rule::SineFollowing(law) => law.value(target).sin(),
                Rule::Root { code, value } => {
                    let mut frame = Frame::new(&values, 0.0, 0, code.len());
                    frame.run(code);
                    frame.value(*value).max(0.0).sqrt()
                }
            };
            values.push(value);
        }
        values
    }

    fn mark_choice(&self, answers: &mut [Solution]) {
        let Some(preference) = self.preference else { return };
        let sign = if preference.greatest { -1.0 } else { 1.0 };
        let value = |answer: &Solution| {
            let mut unknowns = vec![0.0; self.unknowns.len()];
            refine::unknowns_of(self, &answer.q, &mut unknowns);
            sign * unknowns[preference.unknown]
        };
        let least = answers.iter().map(value).fold(f64::INFINITY, f64::min);
        for answer in answers {
            answer.chosen = value(answer) <= least + MERGE;
        }
    }
}

impl InverseKinematics for Program {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve(target, given)?;
        Ok(())
    }
}
