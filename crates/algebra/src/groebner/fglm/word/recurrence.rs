//! The shortest linear recurrence of a sequence, updated term by term (Berlekamp-Massey), and the solution of its
//! Hankel systems.
//!
//! J. Massey, "Shift-register synthesis and BCH decoding", IEEE Transactions on Information Theory 15 (1969).

use super::kernel::{Modulus, Sums, padded};

/// The recurrence of the terms seen so far: `sum over i of connection[i] * term[n - i] = 0`.
#[derive(Clone, Debug)]
pub(super) struct Recurrence {
    modulus: Modulus,
    /// Storage of the terms in reverse, the first at the end, so that a term and those before it are in ascending
    /// memory.
    reversed: Vec<u32>,
    capacity: usize,
    terms: usize,
    connection: Vec<u32>,
    length: usize,
    /// The recurrence before the last change of length, its length, the term that it failed to predict, and the
    /// discrepancy.
    previous: Vec<u32>,
    previous_length: usize,
    missed_by: u32,
    missed_at: Option<usize>,
}

impl Recurrence {
    /// An empty recurrence for at most `capacity` terms.
    pub fn new(modulus: Modulus, capacity: usize) -> Self {
        let mut connection = vec![0; padded(capacity + 1)];
        connection[0] = 1;
        Recurrence {
            modulus,
            reversed: vec![0; capacity + padded(capacity + 1)],
            capacity,
            terms: 0,
            previous: connection.clone(),
            connection,
            length: 0,
            previous_length: 0,
            missed_by: 1,
            missed_at: None,
        }
    }

    /// The order of the recurrence.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Adds the next term.
    pub fn push(&mut self, term: u32) {
        let n = self.terms;
        let start = self.capacity - 1 - n;
        self.reversed[start] = term;
        self.terms += 1;
        let size = padded(self.length + 1);
        let discrepancy = self.modulus.dot(&self.connection[..size], &self.reversed[start..start + size]);
        if discrepancy == 0 {
            return;
        }
        let shift = self.missed_at.map_or(n + 1, |at| n - at);
        let grows = 2 * self.length <= n;
        let before = grows.then(|| self.connection.clone());
        self.correct(discrepancy, shift);
        if let Some(before) = before {
            self.previous = before;
            self.previous_length = self.length;
            (self.missed_by, self.missed_at) = (discrepancy, Some(n));
            self.length = n + 1 - self.length;
        }
    }

    /// Subtracts the shifted multiple of the previous recurrence that cancels `discrepancy`.
    fn correct(&mut self, discrepancy: u32, shift: usize) {
        let factor = self.modulus.mul(discrepancy, self.modulus.inverse(self.missed_by));
        let factor = self.modulus.neg(factor);
        let previous = &self.previous[..=self.previous_length];
        for (entry, &old) in self.connection[shift..].iter_mut().zip(previous) {
            *entry = self.modulus.add_mul(*entry, factor, old);
        }
    }

    /// The monic characteristic polynomial, constant term first.
    pub fn polynomial(&self) -> Vec<u32> {
        self.connection[..=self.length].iter().rev().copied().collect()
    }

    /// The Hankel solver of the sequence, which is long enough to determine the recurrence.
    pub fn hankel(&self) -> Hankel {
        let previous = self.previous[..=self.previous_length].iter().rev();
        let scale = self.modulus.inverse(self.missed_by);
        let inverse: Vec<u32> = previous.map(|&c| self.modulus.mul(c, scale)).collect();
        Hankel { modulus: self.modulus, polynomial: self.polynomial(), inverse }
    }
}

/// The Hankel matrix `H[k][j] = term[k + j]` of a sequence with characteristic polynomial P, of degree the size of H.
///
/// Its generating series is N/P. The numerators of two consecutive convergents N/P and N'/P' satisfy `N P' - N' P = c`,
/// where c is the discrepancy between them. So `P'/c` is the inverse of N modulo P.
#[derive(Clone, Debug)]
pub(super) struct Hankel {
    modulus: Modulus,
    polynomial: Vec<u32>,
    inverse: Vec<u32>,
}

impl Hankel {
    fn size(&self) -> usize {
        self.polynomial.len() - 1
    }

    /// The solution `c` of `sum over j of H[k][j] c[j] = values[k]`: as series, `values = N c / P` up to a polynomial.
    pub fn solve(&self, values: &[u32]) -> Vec<u32> {
        let numerator = self.numerator(values);
        self.remainder(&self.times_inverse(&numerator))
    }

    /// The polynomial part of P times the series of `values`.
    fn numerator(&self, values: &[u32]) -> Vec<u32> {
        let size = self.size();
        let values = extended(values, padded(size));
        let polynomial = extended(&self.polynomial, size + 1 + padded(size));
        (0..size).map(|j| self.modulus.dot(&polynomial[j + 1..][..values.len()], &values)).collect()
    }

    /// The product with the inverse of N, not reduced.
    fn times_inverse(&self, numerator: &[u32]) -> Vec<u32> {
        let (size, width) = (self.size(), padded(self.size()));
        let numerator = extended(numerator, width);
        let mut reversed = vec![0; 3 * width + 1];
        for (k, &c) in self.inverse.iter().enumerate() {
            reversed[2 * width - k] = c;
        }
        (0..2 * size).map(|k| self.modulus.dot(&numerator, &reversed[2 * width - k..][..width])).collect()
    }

    /// The remainder by P.
    fn remainder(&self, dividend: &[u32]) -> Vec<u32> {
        let size = self.size();
        let mut sums = Sums::new(self.modulus, dividend.len());
        sums.set(dividend);
        for top in (size..dividend.len()).rev() {
            let factor = self.modulus.neg(sums.get(top));
            sums.add_at(top - size, factor, &self.polynomial[..size]);
        }
        let mut remainder = sums.residues();
        remainder.truncate(size);
        remainder
    }
}

/// `values` followed by zeros.
fn extended(values: &[u32], length: usize) -> Vec<u32> {
    let mut extended = values.to_vec();
    extended.resize(length, 0);
    extended
}
