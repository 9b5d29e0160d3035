//! The solvers of a redundant chain, one for each joint as the given one. Main type: [`RedundantChain`].
//!
//! A chain with more redundant joints has scanned ones, the first of its given joints: their values are given to every solver in addition, and their ranges are
//! sampled. The remaining joints are a chain with one redundant joint.
//!
//! The solutions of a target are curves. A curve leaves the joint limits only where a joint reaches a limit, and these points are the solutions with that joint
//! given at that limit. So the given-solvers of all joints determine the ends of all arcs of solutions within limits.
//! Curves that reach no limit have no such ends.

mod certificate;
mod data;
mod report;
mod sections;

pub(in crate::derive) use certificate::{certificate, is_certificate, prove};
pub(in crate::derive) use data::data;
pub(in crate::derive) use report::section;

use rayon::prelude::*;

use crate::derive::closure::Mechanism;
use crate::derive::planner::{is_constant, is_redundant};
use crate::derive::{ChainProblem, Derivation};
use crate::solver::MOST_SCANNED;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;

/// The solvers of a redundant chain, one for each joint as the given one.
#[derive(Clone, Debug, PartialEq)]
pub struct RedundantChain {
    parts: Vec<Part>,
}

/// The solver of a redundant chain with one joint given.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Part {
    /// The derivation that has the redundancy.
    Main,
    /// Another derivation.
    Derived(Box<Derivation>),
    /// The joint has finitely many values, which the target determines: it is constant on every self-motion.
    Constant,
    /// The range of the joint is scanned: its value is given to all solvers.
    Scanned,
    /// There is no solver, for this reason.
    Unsolved(String),
}

impl RedundantChain {
    /// By joint of the chain, its part.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The derivations in addition to the main one, with the index of the given joint of each.
    pub fn derivations(&self) -> impl Iterator<Item = (usize, &Derivation)> {
        self.parts.iter().enumerate().filter_map(|(joint, part)| match part {
            Part::Derived(derivation) => Some((joint, &**derivation)),
            _ => None,
        })
    }

    /// Derives the solver for each joint of `problem` other than its given one. They are derived on rayon's threads.
    ///
    /// # Errors
    /// As [`check`]. The error of `watch` if it stops a derivation.
    pub(in crate::derive) fn derive(problem: &ChainProblem, watch: &Watch) -> Result<Self> {
        let (scanned, main) = check(&problem.chain)?;
        let count = problem.chain.joints().len();
        let part = |joint: usize| {
            watch.report("derive the solver with another joint given", joint, count - joint);
            match joint {
                _ if joint == main => Ok(Part::Main),
                _ if scanned.contains(&joint) => Ok(Part::Scanned),
                _ => part(&given(problem, joint)?, joint, watch),
            }
        };
        let parts = (0..count).into_par_iter().map(part).collect::<Result<_>>()?;
        Ok(RedundantChain { parts })
    }
}

/// The part of `joint`, which `problem` gives in addition to the scanned joints.
fn part(problem: &ChainProblem, joint: usize, watch: &Watch) -> Result<Part> {
    match Derivation::of_problem(problem.clone(), watch) {
        Ok(derivation) => Ok(Part::Derived(Box::new(derivation))),
        Err(error) if is_refusal(error.kind()) && is_determined(problem, joint)? => Ok(Part::Constant),
        Err(error) if is_refusal(error.kind()) => Ok(Part::Unsolved(error.message().to_owned())),
        Err(error) => Err(error),
    }
}

/// Whether the target and the scanned joints determine the given `joint` of `problem`: it is proved to be constant on every self-motion.
fn is_determined(problem: &ChainProblem, joint: usize) -> Result<bool> {
    let mechanism = Mechanism::new(&problem.chain)?;
    Ok(mechanism.upright_loop().is_none() && matches!(is_constant(&mechanism, joint), Ok(true)))
}

fn is_refusal(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::Unsupported | ErrorKind::PositiveDimensional | ErrorKind::Inconsistent)
}

/// The problem with the joint of this index as the only given one apart from those that are scanned.
///
/// # Errors
/// As [`check`] and [`Chain::with_task`].
pub(in crate::derive) fn given(problem: &ChainProblem, joint: usize) -> Result<ChainProblem> {
    let (scanned, _) = check(&problem.chain)?;
    let with = |chain: &Chain| {
        let names = scanned.iter().chain([&joint]).map(|&place| chain.joints()[place].name.clone()).collect();
        chain.with_task(chain.task(), chain.direction().clone(), names)
    };
    let truth = problem.truth.as_ref().map(|(truth, report)| Ok((with(truth)?, report.clone()))).transpose()?;
    Ok(ChainProblem { chain: with(&problem.chain)?, truth })
}

/// The scanned joints of a redundant chain, and the given joint of its main solver: the last one of those that are given.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a chain that is not redundant, has other given joints or mimic joints.
pub(in crate::derive) fn check(chain: &Chain) -> Result<(Vec<usize>, usize)> {
    let mut scanned = chain.given();
    match scanned.pop() {
        Some(joint) if is_redundant(chain) && chain.joints().len() == chain.task().freedoms() + 1 + scanned.len() => {
            Ok((scanned, joint))
        }
        _ => {
            let text = format!(
                "a redundant solver needs one joint more than the task determines, or up to {MOST_SCANNED} others, no mimic joint, and as \
                 many given joints"
            );
            Err(Error::new(ErrorKind::Unsupported, text))
        }
    }
}
