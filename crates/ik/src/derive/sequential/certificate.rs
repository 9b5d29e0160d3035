//! The stored proof of a chain's solver: the plan with its relations, and the strata of each form with cofactors.
//!
//! A reader proves everything again, without the searches:
//! * Every relation is reduced to its normal form modulo the loop ([`crate::derive::closure::prove`]).
//! * Every step may use only what is known before it, and its equations must have the form that the plan's count of solutions assumes.
//! * [`groebot_algebra::groebner::verify`] checks the bases of every form on all strata.
//!
//! So no solution is lost, and the product of the degrees is the number of solutions that the plan claims. That number was counted modulo primes. The
//! certificate stores the poses of the count, and [`crate::derive::Recount`] repeats it.

use serde::{Deserialize, Serialize};

use super::eliminate::{self, Elimination};
use super::forms::{Forms, NamedForm};
use super::shape::{eliminated, shape};
use super::{ProvedStep, Sequential, SequentialView};
use crate::derive::closure::{self, Mechanism};
use crate::derive::equations::certificate::refused;
use crate::derive::planner::{Plan, PlanStep, StepMethod};
use crate::derive::problem::ChainProblem;
use crate::solver::Program;
use crate::{Error, Result};
use groebot_robot::document::{Certificate, Proves};

/// The claims about a chain.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::derive) struct Claims {
    plan: Plan,
    forms: Vec<NamedForm>,
    /// The eliminations, in the order of the steps that need one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    eliminations: Vec<eliminate::Stored>,
}
/// The text of `certificate.json`.
///
/// # Errors
/// If a form's field cannot be built. This does not occur for a derivation that this crate made.
pub(in crate::derive) fn write(derived: SequentialView<'_>) -> Result<String> {
    Ok(certificate(derived)?.to_json())
}

/// The certificate as data.
///
/// # Errors
/// As [`write`].
pub(in crate::derive) fn certificate(derived: SequentialView<'_>) -> Result<Certificate<Claims>> {
    Ok(Certificate::new(Proves::Chain, derived.problem.chain.name(), claims(derived)?))
}

/// The claims of the certificate.
///
/// # Errors
/// As [`write`].
pub(in crate::derive) fn claims(derived: SequentialView<'_>) -> Result<Claims> {
    Ok(Claims {
        plan: derived.method.plan.clone(),
        forms: derived.method.forms.named(),
        eliminations: derived
            .method
            .steps
            .iter()
            .filter_map(|step| step.elimination.as_ref())
            .map(Elimination::stored)
            .collect(),
    })
}

/// Proves the solution of `problem` again from the text of its certificate, and compiles its solver. It uses no search and no Groebner engine.
///
/// # Errors
/// [`crate::ErrorKind::Syntax`] with the line for text that is not a certificate. [`crate::ErrorKind::Certificate`] with the step or the form for a false
/// claim.
pub(in crate::derive) fn prove(problem: &ChainProblem, text: &str) -> Result<(Sequential, Program)> {
    prove_claims(problem, Certificate::read(text, Proves::Chain, problem.chain.name())?)
}

/// Proves the solution of `problem` again from its claims.
///
/// # Errors
/// [`crate::ErrorKind::Certificate`] as [`prove`].
pub(in crate::derive) fn prove_claims(problem: &ChainProblem, claims: Claims) -> Result<(Sequential, Program)> {
    let mechanism = Mechanism::new(&problem.chain)?;
    let mut stored = claims.eliminations.iter();
    let mut eliminate = |step: &PlanStep, away: &[usize]| match stored.next() {
        Some(stored) => Elimination::reprove(&mechanism, step, away, stored),
        None => Err(refused("its elimination is missing".to_owned())),
    };
    let steps = prove_plan(&mechanism, &claims.plan, &mut eliminate)?;
    if stored.next().is_some() {
        return Err(refused("an elimination is superfluous".to_owned()));
    }
    let forms = Forms::reprove(&steps, &claims.forms)?;
    Sequential { plan: claims.plan, steps, forms }.compiled(problem, &mechanism)
}

/// A function that returns the proved elimination of joints from a step.
type Eliminate<'a> = dyn FnMut(&PlanStep, &[usize]) -> Result<Elimination> + 'a;

/// Proves every step of `plan`. Together the steps find each joint once, with as many solutions as the plan claims.
///
/// # Errors
/// [`crate::ErrorKind::Certificate`] that names the step.
pub(super) fn prove_plan(mechanism: &Mechanism, plan: &Plan, eliminate: &mut Eliminate<'_>) -> Result<Vec<ProvedStep>> {
    let count = mechanism.joints().len();
    if plan.given != mechanism.given() {
        return Err(refused("the plan's given joints are not those of the chain".to_owned()));
    }
    let mut known = plan.given.clone();
    let mut steps = Vec::new();
    for (index, step) in plan.steps.iter().enumerate() {
        let proved = match step.joint < count {
            true => prove_step(mechanism, step, &known, eliminate),
            false => Err(refused("no such joint".to_owned())),
        };
        let name = mechanism.joints().get(step.joint).map_or("?", |joint| joint.name.as_str());
        let of_step =
            |error: Error| Error::new(error.kind(), format!("step {}, `{name}`: {}", index + 1, error.message()));
        steps.push(proved.map_err(of_step)?);
        known.push(step.joint);
    }
    if steps.len() + plan.given.len() != count {
        return Err(refused("the plan does not find every joint".to_owned()));
    }
    // The equations that the plan does not use leave fewer solutions, if the task is overdetermined (more numbers than independent joints) or if joints follow
    // others.
    let exact = mechanism.counts_exactly();
    if !exact && most(plan) < plan.dimension || exact && plan.product() != plan.dimension {
        let text = format!("the steps give {} solutions, {} are claimed", plan.product(), plan.dimension);
        return Err(refused(text));
    }
    Ok(steps)
}

/// The maximum number of solutions of all steps together, for overdetermined tasks (more numbers than independent joints). Two equations in one joint may be
/// dependent then.
fn most(plan: &Plan) -> usize {
    let most = |step: &PlanStep| if matches!(step.method, StepMethod::Pair(_)) { 2 } else { step.degree };
    plan.steps.iter().map(most).product()
}

fn prove_step(
    mechanism: &Mechanism,
    step: &PlanStep,
    known: &[usize],
    eliminate: &mut Eliminate<'_>,
) -> Result<ProvedStep> {
    let away: &[usize] = if let StepMethod::Eliminated { away, .. } = &step.method { away } else { &[] };
    if known.contains(&step.joint) {
        return Err(refused("the joint is known already".to_owned()));
    }
    for relation in step.method.relations() {
        let is_new = |joint: &usize| *joint != step.joint && !known.contains(joint) && !away.contains(joint);
        if let Some(other) = relation.joints().into_iter().find(is_new) {
            return Err(refused(format!("`{relation}` contains joint {}, which is not known yet", other + 1)));
        }
        closure::prove(mechanism, relation)?;
    }
    let elimination = if away.is_empty() { None } else { Some(eliminate(step, away)?) };
    let shape = match &elimination {
        Some(elimination) => eliminated(mechanism, step, elimination)?,
        None => shape(mechanism, step)?,
    };
    // The result of an elimination may have a form of higher degree than its number of solutions.
    let fits =
        if elimination.is_some() { step.degree <= shape.form.degree() } else { step.degree == shape.form.degree() };
    if !fits {
        let text = format!("its equations give {} solutions, {} are claimed", shape.form.degree(), step.degree);
        return Err(refused(text));
    }
    Ok(ProvedStep { joint: step.joint, relations: step.method.relations().to_vec(), elimination, shape })
}
