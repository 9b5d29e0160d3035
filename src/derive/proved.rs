//! A derivation of any kind, from a [`Source`]: [`Proved`].

use super::lift::{self, Derived};
use super::limbs::DerivedLimbs;
use super::{Derivation, Source, certificate};
use crate::kinematics::Chain;
use crate::solver::Program;
use crate::{Error, ErrorKind, Result, Watch};

/// What a source's derivation gives.
#[derive(Clone, Debug, PartialEq)]
pub enum Proved {
    /// Of equations that are solved as one block: those of a system, and of a chain that asks for an order or a root.
    Equations(Box<Derivation>),
    /// Of a chain, one joint at a time.
    Chain(Box<Derived>),
    /// Of limbs that share motors, one limb after the other.
    Limbs(Box<DerivedLimbs>),
}

impl Proved {
    /// Derives and proves `source`.
    ///
    /// # Errors
    /// As [`Derivation::new`], [`Derived::of_chain`] and [`DerivedLimbs::of_limbs`].
    pub fn of(source: &Source, watch: &Watch) -> Result<Self> {
        match (source.chain_by_steps(), &source.limbs) {
            (Some(chain), _) => Proved::chain(source, chain, |chain| Derived::of_chain(chain, watch)),
            (None, Some(limbs)) => Ok(Proved::Limbs(Box::new(DerivedLimbs::of_limbs(limbs, watch)?))),
            (None, None) => {
                let derivation = Derivation::new(equations(source)?.clone(), watch)?;
                Ok(Proved::Equations(Box::new(derivation)))
            }
        }
    }

    /// Proves the derivation of `source` anew from the text of its certificate, without the Groebner engine.
    ///
    /// # Errors
    /// As [`certificate::prove`], [`lift::certificate::prove`] and [`DerivedLimbs::prove`].
    pub fn again(source: &Source, text: &str) -> Result<Self> {
        match (source.chain_by_steps(), &source.limbs) {
            (Some(chain), _) => Proved::chain(source, chain, |chain| lift::certificate::prove(chain, text)),
            (None, Some(limbs)) => Ok(Proved::Limbs(Box::new(DerivedLimbs::prove(limbs, text)?))),
            (None, None) => {
                let derivation = certificate::prove(equations(source)?, text)?;
                Ok(Proved::Equations(Box::new(derivation)))
            }
        }
    }

    /// The derivation of `chain`, or of the ideal one that `source` asks for instead, its answers polished on `chain`.
    fn chain(source: &Source, chain: &Chain, derive: impl Fn(&Chain) -> Result<Derived>) -> Result<Self> {
        let derived = match source.ends.ideal(chain)? {
            Some((ideal, report)) => derive(&ideal)?.polished_on(chain, report)?,
            None => derive(chain)?,
        };
        Ok(Proved::Chain(Box::new(derived)))
    }

    /// The solver.
    pub fn program(&self) -> &Program {
        match self {
            Proved::Equations(derivation) => &derivation.program,
            Proved::Chain(derived) => &derived.program,
            Proved::Limbs(derived) => &derived.program,
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
            Proved::Limbs(derived) => derived.stage_files(),
        }
    }
}

fn equations(source: &Source) -> Result<&super::System> {
    let none =
        || Error::new(ErrorKind::BadValue, "the source has no equations, no chain and no limbs").in_file(&source.path);
    source.system.as_ref().ok_or_else(none)
}
