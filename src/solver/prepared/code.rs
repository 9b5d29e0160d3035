//! Straight-line code whose operands are places of one memory. Main type: [`Code`].

use groebot_runtime::{Number, With};

use crate::solver::{Demand, Instruction, Operand, Operation};

/// What an instruction does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Add,
    Sub,
    Mul,
    Div,
    Abs,
    Sqrt,
}

/// An instruction between places of the memory.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    kind: Kind,
    target: u32,
    a: u32,
    b: u32,
}

/// Instructions that run one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Code(Vec<Step>);

impl Code {
    /// Runs the instructions.
    #[inline]
    pub fn run<N: Number>(&self, memory: &mut [N])
    where
        f64: With<N>,
    {
        for step in &self.0 {
            let (a, b) = (memory[step.a as usize], memory[step.b as usize]);
            memory[step.target as usize] = match step.kind {
                Kind::Add => a + b,
                Kind::Sub => a - b,
                Kind::Mul => a * b,
                Kind::Div => a / b,
                Kind::Abs => a.abs(),
                Kind::Sqrt => a.root(),
            };
        }
    }
}

/// Where operands stand: parameters, the magnitude, unknowns, registers, and constants behind them.
#[derive(Clone, Debug)]
pub(super) struct Assembler {
    parameters: usize,
    unknowns: usize,
    /// By unknown, where it stands among those; an unknown without a place is not read.
    place_of: Vec<usize>,
    registers: usize,
    constants: Vec<f64>,
    /// Where register 0 stands among the registers.
    pub base: usize,
}

impl Assembler {
    /// For code with so many parameters, unknowns of which each stands where `place_of` tells, and registers.
    pub fn new(parameters: usize, place_of: Vec<usize>, registers: usize) -> Self {
        let unknowns = place_of.iter().map(|place| place + 1).max().unwrap_or(0);
        Assembler { parameters, unknowns, place_of, registers, constants: Vec::new(), base: 0 }
    }

    /// Where an operand stands.
    pub fn place(&mut self, operand: Operand) -> u32 {
        let first_register = self.parameters + 1 + self.unknowns;
        let place = match operand {
            Operand::Parameter(index) => index,
            Operand::Magnitude => self.parameters,
            Operand::Unknown(index) => self.parameters + 1 + self.place_of[index],
            Operand::Register(index) => first_register + self.base + index,
            Operand::Constant(value) => {
                let is_same = |other: &f64| other.to_bits() == value.to_bits();
                let known = self.constants.iter().position(is_same);
                let index = known.unwrap_or(self.constants.len());
                if known.is_none() {
                    self.constants.push(value);
                }
                first_register + self.registers + index
            }
        };
        u32::try_from(place).expect("a program's values are fewer than 2^32")
    }

    /// The instructions that are asked for.
    pub fn code(&mut self, code: &[Instruction], demand: &Demand) -> Code {
        let wanted = code.iter().filter(|instruction| demand.register(instruction.target) > 0);
        Code(wanted.map(|instruction| self.step(instruction)).collect())
    }

    fn step(&mut self, instruction: &Instruction) -> Step {
        let kind = match instruction.operation {
            Operation::Add(..) => Kind::Add,
            Operation::Sub(..) => Kind::Sub,
            Operation::Mul(..) => Kind::Mul,
            Operation::Div(..) => Kind::Div,
            Operation::Abs(_) => Kind::Abs,
            Operation::Sqrt(_) => Kind::Sqrt,
        };
        let (a, b) = instruction.operation.operands();
        let a = self.place(a);
        let b = b.map_or(a, |b| self.place(b));
        Step { kind, target: self.place(Operand::Register(instruction.target)), a, b }
    }

    /// The memory's size, and the constants at its end.
    pub fn memory(self) -> Memory {
        let constants = self.parameters + 1 + self.unknowns + self.registers;
        Memory { unknowns: self.parameters + 1, first_constant: constants, constants: self.constants }
    }
}

/// How a memory is laid out.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// Where the unknowns begin, behind the parameters and the magnitude.
    pub unknowns: usize,
    first_constant: usize,
    constants: Vec<f64>,
}

impl Memory {
    /// A memory with parameters, the magnitude behind them.
    #[inline]
    pub fn with<N: Number>(&self, parameters: &[N]) -> Vec<N> {
        let mut memory = Vec::with_capacity(self.first_constant + self.constants.len());
        memory.extend_from_slice(parameters);
        memory.resize(self.first_constant, N::of(0.0));
        memory.extend(self.constants.iter().map(|&constant| N::of(constant)));
        memory
    }
}
