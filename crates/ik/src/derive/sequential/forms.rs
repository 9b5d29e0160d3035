//! The forms of the steps of a chain, solved and proved: [`Forms`].
//!
//! The bases of a form are independent of the mechanism. `forms.json` stores them with their cofactors, and a certificate names each form with the hash of its
//! stored proof. Every derivation and every check verifies the stored proof of the forms that it uses.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::ProvedStep;
use super::form_basis::{Form, FormBasis};
use super::half_angle::{self, HalfAngles};
use crate::derive::Orders;
use crate::derive::equations::certificate::{Entry, entries, refused, replay};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::json_text;

/// The stored proofs of all forms.
const STORED: &str = include_str!("forms.json");
/// The forms with stored strata. Half angles solve [`Form::Quartic`].
const ALL: [Form; 6] = [Form::Angle, Form::Rotation, Form::Pair, Form::Linear, Form::Lengths, Form::Quadratic];

/// The proofs of all forms as JSON.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stored {
    form_bases: Vec<Proof>,
    half_angles: Vec<half_angle::Stored>,
}

/// The strata of a form with their proofs.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Proof {
    form: Form,
    strata: Vec<Entry>,
}

/// A form in a certificate.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NamedForm {
    form: Form,
    /// The SHA-256 hash of its stored proof.
    hash: String,
}

/// The forms of steps, solved and proved.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Forms {
    /// The forms with bases over the rational functions of their symbols, in their order.
    pub bases: Vec<FormBasis>,
    /// The half angles, if a step has an equation of degree two in cosine and sine.
    pub half_angles: Option<HalfAngles>,
    named: Vec<NamedForm>,
}

impl Forms {
    /// The forms that `steps` use, with their stored proofs verified.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] for a stored proof that fails, which does not happen.
    pub(super) fn of(steps: &[ProvedStep]) -> Result<Self> {
        let stored: Stored = serde_json::from_str(STORED).map_err(|error| refused(format!("forms.json: {error}")))?;
        let mut forms = Forms { bases: Vec::new(), half_angles: None, named: Vec::new() };
        let mut needed: Vec<Form> = steps.iter().flat_map(|step| step.shape.form.needs()).copied().collect();
        needed.sort_unstable();
        needed.dedup();
        for form in needed {
            let hash = match form {
                Form::Quartic => {
                    forms.half_angles = Some(HalfAngles::reprove(&stored.half_angles)?);
                    hash(&stored.half_angles)
                }
                _ => {
                    let proof = stored.form_bases.iter().find(|proof| proof.form == form);
                    let proof = proof.ok_or_else(|| refused(format!("the form `{}` is not stored", form.name())))?;
                    forms.bases.push(proof.verified()?);
                    hash(proof)
                }
            };
            forms.named.push(NamedForm { form, hash });
        }
        Ok(forms)
    }

    /// The forms for a certificate.
    pub(super) fn named(&self) -> Vec<NamedForm> {
        self.named.clone()
    }

    /// Same as [`Forms::of`], for the forms that a certificate names.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] if they are not those of the steps.
    pub(super) fn reprove(steps: &[ProvedStep], named: &[NamedForm]) -> Result<Self> {
        let forms = Forms::of(steps)?;
        if let Some((own, _)) = forms.named.iter().zip(named).find(|(own, other)| own != other) {
            return Err(refused(format!("form `{}`: the certificate names another form or proof", own.form.name())));
        }
        match forms.named.len() == named.len() {
            true => Ok(forms),
            false => Err(refused("the forms are not those of the steps, in their order".to_owned())),
        }
    }

    /// The bases of one form.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] if no step uses the form.
    pub(super) fn basis(&self, form: Form) -> Result<&FormBasis> {
        let missing = || Error::new(ErrorKind::Certificate, format!("the form `{}` is missing", form.name()));
        self.bases.iter().find(|form_basis| form_basis.form == form).ok_or_else(missing)
    }

    /// The content of `forms.json`, derived by the Groebner engine.
    ///
    /// # Errors
    /// The error of `watch` if it stops the derivation.
    pub fn derive_stored<'w>(watch: impl Into<Option<&'w Watch>>) -> Result<String> {
        let watch = Watch::or_none(watch);
        let proof = |form| Ok(Proof { form, strata: entries(&FormBasis::derive(form, watch)?.tree)? });
        let form_bases = ALL.into_iter().map(proof).collect::<Result<_>>()?;
        Ok(json_text(&Stored { form_bases, half_angles: HalfAngles::derive(watch)?.stored() }))
    }

    /// The content of `forms.json`.
    pub fn stored() -> &'static str {
        STORED
    }
}

impl Proof {
    fn verified(&self) -> Result<FormBasis> {
        let system = self.form.system()?;
        let tree = replay(&system, Orders::Requested, &self.strata)
            .map_err(|error| refused(format!("form `{}`: {}", self.form.name(), error.message())))?;
        Ok(FormBasis { form: self.form, system, tree })
    }
}

/// The hash of a stored proof, in hexadecimal digits.
fn hash(proof: &impl Serialize) -> String {
    let digest = Sha256::digest(json_text(proof));
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
