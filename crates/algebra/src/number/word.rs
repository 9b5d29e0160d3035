//! Modular arithmetic on machine words, shared by all engines modulo primes. Vector kernels are elsewhere.

/// The integers modulo `p`. Elements are in `0..p`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Prime {
    pub p: u64,
    /// `floor(2^64 / p)`, for Barrett reduction (CRYPTO 1986).
    reciprocal: u64,
}

impl Prime {
    /// Builds the field of integers modulo `p`, a prime below 2^31.
    pub fn new(p: u32) -> Self {
        debug_assert!((2..1 << 31).contains(&p));
        Prime { p: u64::from(p), reciprocal: u64::MAX / u64::from(p) }
    }

    /// `x` modulo `p`, for any `x`.
    #[inline]
    pub fn reduce(self, x: u64) -> u64 {
        let quotient = ((u128::from(x) * u128::from(self.reciprocal)) >> 64) as u64;
        let rest = x - quotient * self.p;
        if rest >= self.p { rest - self.p } else { rest }
    }

    /// `a b`.
    #[inline]
    pub fn mul(self, a: u64, b: u64) -> u64 {
        self.reduce(a * b)
    }

    /// `a + b`.
    #[inline]
    pub fn add(self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    /// `a - b`.
    #[inline]
    pub fn sub(self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    /// `-a`.
    #[inline]
    pub fn neg(self, a: u64) -> u64 {
        self.sub(0, a)
    }

    /// `a^n`.
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

    /// The inverses of all `values` with one inversion (Montgomery 1987); `None` when one is zero.
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

    /// Evaluates a polynomial, constant term first.
    pub fn horner(self, coefficients: &[u64], x: u64) -> u64 {
        coefficients.iter().rev().fold(0, |value, &c| self.reduce(value * x + c))
    }
}

/// The inverse of `a` modulo `n < 2^63` by Euclid's algorithm. `a` is coprime to `n`.
pub(crate) fn inverse_modulo(a: u64, n: u64) -> u64 {
    let (mut r0, mut r1, mut s0, mut s1) = (n as i64, a as i64, 0i64, 1i64);
    while r1 > 0 {
        let quotient = r0 / r1;
        (r0, r1) = (r1, r0 - quotient * r1);
        (s0, s1) = (s1, s0 - quotient * s1);
    }
    s0.rem_euclid(n as i64) as u64
}
