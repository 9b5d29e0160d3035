//! Selection of the joints whose values are given, for chains with more joints than their task determines: [`joints_to_give`]. Main types: [`Choice`],
//! [`Candidate`].

use std::cmp::Reverse;
use std::fmt;

use super::attempt;
use super::refuse::{self, driven};
use super::types::Plan;
use crate::derive::closure::Mechanism;
use crate::derive::eigenvalue::fits;
use crate::solver::MOST_SCANNED;
use crate::{ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;

/// The fraction of the best share from which a joint counts as equally good to give.
const AS_GOOD: f64 = 0.8;

/// The joints whose values are given, and the alternatives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Choice {
    /// The names of all given joints, from the base, including those that were given before.
    pub given: Vec<String>,
    /// All candidates for the last given joint, from the base.
    pub candidates: Vec<Candidate>,
}

/// A joint that may be given.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Candidate {
    /// The name of the joint.
    pub joint: String,
    /// The fraction of its range, over reachable poses, that has solutions: counted by screw theory if possible, else [`Chain::shares`].
    pub share: f64,
    /// The greatest degree of a step, and the number of solutions, if the other joints are found one at a time.
    pub plan: Option<[usize; 2]>,
}

/// Selects the joints of `chain` to give, so that its task determines the others. `None` for a chain without redundant joints.
///
/// The last joint must have solutions for nearly the greatest share of its range. Of such joints it is the one with the simplest plan for the others: least
/// polynomial degree, then fewest solutions, then last in the chain. If no joint gives such a plan, the last joint is given if the other six can be solved
/// together, else joints at the ends of the chain, else any joint. Joints before the last are chosen by their shares alone: the first from the base whose share is nearly the greatest.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if there is no such joint, with the number of solutions for each. The error of `watch` if it stops the search.
pub fn joints_to_give<'w>(chain: &Chain, watch: impl Into<Option<&'w Watch>>) -> Result<Option<Choice>> {
    let watch = Watch::or_none(watch);
    let leads = |joint: &&usize| chain.leader(**joint).is_none();
    let names =
        |joints: &[usize]| joints.iter().filter(leads).map(|&joint| chain.joints()[joint].name.clone()).collect();
    let requested = chain.given();
    let mut given = requested.clone();
    let Some(excess) = chain.independent().len().checked_sub(chain.task().freedoms()).filter(|n| *n > 0) else {
        return Ok(None);
    };
    for _ in 1..excess {
        let joint = of_greatest_share(&chain.shares(&given), &given);
        given.extend((0..chain.joints().len()).filter(|&place| place == joint || led_by(chain, place) == Some(joint)));
        given.sort_unstable();
    }
    let (joint, candidates) = match last_to_give(chain, &given, watch) {
        Err(error) if is_refusal(error.kind()) => {
            match ends_to_give(chain, &requested, excess).or_else(|| one_to_give(chain, &given)) {
                Some(given) => return Ok(Some(Choice { given: names(&given), candidates: Vec::new() })),
                None => return Err(error),
            }
        }
        last => last?,
    };
    given.push(joint);
    given.sort_unstable();
    Ok(Some(Choice { given: names(&given), candidates }))
}

/// Whether a redundant solver finds the solutions of a target of `chain` within limits: one joint more than its task determines, or up to [`MOST_SCANNED`]
/// others whose ranges are scanned, and no mimic joint.
pub fn is_redundant(chain: &Chain) -> bool {
    let (count, most) = (chain.joints().len(), chain.task().freedoms() + 1);
    let by_steps = chain.order().is_none() && chain.choice().is_none();
    by_steps
        && (most..=most + MOST_SCANNED).contains(&count)
        && chain.joints().iter().all(|joint| joint.mimic.is_none())
}

/// The leader of the joint at `place`, if that joint follows another one.
fn led_by(chain: &Chain, place: usize) -> Option<usize> {
    chain.leader(place).map(|(leader, _)| leader)
}

/// The first joint whose share is nearly the greatest ([`AS_GOOD`]).
fn of_greatest_share(shares: &[f64], given: &[usize]) -> usize {
    let best = shares.iter().copied().fold(0.0, f64::max);
    let free = || (0..shares.len()).filter(|joint| !given.contains(joint));
    free().find(|&joint| shares[joint] >= AS_GOOD * best).or_else(|| free().next()).unwrap_or(0)
}

/// The last joint to give in addition to those of `given`, and all candidates.
fn last_to_give(chain: &Chain, given: &[usize], watch: &Watch) -> Result<(usize, Vec<Candidate>)> {
    let mechanism = Mechanism::new(chain)?.with_given(given)?;
    let (places, mut shares) = (driven(&mechanism), chain.shares(given));
    let (mut plans, mut refusals) = (Vec::new(), Vec::new());
    for &joint in &places {
        watch.report("choose the joint that is given", joint, places.len());
        let with: Vec<usize> = given.iter().copied().chain([joint]).collect();
        match attempt(&mechanism.clone().with_given(&with)?, watch) {
            Ok(Ok(plan)) => plans.push((joint, [hardest(&plan), plan.dimension])),
            Ok(Err(refusal)) => refusals.push((joint, refusal.result)),
            Err(error) if is_refusal(error.kind()) => refusals.push((joint, error.message().to_owned())),
            Err(error) => return Err(error),
        }
    }
    for (joint, _) in &plans {
        shares[*joint] = chain.counted_share(given, *joint).unwrap_or(shares[*joint]);
    }
    let candidate = |&joint: &usize| Candidate {
        joint: chain.joints()[joint].name.clone(),
        share: shares[joint],
        plan: plans.iter().find(|(other, _)| *other == joint).map(|(_, plan)| *plan),
    };
    let greatest = plans.iter().map(|(joint, _)| shares[*joint]).fold(0.0, f64::max);
    let good = plans.iter().filter(|(joint, _)| shares[*joint] >= AS_GOOD * greatest);
    let best = good.min_by_key(|(joint, plan)| (*plan, Reverse(*joint))).map(|(joint, _)| *joint);
    match best.or_else(|| together(chain, given)) {
        Some(joint) => Ok((joint, places.iter().map(candidate).collect())),
        None => Err(refuse::none_to_give(&mechanism, &refusals)),
    }
}

/// Selects `count` joints at the ends of the chain, in addition to those of `given`, such that the other six can be solved together. It takes as many as
/// possible at the tip end.
fn ends_to_give(chain: &Chain, given: &[usize], count: usize) -> Option<Vec<usize>> {
    let leading: Vec<usize> = chain.independent().into_iter().filter(|joint| !given.contains(joint)).collect();
    (0..=count).find_map(|front| {
        let ends = leading[..front].iter().chain(&leading[leading.len() - (count - front)..]);
        let mut all: Vec<usize> = given.iter().chain(ends).copied().collect();
        all.sort_unstable();
        leaves_six(chain, &all).filter(|six| is_row(six)).map(|_| all)
    })
}

/// Selects one joint anywhere in the chain, in addition to those of `given`, such that the other six can be solved together: the last one that suits.
fn one_to_give(chain: &Chain, given: &[usize]) -> Option<Vec<usize>> {
    let with = |place: usize| {
        let mut all: Vec<usize> = given.iter().copied().chain([place]).collect();
        all.sort_unstable();
        all
    };
    let leading = chain.independent().into_iter().filter(|joint| !given.contains(joint)).rev();
    leading.map(with).find(|all| leaves_six(chain, all).is_some())
}

/// The other joints, if they are six that can be solved together. Others are joints that are not given and follow no given joint.
fn leaves_six(chain: &Chain, given: &[usize]) -> Option<Vec<usize>> {
    let leads = |joint: &&usize| chain.leader(**joint).is_none();
    let given = given.iter().filter(leads).map(|&joint| chain.joints()[joint].name.clone()).collect();
    let chain = chain.with_task(chain.task(), chain.direction().clone(), given).ok()?;
    fits(&chain).ok()?;
    let given = chain.given();
    Some((0..chain.joints().len()).filter(|joint| !given.contains(joint)).collect())
}

/// Whether joints follow one another.
fn is_row(joints: &[usize]) -> bool {
    joints.windows(2).all(|pair| pair[1] == pair[0] + 1)
}

/// The joint that leaves six joints which can be solved together: the last, else the first. A follower is replaced by its leader.
fn together(chain: &Chain, given: &[usize]) -> Option<usize> {
    let fits_with = |place: &usize| {
        let all: Vec<usize> = given.iter().copied().chain([*place]).collect();
        leaves_six(chain, &all).is_some_and(|six| is_row(&six))
    };
    let ends = [chain.joints().len() - 1, 0].map(|place| led_by(chain, place).unwrap_or(place));
    ends.into_iter().filter(|place| !given.contains(place)).find(fits_with)
}

fn is_refusal(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::Unsupported | ErrorKind::PositiveDimensional)
}

fn hardest(plan: &Plan) -> usize {
    plan.steps.iter().map(|step| step.degree).max().unwrap_or(0)
}

/// Text such as `shoulder: solutions on 62 % of its range, up to 8 of them`.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: solutions on {:.0} % of its range", self.joint, 100.0 * self.share)?;
        match self.plan {
            Some([_, dimension]) => write!(f, ", up to {dimension} of them"),
            None => f.write_str(", which are not found one joint at a time"),
        }
    }
}
