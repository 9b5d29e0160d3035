//! The solution by eigenvalue problems ([`Eigenvalue`]), and its proof from the text of a certificate.

use groebot_runtime::six_axes::SIZE;
use serde::{Deserialize, Serialize};

use super::given::Six;
use super::program::{program, within};
use super::{Determinant, Regular, ranked};
use crate::derive::closure::Mechanism;
use crate::derive::equations::certificate::refused;
use crate::derive::planner::{self, Evidence};
use crate::derive::problem::ChainProblem;
use crate::derive::sequential::checks_on;
use crate::derive::view::View;
use crate::solver::Program;
use crate::solver::eigenvalue::Formulation;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::{Certificate, Proves, head_of};
use groebot_robot::kinematics::Chain;

/// The solution by eigenvalue problems of a chain of six joints with arbitrary axes. Further joints anywhere in the chain may be given.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Eigenvalue {
    /// The six joints that are found together, with the given joints at zero.
    pub six: Chain,
    /// The numbers of complex solutions of random targets modulo primes.
    pub evidence: Vec<Evidence>,
    /// The eigenvalue problems, in the order in which they are tried. Each is proved to be regular.
    pub formulations: Vec<Regular>,
}

/// The view of a chain that is solved by eigenvalue problems.
pub type EigenvalueView<'a> = View<'a, ChainProblem, Eigenvalue>;

/// The claims about six axes.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::derive) struct Claims {
    evidence: Vec<Evidence>,
    formulations: Vec<Entry>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    formulation: Formulation,
    determinants: Vec<Determinant>,
}

impl Eigenvalue {
    /// Counts the solutions of `problem`, finds and ranks the regular formulations, and compiles its solver.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a chain that does not fit the eigenvalue problem ([`fits`](super::fits)), that has infinitely many solutions, or that has
    /// no regular and accurate formulation. The error of `watch` if it stops the derivation.
    pub(in crate::derive) fn derive(problem: &ChainProblem, watch: &Watch) -> Result<(Self, Program)> {
        let six = Six::of(&problem.chain)?;
        let unsupported = |text: &str| Error::new(ErrorKind::Unsupported, text);
        let evidence = planner::evidence(&Mechanism::new(&problem.chain)?, watch)?;
        let evidence = evidence.ok_or_else(|| unsupported("joints are free at every target"))?;
        let formulations = ranked(&problem.chain)?;
        Eigenvalue { six: six.chain, evidence, formulations }.compiled(problem)
    }

    /// Proves the solution of `problem` again from the text of its certificate. Every determinant is evaluated again.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with the line for text that is not a certificate; [`ErrorKind::Certificate`] for a false claim.
    pub(in crate::derive) fn prove(problem: &ChainProblem, text: &str) -> Result<(Self, Program)> {
        Eigenvalue::prove_claims(problem, Certificate::read(text, Proves::EigenvalueProblem, problem.chain.name())?)
    }

    /// Proves the solution of `problem` again from its claims.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] for a false claim.
    pub(in crate::derive) fn prove_claims(problem: &ChainProblem, claims: Claims) -> Result<(Self, Program)> {
        let six = Six::of(&problem.chain)?;
        let formulations: Result<Vec<Regular>> = claims.formulations.iter().map(|entry| entry.prove(&six)).collect();
        let formulations = formulations?;
        let claimed = claims.evidence.iter().map(|evidence| evidence.dimension).max().unwrap_or(0);
        if formulations.is_empty() || claimed == 0 || claimed > SIZE {
            return Err(refused(format!("{} formulations, {claimed} solutions", formulations.len())));
        }
        Eigenvalue { six: six.chain, evidence: claims.evidence, formulations }.compiled(problem)
    }

    /// The least of the counted numbers of complex solutions.
    pub fn dimension(&self) -> usize {
        self.evidence.iter().map(|evidence| evidence.dimension).min().unwrap_or(SIZE)
    }

    /// Adds the solver of `problem`, which polishes its solutions on the described chain.
    fn compiled(self, problem: &ChainProblem) -> Result<(Self, Program)> {
        let mut program = self.unpolished(&problem.chain)?;
        if let Some((truth, report)) = &problem.truth {
            program.checks = checks_on(&problem.chain, truth)?;
            within(&mut program, report.deviation())?;
            (program.nearby, program.isolated) = (true, None);
        }
        Ok((self, program))
    }

    /// The solver of the ideal chain itself.
    fn unpolished(&self, chain: &Chain) -> Result<Program> {
        let order = self.formulations.iter().map(|regular| regular.formulation).collect();
        program(chain, &Six::of(chain)?, order, self.dimension())
    }
}

impl EigenvalueView<'_> {
    /// The solver of the ideal chain itself, if the program polishes its solutions on another chain.
    ///
    /// # Errors
    /// As [`Mechanism::new`].
    pub fn unpolished(&self) -> Result<Option<Program>> {
        self.problem.truth.as_ref().map(|_| self.method.unpolished(&self.problem.chain)).transpose()
    }

    /// The text of `certificate.json`.
    pub(in crate::derive) fn certificate(&self) -> String {
        Certificate::new(Proves::EigenvalueProblem, self.problem.chain.name(), self.claims()).to_json()
    }

    /// The claims of the certificate.
    pub(in crate::derive) fn claims(&self) -> Claims {
        let entry =
            |regular: &Regular| Entry { formulation: regular.formulation, determinants: regular.determinants.clone() };
        let formulations = self.method.formulations.iter().map(entry).collect();
        Claims { evidence: self.method.evidence.clone(), formulations }
    }
}

/// Whether `text` is the certificate of eigenvalue problems.
pub(in crate::derive) fn is_certificate(text: &str) -> bool {
    head_of(text).is_some_and(|(proves, _)| proves == Proves::EigenvalueProblem)
}

impl Entry {
    fn prove(&self, six: &Six) -> Result<Regular> {
        let formulation = self.formulation;
        let name = format!("the formulation that hides joint {}", formulation.hidden + 1);
        if !formulation.is_valid() || self.determinants.iter().all(|determinant| determinant.value == 0) {
            return Err(refused(format!("{name} is not shown to be regular")));
        }
        for determinant in &self.determinants {
            let again = Determinant::of_six(six, formulation, determinant.prime, determinant.seed)?;
            if again != *determinant {
                return Err(refused(format!("{name}: the determinant modulo {} differs", determinant.prime)));
            }
        }
        Ok(Regular { formulation, determinants: self.determinants.clone() })
    }
}
