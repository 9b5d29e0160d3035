//! The solvers of a chain with one redundant joint, one for each joint as the given one. Main type: [`RedundantChain`].
//!
//! The solutions of a target are curves. A curve leaves the joint limits only where a joint reaches a limit, and these points are the solutions with that joint
//! given at that limit. So the given-solvers of all joints determine the ends of all arcs of solutions within limits.
//! Curves that reach no limit have no such ends.

mod certificate;
mod data;
mod report;

pub(in crate::derive) use certificate::{certificate, is_certificate, prove};
pub(in crate::derive) use data::data;
pub(in crate::derive) use report::section;

use groebot_runtime::redundant::MOST_JOINTS;
use rayon::prelude::*;

use crate::derive::closure::Mechanism;
use crate::derive::planner::{is_constant, is_redundant};
use crate::derive::{ChainProblem, Derivation};
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
        let main = check(&problem.chain)?;
        let count = problem.chain.joints().len();
        let part = |joint: usize| {
            watch.report("derive the solver with another joint given", joint, count - joint);
            if joint == main { Ok(Part::Main) } else { part(&given(problem, joint)?, watch) }
        };
        let parts = (0..count).into_par_iter().map(part).collect::<Result<_>>()?;
        Ok(RedundantChain { parts })
    }
}

/// The part of the only given joint of `problem`.
fn part(problem: &ChainProblem, watch: &Watch) -> Result<Part> {
    match Derivation::of_problem(problem.clone(), watch) {
        Ok(derivation) => Ok(Part::Derived(Box::new(derivation))),
        Err(error) if is_refusal(error.kind()) && is_determined(problem)? => Ok(Part::Constant),
        Err(error) if is_refusal(error.kind()) => Ok(Part::Unsolved(error.message().to_owned())),
        Err(error) => Err(error),
    }
}

/// Whether the target determines the given joint of `problem`: it is proved to be constant on every self-motion.
fn is_determined(problem: &ChainProblem) -> Result<bool> {
    let mechanism = Mechanism::new(&problem.chain)?;
    let given = problem.chain.given();
    Ok(mechanism.upright_loop().is_none()
        && given.iter().all(|&joint| matches!(is_constant(&mechanism, joint), Ok(true))))
}

fn is_refusal(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::Unsupported | ErrorKind::PositiveDimensional | ErrorKind::Inconsistent)
}

/// The problem with the joint of this index as the only given one.
///
/// # Errors
/// As [`Chain::with_task`].
pub(in crate::derive) fn given(problem: &ChainProblem, joint: usize) -> Result<ChainProblem> {
    let with = |chain: &Chain| {
        let name = chain.joints()[joint].name.clone();
        chain.with_task(chain.task(), chain.direction().clone(), vec![name])
    };
    let truth = problem.truth.as_ref().map(|(truth, report)| Ok((with(truth)?, report.clone()))).transpose()?;
    Ok(ChainProblem { chain: with(&problem.chain)?, truth })
}

/// The given joint of a redundant chain.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a chain whose solutions are not curves, or that has mimic joints.
pub(in crate::derive) fn check(chain: &Chain) -> Result<usize> {
    let given = chain.given();
    match given[..] {
        [joint] if is_redundant(chain) => Ok(joint),
        _ => {
            let text = format!(
                "a redundant solver needs one joint more than the task determines, at most {MOST_JOINTS} joints, no mimic joint and one given joint"
            );
            Err(Error::new(ErrorKind::Unsupported, text))
        }
    }
}
