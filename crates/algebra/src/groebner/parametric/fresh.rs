//! Check of the leading monomials by a full computation at another point modulo another prime.
//!
//! A replay skips the rows that became zero when the trace was learned. If this was due to an unlucky prime or point,
//! all replays agree and all miss an element.

use super::flat::{Equations, admit, flat_ring, image_of};
use super::lift::{Primes, image};
use super::prime::Prime;
use super::{Ideal, Poly};
use crate::groebner::f4::leading_monomials;
use crate::number::{BigRational, Zp};
use crate::poly::{Monomial, Polynomial, PolynomialRing, Term};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// Maximum number of primes that may divide a coefficient.
const ATTEMPTS: usize = 10;

/// Whether the basis at a random point modulo the next prime has the leading monomials `leads`, smallest first. The
/// parameters have no relations.
///
/// # Errors
/// Those of [`crate::groebner::f4()`].
pub(super) fn has_leads<'a>(
    ideal: &Ideal<'_>,
    leads: impl Iterator<Item = &'a Monomial> + Clone,
    primes: &mut Primes,
    watch: &Watch,
) -> Result<bool> {
    let ring = ideal.ring;
    let mut stream = SplitMix64::new(17);
    for _ in 0..ATTEMPTS {
        let field = primes.next_prime();
        let point: Vec<u64> = ring.field().ring().variables().iter().map(|_| stream.unit(field.p)).collect();
        let target = ring.over(Zp::known_prime(field.p));
        let at_point = |f: &Poly| generator_at(ideal, &target, f, field, &point);
        if let Some(generators) = ideal.generators.iter().map(at_point).collect::<Option<Vec<_>>>() {
            return Ok(leading_monomials(&target, &generators, watch)?.iter().eq(leads));
        }
    }
    Ok(false)
}

/// Whether the basis with the parameters as variables has the leading monomials of `basis` modulo the next prime too.
///
/// # Errors
/// Those of [`crate::groebner::f4()`].
pub(super) fn has_leads_with_variables(
    ideal: &Ideal<'_>,
    equations: &Equations,
    basis: &[Polynomial<u64>],
    primes: &mut Primes,
    watch: &Watch,
) -> Result<bool> {
    let field = primes.next_that(|field| admit(equations, field));
    let flat = flat_ring(ideal.ring, Zp::known_prime(field.p))?;
    let image = image_of(&flat, equations, field).expect("a prime that divides no coefficient");
    let again = leading_monomials(&flat, &image, watch)?;
    Ok(again.iter().eq(basis.iter().map(|f| &f.terms()[0].monomial)))
}

/// A generator at a point; `None` where a coefficient vanishes or is not defined.
fn generator_at(
    ideal: &Ideal<'_>,
    target: &PolynomialRing<Zp>,
    f: &Poly,
    field: Prime,
    point: &[u64],
) -> Option<Polynomial<u64>> {
    let layout = ideal.ring.field().ring().layout();
    let value = |f: &Polynomial<BigRational>| {
        f.terms().iter().fold(0, |sum, term| {
            let powers = point.iter().enumerate().map(|(v, &x)| (x, u64::from(layout.exponent(&term.monomial, v))));
            let product = |product, (x, e)| if e == 0 { product } else { field.mul(product, field.pow(x, e)) };
            field.add(sum, powers.fold(image(field, &term.coefficient), product))
        })
    };
    let term = |term: &Term<_>| {
        let coefficient: &crate::poly::Fraction<BigRational> = &term.coefficient;
        let quotient = field.mul(value(coefficient.numerator()), field.inverse(value(coefficient.denominator())));
        (quotient != 0).then(|| Term { coefficient: quotient, monomial: term.monomial.clone() })
    };
    Some(target.descending(f.terms().iter().map(term).collect::<Option<_>>()?))
}
