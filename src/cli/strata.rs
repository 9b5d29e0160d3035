//! The strata on which formulas divide by zero, and the solution there, as text.

use super::page::Page;
use crate::Result;
use groebot_algebra::groebner::Basis;
use groebot_ik::derive::System;
use groebot_ik::derive::equations::EquationsView;
use groebot_ik::derive::equations::plan::{self, Score};
use groebot_ik::derive::equations::tree::{Node, Outcome};

/// Adds every stratum of both trees to the page.
pub fn describe(page: &mut Page, derivation: EquationsView<'_>) {
    let two = derivation.method.searched.is_some();
    for (title, root) in derivation.method.trees() {
        let title = if two { format!(": {title}, {}", order(root)) } else { String::new() };
        page.heading(&format!("Where formulas break down{title}"));
        let entries = entries(root, derivation.problem);
        if entries.is_empty() {
            page.line("none: the same formulas hold at every target");
        }
        page.entries(&entries);
    }
}

/// Each stratum once, then the factors that never vanish.
fn entries(root: &Node, system: &System) -> Vec<(String, String)> {
    let nodes = root.walk();
    let strata = nodes[1..].iter().filter(|node| !matches!(node.outcome, Outcome::Seen(_)));
    let mut entries: Vec<_> = strata.map(|node| (node.label.clone(), fate(node, system))).collect();
    for excluded in nodes.iter().flat_map(|node| &node.excluded) {
        let entry = (format!("{} = 0", excluded.factor), format!("never: {}", excluded.reason));
        if !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    entries
}

/// The order of a tree's generic formulas.
pub fn order(node: &Node) -> String {
    node.solved().map(|solved| solved.certified.order.join(" > ")).unwrap_or_default()
}

/// The treatment of a stratum.
fn fate(node: &Node, system: &System) -> String {
    match &node.outcome {
        Outcome::Solved(solved) if solved.inherited => {
            "the generic formulas hold here too, with a separate proof".to_owned()
        }
        Outcome::Solved(solved) => format!("separate formulas, {}", solutions(solved.triangular.bound())),
        Outcome::Inconsistent(_) => "no solution: the equations contradict each other".to_owned(),
        Outcome::SelfMotion(self_motion) => {
            let free: Vec<&str> = self_motion.free.iter().map(|&joint| system.joints[joint].name.as_str()).collect();
            let verb = if free.len() == 1 { "is" } else { "are" };
            let member = match &self_motion.member.outcome {
                Outcome::Solved(solved) => solutions(solved.triangular.bound()),
                _ => "none".to_owned(),
            };
            format!("infinitely many solutions, {} {verb} free; with zero there: {member}", free.join(", "))
        }
        Outcome::Seen(label) => format!("the same as {label}"),
        Outcome::Open(reason) => format!("not derived: a target here is an error, because {reason}"),
    }
}

fn solutions(bound: usize) -> String {
    if bound == 1 { "one solution".to_owned() } else { format!("up to {bound} solutions") }
}

/// The score of a tree's generic formulas by their divisions by zero.
///
/// # Errors
/// When a setting's field cannot be built, which does not happen for a derivation of this crate.
pub fn score(root: &Node) -> Result<Score> {
    let (ring, polynomials) = match root.solved() {
        Some(solved) => (solved.triangular.ring.clone(), solved.certified.basis.clone()),
        None => (root.setting.ring(&root.setting.unknowns, groebot_algebra::poly::Order::Lex)?, Vec::new()),
    };
    plan::score(&root.setting, &Basis { ring, polynomials, cofactors: Vec::new() })
}

/// The number of strata on which the generic formulas of a tree divide by zero, as text.
pub fn breakdowns(score: &Score) -> String {
    let count = |n: usize, what: &str| (n > 0).then(|| format!("{n} {what}"));
    let parts =
        [count(score.open, "not described"), count(score.surfaces, "of codimension one"), count(score.thin, "smaller")];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    if parts.is_empty() { "none".to_owned() } else { parts.join(", ") }
}
