//! A report that explains a derivation to a student.
//!
//! It shows the equations that determine each joint, the joints that cancel, and the polynomials. It explains why each basis is correct, the origin of each
//! branch, and the behaviour at singularities. [`explain`] makes a [`Document`], which is printed as Markdown or LaTeX.

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
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn explain(derivation: &Derivation) -> Result<Document> {
    match derivation.view() {
        AnyView::Equations(equations) => system::document(equations),
        AnyView::Sequential(derived) => chain::document(derived),
        AnyView::Eigenvalue(derived) => Ok(derived.document()),
        AnyView::Coupled(derived) => coupled::document(derived),
    }
}
