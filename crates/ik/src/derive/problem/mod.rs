//! The problem that a derivation solves: [`Problem`].

mod check;
mod constants;
mod description;
pub mod ends;
pub mod formulate;
pub mod input;
mod print;
mod radicals;
pub(super) mod system;
pub(super) mod system_parts;
pub mod system_toml;

use crate::derive::coupled::CoupledChains;
use crate::derive::{Source, System};
use crate::{Error, ErrorKind, Result};
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::ideal::Report;

/// The problem that a derivation solves.
#[derive(Clone, Debug, PartialEq)]
pub enum Problem {
    /// Equations that are solved as one block: those of a system, or of a chain that requests an order or a root.
    System(Box<System>),
    /// A chain.
    Chain(Box<ChainProblem>),
    /// Chains that share actuators.
    Coupled(Box<CoupledChains>),
}

/// A chain to solve, and the described chain on which answers are measured.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChainProblem {
    /// The chain that is solved.
    pub chain: Chain,
    /// The described chain and its difference from `chain`, if `chain` is its ideal. Answers are polished and measured on the described chain.
    pub truth: Option<(Chain, Report)>,
}

impl ChainProblem {
    /// The problem of the ideal chain of `truth`. The [`Report`] of [`Chain::ideal`] lists their differences.
    pub fn ideal((chain, report): (Chain, Report), truth: &Chain) -> Self {
        let truth = (!report.is_same()).then(|| (truth.clone(), report));
        ChainProblem { chain, truth }
    }

    /// The chain on which answers are measured.
    pub fn measured(&self) -> &Chain {
        self.truth.as_ref().map_or(&self.chain, |(truth, _)| truth)
    }
}

impl Problem {
    /// The problem that `source` describes.
    ///
    /// # Errors
    /// As [`Ends::ideal`](super::Ends::ideal); [`ErrorKind::BadValue`] for a source without equations, chain or coupled chains.
    pub fn of(source: &Source) -> Result<Self> {
        if let Some(chain) = source.chain_by_steps() {
            let ideal = source.ideal.clone().map_or_else(|| source.ends.ideal(chain), Ok)?;
            return Ok(ChainProblem::ideal(ideal, chain).into());
        }
        match (&source.coupled, &source.system) {
            (Some(coupled), _) => Ok(coupled.clone().into()),
            (None, Some(system)) => Ok(system.clone().into()),
            (None, None) => {
                let text = "the source has no equations, no chain and no coupled chains";
                Err(Error::new(ErrorKind::BadValue, text).in_file(&source.path))
            }
        }
    }
}

/// A chain that is solved exactly as described, without an ideal.
impl From<&Chain> for ChainProblem {
    fn from(chain: &Chain) -> Self {
        ChainProblem { chain: chain.clone(), truth: None }
    }
}

impl From<System> for Problem {
    fn from(system: System) -> Self {
        Problem::System(Box::new(system))
    }
}

impl From<ChainProblem> for Problem {
    fn from(problem: ChainProblem) -> Self {
        Problem::Chain(Box::new(problem))
    }
}

impl From<&Chain> for Problem {
    fn from(chain: &Chain) -> Self {
        ChainProblem::from(chain).into()
    }
}

impl From<CoupledChains> for Problem {
    fn from(coupled: CoupledChains) -> Self {
        Problem::Coupled(Box::new(coupled))
    }
}
