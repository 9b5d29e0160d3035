//! Cheap logarithms modulo a prime below 2^31.

use crate::number::word::inverse_modulo;

pub(super) use crate::number::word::Prime;

/// A prime whose multiplicative group has an order with small prime factors only, so that logarithms are cheap.
#[derive(Clone, Copy, Debug)]
pub(super) struct SmoothPrime {
    pub field: Prime,
    /// A generator of the multiplicative group.
    pub generator: u64,
    /// The prime powers of `p - 1`, as (prime, exponent).
    factors: &'static [(u64, u32)],
}

impl SmoothPrime {
    /// 2013265921 = 15 * 2^27 + 1 with generator 31, and 2113929217 = 63 * 2^25 + 1 with generator 5.
    pub fn all() -> [SmoothPrime; 2] {
        const FIRST: &[(u64, u32)] = &[(2, 27), (3, 1), (5, 1)];
        const SECOND: &[(u64, u32)] = &[(2, 25), (3, 2), (7, 1)];
        [(2_013_265_921, 31, FIRST), (2_113_929_217, 5, SECOND)].map(|(p, generator, factors)| SmoothPrime {
            field: Prime::new(p),
            generator,
            factors,
        })
    }

    /// The exponent `n < p - 1` with `generator^n = a`, for nonzero `a` (Pohlig and Hellman 1978).
    pub fn logarithm(&self, a: u64) -> u64 {
        let order = self.field.p - 1;
        let (mut result, mut modulus) = (0u64, 1u64);
        for &(prime, exponent) in self.factors {
            let power = prime.pow(exponent);
            let part = (self.field.p - 1) / power;
            let bases = (self.field.pow(a, part), self.field.pow(self.generator, part));
            let residue = self.logarithm_in_group(bases, prime, exponent);
            let steps = (residue + power - result % power) % power;
            let inverse = inverse_modulo(modulus % power, power);
            result += modulus * (steps * inverse % power);
            modulus *= power;
        }
        debug_assert_eq!(modulus, order);
        result
    }

    /// The logarithm of `a` to the base `g` of order `prime^exponent`, by recursive halving of the exponent.
    fn logarithm_in_group(&self, (a, g): (u64, u64), prime: u64, exponent: u32) -> u64 {
        let field = self.field;
        if exponent == 1 {
            let powers = std::iter::successors(Some(1), |&power| Some(field.mul(power, g)));
            return powers.take(prime as usize).position(|power| power == a).unwrap_or(0) as u64;
        }
        let low_size = exponent / 2;
        let (low_power, high_power) = (prime.pow(exponent - low_size), prime.pow(low_size));
        let low = self.logarithm_in_group((field.pow(a, low_power), field.pow(g, low_power)), prime, low_size);
        let order = low_power * high_power;
        let rest = field.mul(a, field.pow(g, order - low));
        let high = self.logarithm_in_group((rest, field.pow(g, high_power)), prime, exponent - low_size);
        low + high * high_power
    }
}
