//! Rational reconstruction: a rational number from its residue modulo a large integer.
//!
//! The Euclidean algorithm on the modulus and the residue produces the fraction (Wang, Guy and Davenport 1982). The
//! large quotient after it identifies it (Monagan 2004), so numerator and denominator need not have similar sizes.
//! Quotients are computed from one word of leading digits at a time (Lehmer; Knuth, TAOCP 2, 4.5.2, algorithm L).

use num_bigint::Sign;
use num_integer::Integer;

use super::limbs::{bits, combine, top_words};
use super::{BigInt, BigRational};

/// Reconstructs a fraction `n / d` in lowest terms with `n = d * residue` modulo `modulus` and `|n| d 2^surplus <
/// modulus`. Among the fractions that are smaller by another factor 4, it is the one with the largest numerator.
/// Returns `None` when there is no such fraction. A random residue has one with a probability of about `2^-surplus` for
/// each bit of the modulus.
///
/// ```
/// use groebot_algebra::number::{BigInt, BigRational, reconstruct};
/// let modulus = BigInt::from(2_147_483_647u64);
/// let third = reconstruct(&BigInt::from(1_431_655_765u64), &modulus, 20).unwrap();
/// assert_eq!(third, BigRational::new(BigInt::from(1), BigInt::from(3)));
/// ```
///
/// # Panics
/// When `modulus` is not positive.
pub fn reconstruct(residue: &BigInt, modulus: &BigInt, surplus: u32) -> Option<BigRational> {
    assert_eq!(modulus.sign(), Sign::Plus, "a modulus is positive");
    let mut euclid = Euclid::new(&residue.mod_floor(modulus), modulus);
    let limit = modulus.bits();
    loop {
        if bits(&euclid.rests[1]) + bits(&euclid.cofactors[1]) + u64::from(surplus) < limit {
            return euclid.fraction();
        }
        if euclid.rests[1].is_empty() {
            return None;
        }
        let matrix = Matrix::of_leading_digits(&euclid.rests, 1 << surplus.min(31));
        if matrix.steps > 0 { euclid.apply(&matrix) } else { euclid.divide() }
    }
}

/// Two consecutive remainders, and the magnitudes of their cofactors: each remainder is its cofactor times the residue,
/// modulo the modulus.
struct Euclid {
    rests: [Vec<u64>; 2],
    cofactors: [Vec<u64>; 2],
    /// Whether the cofactor of the second remainder is negative; the signs alternate.
    negative: bool,
}

impl Euclid {
    fn new(residue: &BigInt, modulus: &BigInt) -> Self {
        let limbs = |n: &BigInt| n.iter_u64_digits().collect();
        Euclid { rests: [limbs(modulus), limbs(residue)], cofactors: [Vec::new(), vec![1]], negative: false }
    }

    /// Applies several steps at once.
    fn apply(&mut self, matrix: &Matrix) {
        let [[a, b], [c, d]] = matrix.entries;
        let [x, y] = &self.rests;
        self.rests = [combine(x, y, a, b), combine(x, y, c, d)];
        let [s, t] = &self.cofactors;
        self.cofactors = [combine(s, t, a.abs(), b.abs()), combine(s, t, c.abs(), d.abs())];
        self.negative ^= matrix.steps % 2 == 1;
    }

    /// One division step with a quotient of any size.
    fn divide(&mut self) {
        let integer = |limbs: &[u64]| super::limbs::unsigned(limbs);
        let [x, y] = [0, 1].map(|k| integer(&self.rests[k]));
        let [s, t] = [0, 1].map(|k| integer(&self.cofactors[k]));
        let (quotient, rest) = x.div_rem(&y);
        let limbs = |n: BigInt| n.iter_u64_digits().collect();
        self.rests = [std::mem::take(&mut self.rests[1]), limbs(rest)];
        self.cofactors = [std::mem::take(&mut self.cofactors[1]), limbs(s + quotient * t)];
        self.negative = !self.negative;
    }

    /// The second remainder divided by its cofactor, when they have no common divisor.
    fn fraction(&self) -> Option<BigRational> {
        let [numerator, denominator] = [&self.rests[1], &self.cofactors[1]].map(|limbs| super::limbs::unsigned(limbs));
        let coprime = numerator.gcd(&denominator) == BigInt::from(1);
        let numerator = if self.negative { -numerator } else { numerator };
        coprime.then(|| BigRational::new_raw(numerator, denominator))
    }
}

/// Several steps of the Euclidean algorithm as one matrix: the new remainders are `entries` times the old ones.
struct Matrix {
    entries: [[i64; 2]; 2],
    steps: u32,
}

impl Matrix {
    /// The steps that the leading 62 bits determine, with quotients below `limit` and entries below 2^31.
    fn of_leading_digits(rests: &[Vec<u64>; 2], limit: i64) -> Matrix {
        const WORD: i64 = 1 << 31;
        let (mut x, mut y) = top_words(&rests[0], &rests[1]);
        let mut matrix = Matrix { entries: [[1, 0], [0, 1]], steps: 0 };
        loop {
            let [[a, b], [c, d]] = matrix.entries;
            if y + c == 0 || y + d == 0 {
                return matrix;
            }
            let quotient = (x + a) / (y + c);
            if quotient != (x + b) / (y + d) || quotient >= limit {
                return matrix;
            }
            let (next_c, next_d) = (a - quotient * c, b - quotient * d);
            if next_c.abs() >= WORD || next_d.abs() >= WORD {
                return matrix;
            }
            matrix.entries = [[c, d], [next_c, next_d]];
            matrix.steps += 1;
            (x, y) = (y, x - quotient * y);
        }
    }
}
