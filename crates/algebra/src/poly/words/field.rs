//! Finite fields whose elements are the machine words `0..q`.

use crate::number::word::inverse_modulo;

/// A finite field of `q` elements, as a value. Its elements are the words `0..q`; 0 and 1 are zero and one.
pub trait WordField: Clone {
    /// The number of elements.
    fn size(&self) -> u64;
    /// The characteristic.
    fn characteristic(&self) -> u64;
    /// `a + b`.
    fn add(&self, a: u64, b: u64) -> u64;
    /// `-a`.
    fn neg(&self, a: u64) -> u64;
    /// `a b`.
    fn mul(&self, a: u64, b: u64) -> u64;
    /// `1 / a`; `None` for zero.
    fn inverse(&self, a: u64) -> Option<u64>;

    /// `a - b`.
    fn sub(&self, a: u64, b: u64) -> u64 {
        self.add(a, self.neg(b))
    }
}

/// The integers modulo a prime `p < 2^61`, with Barrett reduction.
#[derive(Clone, Copy, Debug)]
pub struct Prime {
    p: u64,
    reciprocal: u64,
    bits: u32,
}

impl Prime {
    /// The field of `p` elements; `p` is a prime below `2^61`.
    pub fn new(p: u64) -> Self {
        let bits = 64 - p.leading_zeros();
        Prime { p, reciprocal: ((1u128 << (2 * bits)) / u128::from(p)) as u64, bits }
    }

    /// The modulus.
    pub fn modulus(&self) -> u64 {
        self.p
    }
}

impl WordField for Prime {
    fn size(&self) -> u64 {
        self.p
    }
    fn characteristic(&self) -> u64 {
        self.p
    }
    fn add(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }
    fn neg(&self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.p - a }
    }
    fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }
    fn mul(&self, a: u64, b: u64) -> u64 {
        let product = u128::from(a) * u128::from(b);
        let high = (product >> (self.bits - 1)) as u64;
        let quotient = ((u128::from(high) * u128::from(self.reciprocal)) >> (self.bits + 1)) as u64;
        let mut rest = (product as u64).wrapping_sub(quotient.wrapping_mul(self.p));
        while rest >= self.p {
            rest -= self.p;
        }
        rest
    }
    fn inverse(&self, a: u64) -> Option<u64> {
        (a != 0).then(|| inverse_modulo(a, self.p))
    }
}

/// The inverses of nonzero `values` with one inversion (Montgomery's trick); `None` when one is zero.
pub fn inverses<K: WordField>(field: &K, values: &[u64]) -> Option<Vec<u64>> {
    let mut result = Vec::with_capacity(values.len());
    let mut product = 1;
    for &value in values {
        result.push(product);
        product = field.mul(product, value);
    }
    let mut rest = field.inverse(product)?;
    for (slot, &value) in result.iter_mut().zip(values).rev() {
        *slot = field.mul(*slot, rest);
        rest = field.mul(rest, value);
    }
    Some(result)
}
