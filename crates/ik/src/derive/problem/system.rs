//! [`System`]: polynomial equations with named unknowns and parameters, checked, which every later stage reads.

use std::ops::Deref;

use serde::{Deserialize, Serialize};

use crate::Result;
use crate::derive::problem::check::{Mistake, check};
use crate::derive::problem::system_parts::SystemParts;

/// A checked system: read its [`SystemParts`] through it; it does not change.
///
/// It holds that: names are identifiers and mean one thing; every name in an equation is an unknown or a parameter;
/// a parameter's square mentions earlier parameters only; no equation divides by an unknown; `order` is a permutation
/// of the unknowns; the circle relation of every angle is given once, at the end of the equations.
///
/// Its `Display` is the stage file `1_equations.txt`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "SystemParts")]
pub struct System(SystemParts);

impl System {
    /// Checks `parts`, adds the circle relations that they lack, and relates cosines and sines of input angles.
    ///
    /// # Errors
    /// [`DuplicateName`](crate::ErrorKind::DuplicateName), [`UnknownName`](crate::ErrorKind::UnknownName),
    /// [`MissingKey`](crate::ErrorKind::MissingKey), [`BadValue`](crate::ErrorKind::BadValue),
    /// [`Overflow`](crate::ErrorKind::Overflow) for an equation whose expansion is hopeless, or
    /// [`Unsupported`](crate::ErrorKind::Unsupported) for more than [`MAX_UNKNOWNS`](crate::derive::MAX_UNKNOWNS) unknowns.
    pub fn new(parts: SystemParts) -> Result<Self> {
        System::build(parts).map_err(|mistake| mistake.error)
    }

    /// As [`System::new`], but a mistake says in which part it stands.
    pub(in crate::derive) fn build(mut parts: SystemParts) -> std::result::Result<Self, Mistake> {
        parts.complete_squares();
        check(&parts)?;
        parts.complete_circles();
        Ok(System(parts))
    }

    /// The parts, to make another system of.
    pub fn into_parts(self) -> SystemParts {
        self.0
    }
}

impl Deref for System {
    type Target = SystemParts;

    fn deref(&self) -> &SystemParts {
        &self.0
    }
}

impl TryFrom<SystemParts> for System {
    type Error = crate::Error;

    fn try_from(parts: SystemParts) -> Result<Self> {
        System::new(parts)
    }
}
