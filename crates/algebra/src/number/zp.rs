//! Prime fields GF(p) with a word-size p.

use num_bigint::Sign;

use super::{BigInt, Field, PrimeElement, Ring, Style};
use crate::{Error, ErrorKind, Result};

/// The field of integers modulo a prime `p < 2^61`. Elements are in `0..p`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Zp {
    p: u64,
}

impl Zp {
    /// Exclusive upper bound of the modulus.
    pub const LIMIT: u64 = 1 << 61;

    /// Builds GF(p).
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `p` is not a prime below [`Zp::LIMIT`].
    pub fn new(p: u64) -> Result<Self> {
        if p < Self::LIMIT && is_prime(p) {
            return Ok(Zp { p });
        }
        Err(Error::new(ErrorKind::BadValue, format!("{p} is not a prime below 2^61; give one, such as 2147483647")))
    }

    /// Builds GF(p) for a number `p` below [`Zp::LIMIT`] that is known to be prime.
    pub(crate) fn known_prime(p: u64) -> Self {
        debug_assert!(p < Self::LIMIT && is_prime(p));
        Zp { p }
    }

    /// The modulus.
    pub fn modulus(&self) -> u64 {
        self.p
    }
}

fn mul_mod(a: u64, b: u64, p: u64) -> u64 {
    match a.checked_mul(b) {
        Some(product) => product % p,
        None => (u128::from(a) * u128::from(b) % u128::from(p)) as u64,
    }
}

fn pow_mod(mut a: u64, mut n: u64, p: u64) -> u64 {
    let mut result = 1 % p;
    a %= p;
    while n > 0 {
        if n & 1 == 1 {
            result = mul_mod(result, a, p);
        }
        a = mul_mod(a, a, p);
        n >>= 1;
    }
    result
}

/// Miller-Rabin primality test. The bases 2, 7 and 61 are exact below 4,759,123,141 (Jaeschke 1993), the first twelve
/// primes below 3.3e24 (Sorenson and Webster 2015).
pub(super) fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    const FEW: [u64; 3] = [2, 7, 61];
    if n < 2 {
        return false;
    }
    if let Some(base) = BASES.iter().find(|&&base| n.is_multiple_of(base)) {
        return n == *base;
    }
    if n < 41 * 41 {
        return true;
    }
    let (twos, bases) = ((n - 1).trailing_zeros(), if n >> 32 == 0 { &FEW[..] } else { &BASES[..] });
    let odd = (n - 1) >> twos;
    bases.iter().all(|&base| {
        let mut x = pow_mod(base, odd, n);
        if x == 1 || x == n - 1 {
            return true;
        }
        (1..twos).any(|_| {
            x = mul_mod(x, x, n);
            x == n - 1
        })
    })
}

impl Ring for Zp {
    type Element = u64;

    fn zero(&self) -> u64 {
        0
    }
    fn one(&self) -> u64 {
        1
    }
    fn from_integer(&self, n: &BigInt) -> u64 {
        let digits = (n.magnitude() % self.p).to_u64_digits();
        let magnitude = digits.first().copied().unwrap_or(0);
        if n.sign() == Sign::Minus { self.neg(&magnitude) } else { magnitude }
    }
    fn add(&self, a: &u64, b: &u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }
    fn neg(&self, a: &u64) -> u64 {
        if *a == 0 { 0 } else { self.p - a }
    }
    fn mul(&self, a: &u64, b: &u64) -> u64 {
        mul_mod(*a, *b, self.p)
    }
    fn is_zero(&self, a: &u64) -> bool {
        *a == 0
    }
    fn is_one(&self, a: &u64) -> bool {
        *a == 1
    }
    fn checked_div(&self, a: &u64, b: &u64) -> Option<u64> {
        (*b != 0).then(|| mul_mod(*a, pow_mod(*b, self.p - 2, self.p), self.p))
    }
    fn format(&self, a: &u64, _style: Style) -> String {
        a.to_string()
    }
}

impl Field for Zp {
    fn characteristic(&self) -> u64 {
        self.p
    }
    fn prime_element<'a>(&self, a: &'a u64) -> Option<PrimeElement<'a>> {
        Some(PrimeElement::Residue(*a))
    }
}
