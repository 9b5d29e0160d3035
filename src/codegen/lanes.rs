//! Candidates that wait to be measured, several at once in the lanes of a vector register: how many, and what they consist of.

use super::body::Scene;
use crate::solver::{Block, Case, Program};

/// The most candidates that wait to be measured together.
pub(super) const MOST: usize = 16;

/// How many candidates wait to be measured together: as many as there are at ordinary targets, an even number.
pub(super) fn room(program: &Program) -> usize {
    let often = |block: &Block| block.cases.iter().filter(|case| !Case::is_rare(case)).map(Program::branches).max();
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

/// What the equations compare with the target, as values of any kind of number.
pub(super) fn generic(values: &[String]) -> Vec<String> {
    let value = |value: &String| if value.parse::<f64>().is_ok() { format!("T::of({value})") } else { value.clone() };
    values.iter().map(value).collect()
}
