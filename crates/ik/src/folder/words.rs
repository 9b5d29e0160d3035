//! What a certificate proves, in words.

use crate::derive::coupled::ChainStage;
use crate::derive::sequential::Derived;
use crate::derive::{Derivation, Proved};

/// How many steps, bases or eigenvalue problems were proved again.
pub fn proof_words(proved: &Proved) -> String {
    match proved {
        Proved::Equations(derivation) => proved_equations(derivation),
        Proved::Chain(derived) => proved_chain(derived),
        Proved::SixAxes(derived) => {
            format!("{} eigenvalue problems proved regular again", derived.formulations.len())
        }
        Proved::Coupled(derived) => {
            let member = |stage: &ChainStage| {
                format!("{}: {}", derived.coupled.chains()[stage.member].name, proved_chain(&stage.derived))
            };
            let shared = derived.simultaneous.iter().map(|_| {
                format!("{}: an equation of each chain proved again", derived.simultaneous_names().join(", "))
            });
            shared.chain(derived.stages.iter().map(member)).collect::<Vec<_>>().join("; ")
        }
    }
}

fn proved_chain(derived: &Derived) -> String {
    let relations: usize = derived.steps.iter().map(|step| step.relations.len()).sum();
    let bases: usize =
        derived.form_bases.iter().flat_map(|form_basis| form_basis.tree.walk()).map(|node| node.proofs().len()).sum();
    format!(
        "{} steps proved again: {relations} equations follow from the loop, {bases} bases of {} forms",
        derived.steps.len(),
        derived.form_bases.len()
    )
}

fn proved_equations(derivation: &Derivation) -> String {
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
