//! Whether a file measures candidates by several at once, in the lanes of a vector register.

use super::body::Scene;
use super::forward::ForwardText;
use super::outline::Code;
use super::six_axes;
use crate::solver::{Block, Chart, Program};

/// The most candidates that wait to be measured together.
const MOST: usize = 16;

/// Whether candidates can wait for one another: all equations compare the tip with the target, by operations that lanes have, and
/// nothing but joints' values is read.
pub(super) fn are_wanted(scene: &Scene<'_>, forward: Option<&ForwardText>, checks: &Code) -> bool {
    let Some(forward) = forward.filter(|_| scene.language.has_lanes() && scene.extra.is_empty()) else { return false };
    let is_compared = checks.values.len() == forward.values.len();
    let calls = |line: &String| line.contains("f64::") || line.contains(".sqrt()");
    let is_number = |value: &String| value.parse::<f64>().is_ok();
    is_compared
        && six_axes::steps(scene.program).is_empty()
        && !forward.lines.iter().chain(&forward.values).any(calls)
        && !forward.values.iter().any(is_number)
}

/// How many candidates wait to be measured together: as many as there are at ordinary targets, an even number.
pub(super) fn room(program: &Program) -> usize {
    let often = |block: &Block| block.charts.iter().filter(|chart| !Chart::is_rare(chart)).map(Program::branches).max();
    let candidates = program.blocks.iter().filter_map(often).fold(1_usize, usize::saturating_mul);
    candidates.next_multiple_of(2).clamp(2, MOST)
}

/// By joint: its value at the candidate with index `k`, as an expression.
pub(super) fn values(scene: &Scene<'_>) -> Vec<String> {
    let mut angles = 0..;
    let value = |stands: Vec<usize>| match stands[..] {
        [place] => format!("self.at[{place}][k]"),
        _ => format!("angles[{}][k]", angles.next().unwrap_or(0)),
    };
    scene.stands().into_iter().map(value).collect()
}
