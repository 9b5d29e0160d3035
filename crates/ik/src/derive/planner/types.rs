//! What the planner returns: [`Plan`].

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::derive::closure::Relation;

/// How a step finds its joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(clippy::large_enum_variant, reason = "a plan has a handful of them")]
pub enum Way {
    /// One relation in which no other joint is unknown: a linear equation in c and s' (two solutions), or one in d'.
    Single(Relation),
    /// Two relations that are linear and independent in c and s' of the joint: one solution.
    Pair([Relation; 2]),
    /// Relations from which the joints `away` are eliminated; what is left determines the joint.
    Eliminated {
        /// As many as unknown joints.
        relations: Vec<Relation>,
        /// The places of the joints that are eliminated.
        away: Vec<usize>,
    },
}

impl Way {
    /// Its relations.
    pub fn relations(&self) -> &[Relation] {
        match self {
            Way::Single(relation) => std::slice::from_ref(relation),
            Way::Pair(pair) => pair,
            Way::Eliminated { relations, .. } => relations,
        }
    }
}

/// One joint determined, given those of the steps before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanStep {
    /// The place of the joint.
    pub joint: usize,
    /// How it is found.
    pub way: Way,
    /// The number of solutions, given the joints before.
    pub degree: usize,
}

/// What a random reachable pose modulo a prime showed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Evidence {
    /// The prime.
    pub prime: u32,
    /// What the pose was drawn with.
    pub seed: u64,
    /// The number of complex solutions, with multiplicity: the dimension of the quotient by all equations.
    pub dimension: usize,
    /// For each joint the degree of the minimal polynomial of a random linear form of its unknowns: the number of its values. A
    /// given joint has 1.
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

/// The order in which the joints are found, one at a time. Every relation is in the ideal of the loop, so no solution is lost; the
/// product of the degrees is the number of complex solutions, so none is added.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// The places of the joints that the user gives.
    pub given: Vec<usize>,
    /// The number of complex solutions at a generic reachable target.
    pub dimension: usize,
    /// What three random targets showed.
    pub evidence: Vec<Evidence>,
    /// One for each joint that is not given.
    pub steps: Vec<PlanStep>,
}

impl Plan {
    /// The product of the steps' degrees.
    pub fn product(&self) -> usize {
        self.steps.iter().map(|step| step.degree).product()
    }
}

/// One paragraph a step; joints are counted from 1.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", plural(self.dimension, "solution"))?;
        if !self.given.is_empty() {
            write!(f, "; given: {}", joints(&self.given))?;
        }
        for (at, step) in self.steps.iter().enumerate() {
            write!(f, "\n{}. {}: {}", at + 1, joints(&[step.joint]), plural(step.degree, "solution"))?;
            match &step.way {
                Way::Single(_) => f.write_str(", from one equation")?,
                Way::Pair(_) => f.write_str(", from two linear equations")?,
                Way::Eliminated { away, .. } => write!(f, ", with {} eliminated", joints(away))?,
            }
            for relation in step.way.relations() {
                write!(f, "\n   {relation}")?;
            }
        }
        Ok(())
    }
}

/// `1 solution`, `2 solutions`.
fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// `joint 3`, `joints 1, 2`: counted from 1.
pub fn joints(places: &[usize]) -> String {
    let list: Vec<String> = places.iter().map(|place| (place + 1).to_string()).collect();
    format!("joint{} {}", if places.len() == 1 { "" } else { "s" }, list.join(", "))
}
