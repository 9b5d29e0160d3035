//! Dense vectors and univariate polynomials modulo a prime below `2^31`, in machine words.
//!
//! A polynomial is its coefficients, constant term first, without trailing zeros.

use crate::number::word::Prime;
use crate::{Result, Watch};

/// Arithmetic modulo `p`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Residues {
    prime: Prime,
}

impl Residues {
    /// Builds the arithmetic modulo the prime `p < 2^31`.
    pub(super) fn new(p: u32) -> Self {
        Residues { prime: Prime::new(p) }
    }

    pub(super) fn prime(&self) -> u32 {
        self.prime.p as u32
    }

    pub(super) fn from_i64(&self, n: i64) -> u32 {
        n.rem_euclid(self.prime.p as i64) as u32
    }

    pub(super) fn add(&self, a: u32, b: u32) -> u32 {
        self.prime.add(u64::from(a), u64::from(b)) as u32
    }

    pub(super) fn neg(&self, a: u32) -> u32 {
        self.prime.neg(u64::from(a)) as u32
    }

    pub(super) fn sub(&self, a: u32, b: u32) -> u32 {
        self.prime.sub(u64::from(a), u64::from(b)) as u32
    }

    pub(super) fn mul(&self, a: u32, b: u32) -> u32 {
        self.prime.mul(u64::from(a), u64::from(b)) as u32
    }

    /// The inverse of a nonzero residue.
    pub(super) fn inverse(&self, a: u32) -> u32 {
        self.prime.inverse(u64::from(a)) as u32
    }

    /// The inner product. The halves of the products are summed separately, so nothing overflows.
    pub(super) fn dot(&self, a: &[u32], b: &[u32]) -> u32 {
        let (mut low, mut high) = (0u64, 0u64);
        for (&x, &y) in a.iter().zip(b) {
            let product = u64::from(x) * u64::from(y);
            low += product & 0xffff_ffff;
            high += product >> 32;
        }
        let shift = self.prime.reduce(1 << 32);
        self.prime.reduce(self.prime.reduce(high) * shift + self.prime.reduce(low)) as u32
    }

    /// `target += factor row`, with Shoup's precomputed quotient.
    pub(super) fn add_scaled(&self, target: &mut [u32], factor: u32, row: &[u32]) {
        let factor = u64::from(factor);
        let quotient = (factor << 32) / self.prime.p;
        for (sum, &entry) in target.iter_mut().zip(row) {
            let entry = u64::from(entry);
            let product = factor * entry - ((quotient * entry) >> 32) * self.prime.p;
            let mut value = u64::from(*sum) + product;
            value = value.min(value.wrapping_sub(self.prime.p));
            *sum = value.min(value.wrapping_sub(self.prime.p)) as u32;
        }
    }

    pub(super) fn scale(&self, a: &[u32], factor: u32) -> Vec<u32> {
        let mut scaled = vec![0; a.len()];
        self.add_scaled(&mut scaled, factor, a);
        scaled
    }

    /// `a` divided by its leading coefficient; zero stays zero.
    pub(super) fn monic(&self, a: &[u32]) -> Vec<u32> {
        a.last().map_or(Vec::new(), |&lead| self.scale(a, self.inverse(lead)))
    }

    pub(super) fn difference(&self, a: &[u32], b: &[u32]) -> Vec<u32> {
        let mut rest = a.to_vec();
        rest.resize(a.len().max(b.len()), 0);
        self.add_scaled(&mut rest, self.neg(1), b);
        trim(rest)
    }

    pub(super) fn product(&self, a: &[u32], b: &[u32]) -> Vec<u32> {
        if a.is_empty() || b.is_empty() {
            return Vec::new();
        }
        let reversed: Vec<u32> = b.iter().rev().copied().collect();
        let coefficient = |k: usize| {
            let first = k.saturating_sub(b.len() - 1);
            let last = k.min(a.len() - 1);
            self.dot(&a[first..=last], &reversed[b.len() - 1 + first - k..])
        };
        (0..a.len() + b.len() - 1).map(coefficient).collect()
    }

    /// Quotient and remainder by a nonzero `b`.
    pub(super) fn div_rem(&self, a: &[u32], b: &[u32]) -> (Vec<u32>, Vec<u32>) {
        let low = &b[..b.len() - 1];
        let inverse = self.inverse(b[b.len() - 1]);
        let mut rest = a.to_vec();
        let mut quotient = Vec::new();
        while rest.len() > low.len() {
            let Some(top) = rest.pop() else { break };
            let factor = self.mul(top, inverse);
            let shift = rest.len() - low.len();
            self.add_scaled(&mut rest[shift..], self.neg(factor), low);
            quotient.push(factor);
        }
        quotient.reverse();
        (trim(quotient), trim(rest))
    }

    /// `a b` modulo `modulus`.
    pub(super) fn product_modulo(&self, a: &[u32], b: &[u32], modulus: &[u32]) -> Vec<u32> {
        self.div_rem(&self.product(a, b), modulus).1
    }

    /// The monic greatest common divisor.
    pub(super) fn gcd(&self, a: &[u32], b: &[u32]) -> Vec<u32> {
        let (mut a, mut b) = (a.to_vec(), b.to_vec());
        while !b.is_empty() {
            let rest = self.div_rem(&a, &b).1;
            a = b;
            b = rest;
        }
        self.monic(&a)
    }

    /// The inverse of `a` modulo `modulus`; `None` when they have a common root.
    pub(super) fn inverse_modulo(&self, a: &[u32], modulus: &[u32]) -> Option<Vec<u32>> {
        let (mut left, mut right) = (modulus.to_vec(), self.div_rem(a, modulus).1);
        let (mut left_factor, mut right_factor) = (Vec::new(), vec![1]);
        while !right.is_empty() {
            let (quotient, rest) = self.div_rem(&left, &right);
            let factor = self.difference(&left_factor, &self.product(&quotient, &right_factor));
            (left, right) = (right, rest);
            (left_factor, right_factor) = (right_factor, factor);
        }
        let [unit] = left[..] else { return None };
        Some(self.div_rem(&self.scale(&left_factor, self.inverse(unit)), modulus).1)
    }

    pub(super) fn derivative(&self, a: &[u32]) -> Vec<u32> {
        trim(a.iter().enumerate().skip(1).map(|(i, &c)| self.mul(self.prime.reduce(i as u64) as u32, c)).collect())
    }

    /// The monic minimal polynomial of a linearly recurrent sequence (Berlekamp and Massey).
    pub(super) fn minimal_polynomial(&self, sequence: &[u32]) -> Vec<u32> {
        let reversed: Vec<u32> = sequence.iter().rev().copied().collect();
        let (mut connection, mut previous) = (vec![1u32], vec![1u32]);
        let (mut length, mut gap, mut last) = (0, 1, 1);
        for n in 0..sequence.len() {
            let start = sequence.len() - 1 - n;
            let discrepancy = self.dot(&connection, &reversed[start..]);
            if discrepancy == 0 {
                gap += 1;
                continue;
            }
            let factor = self.neg(self.mul(discrepancy, self.inverse(last)));
            let before = connection.clone();
            connection.resize(connection.len().max(previous.len() + gap), 0);
            self.add_scaled(&mut connection[gap..], factor, &previous);
            if 2 * length <= n {
                (length, gap, last, previous) = (n + 1 - length, 1, discrepancy, before);
            } else {
                gap += 1;
            }
        }
        connection.resize(length + 1, 0);
        connection.reverse();
        connection
    }

    /// The monic characteristic polynomial of a square matrix, given by its columns. Method: reduction to Hessenberg
    /// form (Cohen, A Course in Computational Algebraic Number Theory, algorithm 2.2.9).
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn characteristic_polynomial(&self, columns: Vec<Vec<u32>>, watch: &Watch) -> Result<Vec<u32>> {
        let h = self.hessenberg(columns, watch)?;
        let mut minors: Vec<Vec<u32>> = vec![vec![1]];
        for m in 0..h.len() {
            watch.check()?;
            let mut next = self.product(&minors[m], &[self.neg(h[m][m]), 1]);
            let mut below = 1;
            for i in (0..m).rev() {
                below = self.mul(below, h[i][i + 1]);
                let factor = self.neg(self.mul(below, h[m][i]));
                self.add_scaled(&mut next, factor, &minors[i]);
            }
            minors.push(next);
        }
        Ok(minors.pop().unwrap_or_default())
    }

    /// A similar matrix, by columns, that is zero below its first subdiagonal.
    fn hessenberg(&self, mut h: Vec<Vec<u32>>, watch: &Watch) -> Result<Vec<Vec<u32>>> {
        let size = h.len();
        for m in 1..size.saturating_sub(1) {
            watch.check()?;
            let Some(pivot) = (m..size).find(|&i| h[m - 1][i] != 0) else { continue };
            h.iter_mut().for_each(|column| column.swap(pivot, m));
            h.swap(pivot, m);
            let inverse = self.inverse(h[m - 1][m]);
            for i in m + 1..size {
                let factor = self.mul(h[m - 1][i], inverse);
                if factor == 0 {
                    continue;
                }
                for column in h.iter_mut() {
                    column[i] = self.sub(column[i], self.mul(factor, column[m]));
                }
                let (left, right) = h.split_at_mut(i);
                self.add_scaled(&mut left[m], factor, &right[0]);
            }
        }
        Ok(h)
    }

    /// The square-free, pairwise coprime parts of a monic polynomial with their multiplicities, constant parts left out
    /// (Yun 1976); the characteristic is above the degree.
    pub(super) fn square_free_parts(&self, a: &[u32]) -> Vec<(usize, Vec<u32>)> {
        let derivative = self.derivative(a);
        let common = self.gcd(a, &derivative);
        let mut rest = self.div_rem(a, &common).0;
        let mut slope = self.div_rem(&derivative, &common).0;
        let mut parts = Vec::new();
        for multiplicity in 1.. {
            if rest.len() <= 1 {
                break;
            }
            let difference = self.difference(&slope, &self.derivative(&rest));
            let part = self.gcd(&rest, &difference);
            rest = self.div_rem(&rest, &part).0;
            slope = self.div_rem(&difference, &part).0;
            if part.len() > 1 {
                parts.push((multiplicity, part));
            }
        }
        parts
    }
}

/// `a` without trailing zeros.
pub(super) fn trim(mut a: Vec<u32>) -> Vec<u32> {
    while a.last() == Some(&0) {
        a.pop();
    }
    a
}
