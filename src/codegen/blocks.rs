//! What a program's blocks, their charts and the target's conditions put into the skeleton of a file.

use serde::Serialize;

use super::body::Scene;
use super::names::remark;
use super::printer::Language;
use crate::solver::{Chart, Condition};

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

/// A block: its code, its charts, and in which order they take their turns.
#[derive(Serialize)]
pub(super) struct BlockText {
    label: String,
    lines: Vec<String>,
    /// Registers that charts read.
    shared: Vec<String>,
    charts: Vec<ChartText>,
    turns: Vec<Turn>,
    /// Whether charts ask how many candidates there were before.
    counts: bool,
    /// Whether one chart that often runs goes on here, so that a language had better put this block in its place.
    is_inlined: bool,
    /// Whether a chart that hardly ever runs goes on here.
    is_met_again: bool,
}

/// Charts of which one runs: one alone, or a pivot group.
#[derive(Serialize)]
struct Turn {
    /// Indices, from 0.
    charts: Vec<usize>,
    grouped: bool,
}

#[derive(Serialize)]
struct ChartText {
    label: String,
    quoted: String,
    guards: Vec<String>,
    free: Vec<String>,
    open: bool,
    /// Whether it is the one chart of its block that often runs.
    is_inlined: bool,
    body: Function,
    /// Its claim among its pivot group, or the condition of an open chart.
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
        let before = index.checked_sub(1).map_or(&[][..], |before| &scene.program.blocks[before].charts);
        let group = |chart: usize| block.charts[chart].pivot.map(|pivot| pivot.group);
        let all = 0..block.charts.len();
        let turn = |first: usize| {
            let member = |chart: &usize| *chart == first || (group(first).is_some() && group(*chart) == group(first));
            Turn { charts: all.clone().filter(member).collect(), grouped: group(first).is_some() }
        };
        BlockText {
            label: remark(&block.label),
            lines,
            shared,
            charts: block.charts.iter().map(|chart| ChartText::new(scene, index, chart)).collect(),
            counts: block.charts.iter().any(Chart::is_of_stratum),
            is_inlined: before.iter().filter(|chart| !chart.is_rare()).count() == 1,
            is_met_again: before.iter().any(Chart::is_rare),
            turns: all.clone().filter(|&chart| block.opens_group(chart)).map(turn).collect(),
        }
    }
}

impl ChartText {
    fn new(scene: &Scene<'_>, block: usize, chart: &Chart) -> Self {
        let lines = if chart.open { Vec::new() } else { scene.chart(block, chart) };
        let (claim, condition, pivot) = scene.claim(block, chart);
        let often = scene.program.blocks[block].charts.iter().filter(|chart| !chart.is_rare()).count();
        let claims = chart.open || chart.pivot.is_some();
        let free = chart.free.iter().map(|&joint| remark(&scene.program.joints[joint].name));
        let read: Vec<&String> = claim.iter().chain([&condition, &pivot]).collect();
        let has = |what: String, name: &'static str| reads(&read, &what).then_some(name);
        let language = scene.language;
        let names =
            [has(language.field(""), "p"), has(language.known(""), "known"), has(language.shared(""), "shared")];
        let claim_names: Vec<&str> = names.into_iter().flatten().collect();
        let shared = reads(&lines.iter().collect::<Vec<_>>(), &language.shared("")).then_some("shared");
        let known = (block > 0).then_some("known");
        let before = chart.is_of_stratum().then_some("before");
        let own: Vec<&str> = [Some("p"), known, shared, before].into_iter().flatten().collect();
        ChartText {
            label: remark(&chart.label),
            quoted: language.quote(&chart.label),
            guards: chart.guards.iter().map(|guard| guard_text(&guard.text, guard.near)).collect(),
            free: free.collect(),
            open: chart.open,
            is_inlined: !chart.is_rare() && often == 1,
            body: Function::new(language, block, lines, &own),
            claim: claims.then(|| Function::new(language, block, claim, &claim_names)),
            condition,
            pivot: if chart.pivot.is_some() { language.call("abs", &pivot) } else { pivot },
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
