//! From residues modulo many primes to rational numbers with one common denominator.
//!
//! Chinese remaindering and rational reconstruction: von zur Gathen and Gerhard, Modern Computer Algebra (2013), section 5.10.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::residues::Residues;

/// A reconstruction must be this many bits shorter than the modulus to be believed; the proof comes later.
const MARGIN: u64 = 40;

/// Integers modulo a growing product of primes.
#[derive(Clone, Debug)]
pub(super) struct Lift {
    modulus: BigInt,
    values: Vec<BigInt>,
    primes: usize,
    next_attempt: usize,
}

impl Lift {
    pub(super) fn new(length: usize) -> Self {
        Lift { modulus: BigInt::one(), values: vec![BigInt::zero(); length], primes: 0, next_attempt: 1 }
    }

    /// The number of primes so far.
    pub(super) fn primes(&self) -> usize {
        self.primes
    }

    /// Takes in the residues modulo a new prime.
    pub(super) fn add(&mut self, field: &Residues, residues: &[u32]) {
        let prime = field.prime();
        let inverse = field.inverse(residue(&self.modulus, prime));
        for (value, &wanted) in self.values.iter_mut().zip(residues) {
            let digit = field.mul(field.sub(wanted, residue(value, prime)), inverse);
            *value += &self.modulus * digit;
        }
        self.modulus *= prime;
        self.primes += 1;
    }

    /// Whether the next [`Lift::rationals`] may pay; attempts become rarer as the numbers grow.
    pub(super) fn is_due(&mut self) -> bool {
        let due = self.primes >= self.next_attempt;
        if due {
            self.next_attempt = self.primes + 1 + self.primes / 10;
        }
        due
    }

    /// Numerators over one positive common denominator, the last entry; `None` when the modulus is too small yet.
    pub(super) fn rationals(&self) -> Option<Vec<BigInt>> {
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

/// `n` modulo a prime, from 0.
pub(super) fn residue(n: &BigInt, prime: u32) -> u32 {
    n.mod_floor(&BigInt::from(prime)).to_u32().unwrap_or(0)
}
