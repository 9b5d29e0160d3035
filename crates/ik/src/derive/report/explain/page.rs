//! The README of a mechanism's folder: the problem, a summary of the steps, and the calls of the solver.

use super::chain::YAW_OPEN;
use super::document::{Document, Line};
use super::{forms, strata};
use crate::Result;
use crate::derive::closure::{Mechanism, Relation};
use crate::derive::coupled::CoupledView;
use crate::derive::eigenvalue::EigenvalueView;
use crate::derive::equations::EquationsView;
use crate::derive::problem::ChainProblem;
use crate::derive::sequential::{Form, SequentialView};
use crate::derive::{AnyView, Derivation, redundant};
use crate::solver::Program;
use groebot_robot::document::word;
use groebot_robot::kinematics::LengthUnit;

/// The README of a derivation.
///
/// # Errors
/// If a field cannot be built. This does not occur for a derivation that this crate made.
pub fn page(derivation: &Derivation) -> Result<Document> {
    let mut page = match derivation.view() {
        AnyView::Equations(view) => equations(view),
        AnyView::Sequential(view) => sequential(view)?,
        AnyView::Eigenvalue(view) => eigenvalue(view),
        AnyView::Coupled(view) => coupled(view)?,
    };
    let redundancy = derivation.redundancy();
    if let Some(redundancy) = redundancy {
        redundant::section(&mut page, derivation, redundancy);
    }
    let checked = Line::of("Written by ").name("groebot derive").and("; ").name("groebot check");
    page.paragraph(checked.and(" proves it again from ").name("certificate.json").and(". Solve with"));
    let program = derivation.program();
    let numbers = program.inputs.len() - redundancy.map_or(0, |_| program.given_joints.len());
    let target = vec!["..."; numbers].join(",");
    page.display(format!("groebot solve derivations/{} --target {target}", word(&page.title)));
    Ok(page)
}

/// The first part for the mechanism `name`: its description and source, the inputs and the joints.
fn opened(name: &str, texts: [&str; 2], unit: LengthUnit, program: &Program) -> Document {
    let mut page = Document::new(name);
    texts.into_iter().filter(|text| !text.is_empty()).for_each(|text| page.paragraph(Line::plain(text)));
    let inputs: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
    let joints: Vec<&str> = program.joints.iter().map(|joint| joint.name.as_str()).collect();
    let line = Line::of(&format!("Lengths in {}, angles in rad. Target: ", unit.symbol())).words(&inputs.join(", "));
    page.paragraph(line.and(". Joints: ").words(&joints.join(", ")).and("."));
    page
}

fn equations(view: EquationsView<'_>) -> Document {
    let system = view.problem;
    let mut page = opened(&system.name, [&system.description, &system.source], system.length_unit, view.program);
    if let Some(solved) = view.method.requested.solved() {
        let order = solved.certified.order.join(" > ");
        page.paragraph(Line::of("The Groebner basis in the order ").formula(&order).and(":"));
        strata::stairs(solved).into_iter().for_each(|stair| page.display(stair));
    }
    page
}

/// The part on a chain, with its idealisation.
fn chain(problem: &ChainProblem, program: &Program) -> Document {
    let parts = problem.chain.parts();
    let texts = [&parts.description, &parts.source].map(|text| text.as_deref().unwrap_or_default());
    let mut page = opened(&parts.name, texts, parts.length_unit, program);
    if let Some((_, report)) = &problem.truth {
        page.text(&report.sentence());
        page.items(report.lines().iter().map(|line| Line::plain(line)).collect());
    }
    page
}

fn sequential(view: SequentialView<'_>) -> Result<Document> {
    let mut page = chain(view.problem, view.program);
    if Mechanism::new(&view.problem.chain)?.upright_loop().is_some() {
        page.text(YAW_OPEN);
    }
    steps(&mut page, view)?;
    page.paragraph(
        Line::of("Each equation is a rigid-motion invariant of the loop ")
            .formula("E1 ... En = G")
            .and(", where $G$ moves the tip from its pose at zero to the target: ")
            .name("1_equations.txt")
            .and(
                ". No solution is lost: each equation follows from the loop. None is added: each solution is checked by forward \
                 kinematics.",
            ),
    );
    Ok(page)
}

/// Adds the steps of a chain as a list.
fn steps(page: &mut Document, view: SequentialView<'_>) -> Result<()> {
    let mechanism = Mechanism::new(&view.problem.chain)?;
    page.text(&format!("Up to {} solutions. The joints are found one at a time:", view.method.plan.dimension));
    let items = view.method.steps.iter().map(|step| {
        let line = Line::of("Joint ").name(&mechanism.joints()[step.joint].name);
        let line = line.and(", form ").name(step.shape.form.name()).and(&format!(": {}.", forms::why(step.shape.form)));
        step.relations.iter().fold(line, |line, relation| meaning(line.and(" "), &mechanism, relation))
    });
    page.items(items.collect());
    page.text("Singular:");
    let mut forms: Vec<Form> = view.method.steps.iter().map(|step| step.shape.form).collect();
    forms.sort_unstable();
    forms.dedup();
    let line = |form: Form| Line::of("In the form ").name(form.name()).and(", ").and(forms::singular(form));
    page.items(forms.into_iter().map(line).collect());
    Ok(())
}

/// Appends a relation and its geometric statement to `line`.
fn meaning(line: Line, mechanism: &Mechanism, relation: &Relation) -> Line {
    line.formula(&relation.to_string()).and(&format!(": {}.", relation.meaning(mechanism)))
}

fn eigenvalue(view: EigenvalueView<'_>) -> Document {
    let mut page = chain(view.problem, view.program);
    page.paragraph(
        Line::of(&format!(
            "Up to {} solutions, all found together: no order of joints with few solutions each exists. ",
            view.method.dimension()
        ))
        .name("1_equations.txt")
        .and(" derives one eigenvalue problem from the equations. The number of solutions lost by rounding is in ")
        .name("6_check.csv")
        .and("."),
    );
    view.given().iter().chain(&view.choices()).for_each(|line| page.paragraph(Line::plain(line)));
    page
}

fn coupled(view: CoupledView<'_>) -> Result<Document> {
    let parts = view.problem.parts();
    let texts = [&parts.description, &parts.source].map(|text| text.as_deref().unwrap_or_default());
    let mut page = opened(&parts.name, texts, view.problem.chains()[0].chain.length_unit(), view.program);
    page.text(&format!(
        "Up to {} solutions. The chains are solved one after the other; a joint that is already found is given for the chains after it. Each \
         solution of one chain is continued by all solutions of the next, so none is lost. The solutions are polished on the equations of all \
         chains together, which also give their residuals.",
        view.method.dimension()
    ));
    if let Some(simultaneous) = &view.method.simultaneous {
        page.section(Line::of("Shared joints: ").words(&view.simultaneous_names().join(", ")));
        page.text("They are found first, from one equation of each chain that contains no other unknown joint:");
        let mut items = Vec::new();
        for (member, relation) in view.problem.chains().iter().zip(simultaneous.relations()?) {
            let line = Line::of("Chain ").name(&member.name).and(": ");
            items.push(meaning(line, &Mechanism::new(&member.chain)?, relation));
        }
        page.items(items);
        page.text(super::coupled::shared_order(simultaneous));
    }
    for stage in &view.method.stages {
        let parts = stage.problem.chain.parts();
        page.section(Line::plain(&capitalised(&view.title(stage))));
        for text in [&parts.description, &parts.source].into_iter().flatten() {
            page.paragraph(Line::plain(text));
        }
        page.paragraph(Line::of("Task: ").words(&stage.problem.chain.task_text()).and("."));
        steps(&mut page, stage.view())?;
    }
    Ok(page)
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
