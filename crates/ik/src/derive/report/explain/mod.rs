//! The report that explains a derivation to students.
//!
//! It shows the equations that determine each joint, the joints that cancel, and the polynomials. It explains why each basis is correct, the origin of each
//! branch, and the behaviour at singularities. [`explain`] makes a [`Document`], which is printed as Markdown, LaTeX or plain text.
//! A [`Stage`] is a part of it.

mod algebra;
mod chain;
mod coupled;
mod document;
mod forms;
mod geometry;
mod latex;
mod markdown;
mod page;
mod step;
mod strata;
mod system;

pub use document::{Document, Line, Part, Span, Stage};
pub(super) use page::page;
pub(in crate::derive) use system::equations_page;

use crate::Result;
use crate::derive::{AnyView, Derivation, redundant};

/// The report of a derivation.
///
/// # Errors
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn explain(derivation: &Derivation) -> Result<Document> {
    document(derivation, None)
}

/// The report of one stage of a derivation, or of all; without parts for a stage that the method does not have.
///
/// # Errors
/// As [`explain`].
pub(super) fn document(derivation: &Derivation, stage: Option<Stage>) -> Result<Document> {
    let mut document = match derivation.view() {
        AnyView::Equations(equations) => system::document(equations, stage)?,
        AnyView::Sequential(derived) => chain::document(derived, stage)?,
        AnyView::Eigenvalue(derived) => derived.document(stage),
        AnyView::Coupled(derived) => coupled::document(derived, stage)?,
    };
    if let Some(redundancy) = derivation.redundancy().filter(|_| Stage::Plan.is_in(stage)) {
        redundant::section(&mut document, derivation, redundancy);
    }
    Ok(document)
}
