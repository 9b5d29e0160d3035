//! Relations as code: [`Emitter`] computes values, [`Sizes`] the sums of their terms' magnitudes, in registers of a program.

use num_traits::{One, Signed, Zero};

use crate::derive::closure::Arithmetic;
use crate::derive::equations::assemble::{Assembler, constant};
use crate::solver::Operand;
use groebot_algebra::number::BigRational;

/// A number and multiples of results of code: sums are not computed before something else than a sum asks for them, so that what
/// cancels leaves no code.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Emitted {
    number: BigRational,
    /// No operand is a constant or is given twice, and no coefficient is zero.
    terms: Vec<(Operand, BigRational)>,
}

impl Emitted {
    pub fn number(number: BigRational) -> Self {
        Emitted { number, terms: Vec::new() }
    }

    pub fn integer(number: i32) -> Self {
        Emitted::number(BigRational::from_integer(number.into()))
    }

    /// The result of code, or a number.
    pub fn code(operand: Operand) -> Self {
        match operand {
            Operand::Constant(number) => Emitted::number(exact(number)),
            _ => Emitted { number: BigRational::zero(), terms: vec![(operand, BigRational::one())] },
        }
    }

    fn is_number(&self) -> bool {
        self.terms.is_empty()
    }

    /// This times a double.
    pub fn times(&self, factor: f64) -> Self {
        self.scaled(&exact(factor))
    }

    /// This times a number.
    pub fn scaled(&self, factor: &BigRational) -> Self {
        if factor.is_zero() {
            return Emitted::integer(0);
        }
        let terms = self.terms.iter().map(|(operand, coefficient)| (*operand, coefficient * factor));
        Emitted { number: &self.number * factor, terms: terms.collect() }
    }

    /// This plus a multiple of another.
    fn plus(&self, other: &Emitted, factor: &BigRational) -> Self {
        let mut sum = self.clone();
        sum.number += &other.number * factor;
        for (operand, coefficient) in &other.terms {
            let change = coefficient * factor;
            match sum.terms.iter_mut().find(|(own, _)| own == operand) {
                Some((_, own)) => *own += change,
                None => sum.terms.push((*operand, change)),
            }
        }
        sum.terms.retain(|(_, coefficient)| !coefficient.is_zero());
        sum
    }

    /// A number `k` and a sum with `self = k sum`, so that multiples of one sum have one code: its coefficients are 1 and -1 where all
    /// are of one magnitude, and the first is positive.
    fn content(&self) -> BigRational {
        let Some((_, first)) = self.terms.first() else { return BigRational::one() };
        let numbers = self.terms.iter().map(|(_, coefficient)| coefficient);
        let equal = numbers.chain((!self.number.is_zero()).then_some(&self.number)).all(|c| c.abs() == first.abs());
        if equal { first.clone() } else { first.signum() }
    }

    /// What instructions read, computed in `assembler`.
    pub fn operand(&self, assembler: &mut Assembler) -> Operand {
        if self.is_number() {
            return constant(&self.number);
        }
        let content = self.content();
        let sum = self.scaled(&content.recip()).sum(assembler);
        assembler.mul(constant(&content), sum)
    }

    /// The sum of the terms, of which the first is positive.
    fn sum(&self, assembler: &mut Assembler) -> Operand {
        let mut sum = Operand::Constant(0.0);
        for (operand, coefficient) in &self.terms {
            let term = assembler.mul(constant(&coefficient.abs()), *operand);
            sum = if coefficient.is_negative() { assembler.sub(sum, term) } else { assembler.add(sum, term) };
        }
        assembler.add(sum, constant(&self.number))
    }
}

/// The exact value of a finite double.
fn exact(number: f64) -> BigRational {
    BigRational::from_float(number).expect("a constant of a program is finite")
}

/// Computes values: numbers and sums exactly, now; products in code.
pub(super) struct Emitter<'a>(pub &'a mut Assembler);

impl Emitter<'_> {
    /// What instructions read.
    pub fn operand(&mut self, value: &Emitted) -> Operand {
        value.operand(self.0)
    }

    /// A sum, computed if it is long: it may be part of many others, in which little of it cancels.
    fn short(&mut self, sum: Emitted) -> Emitted {
        if sum.terms.len() > self.0.longest() { Emitted::code(sum.operand(self.0)) } else { sum }
    }
}

impl Arithmetic for Emitter<'_> {
    type Value = Emitted;

    fn rational(&mut self, number: &BigRational) -> Emitted {
        Emitted::number(number.clone())
    }

    fn add(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        self.short(a.plus(b, &BigRational::one()))
    }

    fn sub(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        self.short(a.plus(b, &-BigRational::one()))
    }

    fn mul(&mut self, a: &Emitted, b: &Emitted) -> Emitted {
        if a.is_number() {
            return b.scaled(&a.number);
        }
        if b.is_number() {
            return a.scaled(&b.number);
        }
        let contents = [a.content(), b.content()];
        let [a, b] = [a, b].map(|sum| sum.scaled(&sum.content().recip()).sum(self.0));
        Emitted::code(self.0.mul(a, b)).scaled(&(&contents[0] * &contents[1]))
    }

    fn neg(&mut self, a: &Emitted) -> Emitted {
        a.scaled(&-BigRational::one())
    }

    fn is_zero(&self, a: &Emitted) -> bool {
        a.is_number() && a.number.is_zero()
    }
}

/// Computes what the values would be if nothing ever cancelled.
pub(super) struct Sizes<'a>(pub &'a mut Assembler);

impl Arithmetic for Sizes<'_> {
    type Value = Emitted;

    fn rational(&mut self, number: &BigRational) -> Emitted {
        Emitted::number(number.abs())
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
        a.is_number() && a.number.is_zero()
    }
}
