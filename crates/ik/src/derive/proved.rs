//! A derivation of any kind, from a [`Source`]: [`Proved`].

use super::coupled::DerivedCoupled;
use super::eigenvalue::{DerivedSixAxes, fits};
use super::sequential::{self, Derived};
use super::{Derivation, Source, certificate};
use crate::solver::{About, Program};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::ideal::{Report, TOLERANCE};

/// What a source's derivation gives.
#[derive(Clone, Debug, PartialEq)]
pub enum Proved {
    /// Of equations that are solved as one block: those of a system, and of a chain that asks for an order or a root.
    Equations(Box<Derivation>),
    /// Of a chain, one joint at a time.
    Chain(Box<Derived>),
    /// Of six joints in any place, all together.
    SixAxes(Box<DerivedSixAxes>),
    /// Of chains that share actuators, one chain after the other.
    Coupled(Box<DerivedCoupled>),
}

impl Proved {
    /// Derives and proves `source`.
    ///
    /// # Errors
    /// As [`Source::check_base`], [`Derivation::new`], [`Derived::of_chain`] and [`DerivedCoupled::of_coupled`].
    pub fn of(source: &Source, watch: &Watch) -> Result<Self> {
        source.check_base()?;
        Proved::made(source, watch).map_err(|error| match error.kind() {
            ErrorKind::Unsupported | ErrorKind::PositiveDimensional => source.advised(error),
            _ => error,
        })
    }

    fn made(source: &Source, watch: &Watch) -> Result<Self> {
        match (source.chain_by_steps(), &source.coupled) {
            (Some(chain), _) => Proved::of_ideal(chain, &ideal(source, chain)?, watch),
            (None, Some(coupled)) => Ok(Proved::Coupled(Box::new(DerivedCoupled::of_coupled(coupled, watch)?))),
            (None, None) => Ok(Proved::Equations(Box::new(Derivation::new(equations(source)?.clone(), watch)?))),
        }
    }

    /// Proves the derivation of `source` anew from the text of its certificate, without the Groebner engine.
    ///
    /// # Errors
    /// As [`certificate::prove`], [`sequential::certificate::prove`] and [`DerivedCoupled::prove`].
    pub fn again(source: &Source, text: &str) -> Result<Self> {
        match (source.chain_by_steps(), &source.coupled) {
            (Some(chain), _) if DerivedSixAxes::is_certificate(text) => {
                Proved::six_axes(chain, &ideal(source, chain)?, |chain| DerivedSixAxes::prove(chain, text))
            }
            (Some(chain), _) => {
                Proved::chain(chain, &ideal(source, chain)?, |chain| sequential::certificate::prove(chain, text))
            }
            (None, Some(coupled)) => Ok(Proved::Coupled(Box::new(DerivedCoupled::prove(coupled, text)?))),
            (None, None) => Ok(Proved::Equations(Box::new(certificate::prove(equations(source)?, text)?))),
        }
    }

    /// Derives and proves the solver of `chain` for its task: that of the ideal robot which it means, with answers polished on `chain` itself where
    /// that is another. It is one joint at a time, or where that is impossible by one eigenvalue problem of six joints.
    ///
    /// # Errors
    /// As [`Chain::check_base`], [`Derived::of_chain`] and [`Chain::check_task`].
    pub fn of_chain(chain: &Chain, watch: &Watch) -> Result<Self> {
        Proved::of_ideal(chain, &chain.ideal_within(TOLERANCE)?, watch)
    }

    fn of_ideal(chain: &Chain, ideal: &(Chain, Report), watch: &Watch) -> Result<Self> {
        chain.check_base(None)?;
        let by_steps = Proved::chain(chain, ideal, |chain| Derived::of_chain(chain, watch));
        match by_steps {
            Err(refusal) if refusal.kind() == ErrorKind::Unsupported && fits(chain).is_ok() => {
                match Proved::six_axes(chain, ideal, |chain| DerivedSixAxes::of_chain(chain, watch)) {
                    Err(error) if error.kind() == ErrorKind::Unsupported => Err(refusal),
                    together => together,
                }
            }
            other => other,
        }
    }

    /// The derivation of the ideal robot that `chain` means, its answers polished on `chain` where that is another.
    fn chain(chain: &Chain, ideal: &(Chain, Report), derive: impl Fn(&Chain) -> Result<Derived>) -> Result<Self> {
        let (ideal, report) = ideal;
        let derived = derive(ideal)?;
        let derived = if report.is_same() { derived } else { derived.polished_on(chain, report.clone())? };
        Ok(Proved::Chain(Box::new(derived)))
    }

    /// The same of an eigenvalue problem.
    fn six_axes(
        chain: &Chain,
        (ideal, report): &(Chain, Report),
        derive: impl Fn(&Chain) -> Result<DerivedSixAxes>,
    ) -> Result<Self> {
        let derived = derive(ideal)?;
        let derived = if report.is_same() { derived } else { derived.polished_on(chain, report.clone())? };
        Ok(Proved::SixAxes(Box::new(derived)))
    }

    /// The solver.
    pub fn program(&self) -> &Program {
        match self {
            Proved::Equations(derivation) => &derivation.program,
            Proved::Chain(derived) => &derived.program,
            Proved::SixAxes(derived) => &derived.program,
            Proved::Coupled(derived) => &derived.program,
        }
    }

    /// The stage files with their names: the same bytes at every run.
    ///
    /// # Errors
    /// When a field cannot be built: never for a derivation that was made by this crate.
    pub fn stage_files(&self) -> Result<Vec<(String, Vec<u8>)>> {
        match self {
            Proved::Equations(derivation) => derivation.stage_files(),
            Proved::Chain(derived) => derived.stage_files(),
            Proved::SixAxes(derived) => Ok(derived.stage_files()),
            Proved::Coupled(derived) => derived.stage_files(),
        }
    }

    /// Same derivation, with the task, the links, a hash, the limits and the followers of `source` in its program.
    #[must_use]
    pub fn about(mut self, source: &Source) -> Self {
        let solutions = self.dimension();
        let program = match &mut self {
            Proved::Equations(derivation) => &mut derivation.program,
            Proved::Chain(derived) => &mut derived.program,
            Proved::SixAxes(derived) => &mut derived.program,
            Proved::Coupled(derived) => &mut derived.program,
        };
        program.about = Some(About { solutions, ..about(source, program) });
        self
    }

    /// The number of complex solutions of a generic reachable target, where it was counted.
    pub fn dimension(&self) -> Option<usize> {
        match self {
            Proved::Equations(derivation) => derivation.dimension(),
            Proved::Chain(derived) => Some(derived.plan.dimension),
            Proved::SixAxes(derived) => Some(derived.dimension()),
            Proved::Coupled(derived) => Some(derived.dimension()),
        }
    }
}

/// The ideal robot that the chain of `source` means.
fn ideal(source: &Source, chain: &Chain) -> Result<(Chain, Report)> {
    source.ideal.clone().map_or_else(|| source.ends.ideal(chain), Ok)
}

fn equations(source: &Source) -> Result<&super::System> {
    let none = || {
        Error::new(ErrorKind::BadValue, "the source has no equations, no chain and no coupled chains")
            .in_file(&source.path)
    };
    source.system.as_ref().ok_or_else(none)
}

/// What `source` says of itself, with limits and leaders of the program's joints.
fn about(source: &Source, program: &Program) -> About {
    let actuators = match (&source.chain, &source.coupled) {
        (Some(chain), _) => chain.joints().iter().map(|joint| (joint.name.as_str(), joint.limits)).collect(),
        (None, Some(coupled)) => {
            coupled.actuators().iter().map(|actuator| (actuator.name.as_str(), coupled.limits(actuator))).collect()
        }
        (None, None) => Vec::new(),
    };
    let limits = |name: &str| actuators.iter().find(|(actuator, _)| *actuator == name).and_then(|(_, limits)| *limits);
    let limits: Vec<_> = program.joints.iter().map(|joint| limits(&joint.name)).collect();
    let joints = source.chain.as_ref().map_or(&[][..], Chain::joints);
    let follows = |name: &str| joints.iter().find(|joint| joint.name == name).and_then(|joint| joint.mimic.clone());
    let follows: Vec<_> = program.joints.iter().map(|joint| follows(&joint.name)).collect();
    let asked = source.task_file().map_or_else(Vec::new, |(_, text)| text);
    let [base, tip] = source.links.clone().map_or([None, None], |links| links.map(Some));
    About {
        task: task(source),
        base,
        tip,
        solutions: None,
        hash: format!("{:016x}", hash(source.text.bytes().chain(asked))),
        limits: if limits.iter().all(Option::is_none) { Vec::new() } else { limits },
        follows: if follows.iter().all(Option::is_none) { Vec::new() } else { follows },
    }
}

/// What is asked of the tip, or of each chain's.
fn task(source: &Source) -> String {
    match (&source.chain, &source.coupled) {
        (Some(chain), _) => chain.asked(),
        (None, Some(coupled)) => {
            let asked = coupled.chains().iter().map(|member| format!("{}: {}", member.name, member.chain.asked()));
            asked.collect::<Vec<_>>().join("; ")
        }
        (None, None) => "its equations".to_owned(),
    }
}

/// The hash of Fowler, Noll and Vo, FNV-1a, of 64 bits (draft-eastlake-fnv).
fn hash(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
