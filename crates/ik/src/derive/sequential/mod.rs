//! From a plan to a solver. Each step's equations become a [`FormBasis`] with free symbols, proved on all strata. The symbols become code that computes their
//! values from the target and the earlier joints.

mod cases;
pub(super) mod certificate;
mod checks;
mod circle;
mod combination;
mod context;
mod determinant;
mod eliminate;
mod emit;
mod form_basis;
mod forms;
mod frame;
mod half_angle;
mod layout;
mod program;
mod ray;
mod samples;
mod shape;
mod simultaneous;
mod slack;
mod squares;
mod symbolic;
mod symbols;
mod target;
mod upright_loop;

pub use eliminate::{Elimination, SymbolPlace};
pub use form_basis::{Form, FormBasis};
pub use forms::Forms;
pub(super) use frame::frame_of;
pub use half_angle::{HalfAngle, HalfAngles};
pub(super) use program::checks_on;
pub use shape::Shape;
pub(super) use simultaneous::Stored as StoredSimultaneous;
pub use simultaneous::{Side, Simultaneous};
pub(super) use symbolic::{Symbolic, TargetPoly};

use slack::Slack;

use super::closure::{Mechanism, Relation};
use super::planner::{self, Plan, PlanStep};
use super::problem::ChainProblem;
use super::view::View;
use crate::solver::Program;
use crate::{Error, ErrorKind, Result, Watch};

/// A step of a plan whose form is known.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProvedStep {
    /// The index of the joint.
    pub joint: usize,
    /// The equations.
    pub relations: Vec<Relation>,
    /// The elimination of other joints from the equations, if the step has one.
    pub elimination: Option<Elimination>,
    /// The form of the equations in the joint.
    pub shape: Shape,
}

/// The proved solution of a chain, one joint at a time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sequential {
    /// The order in which the joints are found.
    pub plan: Plan,
    /// The steps.
    pub steps: Vec<ProvedStep>,
    /// The forms that the steps use, solved.
    pub forms: Forms,
}

/// The view of a chain that is solved one joint at a time.
pub type SequentialView<'a> = View<'a, ChainProblem, Sequential>;

impl Sequential {
    /// Plans, derives and proves the solution of `problem`, and compiles its solver.
    ///
    /// # Errors
    /// As [`planner::plan`]; [`crate::ErrorKind::Unsupported`] for a step that no form fits.
    pub(super) fn derive(problem: &ChainProblem, watch: &Watch) -> Result<(Self, Program)> {
        let mechanism = Mechanism::new(&problem.chain)?;
        let plan = planner::plan(&mechanism, watch)?;
        let evidence = plan.evidence[0].clone();
        let described = |error: Error| match error.kind() {
            ErrorKind::Unsupported => planner::not_derived(&mechanism, &evidence, &error),
            _ => error,
        };
        Sequential::of_plan(&mechanism, plan, watch)
            .and_then(|method| method.compiled(problem, &mechanism))
            .map_err(described)
    }

    /// Derives and proves `plan`, a plan of `mechanism`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Certificate`] that names the step, if the plan is wrong. [`crate::ErrorKind::Unsupported`] for a step that no form fits. The error
    /// of `watch` if it stops the derivation.
    pub(super) fn of_plan(mechanism: &Mechanism, plan: Plan, watch: &Watch) -> Result<Self> {
        let mut eliminate = |step: &PlanStep, away: &[usize]| Elimination::derive(mechanism, step, away, watch);
        let steps = certificate::prove_plan(mechanism, &plan, &mut eliminate)?;
        let forms = Forms::of(&steps)?;
        Ok(Sequential { plan, steps, forms })
    }

    /// Adds the program of `problem`, whose mechanism is `mechanism`.
    ///
    /// Newton's method polishes every solution of the closed form on the described chain, and solutions are measured there. If the task is overdetermined (more
    /// numbers than independent joints), the ideal chain decides which solutions exist.
    ///
    /// # Errors
    /// As [`Mechanism::new`]; [`crate::ErrorKind::Unsupported`] for a problem that a program cannot represent.
    pub(super) fn compiled(self, problem: &ChainProblem, mechanism: &Mechanism) -> Result<(Self, Program)> {
        let program = program::of_problem(problem, mechanism, &self)?;
        Ok((self, program))
    }
}

impl SequentialView<'_> {
    /// The solver of the ideal chain itself, if the program polishes its solutions on another chain.
    ///
    /// # Errors
    /// As [`Mechanism::new`].
    pub(crate) fn unpolished(&self) -> Result<Option<Program>> {
        let ideal =
            || program::compile(&self.problem.chain, &Mechanism::new(&self.problem.chain)?, self.method, Slack::NONE);
        self.problem.truth.as_ref().map(|_| ideal()).transpose()
    }
}
