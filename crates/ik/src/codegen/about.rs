//! The header comment of a printed file about the source of the program, and the joint limits.

use serde::Serialize;

use super::language::Expressions;
use super::names::remark;
use crate::solver::Program;

/// The lines of the header, and the limits.
#[derive(Serialize)]
pub(super) struct AboutText {
    /// Lines such as `Task: pose`.
    lines: Vec<String>,
    /// By joint: its least and its greatest value.
    limits: Vec<[String; 2]>,
}

impl AboutText {
    pub fn new(program: &Program, language: &dyn Expressions) -> Self {
        let about = program.about.clone().unwrap_or_default();
        let of_arm = |joint: usize| program.redundancy.as_ref()?.limits[joint].map(|[low, high]| (low, high));
        let limits = |joint: usize| match about.limits.get(joint).copied().flatten().or_else(|| of_arm(joint)) {
            Some((low, high)) => [language.given(low), language.given(high)],
            None => [false, true].map(|positive| language.infinity(positive)),
        };
        AboutText { limits: (0..program.joints.len()).map(limits).collect(), lines: lines(program) }
    }
}

fn lines(program: &Program) -> Vec<String> {
    let Some(about) = &program.about else { return Vec::new() };
    let named = |what: &str, name: Option<&String>| name.map(|name| format!("{what}: {}", remark(name)));
    let task = Some(format!("Task: {}", remark(&program.task_text())));
    let hash = (!about.hash.is_empty()).then(|| format!("Hash of the input: {}", remark(&about.hash)));
    let ends = [named("Base link", about.base.as_ref()), named("Tip link", about.tip.as_ref())];
    let solutions = about.solutions.map(|count| format!("Solutions: up to {count} at a generic target"));
    [task, solutions].into_iter().chain(ends).chain([hash]).flatten().collect()
}
