//! Rational numbers with one common denominator from residues modulo many primes.
//!
//! Chinese remaindering and rational reconstruction: von zur Gathen and Gerhard, Modern Computer Algebra (2013),
//! section 5.10.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::modular::Modular;
use super::residues::Residues;
use super::shape::Shape;

/// Number of bits by which a reconstruction must be shorter than the modulus to be accepted. The proof follows later.
const MARGIN: u64 = 40;

/// The coefficients of a representation modulo a growing product of lucky primes, and the candidate over Q.
#[derive(Clone, Debug)]
pub(super) struct Lift {
    shape: Shape,
    modulus: BigInt,
    values: Vec<BigInt>,
    primes: usize,
    next_attempt: usize,
    /// Numerators, then their common denominator.
    candidate: Option<Vec<BigInt>>,
}

impl Lift {
    pub(super) fn new(shape: Shape) -> Self {
        let values = vec![BigInt::zero(); shape.length()];
        Lift { shape, modulus: BigInt::one(), values, primes: 0, next_attempt: 1, candidate: None }
    }

    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The number of primes so far.
    pub(super) fn primes(&self) -> usize {
        self.primes
    }

    /// The coefficients modulo a new prime; `None` when it is unlucky. If the earlier primes were unlucky, the lift
    /// starts again.
    pub(super) fn lucky_residues(&mut self, modular: &Modular) -> Option<Vec<u32>> {
        if self.shape.is_unlucky(modular) {
            *self = Lift::new(Shape::of(modular));
        }
        (self.shape == Shape::of(modular)).then(|| self.shape.flatten(modular))
    }

    /// Returns the candidate over Q if it has these residues modulo a new prime. Otherwise it is discarded.
    pub(super) fn confirmed(&mut self, residues: &[u32], prime: u32) -> Option<Vec<BigInt>> {
        self.candidate.take().filter(|values| agrees(values, residues, prime))
    }

    /// Adds the residues modulo a new prime and searches for a candidate. Attempts become rarer as the numbers grow.
    pub(super) fn add(&mut self, prime: u32, residues: &[u32]) {
        let field = Residues::new(prime);
        let inverse = field.inverse(residue(&self.modulus, prime));
        for (value, &wanted) in self.values.iter_mut().zip(residues) {
            let digit = field.mul(field.sub(wanted, residue(value, prime)), inverse);
            *value += &self.modulus * digit;
        }
        self.modulus *= prime;
        self.primes += 1;
        if self.primes >= self.next_attempt {
            self.next_attempt = self.primes + 1 + self.primes / 10;
            self.candidate = self.rationals();
        }
    }

    /// Numerators and, as the last entry, one positive common denominator; `None` when the modulus is still too small.
    fn rationals(&self) -> Option<Vec<BigInt>> {
        let mut denominator = BigInt::one();
        for value in &self.values {
            let numerator = self.symmetric(value * &denominator);
            if !self.is_short(numerator.bits()) {
                denominator *= self.denominator_of(&numerator)?;
            }
        }
        let mut numerators: Vec<BigInt> = self.values.iter().map(|v| self.symmetric(v * &denominator)).collect();
        numerators.push(denominator);
        numerators.iter().all(|n| self.is_short(n.bits())).then_some(numerators)
    }

    fn is_short(&self, bits: u64) -> bool {
        bits + MARGIN < self.modulus.bits()
    }

    fn symmetric(&self, value: BigInt) -> BigInt {
        let rest = value.mod_floor(&self.modulus);
        if &rest + &rest > self.modulus { rest - &self.modulus } else { rest }
    }

    /// The denominator of the short fraction that is `value` modulo the modulus, by the extended Euclidean algorithm.
    fn denominator_of(&self, value: &BigInt) -> Option<BigInt> {
        let bound = self.modulus.sqrt();
        let (mut left, mut right) = (self.modulus.clone(), value.mod_floor(&self.modulus));
        let (mut left_factor, mut right_factor) = (BigInt::zero(), BigInt::one());
        while right > bound {
            let (quotient, rest) = left.div_rem(&right);
            let factor = left_factor - &quotient * &right_factor;
            (left, right) = (right, rest);
            (left_factor, right_factor) = (right_factor, factor);
        }
        self.is_short(right.bits() + right_factor.bits()).then(|| right_factor.abs())
    }
}

/// The residue of `n` modulo a prime, in `0..prime`.
pub(super) fn residue(n: &BigInt, prime: u32) -> u32 {
    n.mod_floor(&BigInt::from(prime)).to_u32().unwrap_or(0)
}

/// Whether fractions over a common denominator, the last entry, have these residues.
fn agrees(values: &[BigInt], residues: &[u32], prime: u32) -> bool {
    let field = Residues::new(prime);
    let Some((denominator, numerators)) = values.split_last() else { return false };
    let denominator = residue(denominator, prime);
    let same = |(n, &r): (&BigInt, &u32)| residue(n, prime) == field.mul(r, denominator);
    denominator != 0 && numerators.iter().zip(residues).all(same)
}
