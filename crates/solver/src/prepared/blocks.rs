//! Blocks, cases and steps with their operands as memory addresses. Main type: [`Blocks`].

use groebot_runtime::six_axes::{Chain, Given};

use super::code::{Assembler, Code, Memory};
use crate::{Block, Case, Demand, JointValue, Layout, Operand, Program, Step, square};

/// All blocks of a program.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    pub memory: Memory,
    pub list: Vec<PreparedBlock>,
    /// The addresses of the numbers that the equations read.
    pub places: Vec<u32>,
    /// Whether the squares of unknowns are computed from less exact values.
    pub grazing: bool,
}

/// A block.
#[derive(Clone, Debug)]
pub(super) struct PreparedBlock {
    pub code: Code,
    /// The number of branch numbers.
    pub radix: usize,
    pub alternatives: Vec<Alternative>,
}

/// One of several alternative cases, of which one runs.
#[derive(Clone, Debug)]
pub(super) enum Alternative {
    /// A case that its guards select.
    Guarded(PreparedCase),
    /// A group of cases, each with its pivot. The best conditioned one runs.
    BestConditioned(Vec<(u32, PreparedCase)>),
    /// A gap, with its number: a stratum that could not be derived.
    Gap(usize, PreparedCase),
}

/// A case.
#[derive(Clone, Debug)]
pub(super) struct PreparedCase {
    pub code: Code,
    pub guards: Vec<Guard>,
    pub applies: Applies,
    pub steps: Vec<PreparedStep>,
    pub first_branch: usize,
    /// The end of its branch numbers.
    pub last: usize,
    /// Free joints: bit `j` for joint `j`.
    pub free: u32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Guard {
    pub value: u32,
    pub scale: u32,
    pub near: bool,
}

/// The condition under which a case whose guards hold applies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Applies {
    Usually,
    Rarely,
    Near,
}

/// A step.
#[derive(Clone, Debug)]
pub(super) enum PreparedStep {
    Compute(Code),
    Set { unknown: u32, value: u32 },
    Square { unknown: u32, constant: u32, typical: u32, stride: usize, is_pair: bool },
    Roots { unknown: u32, polynomials: Vec<Vec<u32>>, typical: u32, half_angle: bool, stride: usize },
    Sample { unknowns: Vec<u32>, rows: Vec<Vec<f64>> },
    SixAxes(Box<Six>),
}

/// A step that finds six joints.
#[derive(Clone, Debug)]
pub(super) struct Six {
    pub chain: Chain,
    /// The joints with given values between the six.
    pub given: Vec<Given>,
    /// The target, then the values of the given joints; unused numbers are zero.
    pub numbers: [u32; 12 + 2 * Given::ROOM],
    pub joints: [JointPlace; 6],
    /// By joint, its bit among the free ones.
    pub bits: [u32; 6],
    pub stride: usize,
}

/// The memory address for a joint's value.
#[derive(Clone, Copy, Debug)]
pub(super) enum JointPlace {
    Angle([u32; 2]),
    Length(u32),
}

impl Blocks {
    pub fn new(layout: &Layout<'_>) -> Self {
        let program = layout.program;
        let mut assembler = Assembler::new(program.parameters.len(), (0..program.unknowns.len()).collect());
        let mut preparing = Preparing { layout, assembler: &mut assembler };
        let list = (0..program.blocks.len()).map(|index| preparing.block(index)).collect();
        let places = layout.places().into_iter().map(|unknown| assembler.place(Operand::Unknown(unknown))).collect();
        Blocks { memory: assembler.memory(), list, places, grazing: program.degree() > 2 }
    }
}

struct Preparing<'a> {
    layout: &'a Layout<'a>,
    assembler: &'a mut Assembler,
}

impl Preparing<'_> {
    fn block(&mut self, index: usize) -> PreparedBlock {
        let (layout, block) = (self.layout, &self.layout.program.blocks[index]);
        let is_last = index + 1 == layout.program.blocks.len();
        let wanted = if is_last { layout.wanted() } else { layout.wanted_of(index) };
        let demand = Demand::of_block(layout.program, block, &wanted);
        let code = self.assembler.code(&block.code, &demand);
        let first = (0..block.cases.len()).filter(|&case| block.opens_group(case));
        let alternatives = first.map(|first| self.alternative(block, first, &wanted)).collect();
        PreparedBlock { code, radix: block.branches(), alternatives }
    }

    fn alternative(&mut self, block: &Block, first: usize, wanted: &[usize]) -> Alternative {
        let case = &block.cases[first];
        let Some(pivot) = case.pivot else {
            let prepared = self.prepared_case(case, wanted);
            return if case.open {
                Alternative::Gap(self.number(case), prepared)
            } else {
                Alternative::Guarded(prepared)
            };
        };
        let mut members = Vec::new();
        for case in &block.cases {
            if let Some(own) = case.pivot.filter(|own| own.group == pivot.group) {
                let prepared = self.prepared_case(case, wanted);
                members.push((self.assembler.place(own.value), prepared));
            }
        }
        Alternative::BestConditioned(members)
    }

    /// The number of an open case among all, from 1.
    fn number(&self, case: &Case) -> usize {
        let mut open = self.layout.program.cases().filter(|case| case.open);
        1 + open.position(|other| std::ptr::eq(other, case)).unwrap_or(0)
    }

    fn prepared_case(&mut self, case: &Case, wanted: &[usize]) -> PreparedCase {
        let program = self.layout.program;
        let (mut demand, claim) = (Demand::of_case(program, case, wanted), Demand::of_claim(case));
        demand.add(&claim);
        let code = self.assembler.code(&case.guard_code, &demand);
        let guard = |guard: &crate::Guard| Guard {
            value: self.assembler.place(guard.value),
            scale: self.assembler.place(guard.scale),
            near: guard.near,
        };
        let guards = case.guards.iter().map(guard).collect();
        let applies = match () {
            () if case.is_of_stratum() => Applies::Near,
            () if case.is_rare() => Applies::Rarely,
            () => Applies::Usually,
        };
        let steps = if case.open { Vec::new() } else { self.steps(case, &demand) };
        let last = case.first_branch + Program::branches(case);
        let free = case.free.iter().fold(0, |free, joint| free | 1 << joint);
        PreparedCase { code, guards, applies, steps, first_branch: case.first_branch, last, free }
    }

    fn steps(&mut self, case: &Case, demand: &Demand) -> Vec<PreparedStep> {
        let is_mirror = self.layout.is_mirror(case);
        let mut prepared = Vec::new();
        for (index, step) in case.steps.iter().enumerate() {
            let stride: usize = case.steps[index + 1..].iter().map(Step::slots).product();
            match step {
                Step::Compute(code) => prepared.push(PreparedStep::Compute(self.assembler.code(code, demand))),
                Step::Set { unknown, value } if demand.wants_unknown(*unknown) => {
                    prepared.push(PreparedStep::Set {
                        unknown: self.unknown(*unknown),
                        value: self.assembler.place(*value),
                    });
                }
                Step::Set { .. } => {}
                Step::Roots { unknown, polynomials, typical, half_angle } => {
                    prepared.push(self.roots((*unknown, polynomials, *typical, *half_angle), stride, is_mirror));
                }
                Step::Sample { joint, values } => {
                    let unknowns = joint.unknowns().into_iter().map(|unknown| self.unknown(unknown)).collect();
                    let row = |value: &f64| match joint {
                        JointValue::Angle { .. } => vec![value.cos(), value.sin()],
                        JointValue::Plain(_) => vec![*value],
                    };
                    prepared.push(PreparedStep::Sample { unknowns, rows: values.iter().map(row).collect() });
                }
                Step::SixAxes(six) => prepared.push(self.six_axes(six, stride)),
            }
        }
        prepared
    }

    fn unknown(&mut self, unknown: usize) -> u32 {
        self.assembler.place(Operand::Unknown(unknown))
    }

    fn roots(
        &mut self,
        (unknown, polynomials, typical, half_angle): (usize, &[Vec<Operand>], Option<Operand>, bool),
        stride: usize,
        is_pair: bool,
    ) -> PreparedStep {
        let is_plain = self.layout.program.is_plain(unknown);
        let usual = if is_plain { Operand::Magnitude } else { Operand::Constant(1.0) };
        let typical = self.assembler.place(typical.unwrap_or(usual));
        let place = self.unknown(unknown);
        if let Some(constant) = square(polynomials).filter(|_| !half_angle) {
            let constant = self.assembler.place(constant);
            return PreparedStep::Square { unknown: place, constant, typical, stride, is_pair };
        }
        let mut list = |list: &Vec<Operand>| list.iter().map(|&operand| self.assembler.place(operand)).collect();
        let polynomials = polynomials.iter().map(&mut list).collect();
        PreparedStep::Roots { unknown: place, polynomials, typical, half_angle, stride }
    }

    fn six_axes(&mut self, six: &crate::eigenvalue::SixAxes, stride: usize) -> PreparedStep {
        let joints = &self.layout.program.joints;
        let bit =
            |joint: JointValue| joints.iter().position(|other| other.value == joint).map_or(0, |index| 1 << index);
        let (parts, operands, zero) = (six.parts(), six.operands(), Operand::Constant(0.0));
        let place = |joint: JointValue, assembler: &mut Assembler| match joint {
            JointValue::Angle { cosine, sine } => {
                JointPlace::Angle([cosine, sine].map(|unknown| assembler.place(Operand::Unknown(unknown))))
            }
            JointValue::Plain(unknown) => JointPlace::Length(assembler.place(Operand::Unknown(unknown))),
        };
        PreparedStep::SixAxes(Box::new(Six {
            chain: six.chain(),
            given: six.given(),
            numbers: std::array::from_fn(|k| self.assembler.place(operands.get(k).copied().unwrap_or(zero))),
            joints: parts.joints.map(|joint| place(joint, self.assembler)),
            bits: parts.joints.map(bit),
            stride,
        }))
    }
}
