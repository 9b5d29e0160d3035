//! Integers and rational numbers from images modulo several primes: Chinese remaindering and rational reconstruction
//! (Wang, Guy and Davenport 1982).

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::field::{Prime, WordField};
use super::flat::Flat;
use super::integral::{Integral, residue};
use crate::number::{BigInt, Zp};

/// The distances from `2^61` down to the first primes.
const DISTANCES: [u64; 8] = [1, 31, 45, 229, 259, 283, 339, 391];

/// The primes below `2^61`, greatest first.
pub fn primes() -> impl Iterator<Item = u64> {
    let known = DISTANCES.iter().map(|distance| Zp::LIMIT - distance);
    let below = Zp::LIMIT - DISTANCES[DISTANCES.len() - 1];
    known.chain((0..below).rev().filter(|&n| Zp::new(n).is_ok()))
}

/// The polynomial determined by the images so far, modulo the product of their primes.
#[derive(Debug, Default)]
pub struct Images {
    modulus: BigInt,
    keys: Vec<u128>,
    values: Vec<BigInt>,
}

impl Images {
    /// Adds the image modulo one more prime.
    pub fn add(&mut self, field: &Prime, image: Flat) {
        if self.modulus.is_zero() {
            self.modulus = BigInt::from(field.modulus());
            self.values = image.values.into_iter().map(BigInt::from).collect();
            self.keys = image.keys;
            return;
        }
        let inverse = field.inverse(residue(&self.modulus, field)).expect("the primes are distinct");
        let mut joined = Images { modulus: &self.modulus * field.modulus(), keys: Vec::new(), values: Vec::new() };
        let mut old = self.keys.iter().copied().zip(std::mem::take(&mut self.values)).peekable();
        let mut new = image.terms().peekable();
        while let Some(key) = old.peek().map(|term| term.0).max(new.peek().map(|term| term.0)) {
            let value = old.next_if(|term| term.0 == key).map_or_else(BigInt::zero, |term| term.1);
            let target = new.next_if(|term| term.0 == key).map_or(0, |term| term.1);
            let step = field.mul(field.sub(target, residue(&value, field)), inverse);
            joined.keys.push(key);
            joined.values.push(value + &self.modulus * step);
        }
        drop(old);
        *self = joined;
    }

    /// The bits of the modulus.
    pub fn bits(&self) -> u64 {
        self.modulus.bits()
    }

    /// The integer coefficients of least absolute value.
    pub fn symmetric(&self) -> Integral {
        let half = &self.modulus / 2;
        let lift = |value: &BigInt| if value > &half { value - &self.modulus } else { value.clone() };
        Integral { keys: self.keys.clone(), values: self.values.iter().map(lift).collect() }
    }

    /// The primitive integer polynomial proportional to the rational one with small numerators and denominators; `None`
    /// when there is none.
    pub fn rational(&self) -> Option<Integral> {
        let limit = BigInt::sqrt(&(&self.modulus / 2));
        let mut denominator = BigInt::one();
        for value in &self.values {
            let scaled = (value * &denominator).mod_floor(&self.modulus);
            let symmetric = if &scaled + &scaled > self.modulus { &scaled - &self.modulus } else { scaled };
            if symmetric.abs() > limit {
                denominator *= self.denominator(symmetric.mod_floor(&self.modulus), &limit)?;
                if denominator > limit {
                    return None;
                }
            }
        }
        let values = self.values.iter().map(|value| (value * &denominator).mod_floor(&self.modulus)).collect();
        let scaled = Images { modulus: self.modulus.clone(), keys: self.keys.clone(), values };
        Some(scaled.symmetric().primitive().0)
    }

    /// The least `d` for which `d value` is congruent to a number below `limit`, by Euclid's algorithm.
    fn denominator(&self, value: BigInt, limit: &BigInt) -> Option<BigInt> {
        if let (Some(m), Some(a), Some(limit)) = (self.modulus.to_i64(), value.to_i64(), limit.to_i64()) {
            return small_denominator(m, a, limit).map(BigInt::from);
        }
        let (mut r, mut s) = ((self.modulus.clone(), value), (BigInt::zero(), BigInt::one()));
        while &r.1 > limit {
            let (quotient, rest) = r.0.div_rem(&r.1);
            r = (r.1, rest);
            let next = &s.0 - quotient * &s.1;
            s = (s.1, next);
        }
        (s.1.abs() <= *limit).then(|| s.1.abs())
    }
}

/// Same as `denominator`, but on machine words.
fn small_denominator(m: i64, a: i64, limit: i64) -> Option<i64> {
    let (mut r, mut s) = ((m, a), (0, 1));
    while r.1 > limit {
        let quotient = r.0 / r.1;
        r = (r.1, r.0 - quotient * r.1);
        s = (s.1, s.0 - quotient * s.1);
    }
    (s.1.abs() <= limit).then_some(s.1.abs())
}
