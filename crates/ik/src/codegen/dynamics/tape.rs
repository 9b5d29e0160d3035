//! Numbers that record their operations (tape). Main type: [`Recorded`].

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use crate::solver::{Instruction, Operand, Operation};
use groebot_robot::dynamics::Scalar;

/// The recorded operations, each on the same operands once.
#[derive(Debug, Default)]
struct Record {
    operations: Vec<Operation>,
    known: HashMap<Key, usize>,
}

/// An operation and its operands.
type Key = (char, [(u8, u64); 2]);

/// A tape of straight-line code.
#[derive(Clone, Debug, Default)]
pub(super) struct Tape(Rc<RefCell<Record>>);

impl Tape {
    /// The input with this number.
    pub fn input(&self, index: usize) -> Recorded {
        Recorded { value: Value::Recorded(self.clone(), Operand::Parameter(index)), negative: false }
    }

    /// The code that `results` need, in order, and their operands; registers are numbered from zero.
    pub fn code(&self, results: &[Recorded]) -> (Vec<Instruction>, Vec<Operand>) {
        // A final negation is computed here.
        let outputs: Vec<Operand> = results.iter().map(|result| self.output(result)).collect();
        let record = self.0.borrow();
        let mut needed = vec![false; record.operations.len()];
        let register = |operand: &Operand| if let Operand::Register(index) = operand { Some(*index) } else { None };
        outputs.iter().filter_map(register).for_each(|index| needed[index] = true);
        for index in (0..needed.len()).rev().filter(|index| needed[*index]).collect::<Vec<_>>() {
            mark(&record.operations, index, &mut needed);
        }
        let mut places = vec![0; needed.len()];
        let mut code = Vec::new();
        for (index, operation) in record.operations.iter().enumerate().filter(|(index, _)| needed[*index]) {
            places[index] = code.len();
            code.push(Instruction { target: code.len(), operation: moved(operation, &places) });
        }
        let outputs = outputs.into_iter().map(|output| moved_operand(output, &places)).collect();
        (code, outputs)
    }

    fn output(&self, result: &Recorded) -> Operand {
        match (&result.value, result.negative) {
            (Value::Constant(number), negative) => Operand::Constant(if negative { -number } else { *number }),
            (Value::Recorded(_, operand), false) => *operand,
            (Value::Recorded(_, operand), true) => self.write(Operation::Sub(Operand::Constant(0.0), *operand)),
        }
    }

    fn write(&self, operation: Operation) -> Operand {
        let (sign, [a, b]) = match operation {
            Operation::Add(a, b) => ('+', [a, b]),
            Operation::Sub(a, b) => ('-', [a, b]),
            Operation::Mul(a, b) => ('*', [a, b]),
            Operation::Div(a, b) => ('/', [a, b]),
            Operation::Abs(a) => ('a', [a, a]),
            Operation::Sqrt(a) => ('r', [a, a]),
        };
        let key = (sign, [key(a), key(b)]);
        let mut record = self.0.borrow_mut();
        if let Some(&index) = record.known.get(&key) {
            return Operand::Register(index);
        }
        record.operations.push(operation);
        let index = record.operations.len() - 1;
        record.known.insert(key, index);
        Operand::Register(index)
    }

    fn operation(&self, operand: Operand) -> Option<Operation> {
        let Operand::Register(index) = operand else { return None };
        self.0.borrow().operations.get(index).copied()
    }
}

fn mark(operations: &[Operation], index: usize, needed: &mut [bool]) {
    let mut open = vec![index];
    while let Some(index) = open.pop() {
        let (a, b) = operations[index].operands();
        for operand in [Some(a), b].into_iter().flatten() {
            if let Operand::Register(read) = operand
                && !needed[read]
            {
                needed[read] = true;
                open.push(read);
            }
        }
    }
}

fn moved(operation: &Operation, places: &[usize]) -> Operation {
    let to = |operand: Operand| moved_operand(operand, places);
    match *operation {
        Operation::Add(a, b) => Operation::Add(to(a), to(b)),
        Operation::Sub(a, b) => Operation::Sub(to(a), to(b)),
        Operation::Mul(a, b) => Operation::Mul(to(a), to(b)),
        Operation::Div(a, b) => Operation::Div(to(a), to(b)),
        Operation::Abs(a) => Operation::Abs(to(a)),
        Operation::Sqrt(a) => Operation::Sqrt(to(a)),
    }
}

fn moved_operand(operand: Operand, places: &[usize]) -> Operand {
    if let Operand::Register(index) = operand { Operand::Register(places[index]) } else { operand }
}

/// The identity of an operand, and its order.
fn key(operand: Operand) -> (u8, u64) {
    match operand {
        Operand::Constant(number) => (0, number.to_bits()),
        Operand::Parameter(index) => (1, index as u64),
        Operand::Unknown(index) => (2, index as u64),
        Operand::Register(index) => (3, index as u64),
        Operand::Magnitude => (4, 0),
    }
}

/// A number that records its operations. Its sign is separate, and known values are computed at once.
#[derive(Clone, Debug)]
pub(super) struct Recorded {
    value: Value,
    negative: bool,
}

#[derive(Clone, Debug)]
enum Value {
    /// A constant that is not negative.
    Constant(f64),
    Recorded(Tape, Operand),
}

impl Recorded {
    /// A constant.
    pub fn constant(number: f64) -> Self {
        Recorded { value: Value::Constant(number.abs()), negative: number < 0.0 }
    }

    /// Whether it is not a constant outside the range of doubles.
    pub fn is_finite(&self) -> bool {
        self.known().is_none_or(f64::is_finite)
    }

    fn known(&self) -> Option<f64> {
        match self.value {
            Value::Constant(number) => Some(if self.negative { -number } else { number }),
            Value::Recorded(..) => None,
        }
    }

    /// The operand without its sign.
    fn operand(&self) -> Operand {
        match &self.value {
            Value::Constant(number) => Operand::Constant(*number),
            Value::Recorded(_, operand) => *operand,
        }
    }

    fn tape<'a>(&'a self, other: &'a Self) -> &'a Tape {
        match (&self.value, &other.value) {
            (Value::Recorded(tape, _), _) | (_, Value::Recorded(tape, _)) => tape,
            _ => unreachable!("constants are computed at once"),
        }
    }

    fn written(tape: &Tape, operation: Operation, negative: bool) -> Self {
        Recorded { value: Value::Recorded(tape.clone(), tape.write(operation)), negative }
    }
}

impl PartialEq for Recorded {
    fn eq(&self, other: &Self) -> bool {
        self.negative == other.negative && key(self.operand()) == key(other.operand())
    }
}

impl Neg for Recorded {
    type Output = Self;

    fn neg(self) -> Self {
        let is_zero = self.known() == Some(0.0);
        Recorded { negative: !self.negative && !is_zero, ..self }
    }
}

impl Add for Recorded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self.known(), other.known()) {
            (Some(a), Some(b)) => return Recorded::constant(a + b),
            (Some(0.0), _) => return other,
            (_, Some(0.0)) => return self,
            _ => {}
        }
        let (a, b) = (self.operand(), other.operand());
        let (first, second) = if key(a) <= key(b) { (a, b) } else { (b, a) };
        let tape = self.tape(&other);
        if self.negative == other.negative {
            return Recorded::written(tape, Operation::Add(first, second), self.negative);
        }
        if key(a) == key(b) {
            return Recorded::zero();
        }
        // The greater operand minus the other, in the order of recording, with a separate sign.
        let first_is_negative = if first == a { self.negative } else { other.negative };
        Recorded::written(tape, Operation::Sub(first, second), first_is_negative)
    }
}

impl Sub for Recorded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Recorded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let negative = self.negative != other.negative;
        let signed = |number: Recorded| if negative { -number } else { number };
        let plain = |number: &Recorded| Recorded { negative: false, ..number.clone() };
        match (self.known().map(f64::abs), other.known().map(f64::abs)) {
            (Some(a), Some(b)) => return signed(Recorded::constant(a * b)),
            (Some(0.0), _) | (_, Some(0.0)) => return Recorded::zero(),
            (Some(1.0), _) => return signed(plain(&other)),
            (_, Some(1.0)) => return signed(plain(&self)),
            _ => {}
        }
        let (a, b) = (self.operand(), other.operand());
        let (first, second) = if key(a) <= key(b) { (a, b) } else { (b, a) };
        let tape = self.tape(&other);
        // A constant times a constant times a number.
        if let (Operand::Constant(outer), Some(Operation::Mul(Operand::Constant(inner), rest))) =
            (first, tape.operation(second))
        {
            return Recorded::written(tape, Operation::Mul(Operand::Constant(outer * inner), rest), negative);
        }
        Recorded::written(tape, Operation::Mul(first, second), negative)
    }
}

impl Div for Recorded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let negative = self.negative != other.negative;
        if let (Some(a), Some(b)) = (self.known(), other.known()) {
            return Recorded::constant(a / b);
        }
        if self.known() == Some(0.0) {
            return Recorded::zero();
        }
        let operation = Operation::Div(self.operand(), other.operand());
        Recorded::written(self.tape(&other), operation, negative)
    }
}

impl Scalar for Recorded {
    fn zero() -> Self {
        Recorded::constant(0.0)
    }

    fn one() -> Self {
        Recorded::constant(1.0)
    }

    fn half(&self) -> Self {
        Recorded::constant(0.5) * self.clone()
    }
}
