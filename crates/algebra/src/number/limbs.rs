//! Natural numbers as little-endian vectors of 64-bit limbs of a fixed length, for inner loops in which `BigInt` is too
//! slow.

use num_bigint::Sign;

use super::BigInt;

/// `accumulator += factor * number`. The accumulator is long enough for the sum.
pub(super) fn add_product(accumulator: &mut [u64], number: &[u64], factor: u64) {
    let mut carry = 0u128;
    let (low, high) = accumulator.split_at_mut(number.len());
    for (limb, &digit) in low.iter_mut().zip(number) {
        let sum = u128::from(digit) * u128::from(factor) + u128::from(*limb) + carry;
        *limb = sum as u64;
        carry = sum >> 64;
    }
    let mut carry = carry as u64;
    for limb in high {
        if carry == 0 {
            break;
        }
        let (sum, overflow) = limb.overflowing_add(carry);
        (*limb, carry) = (sum, u64::from(overflow));
    }
}

/// `accumulator -= factor * number` in two's complement.
pub(super) fn sub_product(accumulator: &mut [u64], number: &[u64], factor: u64) {
    let mut borrow = 0u64;
    let (low, high) = accumulator.split_at_mut(number.len());
    for (limb, &digit) in low.iter_mut().zip(number) {
        let product = u128::from(digit) * u128::from(factor) + u128::from(borrow);
        let (difference, under) = limb.overflowing_sub(product as u64);
        *limb = difference;
        borrow = (product >> 64) as u64 + u64::from(under);
    }
    for limb in high {
        let (difference, under) = limb.overflowing_sub(borrow);
        (*limb, borrow) = (difference, u64::from(under));
    }
}

/// The value of a two's-complement vector.
pub(super) fn signed(limbs: &[u64]) -> BigInt {
    let negative = limbs.last().is_some_and(|&limb| limb >> 63 == 1);
    if !negative {
        return BigInt::from_slice(Sign::Plus, &halves(limbs.iter().copied()));
    }
    let mut carry = true;
    let negated = limbs.iter().map(|&limb| {
        let (limb, overflow) = (!limb).overflowing_add(u64::from(carry));
        carry = overflow;
        limb
    });
    BigInt::from_slice(Sign::Minus, &halves(negated))
}

fn halves(limbs: impl Iterator<Item = u64>) -> Vec<u32> {
    limbs.flat_map(|limb| [limb as u32, (limb >> 32) as u32]).collect()
}

/// `n` modulo `p`, in `0..p`.
///
/// # Panics
/// When `p` is zero.
pub fn residue(n: &BigInt, p: u32) -> u32 {
    let modulus = u64::from(p);
    let step = |rest: u64, limb: u64| {
        let high = ((rest << 32) | (limb >> 32)) % modulus;
        ((high << 32) | (limb & 0xffff_ffff)) % modulus
    };
    let rest = n.magnitude().iter_u64_digits().rev().fold(0, step) as u32;
    if n.sign() == Sign::Minus && rest != 0 { p - rest } else { rest }
}

/// `a x + b y` without leading zeros. The result is not negative.
pub(super) fn combine(x: &[u64], y: &[u64], a: i64, b: i64) -> Vec<u64> {
    let length = x.len().max(y.len()) + 1;
    let digit = |n: &[u64], k: usize| i128::from(n.get(k).copied().unwrap_or(0));
    let mut carry = 0i128;
    let mut sum: Vec<u64> = Vec::with_capacity(length);
    for k in 0..length {
        let value = digit(x, k) * i128::from(a) + digit(y, k) * i128::from(b) + carry;
        sum.push(value as u64);
        carry = value >> 64;
    }
    debug_assert_eq!(carry, 0, "the combination is not negative");
    trim(&mut sum);
    sum
}

fn trim(limbs: &mut Vec<u64>) {
    while limbs.last() == Some(&0) {
        limbs.pop();
    }
}

/// The number of bits of a number without leading zeros.
pub(super) fn bits(limbs: &[u64]) -> u64 {
    limbs.last().map_or(0, |limb| limbs.len() as u64 * 64 - u64::from(limb.leading_zeros()))
}

/// The leading 62 bits of `x`, and the bits of `y` in the same positions. `y` is at most `x`.
pub(super) fn top_words(x: &[u64], y: &[u64]) -> (i64, i64) {
    let shift = bits(x).saturating_sub(62);
    let (skip, places) = ((shift / 64) as usize, shift % 64);
    let word = |n: &[u64]| {
        let digit = |k: usize| u128::from(n.get(skip + k).copied().unwrap_or(0));
        ((digit(0) | (digit(1) << 64)) >> places) as i64
    };
    (word(x), word(y))
}

/// The value of `limbs`.
pub(super) fn unsigned(limbs: &[u64]) -> BigInt {
    BigInt::from_slice(Sign::Plus, &halves(limbs.iter().copied()))
}
