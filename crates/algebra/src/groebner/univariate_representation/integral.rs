//! Univariate polynomials over the integers: coefficients, constant term first, without trailing zeros.

use num_bigint::{BigInt, BigUint, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::{Result, Watch};

/// `a` without trailing zeros.
pub(super) fn trim(mut a: Vec<BigInt>) -> Vec<BigInt> {
    while a.last().is_some_and(Zero::is_zero) {
        a.pop();
    }
    a
}

pub(super) fn derivative(a: &[BigInt]) -> Vec<BigInt> {
    a.iter().enumerate().skip(1).map(|(i, c)| c * BigInt::from(i)).collect()
}

/// `target += factor a`. The result may have trailing zeros.
pub(super) fn add_scaled(target: &mut Vec<BigInt>, factor: &BigInt, a: &[BigInt]) {
    if target.len() < a.len() {
        target.resize(a.len(), BigInt::zero());
    }
    for (sum, c) in target.iter_mut().zip(a) {
        *sum += factor * c;
    }
}

/// `a` divided by the positive gcd of its coefficients.
pub(super) fn primitive(a: &[BigInt]) -> Vec<BigInt> {
    let content = a.iter().fold(BigInt::zero(), |gcd, c| gcd.gcd(c));
    if content.is_zero() || content.is_one() { a.to_vec() } else { a.iter().map(|c| c / &content).collect() }
}

/// The sum of the absolute values of the coefficients.
pub(super) fn norm(a: &[BigInt]) -> BigInt {
    a.iter().map(Signed::abs).sum()
}

/// The product by Kronecker substitution: one multiplication of long integers.
pub(super) fn product(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let widest = |p: &[BigInt]| p.iter().map(BigInt::bits).max().unwrap_or(0);
    let bits = widest(a) + widest(b) + u64::from(a.len().min(b.len()).ilog2()) + 3;
    let words = bits.div_ceil(32) as usize;
    trim(unpack(&(pack(a, words) * pack(b, words)), words, a.len() + b.len() - 1))
}

/// The value at `2^(32 words)`.
fn pack(a: &[BigInt], words: usize) -> BigInt {
    let part = |sign: Sign| {
        let mut digits = vec![0u32; words * a.len()];
        for (slot, c) in digits.chunks_mut(words).zip(a).filter(|(_, c)| c.sign() == sign) {
            for (digit, value) in slot.iter_mut().zip(c.iter_u32_digits()) {
                *digit = value;
            }
        }
        BigInt::from(BigUint::new(digits))
    };
    part(Sign::Plus) - part(Sign::Minus)
}

/// The polynomial of `length` coefficients below `2^(32 words - 1)` in magnitude with this value at `2^(32 words)`.
fn unpack(value: &BigInt, words: usize, length: usize) -> Vec<BigInt> {
    let mut digits: Vec<u32> = value.iter_u32_digits().collect();
    digits.resize(words * length, 0);
    let whole = BigInt::one() << (32 * words);
    let mut carry = false;
    let coefficients = digits.chunks(words).map(|slot| {
        let mut c = BigInt::from(BigUint::from_slice(slot)) + u32::from(carry);
        carry = c.bits() >= 32 * words as u64;
        if carry {
            c -= &whole;
        }
        if value.is_negative() { -c } else { c }
    });
    coefficients.collect()
}

/// Whether the primitive polynomial `b` divides `a`: by Gauss's lemma the quotient is integral.
///
/// # Errors
/// The error with which `watch` stops the work.
pub(super) fn divides(b: &[BigInt], a: &[BigInt], watch: &Watch) -> Result<bool> {
    let (low, lead) = (&b[..b.len() - 1], &b[b.len() - 1]);
    let mut rest = a.to_vec();
    while rest.len() > low.len() {
        watch.check()?;
        let Some(top) = rest.pop() else { break };
        let (factor, remainder) = top.div_rem(lead);
        if !remainder.is_zero() {
            return Ok(false);
        }
        let shift = rest.len() - low.len();
        for (target, c) in rest[shift..].iter_mut().zip(low) {
            *target -= &factor * c;
        }
    }
    Ok(rest.iter().all(Zero::is_zero))
}
