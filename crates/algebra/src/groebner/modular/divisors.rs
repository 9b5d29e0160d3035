//! Divisors for division modulo primes: [`Divisors`], with their images modulo the primes so far.

use super::system::{Integral, modulo, no_primes, refuse};
use crate::Result;
use crate::number::{BigInt, BigRational, Field, Rationals, primes_below, residue};
use crate::poly::{Polynomial, PolynomialRing};

/// Number of primes for which a division is done at once.
pub(super) const LANES: usize = 8;

/// Divisors and their images modulo as many primes as needed so far.
pub(super) struct Divisors<'a> {
    pub ring: &'a PolynomialRing<Rationals>,
    pub elements: Vec<Integral>,
    /// The greatest coefficient of each divisor.
    pub heights: Vec<BigInt>,
    pub batches: Vec<Batch>,
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
    /// Builds the divisors from nonzero polynomials.
    pub(super) fn new(ring: &'a PolynomialRing<Rationals>, basis: &[Polynomial<BigRational>]) -> Self {
        let elements: Vec<_> = basis.iter().enumerate().map(|(index, f)| Integral::new(index, f)).collect();
        let heights = elements.iter().map(Integral::height).collect();
        Divisors { ring, elements, heights, batches: Vec::new() }
    }

    /// Adds the next primes that divide no leading coefficient.
    ///
    /// # Errors
    /// [`Budget`](crate::ErrorKind::Budget) when there are none.
    pub(super) fn add_batch(&mut self) -> Result<()> {
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
