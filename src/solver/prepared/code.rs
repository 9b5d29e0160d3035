//! Straight-line code whose operands are places of one memory. Main type: [`Code`].

use std::collections::HashMap;

use groebot_runtime::registers::in_widest;
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
    /// Runs the instructions, those of several numbers in the widest registers that the processor has.
    #[inline]
    pub fn run<N: Number>(&self, memory: &mut [N])
    where
        f64: With<N>,
    {
        if size_of::<N>() > size_of::<f64>() {
            in_widest(
                #[inline(always)]
                || self.steps(memory),
            );
        } else {
            self.steps(memory);
        }
    }

    #[inline(always)]
    fn steps<N: Number>(&self, memory: &mut [N])
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

/// Where operands stand: parameters, the magnitude, unknowns, and behind them registers and constants as they come. The place of a register that
/// is read by its own piece of code alone is given to others behind its last reader.
#[derive(Clone, Debug)]
pub(super) struct Assembler {
    /// Where the unknowns begin.
    unknowns: usize,
    /// By unknown, where it stands among those; an unknown without a place is not read.
    place_of: Vec<usize>,
    /// By register, of the block at hand.
    registers: Vec<u32>,
    /// The places that are given on.
    passing: Vec<u32>,
    constants: Vec<(u32, f64)>,
    size: usize,
}

impl Assembler {
    /// For code with so many parameters, and unknowns of which each stands where `place_of` tells.
    pub fn new(parameters: usize, place_of: Vec<usize>) -> Self {
        let (unknowns, count) = (parameters + 1, place_of.iter().map(|place| place + 1).max().unwrap_or(0));
        let (registers, passing, constants) = (Vec::new(), Vec::new(), Vec::new());
        Assembler { unknowns, place_of, registers, passing, constants, size: unknowns + count }
    }

    /// Where an operand stands: a register whose code has been assembled, or anything else.
    pub fn place(&mut self, operand: Operand) -> u32 {
        match operand {
            Operand::Parameter(index) => narrow(index),
            Operand::Magnitude => narrow(self.unknowns - 1),
            Operand::Unknown(index) => narrow(self.unknowns + self.place_of[index]),
            Operand::Register(index) => self.registers[index],
            Operand::Constant(value) => self.constant(value),
        }
    }

    fn constant(&mut self, value: f64) -> u32 {
        let known = self.constants.iter().find(|(_, other)| other.to_bits() == value.to_bits());
        known.map(|(place, _)| *place).unwrap_or_else(|| {
            let place = self.another();
            self.constants.push((place, value));
            place
        })
    }

    /// A place that nothing has.
    fn another(&mut self) -> u32 {
        self.size += 1;
        narrow(self.size - 1)
    }

    /// The same, to be given on.
    fn another_passing(&mut self) -> u32 {
        let place = self.another();
        self.passing.push(place);
        place
    }

    /// The instructions that are asked for.
    pub fn code(&mut self, code: &[Instruction], demand: &Demand) -> Code {
        let wanted: Vec<&Instruction> = code.iter().filter(|line| demand.register(line.target) > 0).collect();
        let mut readers: HashMap<usize, (usize, usize)> = HashMap::new();
        for (index, line) in wanted.iter().enumerate() {
            for register in registers(line) {
                let (count, last) = readers.entry(register).or_default();
                (*count, *last) = (*count + 1, index);
            }
        }
        // Who reads a register last, if nothing behind this code does.
        let ends = |register: usize| {
            readers.get(&register).filter(|(count, _)| *count == demand.register(register)).map(|(_, last)| *last)
        };
        let (mut free, mut passing) = (self.passing.clone(), HashMap::new());
        let mut steps = Vec::with_capacity(wanted.len());
        for (index, line) in wanted.iter().enumerate() {
            let (kind, [a, b]) = self.read(line);
            // Each once, be it read on both sides.
            free.extend(
                registers(line)
                    .filter(|&register| ends(register) == Some(index))
                    .filter_map(|register| passing.remove(&register)),
            );
            let target = if ends(line.target).is_none() {
                self.another()
            } else {
                let place = free.pop().unwrap_or_else(|| self.another_passing());
                passing.insert(line.target, place);
                place
            };
            self.registers.resize(self.registers.len().max(line.target + 1), u32::MAX);
            self.registers[line.target] = target;
            steps.push(Step { kind, target, a, b });
        }
        Code(steps)
    }

    fn read(&mut self, line: &Instruction) -> (Kind, [u32; 2]) {
        let kind = match line.operation {
            Operation::Add(..) => Kind::Add,
            Operation::Sub(..) => Kind::Sub,
            Operation::Mul(..) => Kind::Mul,
            Operation::Div(..) => Kind::Div,
            Operation::Abs(_) => Kind::Abs,
            Operation::Sqrt(_) => Kind::Sqrt,
        };
        let (a, b) = line.operation.operands();
        let a = self.place(a);
        (kind, [a, b.map_or(a, |b| self.place(b))])
    }

    /// The memory that the code runs on.
    pub fn memory(self) -> Memory {
        Memory { unknowns: self.unknowns, size: self.size, constants: self.constants }
    }
}

/// The registers that an instruction reads.
fn registers(line: &Instruction) -> impl Iterator<Item = usize> + use<> {
    let (a, b) = line.operation.operands();
    let register = |operand| if let Operand::Register(index) = operand { Some(index) } else { None };
    [register(a), b.and_then(register)].into_iter().flatten()
}

fn narrow(place: usize) -> u32 {
    u32::try_from(place).expect("a program's values are fewer than 2^32")
}

/// How a memory is laid out.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// Where the unknowns begin, behind the parameters and the magnitude.
    pub unknowns: usize,
    size: usize,
    constants: Vec<(u32, f64)>,
}

impl Memory {
    /// A memory with parameters, the magnitude behind them.
    #[inline]
    pub fn with<N: Number>(&self, parameters: &[N]) -> Vec<N> {
        let mut memory = Vec::with_capacity(self.size);
        memory.extend_from_slice(parameters);
        memory.resize(self.size, N::of(0.0));
        for &(place, constant) in &self.constants {
            memory[place as usize] = N::of(constant);
        }
        memory
    }
}
