//! A proof over Q that polynomials reduce to zero, by arithmetic modulo primes only.
//!
//! Let `G_j` be the primitive integer multiples of the divisors. A target `S` is divided modulo primes that divide none
//! of their leading coefficients. The quotients `n_j / D` are reconstructed over Q. The polynomial `D S - sum n_j m_j
//! G_j` has integer coefficients which vanish modulo the product `M` of all those primes. Once `M` exceeds twice the
//! bound `D |S| + sum |n_j| |G_j|` on them, they are zero, so `S` reduces to zero over Q. A nonzero remainder modulo
//! one such prime disproves it.

use num_traits::Signed;

use super::super::pairs::{Head, Pairs, Strategy};
use super::divisors::Divisors;
use super::matrix::Matrix;
use super::system::{Integral, combination};
use super::vectors::{Tables, Vector};
use crate::number::BigInt;
use crate::poly::Monomial;
use crate::{Result, Watch};

/// Number of targets that share one matrix.
const TARGETS: usize = 64;

impl Divisors<'_> {
    /// Proves that the divisors are a Groebner basis of their ideal. All S-pairs that pass Buchberger's criteria and
    /// the Gebauer-Moeller criteria reduce to zero.
    ///
    /// # Errors
    /// [`Certificate`](crate::ErrorKind::Certificate) when one does not.
    pub(super) fn prove_basis(&mut self, watch: &Watch) -> Result<()> {
        let mut pairs = Pairs::new(Strategy::Normal);
        let mut heads = Vec::new();
        for element in &self.elements {
            watch.check()?;
            let head = Head { monomial: element.lead().clone(), sugar: element.degree(self.ring), redundant: false };
            pairs.update(self.ring, &mut heads, head)?;
        }
        let mut targets = Vec::new();
        while let Some(pair) = pairs.select(self.ring) {
            watch.check()?;
            targets.push(self.s_polynomial(pair.left, pair.right, &pair.lcm)?);
        }
        self.prove_all(&targets, watch).map_err(|error| error.with_context("an S-pair"))
    }

    /// The S-polynomial of two elements with integer coefficients.
    fn s_polynomial(&self, left: usize, right: usize, lcm: &Monomial) -> Result<Integral> {
        let (a, b) = (&self.elements[left], &self.elements[right]);
        let divisor = num_integer::gcd(a.leading_coefficient().clone(), b.leading_coefficient().clone());
        let shift = |f: &Integral| self.ring.layout().checked_div(lcm, f.lead()).expect("a multiple is divisible");
        let left = (a, b.leading_coefficient() / &divisor, shift(a));
        let right = (b, -(a.leading_coefficient() / &divisor), shift(b));
        combination(self.ring, &[left, right])
    }

    /// Proves that all `targets` reduce to zero.
    ///
    /// # Errors
    /// [`Certificate`](crate::ErrorKind::Certificate) when one does not.
    pub(super) fn prove_all(&mut self, targets: &[Integral], watch: &Watch) -> Result<()> {
        for (index, chunk) in targets.chunks(TARGETS).enumerate() {
            watch.report("proof", index * TARGETS, targets.len() - index * TARGETS);
            let matrix = Matrix::new(self, chunk, watch)?;
            self.prove_chunk(&matrix, chunk, watch)?;
        }
        Ok(())
    }

    /// Divides modulo more and more primes until each target is decided.
    fn prove_chunk(&mut self, matrix: &Matrix, targets: &[Integral], watch: &Watch) -> Result<()> {
        let mut open: Vec<usize> = (0..targets.len()).collect();
        let mut quotients: Vec<Vec<Vec<u32>>> = vec![Vec::new(); targets.len()];
        let mut count = 0;
        while !open.is_empty() {
            if self.batches.len() == count {
                self.add_batch()?;
            }
            for &target in &open {
                watch.check()?;
                quotients[target].extend(matrix.divide(&targets[target], &self.batches[count])?);
            }
            count += 1;
            let primes: Vec<u32> = self.batches[..count].iter().flat_map(|batch| batch.primes).collect();
            let mut tables = Tables::new(&primes)?;
            let mut left = Vec::new();
            for target in open {
                watch.check()?;
                let rows: Vec<&[u32]> = quotients[target].iter().map(Vec::as_slice).collect();
                if self.is_settled(matrix, &targets[target], &rows, &mut tables)? {
                    quotients[target] = Vec::new();
                } else {
                    left.push(target);
                }
            }
            open = left;
        }
        Ok(())
    }

    /// Whether the quotients are determined over Q and the primes exceed the bound.
    fn is_settled(&self, matrix: &Matrix, target: &Integral, rows: &[&[u32]], tables: &mut Tables<'_>) -> Result<bool> {
        let Some(witness) = tables.witness(rows) else { return Ok(false) };
        let Some(Vector { numerators, denominator }) = tables.vector(rows, &witness)? else { return Ok(false) };
        let heights = matrix.divisors().map(|element| &self.heights[element]);
        let sum: BigInt = numerators.iter().zip(heights).map(|(n, height)| n.abs() * height).sum();
        let bound = 2 * (sum + &denominator * target.height());
        let quotients = Vector { numerators, denominator };
        Ok(bound < *tables.modulus() && tables.agree(&quotients, rows))
    }
}
