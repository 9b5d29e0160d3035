//! The planner: the order in which the joints of a chain are found one at a time, and the relations for it. [`plan`] makes a [`Plan`].
//!
//! It samples random reachable targets modulo primes. Linear algebra shows which relations determine a joint when some others are known. A Groebner basis of
//! all equations counts the solutions, and the plan must have the same number. Its relations are proved over Q.
//!
//! D. L. Pieper, *The kinematics of manipulators under computer control* (1968), for steps by quartics. D. Manocha and J. F. Canny, "Efficient inverse
//! kinematics for general 6R manipulators", IEEE Trans. Robotics and Automation 10 (1994), for chains without a plan.

mod constant;
mod eliminated;
mod fitting;
mod given;
mod one_joint;
mod recount;
mod refuse;
mod search;
mod types;

pub use constant::{constant_relation, is_constant};
pub use fitting::fitting_task;
pub use given::{Candidate, Choice, is_redundant, joints_to_give};
pub(super) use recount::{same_degrees, same_evidence};
use refuse::Refusal;
pub(super) use refuse::not_derived;
pub use types::{Evidence, Plan, PlanStep, StepMethod};

use crate::derive::closure::{Mechanism, Relation, prove};
use crate::derive::samples;
use crate::derive::samples::sampled_relations::SampledRelations;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::random::SplitMix64;
use search::{Reach, Search};

/// The extents of elimination, in the order in which they are tried. The first that gives the right number of solutions is used.
const REACHES: [Reach; 4] = [Reach::OneJoint, Reach::WhereStuck(2), Reach::Everywhere(2), Reach::WhereStuck(3)];

/// The random seed of the targets in the search.
const SEED: u64 = 5;

/// The plan of `mechanism`: a step for each joint that is not given, with at most four solutions per step.
///
/// The product of these numbers is the number of complex solutions at a generic reachable target. The product may be greater if the task is overdetermined
/// (more numbers than independent joints), or if joints follow others. The remaining equations are then evaluated at run time.
///
/// # Errors
/// [`ErrorKind::PositiveDimensional`] if joints are free, with those that may be given. [`ErrorKind::Unsupported`] if there is no such plan, with the number of
/// solutions, the degrees of the joints and the missing geometric properties. The error of `watch` if it stops the search.
pub fn plan<'w>(mechanism: &Mechanism, watch: impl Into<Option<&'w Watch>>) -> Result<Plan> {
    attempt(mechanism, Watch::or_none(watch))?.map_err(|refusal| refusal.error)
}

/// Same as [`plan`], but a mechanism without a plan is a result.
///
/// # Errors
/// The error of `watch` if it stops the search.
fn attempt(mechanism: &Mechanism, watch: &Watch) -> Result<std::result::Result<Plan, Refusal>> {
    if mechanism.independent() > mechanism.seen().freedoms() {
        return Ok(Err(refuse::free(mechanism, watch)?));
    }
    let relations = mechanism.relations();
    let Some(evidence) = samples::evidence::gather(mechanism, &relations, watch)? else {
        return Ok(Err(refuse::free(mechanism, watch)?));
    };
    let dimension = evidence.iter().map(|evidence| evidence.dimension).min().unwrap_or(0);
    let steps = match search(mechanism, &relations, &evidence[0], dimension, watch)? {
        Ok(steps) => steps,
        Err(refusal) => return Ok(Err(refusal)),
    };
    for relation in steps.iter().flat_map(|step| step.method.relations()) {
        watch.check()?;
        prove(mechanism, relation)?;
    }
    Ok(Ok(Plan { given: mechanism.given().to_vec(), dimension, evidence, steps }))
}

/// The evidence of random reachable targets modulo three primes; `None` if they have infinitely many solutions.
///
/// # Errors
/// The error of `watch` if it stops the count.
pub(super) fn evidence(mechanism: &Mechanism, watch: &Watch) -> Result<Option<Vec<Evidence>>> {
    samples::evidence::gather(mechanism, &mechanism.relations(), watch)
}

/// The relations at random targets modulo a prime.
fn sampled_relations<'a>(mechanism: &'a Mechanism, relations: &'a [Relation]) -> Result<SampledRelations<'a>> {
    let lucky = samples::evidence::lucky_primes(mechanism)?.into_iter().next();
    let (_, arithmetic) = lucky.ok_or_else(|| {
        Error::new(ErrorKind::Unsupported, "no tried prime is coprime to the denominators of the chain's constants")
    })?;
    SampledRelations::new(mechanism, relations, arithmetic, &mut SplitMix64::new(SEED))
}

/// The steps of the best plan, if its number of solutions is acceptable.
fn search(
    mechanism: &Mechanism,
    relations: &[Relation],
    evidence: &Evidence,
    dimension: usize,
    watch: &Watch,
) -> Result<std::result::Result<Vec<PlanStep>, Refusal>> {
    let mut sampled = sampled_relations(mechanism, relations)?;
    let may_be_more = !mechanism.counts_exactly();
    let mut best: Option<(usize, Vec<PlanStep>)> = None;
    for reach in REACHES {
        let Some(steps) = Search::new(&mut sampled, reach, watch).steps()? else { continue };
        let product = steps.iter().map(|step| step.degree).product();
        if product == dimension {
            return Ok(Ok(steps));
        }
        if best.as_ref().is_none_or(|(least, _)| product < *least) {
            best = Some((product, steps));
        }
    }
    match best {
        Some((_, steps)) if may_be_more => Ok(Ok(steps)),
        other => Ok(Err(refuse::no_plan(mechanism, evidence, other.map(|(product, _)| product)))),
    }
}
