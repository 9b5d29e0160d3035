//! Demand analysis of straight-line code: only requested values are computed and printed.

use super::instruction::{Instruction, Operand};
use super::program::{Block, Case, Program, Step};
use super::rule::Rule;

/// The number of reads of each value.
#[derive(Clone, Debug, Default)]
#[doc(hidden)]
pub struct Demand {
    /// Reads by register.
    pub registers: Vec<usize>,
    /// Reads by unknown.
    pub unknowns: Vec<usize>,
    /// Reads by parameter.
    pub parameters: Vec<usize>,
    /// Reads of the magnitude.
    pub magnitude: usize,
}

fn count(counts: &mut Vec<usize>, index: usize) {
    if counts.len() <= index {
        counts.resize(index + 1, 0);
    }
    counts[index] += 1;
}

fn at(counts: &[usize], index: usize) -> usize {
    counts.get(index).copied().unwrap_or(0)
}

impl Demand {
    /// The demand of the case's guards, its root steps and the unknowns in `wanted`.
    pub fn of_case(program: &Program, case: &Case, wanted: &[usize]) -> Self {
        let mut demand = Demand::default();
        if !case.open {
            wanted.iter().for_each(|&unknown| demand.read(Operand::Unknown(unknown)));
            case.steps.iter().rev().for_each(|step| demand.step(program, step));
        }
        demand.guards(case);
        demand
    }

    /// The demand of the case's guards and its pivot.
    pub fn of_claim(case: &Case) -> Self {
        let mut demand = Demand::default();
        case.pivot.iter().for_each(|pivot| demand.read(pivot.value));
        demand.guards(case);
        demand
    }

    /// The demand of the block's cases on its code, including indirect reads. Registers that a case reads count twice:
    /// they become separate values.
    pub fn of_block(program: &Program, block: &Block, wanted: &[usize]) -> Self {
        let mut demand = Demand::default();
        for case in &block.cases {
            let parts = [Demand::of_case(program, case, wanted), Demand::of_claim(case)];
            let reads = |register: usize| parts.iter().any(|part| part.register(register) > 0);
            for register in (0..block.code.len()).filter(|&register| reads(register)) {
                demand.read(Operand::Register(register));
                demand.read(Operand::Register(register));
            }
        }
        demand.code(&block.code);
        demand
    }

    fn guards(&mut self, case: &Case) {
        for guard in &case.guards {
            self.read(guard.value);
            self.read(guard.scale);
        }
        self.code(&case.guard_code);
    }

    /// The demand of `results` on `code`.
    pub fn of_code<'a>(code: &[Instruction], results: impl IntoIterator<Item = &'a Operand>) -> Self {
        let mut demand = Demand::default();
        results.into_iter().for_each(|&operand| demand.read(operand));
        demand.code(code);
        demand
    }

    fn step(&mut self, program: &Program, step: &Step) {
        match step {
            Step::Compute(code) => self.code(code),
            Step::Set { unknown, value } if self.wants_unknown(*unknown) => self.read(*value),
            Step::Set { .. } => {}
            Step::Roots { unknown, polynomials, typical, .. } => {
                polynomials.iter().flatten().for_each(|&operand| self.read(operand));
                typical.iter().for_each(|&operand| self.read(operand));
                self.magnitude += usize::from(typical.is_none() && program.is_plain(*unknown));
            }
            Step::SixAxes(six) => six.operands().into_iter().for_each(|operand| self.read(operand)),
            Step::Sample { .. } => {}
        }
    }

    fn code(&mut self, code: &[Instruction]) {
        for instruction in code.iter().rev() {
            if at(&self.registers, instruction.target) > 0 {
                let (left, right) = instruction.operation.operands();
                self.read(left);
                right.into_iter().for_each(|right| self.read(right));
            }
        }
    }

    fn read(&mut self, operand: Operand) {
        match operand {
            Operand::Constant(_) => {}
            Operand::Parameter(index) => count(&mut self.parameters, index),
            Operand::Unknown(index) => count(&mut self.unknowns, index),
            Operand::Register(index) => count(&mut self.registers, index),
            Operand::Magnitude => self.magnitude += 1,
        }
    }

    /// Adds another demand.
    pub fn add(&mut self, other: &Demand) {
        let lists = [(&mut self.registers, &other.registers), (&mut self.unknowns, &other.unknowns)];
        for (own, others) in lists {
            own.resize(own.len().max(others.len()), 0);
            own.iter_mut().zip(others).for_each(|(own, other)| *own += other);
        }
    }

    /// Reads of a register.
    pub fn register(&self, index: usize) -> usize {
        at(&self.registers, index)
    }

    /// Whether the unknown is read.
    pub fn wants_unknown(&self, index: usize) -> bool {
        at(&self.unknowns, index) > 0
    }
}

/// The parameters that the printed code needs.
#[derive(Clone, Debug)]
#[doc(hidden)]
pub struct ParameterDemand {
    /// By parameter: whether cases or checks read it.
    pub fields: Vec<bool>,
    /// By parameter: whether its value is computed.
    pub computed: Vec<bool>,
    /// Whether the magnitude is read.
    pub magnitude: bool,
}

impl ParameterDemand {
    /// The demand of `readers`, the code after the parameters, including indirect reads.
    pub fn new(program: &Program, readers: &[&Demand]) -> Self {
        let count = program.parameters.len();
        let fields: Vec<bool> =
            (0..count).map(|i| readers.iter().any(|reader| at(&reader.parameters, i) > 0)).collect();
        let magnitude = readers.iter().any(|reader| reader.magnitude > 0);
        let mut computed: Vec<bool> = fields.iter().map(|field| *field || magnitude).collect();
        for (index, parameter) in program.parameters.iter().enumerate().rev() {
            if let (true, Rule::Root { code, value }) = (computed[index], &parameter.rule) {
                let demand = Demand::of_code(code, [value]);
                (0..count).for_each(|i| computed[i] |= at(&demand.parameters, i) > 0);
            }
        }
        ParameterDemand { fields, computed, magnitude }
    }
}
