//! The derivation of six axes ([`DerivedSixAxes`]), and its proof from the text of a certificate.

use groebot_runtime::six_axes::SIZE;
use serde::{Deserialize, Serialize};

use super::given::Six;
use super::program::{program, within};
use super::{Determinant, Regular, ranked};
use crate::derive::certificate::refused;
use crate::derive::closure::Mechanism;
use crate::derive::planner::{self, Evidence};
use crate::derive::sequential::checks_on;
use crate::solver::Program;
use crate::solver::eigenvalue::Formulation;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::{Certificate, Proves, head_of};
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::ideal::Report;

/// The solver of a chain of six joints with axes in any place, or of seven of which the first or the last is given.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedSixAxes {
    /// The chain.
    pub chain: Chain,
    /// The chain that answers are polished and measured on, where `chain` is its ideal, and what was taken for what.
    pub truth: Option<(Chain, Report)>,
    /// Its six joints that are found together, the given one, if there is one, at zero.
    pub six: Chain,
    /// How many complex solutions random targets modulo primes had.
    pub evidence: Vec<Evidence>,
    /// The eigenvalue problems in the order in which they are tried, each proved regular.
    pub formulations: Vec<Regular>,
    /// The solver.
    pub program: Program,
    /// The solver of the ideal chain itself, where `program` polishes its answers on another.
    pub unpolished: Option<Box<Program>>,
}

/// What is claimed about six axes.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    evidence: Vec<Evidence>,
    formulations: Vec<Entry>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    formulation: Formulation,
    determinants: Vec<Determinant>,
}

impl DerivedSixAxes {
    /// Counts the solutions, finds the regular formulations and ranks them.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a chain that the eigenvalue problem is not for ([`fits`](super::fits)), with infinitely many solutions, or
    /// without a formulation that is regular and accurate; what `watch` stops with.
    pub fn of_chain(chain: &Chain, watch: &Watch) -> Result<Self> {
        let six = Six::of(chain)?;
        let unsupported = |text: &str| Error::new(ErrorKind::Unsupported, text);
        let evidence = planner::evidence(&Mechanism::new(chain)?, watch)?;
        let evidence = evidence.ok_or_else(|| unsupported("joints are free at every target"))?;
        let formulations = ranked(&six.chain)?;
        DerivedSixAxes::assemble(chain, six, evidence, formulations)
    }

    /// Proves the derivation of `chain` anew from the text of its certificate: every determinant is evaluated again.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with the line for text that is no certificate; [`ErrorKind::Certificate`] for a claim that does not hold.
    pub fn prove(chain: &Chain, text: &str) -> Result<Self> {
        let claims: Claims = Certificate::read(text, Proves::EigenvalueProblem, chain.name())?;
        let six = Six::of(chain)?;
        let formulations: Result<Vec<Regular>> =
            claims.formulations.iter().map(|entry| entry.prove(&six.chain)).collect();
        let formulations = formulations?;
        let claimed = claims.evidence.iter().map(|evidence| evidence.dimension).max().unwrap_or(0);
        if formulations.is_empty() || claimed == 0 || claimed > SIZE {
            return Err(refused(format!("{} formulations, {claimed} solutions", formulations.len())));
        }
        DerivedSixAxes::assemble(chain, six, claims.evidence, formulations)
    }

    /// Whether `text` is the certificate of six axes.
    pub fn is_certificate(text: &str) -> bool {
        head_of(text).is_some_and(|(proves, _)| proves == Proves::EigenvalueProblem)
    }

    /// The text of `certificate.json`.
    pub fn certificate(&self) -> String {
        let entry =
            |regular: &Regular| Entry { formulation: regular.formulation, determinants: regular.determinants.clone() };
        let formulations = self.formulations.iter().map(entry).collect();
        let claims = Claims { evidence: self.evidence.clone(), formulations };
        Certificate::new(Proves::EigenvalueProblem, self.chain.name(), claims).to_json()
    }

    /// This solver, of an ideal chain, for the chain `truth` that means it, as [`Derived::polished_on`](super::super::sequential::Derived::polished_on).
    ///
    /// # Errors
    /// As [`Mechanism::new`].
    pub fn polished_on(mut self, truth: &Chain, report: Report) -> Result<Self> {
        self.unpolished = Some(Box::new(self.program.clone()));
        self.program.checks = checks_on(&self.chain, truth)?;
        within(&mut self.program, report.deviation())?;
        (self.program.nearby, self.program.isolated) = (true, None);
        self.truth = Some((truth.clone(), report));
        Ok(self)
    }

    /// The chain that answers are measured on.
    pub fn measured(&self) -> &Chain {
        self.truth.as_ref().map_or(&self.chain, |(truth, _)| truth)
    }

    /// The number of complex solutions of a generic reachable target.
    pub fn dimension(&self) -> usize {
        dimension(&self.evidence)
    }

    fn assemble(chain: &Chain, six: Six, evidence: Vec<Evidence>, formulations: Vec<Regular>) -> Result<Self> {
        let order = formulations.iter().map(|regular| regular.formulation).collect();
        let program = program(chain, &six, order, dimension(&evidence))?;
        Ok(DerivedSixAxes {
            chain: chain.clone(),
            truth: None,
            six: six.chain,
            evidence,
            formulations,
            program,
            unpolished: None,
        })
    }
}

/// The least number of complex solutions that was counted.
fn dimension(evidence: &[Evidence]) -> usize {
    evidence.iter().map(|evidence| evidence.dimension).min().unwrap_or(SIZE)
}

impl Entry {
    fn prove(&self, chain: &Chain) -> Result<Regular> {
        let formulation = self.formulation;
        let name = format!("the formulation that hides joint {}", formulation.hidden + 1);
        if !formulation.is_valid() || self.determinants.iter().all(|determinant| determinant.value == 0) {
            return Err(refused(format!("{name} is not shown to be regular")));
        }
        for determinant in &self.determinants {
            let again = Determinant::evaluate(chain, formulation, determinant.prime, determinant.seed)?;
            if again != *determinant {
                return Err(refused(format!("{name}: the determinant modulo {} is another", determinant.prime)));
            }
        }
        Ok(Regular { formulation, determinants: self.determinants.clone() })
    }
}
