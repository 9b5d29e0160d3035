//! Sparse polynomials with integer coefficients on the keys of a [`Packing`](super::Packing). Images modulo primes are
//! computed from them and combined to them.

use num_integer::Integer;
use num_traits::{Signed, ToPrimitive, Zero};

use super::field::Prime;
use super::flat::Flat;
use crate::number::BigInt;

/// A polynomial over the integers: keys in descending order, and a parallel vector of nonzero values.
#[derive(Clone, Debug, PartialEq)]
pub struct Integral {
    pub keys: Vec<u128>,
    pub values: Vec<BigInt>,
}

/// `n` modulo the prime of `field`.
pub fn residue(n: &BigInt, field: &Prime) -> u64 {
    match n.to_i64() {
        Some(small) => i128::from(small).rem_euclid(i128::from(field.modulus())) as u64,
        None => n.mod_floor(&BigInt::from(field.modulus())).to_u64().expect("a residue fits a word"),
    }
}

impl Integral {
    /// The image modulo a prime.
    pub fn image(&self, field: &Prime) -> Flat {
        let images = self.keys.iter().zip(&self.values).map(|(&key, value)| (key, residue(value, field)));
        let (keys, values) = images.filter(|term| term.1 != 0).unzip();
        Flat { keys, values }
    }

    /// Divides by the gcd of the coefficients, with a sign that makes the leading one positive. Also returns the factor
    /// that was removed.
    pub fn primitive(mut self) -> (Self, BigInt) {
        let mut content = self.values.iter().fold(BigInt::zero(), |content, value| content.gcd(value));
        if self.values.first().is_some_and(Signed::is_negative) {
            content = -content;
        }
        if content != BigInt::from(1) && !content.is_zero() {
            self.values.iter_mut().for_each(|value| *value = &*value / &content);
        }
        (self, content)
    }

    /// The greatest number of bits of a coefficient.
    pub fn bits(&self) -> u64 {
        self.values.iter().map(BigInt::bits).max().unwrap_or(0)
    }

    /// Whether this is a constant, zero included.
    pub fn is_constant(&self) -> bool {
        self.keys.first().is_none_or(|&key| key == 0)
    }
}
