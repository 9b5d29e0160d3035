//! The format of every stored proof: what it proves, for which mechanism, and its claims. Main type: [`Certificate`].

use std::fmt;

use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};

use super::json::{JsonFormat, json_text};
use super::shown;
use crate::{Error, ErrorKind, Result};

const FORMAT: JsonFormat = JsonFormat {
    what: "certificate",
    oldest: 7,
    number: 7,
    renew: "`groebot derive`, or for equations of motion `groebot dynamics --symbolic`, on its folder writes it again",
};

/// Subject of a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Proves {
    /// Equations whose solution set is proved.
    Equations,
    /// A chain that is solved joint by joint (sequential method).
    Chain,
    /// A chain that is solved as an eigenvalue problem.
    EigenvalueProblem,
    /// Chains that share joints.
    CoupledChains,
    /// A chain with one redundant joint, with each joint as the given one.
    RedundantChain,
    /// Equations of motion.
    Dynamics,
}

impl fmt::Display for Proves {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Proves::Equations => "the equations",
            Proves::Chain => "the chain",
            Proves::EigenvalueProblem => "the eigenvalue problem",
            Proves::CoupledChains => "the coupled chains",
            Proves::RedundantChain => "the redundant chain",
            Proves::Dynamics => "the equations of motion",
        })
    }
}

/// A stored proof. The type of the claims depends on its subject.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate<Claims> {
    format: u32,
    proves: Proves,
    /// The mechanism.
    name: String,
    claims: Claims,
}

impl<Claims> Certificate<Claims> {
    /// Builds the certificate of these claims about the mechanism `name`.
    pub fn new(proves: Proves, name: &str, claims: Claims) -> Self {
        Certificate { format: FORMAT.number, proves, name: name.to_owned(), claims }
    }

    /// The claims of a certificate with this subject about the mechanism `name`.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] for a certificate with another subject.
    pub fn claims(self, proves: Proves, name: &str) -> Result<Claims> {
        if (self.proves, self.name.as_str()) == (proves, name) {
            return Ok(self.claims);
        }
        let words = |(proves, name): (Proves, &str)| format!("{proves} `{}`", shown(name));
        let (found, allowed) = (words((self.proves, &self.name)), words((proves, name)));
        let text = format!("this certificate proves {found}; one of {allowed} is allowed");
        Err(Error::new(ErrorKind::Certificate, text))
    }
}

impl<Claims: Serialize> Certificate<Claims> {
    /// The text of the certificate. Equal claims give equal bytes.
    pub fn to_json(&self) -> String {
        json_text(self)
    }
}

impl<Claims: DeserializeOwned> Certificate<Claims> {
    /// Reads the claims in `text`, a certificate with this subject about the mechanism `name`.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with the line for text that is not a certificate; [`ErrorKind::Unsupported`] for another
    /// format; those of [`Certificate::claims`].
    pub fn read(text: &str, proves: Proves, name: &str) -> Result<Claims> {
        FORMAT.read::<Certificate<IgnoredAny>>(text)?.claims(proves, name)?;
        FORMAT.read::<Self>(text)?.claims(proves, name)
    }
}

/// The subject and the mechanism of the certificate in `text`; `None` for text that is not a certificate of this
/// format.
pub fn head_of(text: &str) -> Option<(Proves, String)> {
    let Certificate { proves, name, .. } = FORMAT.read::<Certificate<IgnoredAny>>(text).ok()?;
    Some((proves, name))
}
