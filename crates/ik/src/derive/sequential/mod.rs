//! From a plan to a solver: each step's equations become a [`FormBasis`] with free symbols, proved on all strata, and the symbols
//! become code that computes their values from the target and the joints before.

mod cases;
pub mod certificate;
mod checks;
mod circle;
mod combination;
mod context;
mod determinant;
mod eliminate;
mod emit;
mod form_basis;
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
mod stages;
mod standing;
mod symbolic;
mod symbols;
mod target;

pub use eliminate::{Elimination, SymbolPlace};
pub use form_basis::{Form, FormBasis};
pub(super) use frame::frame_of;
pub use half_angle::{HalfAngle, HalfAngles};
pub(super) use program::checks_on;
pub use shape::Shape;
pub(super) use simultaneous::Stored as StoredSimultaneous;
pub use simultaneous::{Side, Simultaneous};
pub(super) use stages::{joint_unknowns, name};
pub(super) use symbolic::{Symbolic, TargetPoly};

use slack::Slack;

use super::closure::{Mechanism, Relation};
use super::planner::{self, Plan, PlanStep};
use crate::solver::Program;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::ideal::Report;

/// A step of a plan whose equations have been recognised.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ProvedStep {
    /// The place of the joint.
    pub joint: usize,
    /// The equations.
    pub relations: Vec<Relation>,
    /// What is left when other joints are eliminated from them, where that is done.
    pub elimination: Option<Elimination>,
    /// The shape in the joint.
    pub shape: Shape,
}

/// What a program is made of, proved.
struct Parts {
    plan: Plan,
    steps: Vec<ProvedStep>,
    form_bases: Vec<FormBasis>,
    half_angles: Option<HalfAngles>,
}

/// The derivation of a chain's solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// The chain whose loop is solved.
    pub chain: Chain,
    /// The chain that answers are polished and measured on, where `chain` is its ideal, and how they differ.
    pub truth: Option<(Chain, Report)>,
    /// In which order its joints are found.
    pub plan: Plan,
    /// The steps.
    pub steps: Vec<ProvedStep>,
    /// The forms that the steps use, solved.
    pub form_bases: Vec<FormBasis>,
    /// The half angles, where a step has an equation of degree two in cosine and sine.
    pub half_angles: Option<HalfAngles>,
    /// The solver.
    pub program: Program,
    /// The solver of the ideal chain itself, where `program` polishes its answers on another.
    pub unpolished: Option<Box<Program>>,
}

impl Derived {
    /// Plans, derives and proves the solver of `chain` for its task.
    ///
    /// # Errors
    /// As [`planner::plan`]; [`crate::ErrorKind::Unsupported`] for a step that no form fits.
    pub fn of_chain(chain: &Chain, watch: &Watch) -> Result<Self> {
        let mechanism = Mechanism::new(chain)?;
        let plan = planner::plan(&mechanism, watch)?;
        let evidence = plan.evidence[0].clone();
        let told = |error: Error| match error.kind() {
            ErrorKind::Unsupported => planner::not_derived(&mechanism, &evidence, &error),
            _ => error,
        };
        Derived::of_plan(chain, &mechanism, plan, watch).map_err(told)
    }

    /// This solver, of an ideal chain, for the chain `truth` that means it: `report` of [`Chain::ideal`] tells how they differ. Every answer of the closed
    /// form is polished by Newton's method on `truth`, and measured there. Where the task asks for more than the joints can do, the ideal chain decides which
    /// answers there are.
    ///
    /// # Errors
    /// As [`Mechanism::new`]; [`crate::ErrorKind::Unsupported`] for what a program cannot hold.
    pub fn polished_on(self, truth: &Chain, report: Report) -> Result<Self> {
        let Derived { chain, plan, steps, form_bases, half_angles, program: unpolished, .. } = self;
        let parts = Parts { plan, steps, form_bases, half_angles };
        let mechanism = Mechanism::new(&chain)?;
        let mut derived = Derived::assemble(&chain, &mechanism, parts, Slack::within(report.deviation()))?;
        match program::described_by(&mechanism, truth, &report, &derived.program)? {
            None => {
                derived.program.checks = program::checks_on(&chain, truth)?;
                derived.program.nearby = true;
            }
            described => derived.program.described = described,
        }
        derived.truth = Some((truth.clone(), report));
        derived.unpolished = Some(Box::new(unpolished));
        Ok(derived)
    }

    /// The chain that answers are measured on.
    pub fn measured(&self) -> &Chain {
        self.truth.as_ref().map_or(&self.chain, |(truth, _)| truth)
    }

    /// Derives and proves `plan`, one of `mechanism`, which is that of `chain`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Certificate`] that names the step when the plan is wrong; [`crate::ErrorKind::Unsupported`] for a step that
    /// no form fits; what `watch` stops with.
    pub fn of_plan(chain: &Chain, mechanism: &Mechanism, plan: Plan, watch: &Watch) -> Result<Self> {
        let mut eliminate = |step: &PlanStep, away: &[usize]| Elimination::derive(mechanism, step, away, watch);
        let steps = certificate::prove_plan(mechanism, &plan, &mut eliminate)?;
        let (form_bases, half_angles) = forms(&steps, watch)?;
        Derived::assemble(chain, mechanism, Parts { plan, steps, form_bases, half_angles }, Slack::NONE)
    }

    fn assemble(chain: &Chain, mechanism: &Mechanism, parts: Parts, slack: Slack) -> Result<Self> {
        let program = program::compile(chain, mechanism, &parts, slack)?;
        let Parts { plan, steps, form_bases, half_angles } = parts;
        Ok(Derived {
            chain: chain.clone(),
            truth: None,
            plan,
            steps,
            form_bases,
            half_angles,
            program,
            unpolished: None,
        })
    }
}

/// The forms that `steps` use, solved and proved.
///
/// # Errors
/// What `watch` stops with.
fn forms(steps: &[ProvedStep], watch: &Watch) -> Result<(Vec<FormBasis>, Option<HalfAngles>)> {
    let half_angles = HalfAngles::are_needed(steps).then(|| HalfAngles::derive(watch)).transpose()?;
    let form_bases = FormBasis::needed(steps).into_iter().map(|form| FormBasis::derive(form, watch));
    Ok((form_bases.collect::<Result<_>>()?, half_angles))
}
