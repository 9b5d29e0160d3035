//! The text report of the derivation of a chain, or of chains that share actuators.

use super::page::Page;
use groebot_ik::derive::coupled::CoupledView;
use groebot_ik::derive::eigenvalue::EigenvalueView;
use groebot_ik::derive::sequential::{Form, SequentialView};

/// Adds the report on each chain, in the order in which they are solved.
pub fn describe_coupled(page: &mut Page, derived: CoupledView<'_>) {
    let parts = derived.problem.parts();
    page.heading(&format!("{}: {} solutions at most", parts.name, derived.method.dimension()));
    for text in [&parts.description, &parts.source].into_iter().flatten() {
        page.line(text);
    }
    if derived.method.simultaneous.is_some() {
        page.heading(&format!("Shared joints: {}", derived.simultaneous_names().join(", ")));
        page.line("solved first, from an equation of each chain without other unknown joints");
    }
    for stage in &derived.method.stages {
        page.heading(&derived.title(stage));
        page.line(&format!("task {}", stage.problem.chain.task_text()));
        describe(page, stage.view());
    }
}

/// Adds the report on an eigenvalue problem.
pub fn describe_six_axes(page: &mut Page, derived: EigenvalueView<'_>) {
    page.heading(&format!(
        "{}: {} solutions at most, all joints together",
        derived.problem.chain.name(),
        derived.method.dimension()
    ));
    derived.given().iter().chain(&derived.counts()).for_each(|line| page.line(line));
    page.heading("Eigenvalue problems, proved regular");
    derived.choices().iter().for_each(|line| page.line(line));
}

/// Adds the report on the plan, its steps and the proofs.
pub fn describe(page: &mut Page, derived: SequentialView<'_>) {
    let plan = &derived.method.plan;
    page.heading(&format!("Plan: {} solutions at most", plan.dimension));
    for line in plan.to_string().lines().skip(1) {
        page.line(line);
    }
    page.heading("Program");
    let blocks = derived.program.blocks.iter().map(|block| {
        let cases: Vec<&str> = block.cases.iter().map(|case| case.label.as_str()).collect();
        (block.label.clone(), cases.join("; "))
    });
    page.entries(&blocks.collect::<Vec<_>>());
    page.heading("Proved exactly, independently of the Groebner engine");
    let relations: usize = derived.method.steps.iter().map(|step| step.relations.len()).sum();
    let proofs: usize = derived
        .method
        .forms
        .bases
        .iter()
        .flat_map(|form_basis| form_basis.tree.walk())
        .map(|node| node.proofs().len())
        .sum();
    let forms: Vec<&str> = derived.method.forms.bases.iter().map(|form_basis| Form::name(form_basis.form)).collect();
    page.entries(&[
        (relations.to_string(), "equations follow from the loop: their normal forms are zero".to_owned()),
        (proofs.to_string(), format!("Groebner bases of the forms {} on all strata", forms.join(", "))),
    ]);
}
