//! Polynomials of a running basis with the cofactors that express them in the generators.

use super::division::{divide_by, inverse, s_factors};
use super::pairs::Pair;
use crate::number::{Field, Ring};
use crate::poly::{Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// A polynomial of the running basis with its cofactors. They are empty when they are not requested.
#[derive(Clone, Debug)]
pub(super) struct Tracked<E> {
    pub polynomial: Polynomial<E>,
    pub cofactors: Vec<Polynomial<E>>,
}

/// The generator `index` with its unit vector of cofactors.
pub(super) fn generator<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    index: usize,
    count: usize,
    track: bool,
) -> Tracked<F::Element> {
    let unit = |k: usize| if k == index { ring.one() } else { ring.zero() };
    let cofactors = if track { (0..count).map(unit).collect() } else { Vec::new() };
    Tracked { polynomial: f.clone(), cofactors }
}

/// The terms of the polynomial and of its cofactors.
pub(super) fn term_count<E>(element: &Tracked<E>) -> usize {
    let cofactors: usize = element.cofactors.iter().map(|f| f.terms().len()).sum();
    element.polynomial.terms().len() + cofactors
}

/// `element` with leading coefficient one; zero stays zero.
pub(super) fn monic<F: Field>(ring: &PolynomialRing<F>, element: Tracked<F::Element>) -> Result<Tracked<F::Element>> {
    let factor = match element.polynomial.leading() {
        Some(lead) if !ring.field().is_one(&lead.coefficient) => inverse(ring, &lead.coefficient)?,
        _ => return Ok(element),
    };
    Ok(Tracked {
        polynomial: ring.scale(&element.polynomial, &factor),
        cofactors: element.cofactors.iter().map(|f| ring.scale(f, &factor)).collect(),
    })
}

/// The S-polynomial of a pair with its cofactors.
pub(super) fn s_element<F: Field>(
    ring: &PolynomialRing<F>,
    pair: &Pair,
    elements: &[Tracked<F::Element>],
) -> Result<Tracked<F::Element>> {
    let (a, b) = (&elements[pair.left], &elements[pair.right]);
    let (left, right) = s_factors(ring, &a.polynomial, &b.polynomial)?.expect("basis elements are not zero");
    let combine = |f: &Polynomial<F::Element>, g: &Polynomial<F::Element>| {
        let first = ring.mul_term(f, &left.coefficient, &left.monomial)?;
        ring.sub_mul_term(&first, &right.coefficient, &right.monomial, g)
    };
    let cofactors = a.cofactors.iter().zip(&b.cofactors).map(|(f, g)| combine(f, g)).collect::<Result<_>>()?;
    Ok(Tracked { polynomial: combine(&a.polynomial, &b.polynomial)?, cofactors })
}

/// The normal form of `element` by `divisors`, with its cofactors.
pub(super) fn reduce<F: Field>(
    ring: &PolynomialRing<F>,
    element: Tracked<F::Element>,
    divisors: &[Tracked<F::Element>],
    watch: &Watch,
) -> Result<Tracked<F::Element>> {
    let polynomials: Vec<_> = divisors.iter().map(|divisor| &divisor.polynomial).collect();
    let division = divide_by(ring, element.polynomial, &polynomials, watch)?;
    let mut cofactors = element.cofactors;
    if !division.remainder.is_zero() {
        for (quotient, divisor) in division.quotients.iter().zip(divisors).filter(|(q, _)| !q.is_zero()) {
            for (cofactor, part) in cofactors.iter_mut().zip(&divisor.cofactors) {
                *cofactor = ring.sub(cofactor, &ring.checked_mul(quotient, part)?);
            }
        }
    }
    Ok(Tracked { polynomial: division.remainder, cofactors })
}
