//! Conversions between polynomials of a ring over a prime field and polynomials on machine words.

use std::cmp::Reverse;

use num_integer::Integer;
use num_traits::One;

use super::flat::{Flat, Packing};
use super::integral::Integral;
use crate::number::{BigInt, BigRational, Field, PrimeElement};
use crate::poly::{Polynomial, PolynomialRing, Term};

/// A packing that is wide enough for products of the given polynomials with themselves.
pub fn packing<F: Field>(ring: &PolynomialRing<F>, polynomials: &[&Polynomial<F::Element>]) -> Option<Packing> {
    let degree = |v: usize| polynomials.iter().map(|f| ring.degree_in(f, v)).max().unwrap_or(0);
    let bounds = (0..ring.variables().len()).map(|v| degree(v).checked_mul(2));
    Packing::new(&bounds.collect::<Option<Vec<_>>>()?)
}

fn key<F: Field>(ring: &PolynomialRing<F>, packing: &Packing, term: &Term<F::Element>) -> u128 {
    let exponents = (0..packing.variables()).map(|v| (v, ring.layout().exponent(&term.monomial, v)));
    exponents.filter(|(_, exponent)| *exponent > 0).fold(0, |key, (v, exponent)| key | packing.power(v, exponent))
}

/// A polynomial over GF(p) on words; `None` over other fields.
pub fn to_flat<F: Field>(ring: &PolynomialRing<F>, packing: &Packing, f: &Polynomial<F::Element>) -> Option<Flat> {
    let word = |term: &Term<F::Element>| match ring.field().prime_element(&term.coefficient)? {
        PrimeElement::Residue(value) => Some((key(ring, packing, term), value)),
        PrimeElement::Rational(_) => None,
    };
    let mut terms = f.terms().iter().map(word).collect::<Option<Vec<_>>>()?;
    terms.sort_unstable_by_key(|term| Reverse(term.0));
    let (keys, values) = terms.into_iter().unzip();
    Some(Flat { keys, values })
}

/// A polynomial over Q as a rational number times a primitive integer polynomial; `None` over other fields.
pub fn to_integral<F: Field>(
    ring: &PolynomialRing<F>,
    packing: &Packing,
    f: &Polynomial<F::Element>,
) -> Option<(Integral, BigRational)> {
    let number = |term| match ring.field().prime_element(term)? {
        PrimeElement::Rational(value) => Some(value),
        PrimeElement::Residue(_) => None,
    };
    let numbers = f.terms().iter().map(|term| number(&term.coefficient)).collect::<Option<Vec<_>>>()?;
    let denominator =
        numbers.iter().fold(BigInt::one(), |lcm, q| if q.is_integer() { lcm } else { lcm.lcm(q.denom()) });
    let integer = |q: &BigRational| {
        if denominator.is_one() { q.numer().clone() } else { q.numer() * (&denominator / q.denom()) }
    };
    let keys = f.terms().iter().map(|term| key(ring, packing, term));
    let mut terms: Vec<_> = keys.zip(numbers.iter().map(|q| integer(q))).collect();
    terms.sort_unstable_by_key(|term| Reverse(term.0));
    let (keys, values) = terms.into_iter().unzip();
    let (primitive, content) = Integral { keys, values }.primitive();
    Some((primitive, BigRational::new(content, denominator)))
}

/// Converts back to the ring. `map` converts the coefficients.
fn unpack<F: Field, C>(
    ring: &PolynomialRing<F>,
    packing: &Packing,
    terms: impl Iterator<Item = (u128, C)>,
    map: impl Fn(C) -> F::Element,
) -> Polynomial<F::Element> {
    let mut exponents = vec![0; packing.variables()];
    let term = |(key, value)| {
        exponents.iter_mut().enumerate().for_each(|(v, exponent)| *exponent = packing.exponent(key, v));
        let monomial = ring.layout().pack(&exponents).expect("a divisor of a polynomial of the ring");
        Term { coefficient: map(value), monomial }
    };
    let mut terms: Vec<_> = terms.map(term).collect();
    terms.sort_unstable_by(|a, b| ring.layout().compare(&b.monomial, &a.monomial));
    Polynomial { terms }
}

/// Converts a polynomial over GF(p) back to the ring.
pub fn from_flat<F: Field>(ring: &PolynomialRing<F>, packing: &Packing, f: &Flat) -> Polynomial<F::Element> {
    unpack(ring, packing, f.terms(), |value| ring.field().from_integer(&BigInt::from(value)))
}

/// The polynomial `scale f` over Q.
pub fn from_integral<F: Field>(
    ring: &PolynomialRing<F>,
    packing: &Packing,
    f: &Integral,
    scale: &BigRational,
) -> Polynomial<F::Element> {
    let number = |value: &BigInt| if scale.is_one() { BigRational::from_integer(value.clone()) } else { scale * value };
    let terms = f.keys.iter().copied().zip(&f.values);
    unpack(ring, packing, terms, |value| ring.field().from_rational(&number(value)).expect("a field of rationals"))
}

/// The leading coefficient of a nonzero polynomial over Q.
pub fn leading_number<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> Option<BigRational> {
    match ring.field().prime_element(&f.leading()?.coefficient)? {
        PrimeElement::Rational(number) => Some(number.clone()),
        PrimeElement::Residue(_) => None,
    }
}
