//! The numbered text files of a derivation: one for each stage, and the certificate.

use std::fmt::Write;

use crate::Result;
use crate::derive::JointKindUnknown;
use crate::derive::equations::EquationsView;
use crate::derive::equations::certificate;
use crate::derive::equations::grow::describe;
use crate::derive::equations::plan::score;
use crate::derive::equations::setting::Poly;
use crate::derive::equations::tree::{Outcome, Solved};
use crate::derive::equations::triangular::presented;
use groebot_algebra::escape::markdown;
use groebot_algebra::groebner::Basis;
use groebot_robot::document::word;

/// The file names of the stages, in order.
pub const STAGES: [&str; 6] =
    ["1_equations.txt", "2_plan.txt", "3_basis.txt", "4_triangular.txt", "5_program.json", "certificate.json"];

/// The README of the mechanism's folder.
pub const PAGE: &str = "README.md";
/// The mark that distinguishes a generated README from a hand-written one.
pub const MARK: &str = "Written by `groebot derive`";

impl EquationsView<'_> {
    /// The stage files with their names. Every run gives the same bytes.
    ///
    /// # Errors
    /// If a setting's field cannot be built. This does not occur for a derivation that this crate made.
    pub fn stage_files(&self) -> Result<Vec<(String, Vec<u8>)>> {
        let texts = [
            self.problem.to_string(),
            self.plan_text()?,
            self.basis_text()?,
            self.triangular_text(),
            self.program.to_json(),
            certificate::write(*self)?,
        ];
        let mut files: Vec<(String, Vec<u8>)> =
            STAGES.iter().zip(texts).map(|(name, text)| ((*name).to_owned(), text.into_bytes())).collect();
        files.push((PAGE.to_owned(), self.readme().into_bytes()));
        Ok(files)
    }

    fn plan_text(&self) -> Result<String> {
        let mut text = format!("{}: plan\n\nblock 1: all unknowns together\n", self.problem.name);
        for joint in &self.problem.joints {
            let _ = match &joint.kind {
                JointKindUnknown::Angle { cosine, sine } => {
                    writeln!(text, "    {} = atan2({sine}, {cosine})", joint.name)
                }
                JointKindUnknown::Value { unknown } => writeln!(text, "    {} = {unknown}", joint.name),
            };
        }
        text += "\norder of the unknowns, greatest first; a denominator that may vanish costs a stratum\n";
        for (title, node) in self.method.trees() {
            let Some(solved) = node.solved() else { continue };
            let polynomials = solved.certified.basis.clone();
            let ring = solved.triangular.ring.clone();
            let score = score(&node.setting, &Basis { ring, polynomials, cofactors: Vec::new() })?;
            let _ = writeln!(
                text,
                "    {title}: {}\n        strata of codimension one: {}, smaller: {}, without description: {}; \
                 candidates: {}; terms: {}",
                solved.certified.order.join(" > "),
                score.surfaces,
                score.thin,
                score.open,
                score.candidates,
                score.terms
            );
        }
        Ok(text)
    }

    fn basis_text(&self) -> Result<String> {
        let mut text = format!(
            "{}: reduced Groebner bases over Q({}), lexicographic\n\
             Each polynomial is zero. Denominators are cleared and common factors divided out.\n",
            self.problem.name,
            self.problem.parameters.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ")
        );
        for (title, node) in self.method.trees() {
            let _ = writeln!(text, "\n{title}");
            for node in node.walk() {
                let _ = writeln!(text, "\n  [{}] {}", node.label, describe(node));
                if let Some(solved) = node.solved().filter(|solved| !solved.inherited) {
                    write_basis(&mut text, solved);
                }
                for excluded in &node.excluded {
                    let _ = writeln!(text, "    never zero: {} ({})", excluded.factor, excluded.reason);
                }
            }
        }
        Ok(text)
    }

    fn triangular_text(&self) -> String {
        let mut text = format!("{}: one unknown at a time\n", self.problem.name);
        for (title, node) in self.method.trees() {
            let _ = writeln!(text, "\n{title}");
            for node in node.walk() {
                let form = match &node.outcome {
                    Outcome::Solved(solved) if !solved.inherited => solved.triangular.to_string(),
                    Outcome::SelfMotion(self_motion) => {
                        let free = self_motion.free.iter().map(|&joint| self.problem.joints[joint].name.as_str());
                        let member = self_motion.member.solved().map(|solved| solved.triangular.to_string());
                        let free = free.collect::<Vec<_>>().join(", ");
                        format!("free: {free}; the member with it at zero:\n{}", member.unwrap_or_default())
                    }
                    _ => continue,
                };
                let _ = writeln!(text, "\n  [{}]", node.label);
                for line in form.lines() {
                    let _ = writeln!(text, "    {line}");
                }
            }
        }
        text
    }

    fn readme(&self) -> String {
        let system = self.problem;
        let names = |list: Vec<String>| list.join(", ");
        let inputs = names(system.inputs.iter().map(|input| markdown(&input.name)).collect());
        let joints = names(system.joints.iter().map(|joint| markdown(&joint.name)).collect());
        let mut text = format!("# {}\n\n", markdown(&system.name));
        for line in [&system.description, &system.source] {
            if !line.is_empty() {
                let _ = writeln!(text, "{}\n", markdown(line));
            }
        }
        let _ = writeln!(
            text,
            "Lengths in {}, angles in rad. Target: {inputs}. Joints: {joints}.\n",
            system.length_unit.symbol()
        );
        if let Some(solved) = self.method.requested.solved() {
            text += "The Groebner basis in the order ";
            let _ = writeln!(text, "{}:\n", solved.certified.order.join(" > "));
            for f in solved.triangular.stairs.iter().flat_map(|stair| &stair.polynomials) {
                let _ = writeln!(text, "    {} = 0", presented(&solved.triangular.ring, f));
            }
            text += "\n";
        }
        text += MARK;
        text += "; `groebot check` proves it again from `certificate.json`. Solve with\n\n";
        let example = vec!["..."; system.inputs.len()].join(",");
        let _ = writeln!(text, "    groebot solve derivations/{} --target {example}", word(&system.name));
        text
    }
}

fn write_basis(text: &mut String, solved: &Solved) {
    let ring = &solved.triangular.ring;
    let _ = writeln!(text, "    order {}", solved.certified.order.join(" > "));
    let polynomials: Vec<&Poly> = solved.triangular.stairs.iter().flat_map(|stair| &stair.polynomials).collect();
    for (index, f) in polynomials.into_iter().enumerate() {
        let _ = writeln!(text, "    {:>3}. {}", index + 1, presented(ring, f));
    }
}
