//! Straight-line code whose operands are places of one memory. Main type: [`Code`].

use std::collections::{BTreeSet, HashMap};

use groebot_runtime::registers::in_widest;
use groebot_runtime::{Number, With};

use super::spare::with_spare;
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

impl Kind {
    const ALL: [Kind; 6] = [Kind::Add, Kind::Sub, Kind::Mul, Kind::Div, Kind::Abs, Kind::Sqrt];

    fn of(operation: &Operation) -> Self {
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

/// An instruction between places of the memory: where its result goes, and its operands.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    target: u32,
    a: u32,
    b: u32,
}

/// Instructions that run one after the other, those of a kind in a row: what is done next is asked once a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Code {
    steps: Vec<Step>,
    /// The rows' kinds and ends.
    rows: Vec<(Kind, usize)>,
}

impl Code {
    /// Runs the instructions, those of several numbers in the widest registers that the processor has.
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
        let wanted = in_rows(code.iter().filter(|line| demand.register(line.target) > 0).collect());
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
        let (mut steps, mut rows) = (Vec::with_capacity(wanted.len()), Vec::new());
        for (index, line) in wanted.iter().enumerate() {
            let [a, b] = self.read(line);
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

/// The instructions in an order in which those of a kind stand in long rows: a row goes on while an instruction of its kind has all that it reads, and the next
/// is of the kind of which most are ready.
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

fn narrow(place: usize) -> u32 {
    u32::try_from(place).expect("a program's values are fewer than 2^32")
}

/// A number in memory. Those of several targets begin where a line of the cache does, for a register is loaded from two lines in twice the time.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Line<N>(pub N);

/// How a memory is laid out.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// Where the unknowns begin, behind the parameters and the magnitude.
    pub unknowns: usize,
    size: usize,
    constants: Vec<(u32, f64)>,
}

impl Memory {
    /// Runs code on a memory with parameters, the magnitude behind them, and the unknowns' first values.
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
