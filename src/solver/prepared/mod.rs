//! A program made ready to run: its code on one flat memory, on the run time that printed solvers call. Main type: [`Solver`].
//!
//! One target is solved number by number, many by several at once: each instruction then runs over all of them.

mod blocks;
mod code;
mod equations;
mod mechanism;
mod parameters;
mod run;
mod storage;

use groebot_runtime as runtime;
use groebot_runtime::storage::Array;
use serde::Serialize;

use self::blocks::Blocks;
use self::equations::Equations;
use self::parameters::Parameters;
use super::condition::conform;
use super::program::{Case, Condition, Input, Program};
use super::{Facts, Layout, Pairs};
use crate::kinematics::{InverseKinematics, Solution, Target};
use crate::{Error, ErrorKind, Result};
use runtime::Solve;

/// A [`Program`] made ready to run. It is made once and solves any number of targets, from several threads at once.
#[derive(Clone, Debug)]
pub struct Solver {
    inputs: Vec<Input>,
    conditions: Vec<Condition>,
    /// The labels of the strata that could not be derived.
    open: Vec<String>,
    facts: Facts,
    kinds: Kinds,
    parameters: Parameters,
    blocks: Blocks,
    tip: Equations,
    values: Equations,
    sizes: Equations,
    /// The derivatives, where the run time does not find them from the values.
    jacobian: Option<Equations>,
    /// The values of the short way's equations, then what they are shares of, then their derivatives, joint by joint.
    short: Equations,
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

/// Lists of facts in the run time's types.
#[derive(Clone, Debug)]
struct Kinds {
    joints: Vec<runtime::Joint>,
    conditions: Vec<runtime::Condition>,
    reached: Vec<runtime::Reached>,
}

impl Kinds {
    fn new(facts: &Facts) -> Self {
        let joint = |stands: &Vec<usize>| match stands[..] {
            [cosine, sine] => runtime::Joint::Angle([cosine, sine]),
            _ => runtime::Joint::Length(stands[0]),
        };
        let condition = |&(kind, first): &(&str, usize)| match kind {
            "Rotation" => runtime::Condition::Rotation(first),
            _ => runtime::Condition::Unit(first),
        };
        let reached = |(kind, numbers): &(&str, Vec<usize>)| match *kind {
            "Value" => runtime::Reached::Value(numbers[0]),
            "Angle" => runtime::Reached::Angle([numbers[0], numbers[1]]),
            _ => runtime::Reached::Joint(numbers[0]),
        };
        Kinds {
            joints: facts.joints.iter().map(joint).collect(),
            conditions: facts.conditions.iter().map(condition).collect(),
            reached: facts.reached.iter().map(reached).collect(),
        }
    }
}

impl Solver {
    /// The solver of a valid program ([`Program::validate`]).
    pub fn new(program: &Program) -> Self {
        let layout = Layout::new(program);
        let (facts, checks) = (Facts::new(&layout), &program.checks);
        let forward = program.forward().filter(|forward| !forward.inputs.is_empty());
        let tip = forward.iter().flat_map(|forward| &forward.equations);
        let tip: Vec<_> =
            tip.map(|equation| equation.map_or(super::Operand::Constant(0.0), |(value, _)| value)).collect();
        let mut short: Vec<_> = checks.short.iter().map(|short| short.residual).collect();
        short.extend(checks.short.iter().map(|short| short.scale));
        let joints = 0..program.joints.len();
        short.extend(joints.flat_map(|joint| checks.short.iter().map(move |short| short.derivatives[joint])));
        Solver {
            inputs: program.inputs.clone(),
            conditions: program.conditions.clone(),
            open: program.cases().filter(|case| case.open).map(|case: &Case| case.label.clone()).collect(),
            kinds: Kinds::new(&facts),
            parameters: Parameters::new(program),
            blocks: Blocks::new(&layout),
            tip: Equations::new(&layout, &tip),
            values: Equations::new(&layout, &checks.residuals),
            sizes: Equations::new(&layout, &facts.sizes),
            jacobian: (!facts.are_affine).then(|| Equations::new(&layout, checks.jacobian.iter().flatten())),
            short: Equations::new(&layout, &short),
            facts,
        }
    }

    /// All real solutions for `target` and the values `given` of the joints that the user gives, by branch: empty when the target is unreachable. Lengths
    /// are in the program's unit.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`]; [`ErrorKind::BadValue`] for a target of another task.
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
        let mut out = self.room(1);
        let count = Solve::solve(self, &self.row(target)?, &mut out).map_err(|error| self.refused(target, error))?;
        Ok(out[..count].iter().map(solution).collect())
    }

    /// The answers of [`Solver::solve_numbers`] by cosines and sines. Where all candidates solve the equations within rounding and are apart, as
    /// at ordinary targets, these are the numbers that angles are taken of, and no arc tangent is; else they are those of the angles.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        let mut out = vec![runtime::Pairs::empty(self); self.facts.capacity];
        let found = Solve::solve_pairs(self, &self.row(target)?, &mut out);
        let count = found.map_err(|error| self.refused(target, error))?;
        let pairs = |pairs: &runtime::Pairs<Self>| Pairs {
            joints: pairs.joints.as_ref().to_vec(),
            residual: pairs.residual,
            branch: pairs.branch,
            free: joints_of(pairs.free),
        };
        Ok(out[..count].iter().map(pairs).collect())
    }

    /// Where `target` has no solution: of the candidates the one that misses the equations by the least share of their size, as far as polishing brings
    /// it; none when there is no such candidate.
    ///
    /// # Errors
    /// As [`Solver::solve_numbers`].
    pub fn nearest(&self, target: &[f64]) -> Result<Option<Nearest>> {
        let found = Solve::solve_or_nearest(self, &self.row(target)?, &mut self.room(1));
        let (_, nearest) = found.map_err(|error| self.refused(target, error))?;
        Ok(nearest.map(|nearest| Nearest {
            q: nearest.q.as_ref().to_vec(),
            residual: nearest.residual,
            relative: nearest.relative,
        }))
    }

    /// The target that joint values reach (radians, and the program's length unit): the one that [`Solver::solve_numbers`] takes. None for a program whose
    /// equations do not compare each number of the target with something that only the joints have, or for another number of joint values.
    pub fn reached(&self, q: &[f64]) -> Option<Vec<f64>> {
        let q = (q.len() == self.facts.joints.len()).then(|| Array::by(q.len(), |i| q[i]))?;
        self.forward(&q).map(|target| target.as_ref().to_vec())
    }

    /// Room for the solutions of so many targets.
    pub(super) fn room(&self, targets: usize) -> Vec<runtime::Solution<Self>> {
        vec![runtime::Solution::empty(self); targets * self.facts.capacity]
    }

    /// A target of the right length.
    fn row(&self, target: &[f64]) -> Result<runtime::mechanism::Inputs<Self>> {
        if target.len() != self.inputs.len() {
            let names: Vec<&str> = self.inputs.iter().map(|input| input.name.as_str()).collect();
            let text = format!("{} numbers given, {} expected: {}", target.len(), self.inputs.len(), names.join(", "));
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Array::by(target.len(), |i| target[i]))
    }

    /// Why a target of the right length is refused.
    pub(super) fn refused(&self, target: &[f64], error: runtime::Error) -> Error {
        if let runtime::Error::OpenStratum(number) = error {
            let label = self.open.get(number.wrapping_sub(1)).map_or("", String::as_str);
            let text = format!("the target lies on `{label}`, a stratum that could not be derived");
            return Error::new(ErrorKind::Unsupported, text);
        }
        let not_finite = self.inputs.iter().zip(target).find(|(_, value)| !value.is_finite());
        let text = match not_finite {
            Some((input, value)) => format!("`{}` is {value}; give a finite number", input.name),
            None => conform(&self.conditions, &self.inputs, target).unwrap_or_else(|| error.to_string()),
        };
        Error::new(ErrorKind::BadValue, text)
    }
}

impl InverseKinematics for Solver {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve(target, given)?;
        Ok(())
    }
}

/// An answer as all solvers give it.
fn solution(found: &runtime::Solution<Solver>) -> Solution {
    Solution {
        q: found.q.as_ref().to_vec(),
        residual: found.residual,
        branch: found.branch,
        free: joints_of(found.free),
        chosen: found.chosen,
    }
}

/// The joints whose bits are set.
fn joints_of(bits: u32) -> Vec<usize> {
    (0..u32::BITS as usize).filter(|joint| bits >> joint & 1 == 1).collect()
}
