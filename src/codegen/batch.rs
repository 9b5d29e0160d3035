//! Batches of targets, several at once in the lanes of vector registers: for which programs, and what their candidates have in common.

use serde::Serialize;

use super::body::Scene;
use super::lanes::MOST;
use super::mirror;
use crate::solver::{Block, Case, JointValue, Program, Rule, Step, square};

/// What the skeleton names of batches.
#[derive(Serialize)]
pub(super) struct BatchText {
    /// How many candidates an ordinary target has.
    candidates: usize,
    /// How many of them in a row miss the equations by the same.
    twins: usize,
    /// By angle and candidate: the first candidate with the same cosine and sine but for signs.
    first: Vec<Vec<usize>>,
    /// The joints that are angles, and those that are lengths, each with where it stands among the places.
    angles: Vec<usize>,
    lengths: Vec<[usize; 2]>,
}

/// Whether all candidates of an ordinary target come from one case of each block, by square roots alone; other cases lie on strata that
/// a guard tells. What else a file may hold is printed for one number only.
pub(super) fn is_possible(program: &Program) -> bool {
    let only_roots = program.cases().flat_map(|case| &case.steps).all(|step| match step {
        Step::Roots { polynomials, .. } => square(polynomials).is_some(),
        Step::SixAxes(_) => false,
        _ => true,
    });
    let is_known = |rule: &Rule| matches!(rule, Rule::Input(_) | Rule::Root { .. });
    let fits = |candidates: usize| candidates <= MOST && program.isolated.is_none_or(|most| candidates <= most);
    program.compares_tip()
        && program.preference.is_none()
        && only_roots
        && program.parameters.iter().all(|parameter| is_known(&parameter.rule))
        && program.blocks.iter().all(|block| usual(block).is_some())
        && fits(candidates(program, 0))
        && candidates(program, 0) <= program.capacity
}

/// The case of a block that runs at ordinary targets, if that is one and guards tell where others do.
fn usual(block: &Block) -> Option<&Case> {
    let is_told = |case: &Case| !case.open && case.pivot.is_none() && !(case.is_rare() && case.guards.is_empty());
    let mut usual = block.cases.iter().filter(|case| !case.is_rare());
    let first = usual.next().filter(|_| usual.next().is_none() && block.cases.iter().all(is_told))?;
    let samples = first.steps.iter().any(|step| matches!(step, Step::Sample { .. }));
    (!samples).then_some(first)
}

/// How many candidates the blocks from this one on make of each of those before.
fn candidates(program: &Program, block: usize) -> usize {
    program.blocks[block..].iter().filter_map(usual).map(Program::branches).fold(1, usize::saturating_mul)
}

impl BatchText {
    /// That of a program whose file [can](is_possible) solve batches.
    pub fn new(scene: &Scene<'_>) -> Self {
        let program = scene.program;
        let joints = 0..program.joints.len();
        let is_angle = |joint: &usize| matches!(program.joints[*joint].value, JointValue::Angle { .. });
        let angles: Vec<usize> = joints.clone().filter(is_angle).collect();
        let length = |joint: usize| [joint, scene.stands()[joint][0]];
        let keeps = scene.mirror.as_ref().is_some_and(|mirror| mirror.keeps_misses(program));
        BatchText {
            candidates: candidates(program, 0),
            twins: if keeps { 2 } else { 1 },
            first: angles.iter().map(|&joint| first(scene, joint)).collect(),
            lengths: joints.filter(|joint| !is_angle(joint)).map(length).collect(),
            angles,
        }
    }
}

/// By candidate: the first one in which an angle is the same but for signs. Such are those that the roots of later blocks tell apart, and
/// the two of a root that turns signs of the cosine and the sine.
fn first(scene: &Scene<'_>, joint: usize) -> Vec<usize> {
    let (program, block) = (scene.program, scene.finder(joint));
    let unknowns = program.joints[joint].value.unknowns();
    let later = candidates(program, block + 1);
    let is_mirrored = usual(&program.blocks[block]).is_some_and(|case| mirror::turns(program, case, &unknowns));
    let is_behind = scene.mirror.as_ref().is_some_and(|mirror| mirror.block < block);
    let row = if is_mirrored || is_behind { 2 * later } else { later };
    (0..candidates(program, 0)).map(|candidate| candidate - candidate % row).collect()
}
