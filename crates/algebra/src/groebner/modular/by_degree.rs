//! Bases of zero-dimensional ideals in other orders, from replayed graded ones.

use super::super::prime_field::reordered;
use super::super::{Basis, Trace};
use super::seen::Image;
use super::system::{System, modulo};
use crate::number::{Rationals, Zp};
use crate::poly::{Monomial, PolynomialRing, Term};
use crate::{Result, Watch};

/// Computation of the graded basis modulo further primes.
pub(super) struct ByDegree {
    trace: Trace,
    ring: PolynomialRing<Rationals>,
    supports: Vec<Vec<Monomial>>,
}

impl ByDegree {
    /// The basis in the order of `target` modulo its prime, and the trace of the graded basis; `None` when the ideal is
    /// positive-dimensional there.
    pub(super) fn learn(
        graded: &System,
        target: &PolynomialRing<Zp>,
        watch: &Watch,
    ) -> Result<Option<(Basis<Zp>, Self)>> {
        let (ring, generators) = graded.image(target.field().modulus() as u32)?;
        let (by_degree, trace) = Trace::learn(&ring, &generators, watch)?;
        let Some(found) = reordered(&by_degree, target, watch)? else { return Ok(None) };
        let support = |f: &[Term<u64>]| f.iter().map(|term| term.monomial.clone()).collect();
        let supports = by_degree.polynomials.iter().map(|f| support(f.terms())).collect();
        let ring = graded.ring.with_width(by_degree.ring.layout().width());
        Ok(Some((found, ByDegree { trace, ring, supports })))
    }

    /// The bases in the order of `target` modulo further primes; `None` where the graded computation differs from the
    /// trace.
    pub(super) fn replay<const N: usize>(
        &self,
        graded: &System,
        target: &PolynomialRing<Rationals>,
        primes: [u32; N],
        watch: &Watch,
    ) -> Result<[Option<Basis<Zp>>; N]> {
        let replayed = self.trace.replay(primes, &graded.lanes(primes), watch)?;
        let mut found = [const { None }; N];
        for ((found, image), p) in found.iter_mut().zip(replayed).zip(primes) {
            if let Some(image) = image {
                *found = reordered(&self.basis(p, &image)?, &modulo(target, p)?, watch)?;
            }
        }
        Ok(found)
    }

    /// The graded basis with these coefficients.
    fn basis(&self, p: u32, image: &Image) -> Result<Basis<Zp>> {
        let ring = modulo(&self.ring, p)?;
        let term = |(&c, m): (&u32, &Monomial)| Term { coefficient: u64::from(c), monomial: m.clone() };
        let terms = |(row, support): (&Vec<u32>, &Vec<Monomial>)| row.iter().zip(support).map(term).collect::<Vec<_>>();
        let nonzero = |mut list: Vec<Term<u64>>| {
            list.retain(|term| term.coefficient != 0);
            ring.descending(list)
        };
        let polynomials = image.iter().zip(&self.supports).map(terms).map(nonzero).collect();
        Ok(Basis { ring, polynomials, cofactors: Vec::new() })
    }
}
