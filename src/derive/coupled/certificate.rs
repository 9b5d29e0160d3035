//! The stored proof of a solver of coupled chains: the certificates of the chains, in the order in which they are solved.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::derived::{DerivedCoupled, coupling};
use super::model::CoupledChains;
use crate::Result;
use crate::derive::certificate::{FORMAT, Proves, check_head, refused, unread, written};
use crate::derive::sequential::{Simultaneous, StoredSimultaneous, certificate};
use crate::kinematics::Chain;

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    format: u32,
    proves: Proves,
    name: String,
    /// How the joints that two chains share are found first, where that is done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    simultaneous: Option<StoredSimultaneous>,
    chains: Vec<Proof>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Proof {
    chain: String,
    certificate: Value,
}

impl DerivedCoupled {
    /// The text of `certificate.json`.
    ///
    /// # Errors
    /// As [`certificate::write`].
    pub fn certificate(&self) -> Result<String> {
        let mut record = Record {
            format: FORMAT.number,
            proves: Proves::CoupledChains,
            name: self.coupled.parts().name.clone(),
            simultaneous: self.simultaneous.as_ref().map(Simultaneous::stored).transpose()?,
            chains: Vec::new(),
        };
        for stage in &self.stages {
            let chain = self.coupled.chains()[stage.member].name.clone();
            let certificate = serde_json::from_str(&certificate::write(&stage.derived)?).map_err(|e| unread(&e))?;
            record.chains.push(Proof { chain, certificate });
        }
        Ok(written(&record))
    }

    /// Proves the derivation of `chains` anew from the text of its certificate, without search and without the Groebner engine.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Syntax`] with the line for text that is no certificate; [`crate::ErrorKind::Certificate`] with the chain, the step
    /// or the form for a claim that does not hold.
    pub fn prove(coupled: &CoupledChains, text: &str) -> Result<Self> {
        let record: Record = FORMAT.read(text)?;
        check_head((record.proves, &record.name), (Proves::CoupledChains, &coupled.parts().name))?;
        let mut stored = record.chains.iter();
        let mut prove = |member: usize, chain: &Chain| match stored.next() {
            Some(proof) if proof.chain == coupled.chains()[member].name => {
                certificate::prove(chain, &proof.certificate.to_string())
            }
            _ => Err(refused("its certificate is missing or not in its place".to_owned())),
        };
        let simultaneous = match (coupling(coupled)?, &record.simultaneous) {
            (Some((sides, shared)), Some(stored)) => Some(Simultaneous::again(sides, shared, stored)?),
            // Where no relations of shared joints fit, the chains are solved one after the other.
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
