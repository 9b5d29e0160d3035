//! The report that explains a derivation to a student: which equations determine which joints and what cancels in them, the
//! polynomials, why each basis is right, where each branch comes from, and what happens at singularities.
//!
//! [`explain`] makes a [`Document`], which is printed as Markdown or as LaTeX.

mod algebra;
mod chain;
mod coupled;
mod document;
mod forms;
mod geometry;
mod latex;
mod markdown;
mod step;
mod strata;
mod system;

pub use document::{Document, Line, Part, Span};

use super::Proved;
use crate::Result;

/// The report of a derivation.
///
/// # Errors
/// When a field cannot be built: never for a derivation that was made by this crate.
pub fn explain(proved: &Proved) -> Result<Document> {
    match proved {
        Proved::Equations(derivation) => system::document(derivation),
        Proved::Chain(derived) => chain::document(derived),
        Proved::SixAxes(derived) => Ok(derived.document()),
        Proved::Coupled(derived) => coupled::document(derived),
    }
}
