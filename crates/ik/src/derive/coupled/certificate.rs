//! The stored proof of a solver of coupled chains: the certificates of the chains, in the order in which they are solved.

use serde::{Deserialize, Serialize};

use super::derived::{ChainStage, DerivedCoupled, coupling};
use super::model::CoupledChains;
use crate::Result;
use crate::derive::certificate::refused;
use crate::derive::sequential::{Simultaneous, StoredSimultaneous, certificate};
use groebot_robot::document::{Certificate, Proves};
use groebot_robot::kinematics::Chain;

/// What is claimed about coupled chains.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claims {
    /// How the joints that two chains share are found first, where that is done.
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

impl DerivedCoupled {
    /// The text of `certificate.json`.
    ///
    /// # Errors
    /// As [`certificate::write`].
    pub fn certificate(&self) -> Result<String> {
        let proof = |stage: &ChainStage| {
            let chain = self.coupled.chains()[stage.member].name.clone();
            Ok(Proof { chain, certificate: certificate::certificate(&stage.derived)? })
        };
        let claims = Claims {
            simultaneous: self.simultaneous.as_ref().map(Simultaneous::stored).transpose()?,
            chains: self.stages.iter().map(proof).collect::<Result<_>>()?,
        };
        Ok(Certificate::new(Proves::CoupledChains, &self.coupled.parts().name, claims).to_json())
    }

    /// Proves the derivation of `chains` anew from the text of its certificate, without search and without the Groebner engine.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Syntax`] with the line for text that is no certificate; [`crate::ErrorKind::Certificate`] with the chain, the step
    /// or the form for a claim that does not hold.
    pub fn prove(coupled: &CoupledChains, text: &str) -> Result<Self> {
        let claims: Claims = Certificate::read(text, Proves::CoupledChains, &coupled.parts().name)?;
        let mut stored = claims.chains.into_iter();
        let mut prove = |member: usize, chain: &Chain| match stored.next() {
            Some(proof) if proof.chain == coupled.chains()[member].name => {
                let claims = proof.certificate.claims(Proves::Chain, chain.name())?;
                certificate::prove_claims(chain, claims)
            }
            _ => Err(refused("its certificate is missing or not in its place".to_owned())),
        };
        let simultaneous = match (coupling(coupled)?, &claims.simultaneous) {
            (Some((sides, shared)), Some(stored)) => Some(Simultaneous::again(sides, shared, stored)?),
            // Where no relations of shared joints fit, the chains are solved one after the other; that they do not fit, a recount tells.
            (_, None) => None,
            _ => return Err(refused("the proof of the shared joints is missing or left over".to_owned())),
        };
        let derived = DerivedCoupled::assemble(coupled, simultaneous, &mut prove)?;
        match stored.next() {
            None => Ok(derived),
            Some(proof) => Err(refused(format!("the certificate of `{}` is left over", proof.chain))),
        }
    }
}
