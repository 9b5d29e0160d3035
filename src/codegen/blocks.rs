//! What a program's blocks, their cases and the target's conditions put into the skeleton of a file.

use serde::Serialize;

use super::body::Scene;
use super::language::Language;
use super::names::remark;
use crate::solver::{Case, Condition};

/// What inputs must fulfil.
#[derive(Serialize)]
pub(super) struct ConditionText {
    function: &'static str,
    /// What is wrong where it does not hold, in Rust and in C.
    error: &'static str,
    code: &'static str,
    first: usize,
    end: usize,
}

/// A block: its code, its cases, and in which order they take their turns.
#[derive(Serialize)]
pub(super) struct BlockText {
    label: String,
    lines: Vec<String>,
    /// Registers that cases read.
    shared: Vec<String>,
    cases: Vec<CaseText>,
    turns: Vec<Turn>,
    /// Whether cases ask how many candidates there were before.
    counts: bool,
    /// Whether one case that often runs goes on here, so that a language had better put this block in its place.
    is_inlined: bool,
    /// Whether a case that hardly ever runs goes on here.
    is_met_again: bool,
}

/// Cases of which one runs: one alone, or a pivot group.
#[derive(Serialize)]
struct Turn {
    /// Indices, from 0.
    cases: Vec<usize>,
    grouped: bool,
}

#[derive(Serialize)]
struct CaseText {
    label: String,
    quoted: String,
    guards: Vec<String>,
    free: Vec<String>,
    open: bool,
    /// Whether it is the one case of its block that often runs.
    is_inlined: bool,
    body: Function,
    /// Its claim among its pivot group, or the condition of an open case.
    claim: Option<Function>,
    condition: String,
    pivot: String,
}

/// Lines of a function, its parameters, and the arguments of a call.
#[derive(Serialize)]
struct Function {
    lines: Vec<String>,
    parameters: String,
    arguments: String,
}

impl ConditionText {
    pub fn new(condition: &Condition) -> Self {
        let [function, error, code] = match condition {
            Condition::Rotation(_) => ["make_rotation", "NotRotation", "NOT_ROTATION"],
            Condition::Unit(_) => ["make_unit", "NotUnit", "NOT_UNIT"],
        };
        let (first, count) = condition.inputs();
        ConditionText { function, error, code, first, end: first + count }
    }
}

impl BlockText {
    pub fn new(scene: &Scene<'_>, index: usize) -> Self {
        let block = &scene.program.blocks[index];
        let (lines, shared) = scene.block_code(index);
        let before = index.checked_sub(1).map_or(&[][..], |before| &scene.program.blocks[before].cases);
        let group = |case: usize| block.cases[case].pivot.map(|pivot| pivot.group);
        let all = 0..block.cases.len();
        let turn = |first: usize| {
            let member = |case: &usize| *case == first || (group(first).is_some() && group(*case) == group(first));
            Turn { cases: all.clone().filter(member).collect(), grouped: group(first).is_some() }
        };
        BlockText {
            label: remark(&block.label),
            lines,
            shared,
            cases: block.cases.iter().map(|case| CaseText::new(scene, index, case)).collect(),
            counts: block.cases.iter().any(Case::is_of_stratum),
            is_inlined: before.iter().filter(|case| !case.is_rare()).count() == 1,
            is_met_again: before.iter().any(Case::is_rare),
            turns: all.clone().filter(|&case| block.opens_group(case)).map(turn).collect(),
        }
    }
}

impl CaseText {
    fn new(scene: &Scene<'_>, block: usize, case: &Case) -> Self {
        let lines = if case.open { Vec::new() } else { scene.case(block, case) };
        let (claim, condition, pivot) = scene.claim(block, case);
        let often = scene.program.blocks[block].cases.iter().filter(|case| !case.is_rare()).count();
        let claims = case.open || case.pivot.is_some();
        let free = case.free.iter().map(|&joint| remark(&scene.program.joints[joint].name));
        let read: Vec<&String> = claim.iter().chain([&condition, &pivot]).collect();
        let has = |what: String, name: &'static str| reads(&read, &what).then_some(name);
        let language = scene.language;
        let names =
            [has(language.field(""), "p"), has(language.known(""), "known"), has(language.shared(""), "shared")];
        let claim_names: Vec<&str> = names.into_iter().flatten().collect();
        let shared = reads(&lines.iter().collect::<Vec<_>>(), &language.shared("")).then_some("shared");
        let known = (block > 0).then_some("known");
        let before = case.is_of_stratum().then_some("before");
        let own: Vec<&str> = [Some("p"), known, shared, before].into_iter().flatten().collect();
        CaseText {
            label: remark(&case.label),
            quoted: language.quote(&case.label),
            guards: case.guards.iter().map(|guard| guard_text(&guard.text, guard.near)).collect(),
            free: free.collect(),
            open: case.open,
            is_inlined: !case.is_rare() && often == 1,
            body: Function::new(language, block, lines, &own),
            claim: claims.then(|| Function::new(language, block, claim, &claim_names)),
            condition,
            pivot: if case.pivot.is_some() { language.call("abs", &pivot) } else { pivot },
        }
    }
}

impl Function {
    fn new(language: &dyn Language, block: usize, lines: Vec<String>, names: &[&str]) -> Self {
        let kind = |name: &str| match name {
            "p" => "Parameters".to_owned(),
            "known" => "Known".to_owned(),
            _ => format!("Shared{}", block + 1),
        };
        let parameter = |name: &&str| match *name {
            "before" => language.count(name),
            _ => language.argument(name, &kind(name)),
        };
        let parameters: Vec<String> = names.iter().map(parameter).collect();
        Function { lines, parameters: parameters.join(", "), arguments: names.join(", ") }
    }
}

/// Whether a text reads fields of something: `what` stands there, but not as the end of a longer word.
fn reads(lines: &[&String], what: &str) -> bool {
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    lines.iter().any(|line| line.match_indices(what).any(|(at, _)| !line[..at].ends_with(word)))
}

fn guard_text(factor: &str, near: bool) -> String {
    format!("{} is {}", remark(factor), if near { "near zero" } else { "not zero" })
}
