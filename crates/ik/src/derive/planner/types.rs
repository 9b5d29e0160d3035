//! The planner's result: [`Plan`].

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::derive::closure::Relation;

/// The relations by which a step finds its joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(clippy::large_enum_variant, reason = "a plan has a handful of them")]
pub enum StepMethod {
    /// One relation in which no other joint is unknown: a linear equation in c and s' (two solutions), or one in d'.
    Single(Relation),
    /// Two relations that are linear and independent in c and s' of the joint: one solution.
    Pair([Relation; 2]),
    /// Relations from which the joints `away` are eliminated. The result determines the joint.
    Eliminated {
        /// As many relations as unknown joints.
        relations: Vec<Relation>,
        /// The indices of the eliminated joints.
        away: Vec<usize>,
    },
}

impl StepMethod {
    /// All relations of the step.
    pub fn relations(&self) -> &[Relation] {
        match self {
            StepMethod::Single(relation) => std::slice::from_ref(relation),
            StepMethod::Pair(pair) => pair,
            StepMethod::Eliminated { relations, .. } => relations,
        }
    }
}

/// A step that determines one joint, given those of earlier steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanStep {
    /// The index of the joint.
    pub joint: usize,
    /// The relations that determine it.
    #[serde(alias = "way")]
    pub method: StepMethod,
    /// The number of solutions, given the earlier joints.
    pub degree: usize,
}

/// The counted solutions of a random reachable pose modulo a prime.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Evidence {
    /// The prime.
    pub prime: u32,
    /// The random seed of the pose.
    pub seed: u64,
    /// The number of complex solutions, with multiplicity: the dimension of the quotient by all equations.
    pub dimension: usize,
    /// The number of values of each joint: the degree of the minimal polynomial of a random linear form of its unknowns. A given joint has 1.
    pub degrees: Vec<usize>,
}

impl fmt::Display for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Evidence { prime, seed, dimension, degrees } = self;
        let degrees = degrees.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        write!(
            f,
            "A random pose modulo {prime} (seed {seed}) has {dimension} complex solutions; values of the joints: {degrees}."
        )
    }
}

/// The order in which the joints are found, one at a time.
///
/// Every relation is in the ideal of the loop, so no solution is lost. The product of the degrees is the number of complex solutions, so there are no
/// additional ones.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// The indices of the joints that the user gives.
    pub given: Vec<usize>,
    /// The number of complex solutions at a generic reachable target.
    pub dimension: usize,
    /// The evidence of three random targets.
    pub evidence: Vec<Evidence>,
    /// The steps, one for each joint that is not given.
    pub steps: Vec<PlanStep>,
}

impl Plan {
    /// The product of the steps' degrees.
    pub fn product(&self) -> usize {
        self.steps.iter().map(|step| step.degree).product()
    }
}

/// One paragraph per step. Joints are counted from 1.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", plural(self.dimension, "solution"))?;
        if !self.given.is_empty() {
            write!(f, "; given: {}", joints(&self.given))?;
        }
        for (at, step) in self.steps.iter().enumerate() {
            write!(f, "\n{}. {}: {}", at + 1, joints(&[step.joint]), plural(step.degree, "solution"))?;
            match &step.method {
                StepMethod::Single(_) => f.write_str(", from one equation")?,
                StepMethod::Pair(_) => f.write_str(", from two linear equations")?,
                StepMethod::Eliminated { away, .. } => write!(f, ", with {} eliminated", joints(away))?,
            }
            for relation in step.method.relations() {
                write!(f, "\n   {relation}")?;
            }
        }
        Ok(())
    }
}

/// A count with its noun as text, such as `1 solution` or `2 solutions`.
fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// Joints counted from 1 as text, such as `joint 3` or `joints 1, 2`.
pub fn joints(places: &[usize]) -> String {
    let list: Vec<String> = places.iter().map(|place| (place + 1).to_string()).collect();
    format!("joint{} {}", if places.len() == 1 { "" } else { "s" }, list.join(", "))
}
