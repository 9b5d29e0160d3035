//! Relations as code of a program: [`Emitter`] computes values, and [`Sizes`] computes the sums of their terms' magnitudes.

use num_traits::{One, Signed, Zero};

use crate::derive::closure::Arithmetic;
use crate::derive::equations::assemble::{Assembler, constant};
use crate::solver::Operand;
use groebot_algebra::number::BigRational;

/// A constant plus multiples of results of code. A sum is computed only when an operation other than a sum needs it, so terms that cancel need no code.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Emitted {
    number: BigRational,
    /// Operands are distinct and not constants, and no coefficient is zero.
    terms: Vec<(Operand, BigRational)>,
}

impl Emitted {
    pub fn number(number: BigRational) -> Self {
        Emitted { number, terms: Vec::new() }
    }

    pub fn integer(number: i32) -> Self {
        Emitted::number(BigRational::from_integer(number.into()))
    }

    /// The result of code, or a constant.
    pub fn code(operand: Operand) -> Self {
        match operand {
            Operand::Constant(number) => Emitted::number(exact(number)),
            _ => Emitted { number: BigRational::zero(), terms: vec![(operand, BigRational::one())] },
        }
    }

    fn is_number(&self) -> bool {
        self.terms.is_empty()
    }

    /// This value times a double.
    pub fn times(&self, factor: f64) -> Self {
        self.scaled(&exact(factor))
    }

    /// This value times an exact number.
    pub fn scaled(&self, factor: &BigRational) -> Self {
        if factor.is_zero() {
            return Emitted::integer(0);
        }
        let terms = self.terms.iter().map(|(operand, coefficient)| (*operand, coefficient * factor));
        Emitted { number: &self.number * factor, terms: terms.collect() }
    }

    /// This value plus a multiple of another.
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

    /// A number `k` such that `self = k sum` with a normalised sum, so that all multiples of one sum share its code. The first coefficient of the sum is
    /// positive. All its coefficients are 1 or -1 if those of `self` have equal magnitudes.
    fn content(&self) -> BigRational {
        let Some((_, first)) = self.terms.first() else { return BigRational::one() };
        let numbers = self.terms.iter().map(|(_, coefficient)| coefficient);
        let equal = numbers.chain((!self.number.is_zero()).then_some(&self.number)).all(|c| c.abs() == first.abs());
        if equal { first.clone() } else { first.signum() }
    }

    /// The operand with this value, computed in `assembler`.
    pub fn operand(&self, assembler: &mut Assembler) -> Operand {
        if self.is_number() {
            return constant(&self.number);
        }
        let content = self.content();
        let sum = self.scaled(&content.recip()).sum(assembler);
        assembler.mul(constant(&content), sum)
    }

    /// The sum of the terms; the first coefficient must be positive.
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

/// Arithmetic that emits code. Constants and sums are computed exactly at derivation time; products are emitted.
pub(super) struct Emitter<'a>(pub &'a mut Assembler);

impl Emitter<'_> {
    /// The operand with this value.
    pub fn operand(&mut self, value: &Emitted) -> Operand {
        value.operand(self.0)
    }

    /// The sum, emitted as code if it is long. It may be part of many other sums, in which little of it cancels.
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

/// Arithmetic with magnitudes, which never cancel: it computes the sizes of values.
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
