//! Properties of a program for all targets, in the types of the run time. Main type: [`Facts`].

use serde::Serialize;

use super::demand::Demand;
use super::forward::{Forward, Reached};
use super::instruction::{Instruction, Operand, Operation};
use super::layout::Layout;
use super::mirror;
use super::program::{Block, Case, Condition, Described, Program, Step, square};
use super::rule::Rule;

/// The maximum number of candidates that are buffered and measured together.
const MOST: usize = 16;

/// Properties that hold for all targets.
#[derive(Clone, Debug, Serialize)]
#[doc(hidden)]
pub struct Facts {
    pub inputs: usize,
    /// By joint, the indices of its cosine and sine, or of its value, among the numbers that the equations read.
    pub joints: Vec<Vec<usize>>,
    pub last_first: Vec<usize>,
    pub places: usize,
    pub has_extras: bool,
    pub equations: usize,
    /// Whether each equation is affine in the numbers of each joint.
    #[serde(skip)]
    pub are_affine: bool,
    pub size_of: Vec<usize>,
    /// The sizes of equations without duplicates.
    #[serde(skip)]
    pub sizes: Vec<Operand>,
    pub shorts: usize,
    /// By equation, the parameter that it compares with the tip; empty if one does not.
    pub compared: Vec<usize>,
    pub turned: Vec<usize>,
    pub candidates: usize,
    pub twins: usize,
    /// By joint, the result of `run`; empty if several targets are not solved at once.
    pub runs: Vec<usize>,
    pub scale: f64,
    pub capacity: usize,
    pub isolated: Option<usize>,
    pub freed: Vec<usize>,
    /// A kind and the first number.
    pub conditions: Vec<(&'static str, usize)>,
    /// A kind and its numbers.
    pub reached: Vec<(&'static str, Vec<usize>)>,
    pub nearby: bool,
    pub within: Option<f64>,
    /// The index, and whether the greatest value is preferred.
    pub preference: Option<(usize, bool)>,
}

impl Facts {
    /// The facts of a program.
    pub fn new(layout: &Layout<'_>) -> Self {
        let program = layout.program;
        let places = layout.places();
        let turned = layout
            .mirror
            .as_ref()
            .map_or_else(Vec::new, |mirror| (0..places.len()).filter(|&place| mirror.odd[places[place]]).collect());
        let forward = program.forward().filter(|forward| !forward.inputs.is_empty());
        let parameter = |equation: &Option<(Operand, usize)>| equation.map(|(_, parameter)| parameter);
        let compared = forward.as_ref().and_then(|forward| forward.equations.iter().map(parameter).collect());
        let sizes = once(&program.checks.scales);
        let size_of = |size: &Operand| sizes.iter().position(|other| other == size).unwrap_or(0);
        let keeps = || layout.mirror.as_ref().is_some_and(|mirror| mirror.keeps_misses(program));
        let is_abreast = is_solved_abreast(program);
        Facts {
            inputs: program.inputs.len(),
            joints: layout.joint_places(),
            last_first: layout.last_first(),
            places: places.len(),
            has_extras: !layout.extra.is_empty(),
            equations: program.checks.residuals.len(),
            are_affine: are_affine(program, &program.checks.code, &program.checks.residuals),
            size_of: program.checks.scales.iter().map(size_of).collect(),
            shorts: if program.nearby { program.checks.short.len() } else { 0 },
            compared: compared.unwrap_or_default(),
            turned,
            candidates: room(program),
            twins: if is_abreast && keeps() { 2 } else { 1 },
            runs: if is_abreast {
                (0..program.joints.len()).map(|joint| run(layout, joint)).collect()
            } else {
                Vec::new()
            },
            scale: program.scale,
            capacity: program.capacity,
            isolated: program.isolated,
            freed: program.freed().collect(),
            conditions: program.conditions.iter().map(condition).collect(),
            reached: forward.map_or_else(Vec::new, |forward| reached(program, &forward)),
            nearby: program.nearby,
            within: program.described.as_ref().map(|described| described.within),
            preference: program.preference.and_then(|preference| {
                let place = places.iter().position(|&unknown| unknown == preference.unknown)?;
                Some((place, preference.greatest))
            }),
            sizes,
        }
    }
}

/// Operands without duplicates, in the order of their first occurrence.
fn once(operands: &[Operand]) -> Vec<Operand> {
    let mut unique: Vec<Operand> = Vec::new();
    for operand in operands {
        if !unique.contains(operand) {
            unique.push(*operand);
        }
    }
    unique
}

/// Whether each equation is affine in the numbers of each joint, by the form of its code: no product of two values that
/// depend on one joint.
fn are_affine(program: &Program, code: &[Instruction], residuals: &[Operand]) -> bool {
    let demand = Demand::of_code(code, residuals);
    let mut read: Vec<u32> = vec![0; code.len()];
    let joints = |unknown: usize| {
        let own = program.joints.iter().position(|joint| joint.value.unknowns().contains(&unknown));
        own.map_or(0, |joint| 1 << joint)
    };
    code.iter().filter(|line| demand.register(line.target) > 0).all(|line| {
        let of = |operand: Operand| match operand {
            Operand::Unknown(unknown) => joints(unknown),
            Operand::Register(register) => read[register],
            _ => 0,
        };
        let (all, is_affine) = match line.operation {
            Operation::Add(a, b) | Operation::Sub(a, b) => (of(a) | of(b), true),
            Operation::Mul(a, b) => (of(a) | of(b), of(a) & of(b) == 0),
            Operation::Div(a, b) => (of(a), of(b) == 0),
            Operation::Abs(a) | Operation::Sqrt(a) => (0, of(a) == 0),
        };
        read[line.target] = all;
        is_affine
    })
}

impl Described {
    /// Whether each equation is affine in the numbers of each joint of `program`.
    #[doc(hidden)]
    pub fn is_affine(&self, program: &Program) -> bool {
        are_affine(program, &self.code, &self.residuals)
    }
}

fn condition(condition: &Condition) -> (&'static str, usize) {
    match *condition {
        Condition::Rotation(first) => ("Rotation", first),
        Condition::Unit(first) => ("Unit", first),
    }
}

fn reached(program: &Program, forward: &Forward) -> Vec<(&'static str, Vec<usize>)> {
    // Two equations of the ideal mechanism may have the same value, but different values as described.
    let is_own =
        |parameter: usize, rule: Rule| program.described.is_none() || program.parameters[parameter].rule == rule;
    let at = |value: Operand, rule: &dyn Fn() -> Rule| {
        let compares = |other: &Option<(Operand, usize)>| {
            other.is_some_and(|(other, parameter)| other == value && is_own(parameter, rule()))
        };
        forward.equations.iter().position(compares).expect("an equation compares what is reached")
    };
    let input = |(index, input): (usize, &Reached)| match *input {
        Reached::Value(value) => ("Value", vec![at(value, &|| Rule::Input(index))]),
        Reached::Angle { cosine, sine } => {
            ("Angle", vec![at(cosine, &|| Rule::Cosine(index)), at(sine, &|| Rule::Sine(index))])
        }
        Reached::Joint(joint) => ("Joint", vec![joint]),
    };
    forward.inputs.iter().enumerate().map(input).collect()
}

/// The number of candidates that are buffered and measured together: the number at ordinary targets, rounded up to an even number.
pub(crate) fn room(program: &Program) -> usize {
    let often = |block: &Block| block.cases.iter().filter(|case| !Case::is_rare(case)).map(Program::branches).max();
    let candidates = program.blocks.iter().filter_map(often).fold(1_usize, usize::saturating_mul);
    candidates.next_multiple_of(2).clamp(2, MOST)
}

/// Whether all candidates of an ordinary target come from one case of each block, by square roots only. Guards detect
/// the other cases, on strata. Other programs are printed for a single number only.
pub(crate) fn is_solved_abreast(program: &Program) -> bool {
    let only_roots = program.cases().flat_map(|case| &case.steps).all(|step| match step {
        Step::Roots { polynomials, .. } => square(polynomials).is_some(),
        Step::SixAxes(_) => false,
        _ => true,
    });
    let is_known = |rule: &Rule| matches!(rule, Rule::Input(_) | Rule::Root { .. });
    let fits = |candidates: usize| candidates <= MOST && program.isolated.is_none_or(|most| candidates <= most);
    program.compares_tip()
        && program.described.is_none()
        && program.preference.is_none()
        && only_roots
        && program.parameters.iter().all(|parameter| is_known(&parameter.rule))
        && program.blocks.iter().all(|block| usual(block).is_some())
        && fits(candidates(program, 0))
        && candidates(program, 0) <= program.capacity
}

/// The case of a block that runs at ordinary targets, if there is only one and guards detect the others.
pub(crate) fn usual(block: &Block) -> Option<&Case> {
    let is_detected = |case: &Case| !case.open && case.pivot.is_none() && !(case.is_rare() && case.guards.is_empty());
    let mut usual = block.cases.iter().filter(|case| !case.is_rare());
    let first = usual.next().filter(|_| usual.next().is_none() && block.cases.iter().all(is_detected))?;
    let samples = first.steps.iter().any(|step| matches!(step, Step::Sample { .. }));
    (!samples).then_some(first)
}

/// The number of candidates that the blocks from this one on make from each earlier candidate.
pub(crate) fn candidates(program: &Program, block: usize) -> usize {
    program.blocks[block..].iter().filter_map(usual).map(Program::branches).fold(1, usize::saturating_mul)
}

/// The number of consecutive candidates in which an angle is equal up to signs. These are candidates that the roots of
/// later blocks distinguish, and the pair of a root that changes the signs of the cosine and the sine.
pub(crate) fn run(layout: &Layout<'_>, joint: usize) -> usize {
    let (program, block) = (layout.program, layout.finder(joint));
    let unknowns = program.joints[joint].value.unknowns();
    let later = candidates(program, block + 1);
    let is_mirrored = usual(&program.blocks[block]).is_some_and(|case| mirror::turns(program, case, &unknowns));
    let is_after_mirror = layout.mirror.as_ref().is_some_and(|mirror| mirror.block < block);
    if is_mirrored || is_after_mirror { 2 * later } else { later }
}
