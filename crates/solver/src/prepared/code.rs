//! Straight-line code whose operands are addresses of one memory. Main type: [`Code`].

use std::collections::{BTreeSet, HashMap};

use groebot_runtime::registers::in_widest;
use groebot_runtime::{Number, With};

use super::spare::with_spare;
use crate::{Demand, Instruction, Operand, Operation};

/// The operation of an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Kind {
    Add,
    Sub,
    Mul,
    Div,
    Abs,
    Sqrt,
    /// The greater one of a number and the magnitude of another.
    Greater,
}

impl Kind {
    const ALL: [Kind; 7] = [Kind::Add, Kind::Sub, Kind::Mul, Kind::Div, Kind::Abs, Kind::Sqrt, Kind::Greater];

    pub fn of(operation: &Operation) -> Self {
        match operation {
            Operation::Add(..) => Kind::Add,
            Operation::Sub(..) => Kind::Sub,
            Operation::Mul(..) => Kind::Mul,
            Operation::Div(..) => Kind::Div,
            Operation::Abs(_) => Kind::Abs,
            Operation::Sqrt(_) => Kind::Sqrt,
        }
    }
}

/// An instruction between addresses of the memory: the address of its result, and its operands.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    target: u32,
    a: u32,
    b: u32,
}

/// Instructions that run one after the other, grouped by operation, so that there is one dispatch per group.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Code {
    steps: Vec<Step>,
    /// The operation and the end of each group.
    rows: Vec<(Kind, usize)>,
}

impl Code {
    /// Runs the instructions; those of several numbers use the widest registers of the processor.
    #[inline]
    pub fn run<N: Number>(&self, memory: &mut [Line<N>])
    where
        f64: With<N>,
    {
        if size_of::<N>() > size_of::<f64>() {
            in_widest(
                #[inline(always)]
                || self.run_rows(memory),
            );
        } else {
            self.run_rows(memory);
        }
    }

    #[inline(always)]
    fn run_rows<N: Number>(&self, memory: &mut [Line<N>])
    where
        f64: With<N>,
    {
        let mut start = 0;
        for &(kind, end) in &self.rows {
            let row = &self.steps[start..end];
            match kind {
                Kind::Add => each(row, memory, |a, b| a + b),
                Kind::Sub => each(row, memory, |a, b| a - b),
                Kind::Mul => each(row, memory, |a, b| a * b),
                Kind::Div => each(row, memory, |a, b| a / b),
                Kind::Abs => each(row, memory, |a, _| a.abs()),
                Kind::Sqrt => each(row, memory, |a, _| a.root()),
                Kind::Greater => each(row, memory, |a, b| a.greater(b.abs())),
            }
            start = end;
        }
    }
}

#[inline(always)]
fn each<N: Number>(row: &[Step], memory: &mut [Line<N>], operation: impl Fn(N, N) -> N) {
    for step in row {
        memory[step.target as usize] = Line(operation(memory[step.a as usize].0, memory[step.b as usize].0));
    }
}

/// The memory layout of operands: parameters, the magnitude, unknowns, and after them registers and constants in the
/// order of use. The address of a register that only its own piece of code reads is used again after its last read.
#[derive(Clone, Debug)]
pub(super) struct Assembler {
    /// The address of the first unknown.
    unknowns: usize,
    /// By unknown, its index among those; an unknown without an index is not read.
    place_of: Vec<usize>,
    /// By register of the current block.
    registers: Vec<u32>,
    /// The addresses that are used again.
    passing: Vec<u32>,
    constants: Vec<(u32, f64)>,
    size: usize,
}

impl Assembler {
    /// An assembler for code with this number of parameters, and unknowns at the indices `place_of`.
    pub fn new(parameters: usize, place_of: Vec<usize>) -> Self {
        let (unknowns, count) = (parameters + 1, place_of.iter().map(|place| place + 1).max().unwrap_or(0));
        let (registers, passing, constants) = (Vec::new(), Vec::new(), Vec::new());
        Assembler { unknowns, place_of, registers, passing, constants, size: unknowns + count }
    }

    /// The address of an operand: a register whose code has been assembled, or any other operand.
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

    /// A new address.
    fn another(&mut self) -> u32 {
        self.size += 1;
        narrow(self.size - 1)
    }

    /// A new address that may be used again.
    fn another_passing(&mut self) -> u32 {
        let place = self.another();
        self.passing.push(place);
        place
    }

    /// Assembles the requested instructions.
    pub fn code(&mut self, code: &[Instruction], demand: &Demand) -> Code {
        let wanted = in_rows(code.iter().filter(|line| demand.register(line.target) > 0).collect());
        let mut readers: HashMap<usize, (usize, usize)> = HashMap::new();
        for (index, line) in wanted.iter().enumerate() {
            for register in registers(line) {
                let (count, last) = readers.entry(register).or_default();
                (*count, *last) = (*count + 1, index);
            }
        }
        // The last reader of a register, if no later code reads it.
        let ends = |register: usize| {
            readers.get(&register).filter(|(count, _)| *count == demand.register(register)).map(|(_, last)| *last)
        };
        let (mut free, mut passing) = (self.passing.clone(), HashMap::new());
        let (mut steps, mut rows) = (Vec::with_capacity(wanted.len()), Vec::new());
        for (index, line) in wanted.iter().enumerate() {
            let [a, b] = self.read(line);
            // Each register once, even if it is both operands.
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
            steps.push(Step { target, a, b });
            let kind = Kind::of(&line.operation);
            match rows.last_mut() {
                Some((last, end)) if *last == kind => *end = steps.len(),
                _ => rows.push((kind, steps.len())),
            }
        }
        Code { steps, rows }
    }

    fn read(&mut self, line: &Instruction) -> [u32; 2] {
        let (a, b) = line.operation.operands();
        let a = self.place(a);
        [a, b.map_or(a, |b| self.place(b))]
    }

    /// The memory that the code runs on.
    pub fn memory(self) -> Memory {
        Memory { unknowns: self.unknowns, size: self.size, constants: self.constants }
    }
}

/// The instructions in an order with long groups of one operation. A group continues while an instruction of its
/// operation has all its operands; the next group is of the operation with the most ready instructions.
fn in_rows(code: Vec<&Instruction>) -> Vec<&Instruction> {
    let writer: HashMap<usize, usize> = code.iter().enumerate().map(|(index, line)| (line.target, index)).collect();
    let mut readers = vec![Vec::new(); code.len()];
    let mut waits = vec![0; code.len()];
    for (index, line) in code.iter().enumerate() {
        for source in registers(line).filter_map(|register| writer.get(&register)) {
            readers[*source].push(index);
            waits[index] += 1;
        }
    }
    let kind_of = |index: usize| Kind::of(&code[index].operation) as usize;
    let mut ready = [const { BTreeSet::new() }; Kind::ALL.len()];
    (0..code.len()).filter(|&index| waits[index] == 0).for_each(|index| _ = ready[kind_of(index)].insert(index));
    let (mut ordered, mut kind) = (Vec::with_capacity(code.len()), 0);
    while ordered.len() < code.len() {
        let Some(index) = ready[kind].pop_first() else {
            kind = (0..ready.len()).max_by_key(|&kind| ready[kind].len()).unwrap_or(0);
            continue;
        };
        ordered.push(code[index]);
        for &reader in &readers[index] {
            waits[reader] -= 1;
            if waits[reader] == 0 {
                ready[kind_of(reader)].insert(reader);
            }
        }
    }
    ordered
}

/// The registers that an instruction reads.
fn registers(line: &Instruction) -> impl Iterator<Item = usize> + use<> {
    let (a, b) = line.operation.operands();
    let register = |operand| if let Operand::Register(index) = operand { Some(index) } else { None };
    [register(a), b.and_then(register)].into_iter().flatten()
}

pub(super) fn narrow(place: usize) -> u32 {
    u32::try_from(place).expect("a program's values are fewer than 2^32")
}

/// A number in memory. Numbers of several targets are aligned to cache lines, because a load from two lines takes twice
/// the time.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Line<N>(pub N);

/// The layout of a memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// The address of the first unknown, after the parameters and the magnitude.
    pub unknowns: usize,
    size: usize,
    constants: Vec<(u32, f64)>,
}

impl Memory {
    /// Runs code on a memory with parameters, the magnitude after them, and the unknowns' initial values.
    #[inline]
    pub fn with<N: Number, R>(&self, parameters: &[N], unknowns: &[N], run: impl FnOnce(&mut [Line<N>]) -> R) -> R
    where
        f64: With<N>,
    {
        with_spare(|memory: &mut Vec<Line<N>>| {
            if memory.len() < self.size {
                memory.resize(self.size, Line(N::of(0.0)));
            }
            let mut write = |first: usize, numbers: &[N]| {
                memory[first..].iter_mut().zip(numbers).for_each(|(line, number)| line.0 = *number);
            };
            write(0, parameters);
            write(self.unknowns, unknowns);
            for &(place, constant) in &self.constants {
                memory[place as usize].0 = N::of(constant);
            }
            run(&mut memory[..self.size])
        })
    }
}
