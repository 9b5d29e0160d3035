//! The report of coupled chains: their composition, then the report of each chain.

use super::algebra::joint_unknowns;
use super::document::{Document, Line, Stage};
use super::{chain, step};
use crate::Result;
use crate::derive::closure::Mechanism;
use crate::derive::coupled::CoupledView;
use crate::derive::sequential::Simultaneous;
use groebot_algebra::number::{Ring, Style};

/// The report of `derived`, or of one of its stages.
///
/// # Errors
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn document(derived: CoupledView<'_>, stage: Option<Stage>) -> Result<Document> {
    let parts = derived.problem.parts();
    let mut page = Document::of(&parts.name, stage);
    if stage.is_none() {
        for text in [&parts.description, &parts.source].into_iter().flatten() {
            page.paragraph(Line::plain(text));
        }
        actuators(&mut page, derived);
        page.text(&format!(
            "The chains are solved one after the other. A joint whose actuator a chain has found is given for the chains after it. Every \
             solution of all chains is one of the first chain, continued by one of the next with the shared joints held, and so on: none \
             is lost. A generic target that the chains can reach has {} complex solutions. Each solution is polished on the \
             equations of all chains together, which also give its residual.",
            derived.method.dimension()
        ));
    }
    if stage != Some(Stage::Basis) {
        shared(&mut page, derived, stage)?;
    }
    for chain_stage in &derived.method.stages {
        page.section(Line::default().name(&derived.title(chain_stage)));
        page.parts.extend(chain::document(chain_stage.view(), stage)?.parts);
    }
    Ok(page)
}

/// Adds how shared joints are found from both chains together.
fn shared(page: &mut Document, derived: CoupledView<'_>, stage: Option<Stage>) -> Result<()> {
    let Some(simultaneous) = &derived.method.simultaneous else { return Ok(()) };
    page.section(Line::default().name(&derived.simultaneous_names().join(", ")).and(": from both chains at once"));
    if Stage::Equations.is_in(stage) {
        page.text(
            "One equation of each chain contains no unknown joints except shared ones. The cancelled joints do not change its \
             invariant; this has been computed. So the equation follows from the chain's loop.",
        );
        for (index, (member, relation)) in derived.problem.chains().iter().zip(simultaneous.relations()?).enumerate() {
            let meaning = relation.meaning(&Mechanism::new(&member.chain)?);
            page.paragraph(Line::default().name(&member.name).and(&format!(": {meaning}.")));
            page.equation(&format!("0.{}", index + FIRST), relation.to_string());
        }
    }
    if Stage::Plan.is_in(stage) {
        page.text(shared_order(simultaneous));
    }
    let mechanism = Mechanism::new(&derived.problem.chains()[0].chain)?;
    for step in simultaneous.steps.iter().filter(|_| Stage::Triangular.is_in(stage)) {
        let name = derived.program.joints[step.joint].name.as_str();
        page.paragraph(
            Line::of("The joint ").name(name).and(" is found by the form ").name(step.shape.form.name()).and("."),
        );
        if let Some(elimination) = &step.elimination {
            page.items(step::symbol_lines(&mechanism, elimination, (0, FIRST)));
            let unknowns = joint_unknowns(&mechanism, step.joint);
            page.paragraph(Line::of("The remaining equation, with $x2, x3$ for ").formula(&unknowns).and(":"));
            page.display(format!("{} = 0", elimination.ring.format(&elimination.member, Style::Decimal)));
        }
    }
    Ok(())
}

/// Text on how the equations of shared joints determine them.
pub fn shared_order(simultaneous: &Simultaneous) -> &'static str {
    match simultaneous.steps.as_slice() {
        [_] => {
            "Both are linear in the cosine and sine of the joint, and each is solved alone where the other vanishes."
        }
        _ => {
            "Both are linear in the cosine and sine of the second joint. Their determinant is an equation in the first joint, of \
             degree two in its cosine and sine; its cofactors are multiplied out in the proof."
        }
    }
}

/// The number of the first relation of shared joints, after that of the loop.
const FIRST: usize = 2;

/// Adds a table of the actuators and the joints that each moves.
fn actuators(page: &mut Document, derived: CoupledView<'_>) {
    page.section(Line::of("The chains and their actuators"));
    let mut rows = vec![["actuator", "chain", "joint"].map(Line::of).to_vec()];
    for actuator in derived.problem.actuators() {
        for place in &actuator.joints {
            let member = &derived.problem.chains()[place.member];
            let name = member.chain.joints()[place.joint].name.as_str();
            rows.push(
                [actuator.name.as_str(), member.name.as_str(), name].map(|text| Line::default().name(text)).to_vec(),
            );
        }
    }
    page.table(rows);
}
