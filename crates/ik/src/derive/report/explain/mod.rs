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

use crate::Result;
use crate::derive::{AnyView, Derivation};

/// The report of a derivation.
///
/// # Errors
/// When a field cannot be built: never for a derivation that was made by this crate.
pub fn explain(derivation: &Derivation) -> Result<Document> {
    match derivation.view() {
        AnyView::Equations(equations) => system::document(equations),
        AnyView::Sequential(derived) => chain::document(derived),
        AnyView::Eigenvalue(derived) => Ok(derived.document()),
        AnyView::Coupled(derived) => coupled::document(derived),
    }
}
