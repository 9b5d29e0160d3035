//! From a plan to a solver: each step's equations become a [`Template`] with free symbols, proved on all strata, and the symbols
//! become code that computes their values from the target and the joints before.

mod charts;
mod checks;
mod emit;
mod layout;
mod program;
mod shape;
mod template;

pub use shape::{Shape, shape};
pub use template::{Form, Template};

use super::closure::{Mechanism, Relation};
use super::planner::Plan;
use crate::kinematics::Chain;
use crate::solver::Program;
use crate::{Result, Watch};

/// A step of a plan whose equations have been recognised.
#[derive(Clone, Debug, PartialEq)]
pub struct Lifted {
    /// The place of the joint.
    pub joint: usize,
    /// The equations.
    pub relations: Vec<Relation>,
    /// Their shape in the joint.
    pub shape: Shape,
}

/// The derivation of a chain's solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// The chain.
    pub chain: Chain,
    /// In which order its joints are found.
    pub plan: Plan,
    /// The steps.
    pub steps: Vec<Lifted>,
    /// The forms that the steps use, solved.
    pub templates: Vec<Template>,
    /// The solver.
    pub program: Program,
}

impl Derived {
    /// Lifts `plan`, one of `mechanism`, which is that of `chain`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Unsupported`] for a step that no form fits; what `watch` stops with.
    pub fn new(chain: &Chain, mechanism: &Mechanism, plan: Plan, watch: &Watch) -> Result<Self> {
        let mut steps = Vec::new();
        let mut templates: Vec<Template> = Vec::new();
        for step in &plan.steps {
            watch.check()?;
            let shape = shape::shape(mechanism, step)?;
            for form in shape.form.needs() {
                if !templates.iter().any(|template| template.form == *form) {
                    templates.push(Template::derive(*form, watch)?);
                }
            }
            steps.push(Lifted { joint: step.joint, relations: step.way.relations().to_vec(), shape });
        }
        let program = program::compile(chain, mechanism, plan.dimension, &steps, &templates)?;
        Ok(Derived { chain: chain.clone(), plan, steps, templates, program })
    }
}
