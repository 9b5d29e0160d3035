//! The part of reports on the redundancy of a chain.

use super::{Part, RedundantChain};
use crate::derive::report::explain::{Document, Line};
use crate::derive::{AnyView, Derivation};

/// Adds the section about the given joints to `page`.
pub(in crate::derive) fn section(page: &mut Document, derivation: &Derivation, redundancy: &RedundantChain) {
    page.section(Line::of("All solutions within limits"));
    if redundancy.parts.contains(&Part::Scanned) {
        page.text(
            "The chain has several joints more than its task determines. The ranges of some are scanned: samples of their values are given. Completeness is \
             that of these samples.",
        );
    }
    page.text(
        "With one joint more than the task determines, the solutions of a target are curves. A curve enters or leaves the joint limits only \
         where a joint is at a limit. These end points are the solutions with that joint given at that limit. The curves are followed from \
         end point to end point: the result is all arcs of solutions within limits. Curves that touch no limit are searched for separately. \
         With each joint given:",
    );
    page.items(items(derivation, redundancy));
    if let Some(line) = closed(derivation) {
        page.paragraph(line);
    }
}

/// Where curves that touch no limit are searched.
fn closed(derivation: &Derivation) -> Option<Line> {
    let program = derivation.program();
    let closed = program.redundancy.as_ref()?.closed.as_ref()?;
    let name = |line: Line, joint: usize| line.name(&program.joints[joint].name);
    let line = name(Line::of("Curves that touch no limit are searched at values of "), closed.grid);
    let line = closed
        .sections
        .iter()
        .fold(line, |line, section| name(line.words(&format!(", and at {} of ", section.value)), section.joint));
    Some(line.words("."))
}

/// By joint, the solver with this joint given.
fn items(derivation: &Derivation, redundancy: &RedundantChain) -> Vec<Line> {
    let joints = &derivation.program().joints;
    let line = |(joint, part): (usize, &Part)| {
        let line = Line::default().name(&joints[joint].name).words(": ");
        match part {
            Part::Main => line.words(&(solved(derivation) + "; the solver of this page")),
            Part::Derived(other) => line.words(&solved(other)),
            Part::Constant => line.words(
                "the target determines it. It is constant on every self-motion, so it is only compared with its limits",
            ),
            Part::Scanned => line.words("scanned"),
            Part::Unsolved(reason) => line.words("no solver: ").words(reason),
        }
    };
    redundancy.parts.iter().enumerate().map(line).collect()
}

impl Derivation {
    /// By joint of a redundant chain, the solver with this joint given, as text; empty for other derivations.
    pub fn redundancy_lines(&self) -> Vec<String> {
        let lines = self.redundancy().map(|redundancy| items(self, redundancy)).unwrap_or_default();
        lines.iter().map(Line::to_plain).collect()
    }
}

/// The method of a derivation, such as `closed form, up to 8 solutions`.
fn solved(derivation: &Derivation) -> String {
    let method = match derivation.view() {
        AnyView::Eigenvalue(_) => "eigenvalue problem",
        _ => "closed form",
    };
    derivation.dimension().map_or_else(|| method.to_owned(), |count| format!("{method}, up to {count} solutions"))
}
