//! A vector of fractions over one denominator, each in lowest terms.
//!
//! One gcd per vector finds the part of the denominator that has common factors with numerators. Usually it is a
//! product of small primes. It is stored as coprime words, so that the remaining arithmetic uses words.

use num_integer::Integer;
use num_traits::{One, Zero};

use super::vectors::Vector;
use crate::number::{BigInt, BigRational, primes_below};

/// Upper bound of the primes that are searched in denominators.
const SMALL: u64 = 1 << 10;

impl Vector {
    /// The entries in lowest terms.
    pub(super) fn entries(&self) -> Vec<BigRational> {
        let common = Common::new(self.common_part());
        let entry = |n: &BigInt| {
            let divisor = if n.is_zero() { self.denominator.clone() } else { common.divisor(n) };
            if divisor.is_one() {
                return BigRational::new_raw(n.clone(), self.denominator.clone());
            }
            BigRational::new_raw(n / &divisor, &self.denominator / &divisor)
        };
        self.numerators.iter().map(entry).collect()
    }

    /// The part of the denominator whose primes divide some numerator too.
    fn common_part(&self) -> BigInt {
        let nonzero = self.numerators.iter().filter(|n| !n.is_zero());
        let product = nonzero.fold(BigInt::one(), |product, n| product * n % &self.denominator);
        let mut part = product.gcd(&self.denominator);
        loop {
            let next = (&part * &part).gcd(&self.denominator);
            if next == part {
                return part;
            }
            part = next;
        }
    }
}

/// A number as a product of words and a cofactor, pairwise coprime.
struct Common {
    words: Vec<u64>,
    rest: BigInt,
}

impl Common {
    fn new(mut number: BigInt) -> Self {
        let (mut words, mut rest, mut word) = (Vec::new(), BigInt::one(), 1u64);
        for q in primes_below(SMALL) {
            if number.is_one() {
                break;
            }
            let power = take_power(&mut number, q);
            match u64::try_from(&power).map(|power| (power, word.checked_mul(power))) {
                Ok((_, Some(product))) => word = product,
                Ok((power, None)) => words.push(std::mem::replace(&mut word, power)),
                Err(_) => rest *= power,
            }
        }
        words.extend(Some(word).filter(|&word| word > 1));
        Common { words, rest: rest * number }
    }

    /// The greatest common divisor with `n`.
    fn divisor(&self, n: &BigInt) -> BigInt {
        let step = |rest: u64, digit: u64, word: u64| {
            (((u128::from(rest) << 64) | u128::from(digit)) % u128::from(word)) as u64
        };
        let residue = |word: u64| n.iter_u64_digits().rev().fold(0, |rest, digit| step(rest, digit, word));
        let words: BigInt = self.words.iter().map(|&word| word.gcd(&residue(word))).product();
        if self.rest.is_one() { words } else { words * self.rest.gcd(&(n % &self.rest)) }
    }
}

/// Divides `number` by the greatest power of `q` that divides it. Returns this power.
fn take_power(number: &mut BigInt, q: u64) -> BigInt {
    let mut power = BigInt::one();
    loop {
        let (quotient, rest) = number.div_rem(&BigInt::from(q));
        if !rest.is_zero() {
            return power;
        }
        (*number, power) = (quotient, power * q);
    }
}
