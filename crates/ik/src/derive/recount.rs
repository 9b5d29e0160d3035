//! The minimum that a certificate must claim, computed from the input alone. Main type: [`Recount`].

use crate::derive::closure::Mechanism;
use crate::derive::coupled::CoupledView;
use crate::derive::eigenvalue::{EigenvalueView, Regular, ranked};
use crate::derive::equations::certificate::refused;
use crate::derive::planner::{Evidence, evidence, same_degrees, same_evidence};
use crate::derive::redundant::RedundantChain;
use crate::derive::sequential::SequentialView;
use crate::derive::{AnyView, Derivation};
use crate::{Result, Watch};
use groebot_robot::kinematics::Chain;

/// Counts the solutions of mechanisms again and compares the counts with certificates.
///
/// It uses the same targets modulo the same primes as the derivations, and it caches its counts. The strata of equations need no count: the proof itself
/// requires them. For strata that are claimed to be open, [`Derivation::prove`] runs the Groebner engine.
pub struct Recount {
    watch: Watch,
    evidence: Vec<(Chain, Option<Vec<Evidence>>)>,
    formulations: Vec<(Chain, Vec<Regular>)>,
}

impl Recount {
    /// Creates a recount with an empty cache; `watch` may stop it.
    pub fn new<'w>(watch: impl Into<Option<&'w Watch>>) -> Self {
        let watch = Watch::or_none(watch);
        Recount { watch: watch.clone(), evidence: Vec::new(), formulations: Vec::new() }
    }

    /// Returns an error if a valid proof claims less than the derivation of its input does.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Certificate`] with the claimed and the actual values. The error of the watch if it stops the count.
    pub fn check(&mut self, derivation: &Derivation) -> Result<()> {
        self.main(derivation)?;
        derivation.redundancy().into_iter().flat_map(RedundantChain::derivations).try_for_each(|(joint, other)| {
            let name = &derivation.program().joints[joint].name;
            self.main(other).map_err(|error| error.with_context(format_args!("{name} given")))
        })
    }

    fn main(&mut self, derivation: &Derivation) -> Result<()> {
        match derivation.view() {
            AnyView::Equations(_) => Ok(()),
            AnyView::Sequential(derived) => self.chain(derived),
            AnyView::Eigenvalue(derived) => self.six_axes(derived),
            AnyView::Coupled(derived) => self.coupled(derived),
        }
    }

    fn chain(&mut self, derived: SequentialView<'_>) -> Result<()> {
        let mechanism = Mechanism::new(&derived.problem.chain)?;
        let plan = &derived.method.plan;
        same_evidence(self.evidence(&derived.problem.chain, &mechanism)?, &plan.evidence, plan.dimension)?;
        same_degrees(&mechanism, plan, &self.watch)
    }

    fn six_axes(&mut self, derived: EigenvalueView<'_>) -> Result<()> {
        let mechanism = Mechanism::new(&derived.problem.chain)?;
        same_evidence(
            self.evidence(&derived.problem.chain, &mechanism)?,
            &derived.method.evidence,
            derived.method.dimension(),
        )?;
        if *self.formulations(&derived.problem.chain)? == derived.method.formulations {
            return Ok(());
        }
        Err(refused("the formulations are not the regular and most accurate ones, ordered by accuracy".to_owned()))
    }

    fn coupled(&mut self, derived: CoupledView<'_>) -> Result<()> {
        if derived.leaves_shared_joints_out(&self.watch)? {
            return Err(refused("the proof of the shared joints is missing".to_owned()));
        }
        for stage in &derived.method.stages {
            let name = &derived.problem.chains()[stage.member].name;
            self.chain(stage.view()).map_err(|error| error.with_context(format_args!("chain `{name}`")))?;
        }
        Ok(())
    }

    /// The evidence of random targets of `chain`; `None` if they have infinitely many solutions.
    fn evidence(&mut self, chain: &Chain, mechanism: &Mechanism) -> Result<Option<&[Evidence]>> {
        let place = match self.evidence.iter().position(|(counted, _)| counted == chain) {
            Some(place) => place,
            None => {
                self.evidence.push((chain.clone(), evidence(mechanism, &self.watch)?));
                self.evidence.len() - 1
            }
        };
        Ok(self.evidence[place].1.as_deref())
    }

    /// The formulations of the eigenvalue problem that a derivation of `chain` uses.
    fn formulations(&mut self, chain: &Chain) -> Result<&Vec<Regular>> {
        let place = match self.formulations.iter().position(|(known, _)| known == chain) {
            Some(place) => place,
            None => {
                self.formulations.push((chain.clone(), ranked(chain)?));
                self.formulations.len() - 1
            }
        };
        Ok(&self.formulations[place].1)
    }
}
