//! What operands refer to while a program runs, and the running of straight-line code.

use super::TINY;
use super::instruction::{Instruction, Operand, Operation};
use super::program::Guard;

/// The values that operands refer to.
pub(super) struct Frame<'a> {
    pub parameters: &'a [f64],
    pub magnitude: f64,
    pub unknowns: Vec<f64>,
    /// Registers of all blocks, those of the running one from `base` on.
    pub registers: Vec<f64>,
    pub base: usize,
}

impl<'a> Frame<'a> {
    /// A frame of zeros.
    pub fn new(parameters: &'a [f64], magnitude: f64, unknowns: usize, registers: usize) -> Self {
        Frame { parameters, magnitude, unknowns: vec![0.0; unknowns], registers: vec![0.0; registers], base: 0 }
    }

    #[inline]
    pub fn value(&self, operand: Operand) -> f64 {
        match operand {
            Operand::Constant(value) => value,
            Operand::Parameter(index) => self.parameters[index],
            Operand::Unknown(index) => self.unknowns[index],
            Operand::Register(index) => self.registers[self.base + index],
            Operand::Magnitude => self.magnitude,
        }
    }

    pub fn run(&mut self, code: &[Instruction]) {
        for instruction in code {
            let result = match instruction.operation {
                Operation::Add(a, b) => self.value(a) + self.value(b),
                Operation::Sub(a, b) => self.value(a) - self.value(b),
                Operation::Mul(a, b) => self.value(a) * self.value(b),
                Operation::Div(a, b) => self.value(a) / self.value(b),
                Operation::Abs(a) => self.value(a).abs(),
                Operation::Sqrt(a) => self.value(a).max(0.0).sqrt(),
            };
            self.registers[self.base + instruction.target] = result;
        }
    }

    /// Whether a guard holds; a stratum is near up to the share `near` of its factor's scale.
    pub fn holds(&self, guard: &Guard, near: f64) -> bool {
        let (value, scale) = (self.value(guard.value).abs(), self.value(guard.scale));
        if guard.near { value <= near * scale } else { value > TINY * scale }
    }
}
