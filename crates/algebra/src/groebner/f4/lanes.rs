//! Arithmetic modulo word-size primes on `N` lanes at once: `N` rows of one matrix, or one row modulo `N` primes.
//!
//! A sum is kept below the square of the modulus: a product is subtracted, and the square is added when the difference
//! is negative. Residues are computed by Barrett reduction (P. Barrett, CRYPTO 1986) with 32-bit factors, which vector
//! units support.

use crate::number::word::inverse_modulo;

/// Type of a row's coefficients: equal in all lanes, or one for each lane.
pub(super) trait Coefficient<const N: usize>: Copy {
    /// The coefficient in this lane.
    fn lane(&self, lane: usize) -> u32;
}

impl<const N: usize> Coefficient<N> for u32 {
    #[inline(always)]
    fn lane(&self, _lane: usize) -> u32 {
        *self
    }
}

impl<const N: usize> Coefficient<N> for [u32; N] {
    #[inline(always)]
    fn lane(&self, lane: usize) -> u32 {
        self[lane]
    }
}

/// The vector instruction set of this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instructions {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Instructions {
    /// Detects the best supported instruction set at run time.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                return Instructions::Avx512;
            }
            if is_x86_feature_detected!("avx2") {
                return Instructions::Avx2;
            }
        }
        Instructions::Portable
    }
}

/// The moduli of the lanes with their constants. Each modulus is below 2^31 and at least 2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moduli<const N: usize> {
    pub p: [u32; N],
    pub square: [u64; N],
    /// floor(2^(2k) / p) for a modulus of k bits.
    reciprocal: [u32; N],
    bits: [u32; N],
}

impl<const N: usize> Moduli<N> {
    pub fn new(p: [u32; N]) -> Self {
        let bits = p.map(|p| 32 - p.leading_zeros());
        Moduli {
            p,
            square: p.map(|p| u64::from(p) * u64::from(p)),
            reciprocal: std::array::from_fn(|l| ((1u64 << (2 * bits[l])) / u64::from(p[l])) as u32),
            bits,
        }
    }

    /// The residues of sums below the squares.
    #[inline(always)]
    pub fn residues(&self, sums: &[u64; N]) -> [u32; N] {
        std::array::from_fn(|l| self.residue(l, sums[l]))
    }

    /// The residue of `sum < p^2` in one lane.
    #[inline(always)]
    pub fn residue(&self, lane: usize, sum: u64) -> u32 {
        let p = u64::from(self.p[lane]);
        let high = (sum >> (self.bits[lane] - 1)) as u32;
        let estimate = ((u64::from(high) * u64::from(self.reciprocal[lane])) >> (self.bits[lane] + 1)) as u32;
        let rest = sum.wrapping_sub(u64::from(estimate) * p);
        let rest = rest.min(rest.wrapping_sub(p));
        rest.min(rest.wrapping_sub(p)) as u32
    }

    /// `a b` modulo the lane's prime.
    #[inline(always)]
    pub fn product(&self, lane: usize, a: u32, b: u32) -> u32 {
        self.residue(lane, u64::from(a) * u64::from(b))
    }

    /// `1 / a` modulo the lane's prime by the Euclidean algorithm, for nonzero `a`.
    pub fn inverse(&self, lane: usize, a: u32) -> u32 {
        inverse_modulo(u64::from(a), u64::from(self.p[lane])) as u32
    }

    /// Subtracts `factor` times a sparse row from `sums`.
    #[inline(always)]
    pub fn subtract<C: Coefficient<N>>(
        &self,
        sums: &mut [[u64; N]],
        columns: &[u32],
        coefficients: &[C],
        factor: &[u32; N],
    ) {
        for (&column, coefficient) in columns.iter().zip(coefficients) {
            let sum = &mut sums[column as usize];
            for l in 0..N {
                let difference = sum[l].wrapping_sub(u64::from(factor[l]) * u64::from(coefficient.lane(l)));
                sum[l] = difference.wrapping_add(self.square[l] & ((difference as i64 >> 63) as u64));
            }
        }
    }
}
