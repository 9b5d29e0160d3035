//! A proof over Q that polynomials reduce to zero, by arithmetic modulo primes alone.
//!
//! Let `G_j` be the primitive integer multiples of the divisors. Modulo primes that divide no leading coefficient of theirs, a
//! target `S` is divided; the quotients `n_j / D` are rebuilt over Q. The polynomial `D S - sum n_j m_j G_j` has integer coefficients
//! which vanish modulo the product `M` of all those primes. Once `M` exceeds twice the bound `D |S| + sum |n_j| |G_j|` on
//! them, they are zero: `S` reduces to zero over Q. A remainder modulo one such prime shows that it does not.

use num_traits::Signed;

use super::super::pairs::{Head, Pairs, Strategy};
use super::matrix::Matrix;
use super::system::{Integral, combination, modulo, no_primes, refuse};
use super::vectors::{Tables, Vector};
use crate::number::{BigInt, BigRational, Field, Rationals, primes_below, residue};
use crate::poly::{Monomial, Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// How many primes are divided by at once.
pub(super) const LANES: usize = 8;

/// How many targets share one matrix.
const TARGETS: usize = 64;

/// Polynomials to divide by, and their images modulo as many primes as were needed so far.
pub(super) struct Divisors<'a> {
    pub ring: &'a PolynomialRing<Rationals>,
    pub elements: Vec<Integral>,
    /// The greatest coefficient of each.
    heights: Vec<BigInt>,
    batches: Vec<Batch>,
}

/// The divisors modulo some primes.
pub(super) struct Batch {
    pub primes: [u32; LANES],
    /// The coefficients of the monic images.
    pub images: Vec<Vec<[u32; LANES]>>,
    /// The inverses of the leading coefficients.
    pub inverses: Vec<[u32; LANES]>,
}

impl<'a> Divisors<'a> {
    /// Divisors that are not zero.
    pub(super) fn new(ring: &'a PolynomialRing<Rationals>, basis: &[Polynomial<BigRational>]) -> Self {
        let elements: Vec<_> = basis.iter().enumerate().map(|(index, f)| Integral::new(index, f)).collect();
        let heights = elements.iter().map(Integral::height).collect();
        Divisors { ring, elements, heights, batches: Vec::new() }
    }

    /// Proves that the S-pairs which the criteria of Buchberger and of Gebauer and Moeller leave reduce to zero: the divisors
    /// are a Groebner basis of the ideal that they generate.
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

    /// Divides modulo more and more primes until each target is settled.
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

    /// Whether the quotients stand over Q and the primes exceed the bound.
    fn is_settled(&self, matrix: &Matrix, target: &Integral, rows: &[&[u32]], tables: &mut Tables<'_>) -> Result<bool> {
        let Some(witness) = tables.witness(rows) else { return Ok(false) };
        let Some(Vector { numerators, denominator }) = tables.vector(rows, &witness)? else { return Ok(false) };
        let heights = matrix.divisors().map(|element| &self.heights[element]);
        let sum: BigInt = numerators.iter().zip(heights).map(|(n, height)| n.abs() * height).sum();
        let bound = 2 * (sum + &denominator * target.height());
        let quotients = Vector { numerators, denominator };
        Ok(bound < *tables.modulus() && tables.agree(&quotients, rows))
    }

    fn add_batch(&mut self) -> Result<()> {
        let good = |&p: &u32| self.elements.iter().all(|f| residue(f.leading_coefficient(), p) != 0);
        let mut primes = primes_below(1 << 31).map(|p| p as u32).filter(good).skip(self.batches.len() * LANES);
        let mut batch = [0; LANES];
        for p in &mut batch {
            *p = primes.next().ok_or_else(no_primes)?;
        }
        drop(primes);
        self.batches.push(self.batch(batch)?);
        Ok(())
    }

    fn batch(&self, primes: [u32; LANES]) -> Result<Batch> {
        let mut inverses = vec![[0; LANES]; self.elements.len()];
        let mut images: Vec<_> = self.elements.iter().map(|f| vec![[0; LANES]; f.terms.len()]).collect();
        for (lane, &p) in primes.iter().enumerate() {
            let field = *modulo(self.ring, p)?.field();
            for (element, f) in self.elements.iter().enumerate() {
                let lead = u64::from(residue(f.leading_coefficient(), p));
                let inverse = field.inverse(&lead).ok_or_else(|| refuse("a prime divides a leading coefficient"))?;
                inverses[element][lane] = inverse as u32;
                for (image, (_, c)) in images[element].iter_mut().zip(&f.terms) {
                    image[lane] = (u64::from(residue(c, p)) * inverse % u64::from(p)) as u32;
                }
            }
        }
        Ok(Batch { primes, images, inverses })
    }
}
