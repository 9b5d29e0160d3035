//! Text that describes what a certificate proves.

use crate::derive::coupled::ChainStage;
use crate::derive::equations::Equations;
use crate::derive::redundant::Part;
use crate::derive::sequential::Sequential;
use crate::derive::{AnyView, Derivation};
use groebot_robot::document::shown;

/// The number of steps, bases or eigenvalue problems that were proved again, as text.
pub fn proof_text(derivation: &Derivation) -> String {
    let own = method_text(derivation);
    let Some(redundancy) = derivation.redundancy() else { return own };
    let joints = &derivation.program().joints;
    let text = |(joint, part): (usize, &Part)| {
        let text = match part {
            Part::Main => return String::new(),
            Part::Derived(other) => method_text(other),
            Part::Constant => "proved constant on every self-motion".to_owned(),
            Part::Unsolved(reason) => format!("no solver (a claim that is not proved: {})", shown(reason)),
        };
        format!("; {} given: {text}", joints[joint].name)
    };
    own + &redundancy.parts().iter().enumerate().map(text).collect::<String>()
}

fn method_text(derivation: &Derivation) -> String {
    match derivation.view() {
        AnyView::Equations(equations) => proved_equations(equations.method),
        AnyView::Sequential(chain) => proved_chain(chain.method),
        AnyView::Eigenvalue(six) => {
            format!("{} eigenvalue problems proved regular again", six.method.formulations.len())
        }
        AnyView::Coupled(derived) => {
            let member = |stage: &ChainStage| {
                format!("{}: {}", derived.problem.chains()[stage.member].name, proved_chain(&stage.method))
            };
            let shared = derived.method.simultaneous.iter().map(|_| {
                format!("{}: an equation of each chain proved again", derived.simultaneous_names().join(", "))
            });
            shared.chain(derived.method.stages.iter().map(member)).collect::<Vec<_>>().join("; ")
        }
    }
}

fn proved_chain(derived: &Sequential) -> String {
    let relations: usize = derived.steps.iter().map(|step| step.relations.len()).sum();
    let bases: usize =
        derived.forms.bases.iter().flat_map(|form_basis| form_basis.tree.walk()).map(|node| node.proofs().len()).sum();
    format!(
        "{} steps proved again: {relations} equations follow from the loop, {bases} bases of {} forms",
        derived.steps.len(),
        derived.forms.bases.len()
    )
}

fn proved_equations(derivation: &Equations) -> String {
    let trees = derivation.trees();
    let nodes: Vec<_> = trees.iter().flat_map(|(_, node)| node.walk()).collect();
    let proofs: Vec<_> = nodes.iter().flat_map(|node| node.proofs()).map(|(_, certified)| certified.proof).collect();
    let rows: usize = proofs.iter().map(|proof| proof.cofactor_rows).sum();
    let pairs: usize = proofs.iter().map(|proof| proof.pairs).sum();
    format!(
        "{} bases proved again: {rows} combinations of the equations multiplied out, {pairs} S-polynomials reduced to zero",
        proofs.len()
    )
}
