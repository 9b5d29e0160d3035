//! In which order the joints of a chain are found, one at a time, and from which relations: [`plan`] makes a [`Plan`].
//!
//! At random reachable targets modulo primes, linear algebra shows which relations determine a joint when some others are known, and a
//! Groebner basis of all equations how many solutions there are: the plan must give as many. Its relations are proved over Q.
//!
//! D. L. Pieper, *The kinematics of manipulators under computer control* (1968), for steps by quartics; D. Manocha and J. F. Canny,
//! "Efficient inverse kinematics for general 6R manipulators", IEEE Trans. Robotics and Automation 10 (1994), for what has no plan.

mod eliminated;
mod fitting;
mod given;
mod one_joint;
mod recount;
mod refuse;
mod search;
mod types;

pub use fitting::fitting_task;
pub use given::{Candidate, Choice, joints_to_give};
pub(super) use recount::{same_degrees, same_evidence};
pub(super) use refuse::not_derived;
pub use types::{Evidence, Plan, PlanStep, Way};

use crate::derive::closure::{Mechanism, Relation, prove};
use crate::derive::samples;
use crate::derive::samples::sights::Sights;
use crate::derive::samples::specimen::Random;
use crate::{Error, ErrorKind, Result, Watch};
use search::{Reach, Search};

/// Where joints are eliminated: the first that leads to the right number of solutions is taken.
const REACHES: [Reach; 4] = [Reach::OneJoint, Reach::WhereStuck(2), Reach::Everywhere(2), Reach::WhereStuck(3)];

/// What the targets of the search are drawn with.
const SEED: u64 = 5;

/// The plan of `mechanism`: each joint that is not given is found by a step of at most four solutions, and the product of these
/// numbers is the number of complex solutions at a generic reachable target. Where the task asks more than the joints can do, or joints follow others, the
/// product may be greater: the equations that are left over are measured at run time.
///
/// # Errors
/// [`ErrorKind::PositiveDimensional`] when joints are free, with those that may be given; [`ErrorKind::Unsupported`] when there is no
/// such plan, with the number of solutions, the degrees of the joints and what the geometry lacks; what `watch` stops with.
pub fn plan(mechanism: &Mechanism, watch: &Watch) -> Result<Plan> {
    if mechanism.independent() > mechanism.seen().freedoms() {
        return Err(refuse::free(mechanism, watch)?);
    }
    let relations = mechanism.relations();
    let Some(evidence) = samples::evidence::gather(mechanism, &relations, watch)? else {
        return Err(refuse::free(mechanism, watch)?);
    };
    let dimension = evidence.iter().map(|evidence| evidence.dimension).min().unwrap_or(0);
    let steps = search(mechanism, &relations, &evidence[0], dimension, watch)?;
    for relation in steps.iter().flat_map(|step| step.way.relations()) {
        watch.check()?;
        prove(mechanism, relation)?;
    }
    Ok(Plan { given: mechanism.given().to_vec(), dimension, evidence, steps })
}

/// What random reachable targets modulo three primes show; `None` when they have infinitely many solutions.
///
/// # Errors
/// What `watch` stops with.
pub(super) fn evidence(mechanism: &Mechanism, watch: &Watch) -> Result<Option<Vec<Evidence>>> {
    samples::evidence::gather(mechanism, &mechanism.relations(), watch)
}

/// What the relations look like at random targets modulo a prime.
fn sights<'a>(mechanism: &'a Mechanism, relations: &'a [Relation]) -> Result<Sights<'a>> {
    let lucky = samples::evidence::lucky_primes(mechanism)?.into_iter().next();
    let (_, arithmetic) =
        lucky.ok_or_else(|| Error::new(ErrorKind::Unsupported, "no prime suits the chain's constants"))?;
    Sights::new(mechanism, relations, arithmetic, &mut Random::new(SEED))
}

/// The steps of the best plan, if it is good enough.
fn search(
    mechanism: &Mechanism,
    relations: &[Relation],
    evidence: &Evidence,
    dimension: usize,
    watch: &Watch,
) -> Result<Vec<PlanStep>> {
    let mut sights = sights(mechanism, relations)?;
    let may_be_more = !mechanism.counts_exactly();
    let mut best: Option<(usize, Vec<PlanStep>)> = None;
    for reach in REACHES {
        let Some(steps) = Search::new(&mut sights, reach, watch).steps()? else { continue };
        let product = steps.iter().map(|step| step.degree).product();
        if product == dimension {
            return Ok(steps);
        }
        if best.as_ref().is_none_or(|(least, _)| product < *least) {
            best = Some((product, steps));
        }
    }
    match best {
        Some((_, steps)) if may_be_more => Ok(steps),
        other => Err(refuse::no_plan(mechanism, evidence, other.map(|(product, _)| product))),
    }
}
