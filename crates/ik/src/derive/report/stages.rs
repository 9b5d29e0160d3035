//! The files of a derivation: a text for each stage, the program, the certificate, and the README of its folder.

use super::explain::{Stage, document, page};
use crate::Result;
use crate::derive::Derivation;

/// The file names of the stages, in order.
pub const STAGES: [&str; 6] =
    ["1_equations.txt", "2_plan.txt", "3_basis.txt", "4_triangular.txt", "5_program.json", "certificate.json"];

/// The README of the mechanism's folder.
pub const PAGE: &str = "README.md";
/// The mark that distinguishes a generated README from a hand-written one.
pub const MARK: &str = "Written by `groebot derive`";

impl Derivation {
    /// The stage files with their names. Every run gives the same bytes.
    ///
    /// # Errors
    /// As [`Derivation::certificate`].
    pub fn stage_files(&self) -> Result<Vec<(String, Vec<u8>)>> {
        let [.., program, certificate] = STAGES;
        let mut files = Vec::new();
        for (name, stage) in STAGES.into_iter().zip([Stage::Equations, Stage::Plan, Stage::Basis, Stage::Triangular]) {
            let document = document(self, Some(stage))?;
            files.extend((!document.parts.is_empty()).then(|| (name, document.to_text())));
        }
        files.push((program, self.program().to_json()));
        files.push((certificate, self.certificate()?));
        files.push((PAGE, page(self)?.to_markdown()));
        Ok(files.into_iter().map(|(name, text)| (name.to_owned(), text.into_bytes())).collect())
    }
}
