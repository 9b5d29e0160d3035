//! What a certificate must claim at least, from the input alone. Main type: [`Recount`].

use crate::derive::closure::Mechanism;
use crate::derive::coupled::CoupledView;
use crate::derive::eigenvalue::{EigenvalueView, Regular, ranked};
use crate::derive::equations::certificate::refused;
use crate::derive::planner::{Evidence, evidence, same_degrees, same_evidence};
use crate::derive::sequential::SequentialView;
use crate::derive::{AnyView, Derivation};
use crate::{Result, Watch};
use groebot_robot::kinematics::Chain;

/// Counts the solutions of mechanisms again, at the same targets modulo the same primes as their derivations, and looks for what was left out. It
/// remembers what it has counted.
///
/// The strata of equations need no count: those that are required follow from the proof itself, and [`Derivation::prove`] asks the engine about those
/// that are claimed to be open.
pub struct Recount {
    watch: Watch,
    evidence: Vec<(Chain, Option<Vec<Evidence>>)>,
    formulations: Vec<(Chain, Vec<Regular>)>,
}

impl Recount {
    /// One that has counted nothing yet; `watch` stops it.
    pub fn new(watch: &Watch) -> Self {
        Recount { watch: watch.clone(), evidence: Vec::new(), formulations: Vec::new() }
    }

    /// Fails where a proof, though it holds, claims less than the derivation of its input does.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Certificate`] with what is claimed and what there is; what the watch stops with.
    pub fn check(&mut self, derivation: &Derivation) -> Result<()> {
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
        if *self.formulations(&derived.method.six)? == derived.method.formulations {
            return Ok(());
        }
        Err(refused("the formulations are not those that are regular and most accurate, the best first".to_owned()))
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

    /// What random targets of `chain` show; none where they have infinitely many solutions.
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

    /// The formulations of the eigenvalue problem of six joints that a derivation takes.
    fn formulations(&mut self, six: &Chain) -> Result<&Vec<Regular>> {
        let place = match self.formulations.iter().position(|(known, _)| known == six) {
            Some(place) => place,
            None => {
                self.formulations.push((six.clone(), ranked(six)?));
                self.formulations.len() - 1
            }
        };
        Ok(&self.formulations[place].1)
    }
}
