//! [`System`]: checked polynomial equations with named unknowns and parameters, the input of all later stages.

use std::ops::Deref;

use serde::{Deserialize, Serialize};

use crate::Result;
use crate::derive::problem::check::{Mistake, check};
use crate::derive::problem::system_parts::SystemParts;

/// A checked, immutable system. It dereferences to its [`SystemParts`].
///
/// Its invariants:
/// * Each name is an identifier with one meaning.
/// * Every name in an equation is an unknown or a parameter.
/// * A parameter's square mentions only earlier parameters.
/// * No equation divides by an unknown.
/// * `order` is a permutation of the unknowns.
/// * The circle relation of every angle occurs once, at the end of the equations.
///
/// Its `Display` is the stage file `1_equations.txt`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "SystemParts")]
pub struct System(SystemParts);

impl System {
    /// Checks `parts`, adds the circle relations that are missing, and relates cosines and sines of input angles.
    ///
    /// # Errors
    /// [`DuplicateName`](crate::ErrorKind::DuplicateName), [`UnknownName`](crate::ErrorKind::UnknownName), [`MissingKey`](crate::ErrorKind::MissingKey),
    /// [`BadValue`](crate::ErrorKind::BadValue). [`Overflow`](crate::ErrorKind::Overflow) for an equation whose expansion exceeds the limits.
    /// [`Unsupported`](crate::ErrorKind::Unsupported) for more than 16 unknowns.
    pub fn new(parts: SystemParts) -> Result<Self> {
        System::build(parts).map_err(|mistake| mistake.error)
    }

    /// Same as [`System::new`], but the error names the part that contains the mistake.
    pub(in crate::derive) fn build(mut parts: SystemParts) -> std::result::Result<Self, Mistake> {
        parts.complete_squares();
        check(&parts)?;
        parts.complete_circles();
        Ok(System(parts))
    }

    /// The parts, for building another system.
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
