//! The stored proof of a solver of coupled chains: the certificates of the chains, in the order of solution.

use serde::{Deserialize, Serialize};

use super::method::{ChainStage, Coupled, CoupledView, coupling};
use super::model::CoupledChains;
use crate::Result;
use crate::derive::equations::certificate::refused;
use crate::derive::problem::ChainProblem;
use crate::derive::sequential::{Simultaneous, StoredSimultaneous, certificate};
use crate::solver::Program;
use groebot_robot::document::{Certificate, Proves};

/// The claims about coupled chains.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    /// The derivation of joints that two chains share and that are found first, if there are any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    simultaneous: Option<StoredSimultaneous>,
    chains: Vec<Proof>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Proof {
    chain: String,
    certificate: Certificate<certificate::Claims>,
}

impl CoupledView<'_> {
    /// The text of `certificate.json`.
    ///
    /// # Errors
    /// As [`certificate::write`].
    pub(in crate::derive) fn certificate(&self) -> Result<String> {
        let proof = |stage: &ChainStage| {
            let chain = self.problem.chains()[stage.member].name.clone();
            Ok(Proof { chain, certificate: certificate::certificate(stage.view())? })
        };
        let claims = Claims {
            simultaneous: self.method.simultaneous.as_ref().map(Simultaneous::stored).transpose()?,
            chains: self.method.stages.iter().map(proof).collect::<Result<_>>()?,
        };
        Ok(Certificate::new(Proves::CoupledChains, &self.problem.parts().name, claims).to_json())
    }
}

impl Coupled {
    /// Proves the solution of `coupled` again from the text of its certificate, and composes its solver. It uses no search and no Groebner engine.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Syntax`] with the line for text that is not a certificate. [`crate::ErrorKind::Certificate`] with the chain, the step or the form
    /// for a false claim.
    pub(in crate::derive) fn prove(coupled: &CoupledChains, text: &str) -> Result<(Self, Program)> {
        let claims: Claims = Certificate::read(text, Proves::CoupledChains, &coupled.parts().name)?;
        let mut stored = claims.chains.into_iter();
        let mut prove = |member: usize, problem: &ChainProblem| match stored.next() {
            Some(proof) if proof.chain == coupled.chains()[member].name => {
                let claims = proof.certificate.claims(Proves::Chain, problem.chain.name())?;
                certificate::prove_claims(problem, claims)
            }
            _ => Err(refused("its certificate is missing or not in its place".to_owned())),
        };
        let simultaneous = match (coupling(coupled)?, &claims.simultaneous) {
            (Some((sides, shared)), Some(stored)) => Some(Simultaneous::reprove(sides, shared, stored)?),
            // If no relations of shared joints fit, the chains are solved one after the other. A recount checks that none fit.
            (_, None) => None,
            _ => return Err(refused("the proof of the shared joints is missing or superfluous".to_owned())),
        };
        let derived = Coupled::assemble(coupled, simultaneous, &mut prove)?;
        match stored.next() {
            None => Ok(derived),
            Some(proof) => Err(refused(format!("the certificate of `{}` is superfluous", proof.chain))),
        }
    }
}
