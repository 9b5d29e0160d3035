//! What a certificate must claim at least, from the input alone: [`Proved::recount`].

use super::certificate::refused;
use super::closure::Mechanism;
use super::coupled::DerivedCoupled;
use super::eigenvalue::DerivedSixAxes;
use super::planner::{same_evidence, same_plan};
use super::sequential::Derived;
use super::Proved;
use crate::{Result, Watch};

impl Proved {
    /// Fails where a proof, though it holds, claims less than the derivation of its input does: it counts the solutions of the mechanism again,
    /// modulo the same primes, and looks for what was left out. The strata of equations need no count: those that are required follow from the
    /// proof itself, and [`Proved::again`] asks the engine about those that are claimed to be open.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Certificate`] with what is claimed and what there is; what `watch` stops with.
    pub fn recount(&self, watch: &Watch) -> Result<()> {
        match self {
            Proved::Equations(_) => Ok(()),
            Proved::Chain(derived) => recount_chain(derived, watch),
            Proved::SixAxes(derived) => recount_six_axes(derived, watch),
            Proved::Coupled(derived) => recount_coupled(derived, watch),
        }
    }
}

fn recount_chain(derived: &Derived, watch: &Watch) -> Result<()> {
    same_plan(&Mechanism::new(&derived.chain)?, &derived.plan, watch)
}

fn recount_six_axes(derived: &DerivedSixAxes, watch: &Watch) -> Result<()> {
    same_evidence(&Mechanism::new(&derived.chain)?, &derived.evidence, derived.dimension(), watch)?;
    if derived.has_all_formulations()? {
        return Ok(());
    }
    Err(refused("the formulations are not those that are regular and most accurate, the best first".to_owned()))
}

fn recount_coupled(derived: &DerivedCoupled, watch: &Watch) -> Result<()> {
    if derived.leaves_shared_joints_out(watch)? {
        return Err(refused("the proof of the shared joints is missing".to_owned()));
    }
    for stage in &derived.stages {
        let name = &derived.coupled.chains()[stage.member].name;
        recount_chain(&stage.derived, watch).map_err(|error| error.with_context(format_args!("chain `{name}`")))?;
    }
    Ok(())
}
