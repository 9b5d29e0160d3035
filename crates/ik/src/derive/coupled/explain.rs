//! The reason why a target of several chains has no solution: [`Explanation`].

use std::fmt;

use super::method::{ChainStage, CoupledView};
use crate::derive::problem::ChainProblem;
use crate::derive::sequential::Sequential;
use crate::solver::{Nearest, Program, Unit};
use crate::{ErrorKind, Result, Watch};
use groebot_robot::kinematics::Solution;
use groebot_robot::spatial::angle;

/// The chain at which a target fails, and the reason.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Explanation {
    /// The name of the chain.
    pub member: String,
    /// The number of solutions of the earlier chains.
    pub before: usize,
    /// The least difference between the values that the chains need for a shared actuator, if the chain reaches its target alone.
    pub disagreement: Option<Disagreement>,
    /// The nearest candidate of the chain's own joints, with the shared joints near one of the earlier chains' solutions. `None` if the equations have no real
    /// candidate, which occurs far outside the workspace.
    pub nearest: Option<Nearest>,
}

/// A shared actuator that two chains need at different values. Of all their solutions, it is for the two that differ least.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Disagreement {
    /// The actuator's name.
    pub actuator: String,
    /// The unit of its values.
    pub unit: Unit,
    /// The value that the chain needs to reach its target.
    pub needed: f64,
    /// The value in a solution of the earlier chains.
    pub found: f64,
}

impl Disagreement {
    /// `needed - found`. For angles it is the difference in (-pi, pi].
    pub fn off(&self) -> f64 {
        match self.unit {
            Unit::Radian => angle::difference(self.needed, self.found),
            _ => self.needed - self.found,
        }
    }
}

/// The solutions of a program. They are empty if the step limit of a target is reached, which occurs next to targets that are just out of reach.
fn answers_of(program: &Program, target: &[f64]) -> Result<Vec<Solution>> {
    match program.solve_numbers(target) {
        Err(error) if error.kind() == ErrorKind::Budget => Ok(Vec::new()),
        found => found,
    }
}

impl CoupledView<'_> {
    /// The first chain that does not reach its part of `target` together with the earlier chains. `None` if there is a solution.
    ///
    /// # Errors
    /// As [`crate::solver::Program::solve_numbers`]. The error of `watch` if it stops the derivation.
    pub fn explain<'w>(&self, target: &[f64], watch: impl Into<Option<&'w Watch>>) -> Result<Option<Explanation>> {
        let watch = Watch::or_none(watch);
        if !answers_of(self.program, target)?.is_empty() {
            return Ok(None);
        }
        match &self.method.simultaneous {
            Some(_) => self.together(target, watch).map(Some),
            None => self.in_turn(target, watch),
        }
    }

    /// The explanation for chains that are solved one after the other.
    fn in_turn(&self, target: &[f64], watch: &Watch) -> Result<Option<Explanation>> {
        let mut before = vec![Vec::new()];
        for stage in &self.method.stages {
            let answers = answers_of(&stage.program, &target[..stage.program.inputs.len()])?;
            if answers.is_empty() {
                let nearest = before.iter().map(|q| stage.solver.nearest(&stage.target(target, q)));
                let nearest: Vec<Option<Nearest>> = nearest.collect::<Result<_>>()?;
                let nearest = nearest.into_iter().flatten().min_by(|a, b| a.relative.total_cmp(&b.relative));
                let count = if stage == &self.method.stages[0] { 0 } else { before.len() };
                let member = self.problem.chains()[stage.member].name.clone();
                let disagreement = match self.alone(stage, watch)? {
                    Some(alone) => self.disagreement(stage, &before, &alone.solve_numbers(&stage.own_target(target))?),
                    None => None,
                };
                return Ok(Some(Explanation { member, before: count, disagreement, nearest }));
            }
            before = answers.into_iter().map(|answer| answer.q).collect();
        }
        Ok(None)
    }

    /// The explanation for shared joints that are found from both chains together. It names the chain that does not reach its target alone, or the difference
    /// between the values of a shared joint. It names both chains if neither can be solved alone.
    fn together(&self, target: &[f64], watch: &Watch) -> Result<Explanation> {
        let mut before: Vec<Vec<f64>> = Vec::new();
        let mut disagreement = None;
        for stage in &self.method.stages {
            let Some(alone) = self.alone(stage, watch)? else { break };
            let own = stage.own_target(target);
            let answers = answers_of(&alone, &own)?;
            let member = self.problem.chains()[stage.member].name.clone();
            if answers.is_empty() {
                return Ok(Explanation { member, before: 0, disagreement: None, nearest: alone.nearest(&own)? });
            }
            if !before.is_empty() {
                disagreement = self.disagreement(stage, &before, &answers);
                return Ok(Explanation { member, before: before.len(), disagreement, nearest: None });
            }
            before = answers.iter().map(|answer| stage.put(&answer.q, self.program.joints.len())).collect();
        }
        let names: Vec<&str> = self.problem.chains().iter().map(|member| member.name.as_str()).collect();
        Ok(Explanation {
            member: names.join("` and `"),
            before: 0,
            disagreement,
            nearest: self.program.nearest(target)?,
        })
    }

    /// The solver of a chain as if it shared no joints. `None` if it shares none, if its task does not determine all its joints, or if the user gives joints.
    fn alone(&self, stage: &ChainStage, watch: &Watch) -> Result<Option<Program>> {
        let chain = &self.problem.chains()[stage.member].chain;
        let is_open = chain.joints().len() > chain.task().freedoms() || !chain.given().is_empty();
        if is_open || stage.found().next().is_none() {
            return Ok(None);
        }
        Ok(Some(Sequential::derive(&ChainProblem::from(chain), watch)?.1))
    }

    /// The smallest difference in the shared actuators between the chain's own solutions `answers` and the solutions `before` of the earlier chains. `None` if
    /// there are no solutions.
    fn disagreement(&self, stage: &ChainStage, before: &[Vec<f64>], answers: &[Solution]) -> Option<Disagreement> {
        let shared: Vec<usize> = stage.found().collect();
        let one = |earlier: &Vec<f64>, answer: &Solution, actuator: usize| Disagreement {
            actuator: self.program.joints[actuator].name.clone(),
            unit: self.program.joints[actuator].unit,
            needed: stage.joints.iter().position(|place| *place == actuator).map_or(f64::NAN, |joint| answer.q[joint]),
            found: earlier[actuator],
        };
        let larger = |a: &Disagreement, b: &Disagreement| a.off().abs().total_cmp(&b.off().abs());
        let pairs = before.iter().flat_map(|earlier| answers.iter().map(move |answer| (earlier, answer)));
        let worst = pairs.filter_map(|(earlier, answer)| {
            shared.iter().map(|&actuator| one(earlier, answer, actuator)).max_by(larger)
        });
        worst.min_by(larger)
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(disagreement) = &self.disagreement {
            let Disagreement { actuator, unit, needed, found } = disagreement;
            let unit = if *unit == Unit::Radian { "rad" } else { "in its length unit" };
            return write!(
                f,
                "the chains' targets contradict each other: chain `{}` needs `{actuator}` at {needed:.9}, {:.3e} {unit} off the nearest \
                 value {found:.9} at which the chains before it reach theirs",
                self.member,
                disagreement.off().abs()
            );
        }
        write!(f, "the equations of chain `{}` fail", self.member)?;
        match self.before {
            0 => {}
            count => write!(f, " for each of the {count} solutions of the chains before it")?,
        }
        match &self.nearest {
            Some(nearest) => write!(f, "; the nearest joints found leave a residual of {:.1e}", nearest.residual),
            None => f.write_str("; no real candidate is near"),
        }
    }
}
