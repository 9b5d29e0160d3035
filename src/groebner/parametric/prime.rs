//! Arithmetic modulo a prime below 2^31 on machine words.

/// The integers modulo `p`; elements are `0..p`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Prime {
    pub p: u64,
    /// `floor(2^64 / p)`, for Barrett's reduction (CRYPTO 1986).
    reciprocal: u64,
}

impl Prime {
    /// The field modulo `p`, an odd prime below 2^31.
    pub fn new(p: u32) -> Self {
        debug_assert!(p % 2 == 1 && p < 1 << 31);
        Prime { p: u64::from(p), reciprocal: u64::MAX / u64::from(p) }
    }

    /// `x` modulo `p`, for any `x`.
    #[inline]
    pub fn reduce(self, x: u64) -> u64 {
        let quotient = ((u128::from(x) * u128::from(self.reciprocal)) >> 64) as u64;
        let rest = x - quotient * self.p;
        if rest >= self.p { rest - self.p } else { rest }
    }

    #[inline]
    pub fn mul(self, a: u64, b: u64) -> u64 {
        self.reduce(a * b)
    }

    #[inline]
    pub fn add(self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    #[inline]
    pub fn sub(self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    #[inline]
    pub fn neg(self, a: u64) -> u64 {
        self.sub(0, a)
    }

    pub fn pow(self, mut a: u64, mut n: u64) -> u64 {
        let mut result = 1;
        while n > 0 {
            if n & 1 == 1 {
                result = self.mul(result, a);
            }
            a = self.mul(a, a);
            n >>= 1;
        }
        result
    }

    /// `a` to an exponent that may be negative; `a` is not zero.
    pub fn signed_pow(self, a: u64, n: i64) -> u64 {
        let power = self.pow(a, n.unsigned_abs());
        if n < 0 { self.inverse(power) } else { power }
    }

    /// `1 / a`; 0 for 0.
    pub fn inverse(self, a: u64) -> u64 {
        if a == 0 { 0 } else { inverse_modulo(a, self.p) }
    }

    /// The inverses of all of `values` with one inversion (Montgomery 1987); `None` when one is zero.
    pub fn inverses(self, values: &[u64]) -> Option<Vec<u64>> {
        let mut products = Vec::with_capacity(values.len());
        let mut product = 1;
        for &value in values {
            products.push(product);
            product = self.mul(product, value);
        }
        if product == 0 {
            return None;
        }
        let mut inverse = self.inverse(product);
        for (slot, &value) in products.iter_mut().zip(values).rev() {
            *slot = self.mul(*slot, inverse);
            inverse = self.mul(inverse, value);
        }
        Some(products)
    }

    /// `sum of a[i] b[i]`.
    pub fn dot<'a>(self, a: impl Iterator<Item = &'a u64>, b: impl Iterator<Item = &'a u64>) -> u64 {
        let limit = 1u64 << 63;
        let sum = a.zip(b).fold(0u64, |sum, (x, y)| {
            let sum = if sum >= limit { self.reduce(sum) } else { sum };
            sum + x * y
        });
        self.reduce(sum)
    }

    /// `a[i] -= factor * b[i]`.
    pub fn sub_multiple(self, a: &mut [u64], factor: u64, b: &[u64]) {
        let negated = self.neg(factor);
        for (x, &y) in a.iter_mut().zip(b) {
            *x = self.reduce(*x + negated * y);
        }
    }

    /// The value of a polynomial, constant term first.
    pub fn horner(self, coefficients: &[u64], x: u64) -> u64 {
        coefficients.iter().rev().fold(0, |value, &c| self.reduce(value * x + c))
    }
}

/// A deterministic stream of numbers that look random (Steele, Lea and Flood, SplitMix64, OOPSLA 2014).
#[derive(Clone, Debug)]
pub(super) struct Stream(pub u64);

impl Stream {
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// An element of `1..p`.
    pub fn unit(&mut self, field: Prime) -> u64 {
        1 + self.word() % (field.p - 1)
    }
}

/// A prime whose multiplicative group has only small prime factors: logarithms are cheap there.
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

    /// The logarithm of `a` to the base `g` of order `prime^exponent`, by halves.
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

/// The inverse of `a` modulo `n`, coprime to it, by Euclid's algorithm.
fn inverse_modulo(a: u64, n: u64) -> u64 {
    let (mut r0, mut r1, mut s0, mut s1) = (n as i64, a as i64, 0i64, 1i64);
    while r1 > 0 {
        let quotient = r0 / r1;
        (r0, r1) = (r1, r0 - quotient * r1);
        (s0, s1) = (s1, s0 - quotient * s1);
    }
    s0.rem_euclid(n as i64) as u64
}
