//! The stored proof of a solver of limbs: the certificates of the limbs' chains, in the order in which they are solved.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::derived::{DerivedLimbs, coupling};
use super::model::Limbs;
use crate::Result;
use crate::derive::certificate::{check_head, refused, unread, written};
use crate::derive::lift::{Coupled, StoredCoupled, certificate};
use crate::kinematics::Chain;

/// The version of the format; that of one chain has number 2.
const FORMAT: u32 = 3;

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    format: u32,
    groebot: String,
    name: String,
    /// How the joints that two limbs share are found first, where that is done.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    coupled: Option<StoredCoupled>,
    limbs: Vec<Proof>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Proof {
    limb: String,
    certificate: Value,
}

impl DerivedLimbs {
    /// The text of `certificate.json`.
    ///
    /// # Errors
    /// As [`certificate::write`].
    pub fn certificate(&self) -> Result<String> {
        let mut record = Record {
            format: FORMAT,
            groebot: env!("CARGO_PKG_VERSION").to_owned(),
            name: self.limbs.parts().name.clone(),
            coupled: self.coupled.as_ref().map(Coupled::stored).transpose()?,
            limbs: Vec::new(),
        };
        for stage in &self.stages {
            let limb = self.limbs.limbs()[stage.limb].name.clone();
            let certificate = serde_json::from_str(&certificate::write(&stage.derived)?).map_err(|e| unread(&e))?;
            record.limbs.push(Proof { limb, certificate });
        }
        Ok(written(&record))
    }

    /// Proves the derivation of `limbs` anew from the text of its certificate, without search and without the Groebner engine.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Syntax`] with the line for text that is no certificate; [`crate::ErrorKind::Certificate`] with the limb, the step
    /// or the form for a claim that does not hold.
    pub fn prove(limbs: &Limbs, text: &str) -> Result<Self> {
        let record: Record = serde_json::from_str(text).map_err(|error| unread(&error))?;
        check_head((record.format, &record.name), (FORMAT, &limbs.parts().name))?;
        let mut stored = record.limbs.iter();
        let mut prove = |limb: usize, chain: &Chain| match stored.next() {
            Some(proof) if proof.limb == limbs.limbs()[limb].name => {
                certificate::prove(chain, &proof.certificate.to_string())
            }
            _ => Err(refused("its certificate is missing or not in its place".to_owned())),
        };
        let coupled = match (coupling(limbs)?, &record.coupled) {
            (Some((sides, shared)), Some(stored)) => Some(Coupled::again(sides, shared, stored)?),
            // Where no relations of shared joints fit, the limbs are solved one after the other.
            (_, None) => None,
            _ => return Err(refused("the proof of the shared joints is missing or left over".to_owned())),
        };
        let derived = DerivedLimbs::assemble(limbs, coupled, &mut prove)?;
        match stored.next() {
            None => Ok(derived),
            Some(proof) => Err(refused(format!("the certificate of `{}` is left over", proof.limb))),
        }
    }
}
