//! Relations as code: [`Emitter`] computes values, [`Sizes`] the sums of their terms' magnitudes, in registers of a program.

use num_traits::{One, Signed, Zero};

use crate::derive::assemble::{Assembler, constant};
use crate::derive::closure::Arithmetic;
use crate::number::BigRational;
use crate::solver::Operand;

/// An exact number, or the result of code.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Emitted {
    Number(BigRational),
    Code(Operand),
}

impl Emitted {
    pub fn integer(number: i32) -> Self {
        Emitted::Number(BigRational::from_integer(number.into()))
    }

    /// What instructions read.
    pub fn operand(&self) -> Operand {
        match self {
            Emitted::Number(number) => constant(number),
            Emitted::Code(operand) => *operand,
        }
    }

    fn is(&self, number: &BigRational) -> bool {
        matches!(self, Emitted::Number(own) if own == number)
    }
}

/// Computes values: numbers exactly, now; all else in code.
pub(super) struct Emitter<'a>(pub &'a mut Assembler);

impl Arithmetic for Emitter<'_> {
    type Value = Emitted;

    fn rational(&mut self, number: &BigRational) -> Emitted {
        Emitted::Number(number.clone())
    }

    fn add(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        match (a, b) {
            (Emitted::Number(x), Emitted::Number(y)) => Emitted::Number(x + y),
            (zero, other) | (other, zero) if self.is_zero(zero) => other.clone(),
            _ => Emitted::Code(self.0.add(a.operand(), b.operand())),
        }
    }

    fn sub(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        match (a, b) {
            (Emitted::Number(x), Emitted::Number(y)) => Emitted::Number(x - y),
            (_, zero) if self.is_zero(zero) => a.clone(),
            _ => Emitted::Code(self.0.sub(a.operand(), b.operand())),
        }
    }

    fn mul(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        match (a, b) {
            (Emitted::Number(x), Emitted::Number(y)) => Emitted::Number(x * y),
            (zero, _) | (_, zero) if self.is_zero(zero) => Emitted::integer(0),
            (one, other) | (other, one) if one.is(&BigRational::one()) => other.clone(),
            _ => Emitted::Code(self.0.mul(a.operand(), b.operand())),
        }
    }

    fn neg(&mut self, a: &Emitted) -> Emitted {
        match a {
            Emitted::Number(x) => Emitted::Number(-x),
            Emitted::Code(operand) => Emitted::Code(self.0.mul(Operand::Constant(-1.0), *operand)),
        }
    }

    fn is_zero(&self, a: &Emitted) -> bool {
        matches!(a, Emitted::Number(number) if number.is_zero())
    }
}

/// Computes what the values would be if nothing ever cancelled.
pub(super) struct Sizes<'a>(pub &'a mut Assembler);

impl Arithmetic for Sizes<'_> {
    type Value = Emitted;

    fn rational(&mut self, number: &BigRational) -> Emitted {
        Emitted::Number(number.abs())
    }

    fn add(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        Emitter(self.0).add(a, b)
    }

    fn sub(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        self.add(a, b)
    }

    fn mul(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        Emitter(self.0).mul(a, b)
    }

    fn neg(&mut self, a: &Emitted) -> Emitted {
        a.clone()
    }

    fn is_zero(&self, a: &Emitted) -> bool {
        matches!(a, Emitted::Number(number) if number.is_zero())
    }
}
