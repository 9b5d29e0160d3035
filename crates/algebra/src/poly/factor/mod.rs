//! Factorization of polynomials into coprime, square-free and irreducible factors.
//!
//! [`factor`] works over Q and GF(p). It separates powers by derivatives ([`square_free`]) and contents by gcds.
//! Square-free primitive polynomials are factored by Hensel lifting ([`lift`]) of the factors of an image in one
//! variable. These come from [`finite`] (Cantor and Zassenhaus) or [`integers`] (Zassenhaus).

mod coprime;
mod finite;
mod integers;
mod lift;
mod over_finite;
mod over_integers;
mod series;
mod square_free;

pub use coprime::{refine_factors, square_free_factors};

use num_traits::One;

use self::over_finite::split_over_prime;
use self::over_integers::split_over_integers;
use super::gcd::{content, gcd_within};
use super::ring::{Polynomial, PolynomialRing};
use super::words::convert;
use crate::number::{BigRational, Field, Ring, Style};
use crate::{Error, ErrorKind, Result, Watch};

/// A polynomial as a constant times powers of irreducible polynomials.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Factorisation<E> {
    /// The leading coefficient of the polynomial.
    pub unit: E,
    /// Monic irreducible polynomials, pairwise different, each with its multiplicity. They are sorted by multiplicity,
    /// degree, number of terms, and text.
    pub factors: Vec<(Polynomial<E>, u32)>,
}

impl<E: Clone> Factorisation<E> {
    /// The product of the factors: the polynomial that was factored.
    pub fn product<F: Field<Element = E>>(&self, ring: &PolynomialRing<F>) -> Polynomial<E>
    where
        E: std::fmt::Debug + PartialEq,
    {
        let unit = ring.constant(self.unit.clone());
        self.factors.iter().fold(unit, |product, (f, n)| ring.mul(&product, &ring.pow(f, *n)))
    }
}

/// Factors a nonzero `f` over Q or GF(p) into irreducible polynomials.
///
/// # Errors
/// [`ErrorKind::BadValue`] for zero; [`ErrorKind::Unsupported`] over other fields, and over one with too few points for
/// the degrees of `f`; [`ErrorKind::Overflow`] when the exponents of a term do not fit 128 bits; the error with which
/// `watch` stops the work.
pub fn factor<'w, F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Factorisation<F::Element>> {
    let watch = Watch::or_none(watch);
    let Some(lead) = f.leading() else {
        return Err(Error::new(ErrorKind::BadValue, "zero has no factorisation; give a nonzero polynomial"));
    };
    if ring.field().prime_element(&lead.coefficient).is_none() {
        return Err(unsupported());
    }
    let mut factors = Vec::new();
    for (part, multiplicity) in square_free::powers(ring, f, watch)? {
        watch.check()?;
        factors.extend(irreducible_factors(ring, &part, watch)?.into_iter().map(|factor| (factor, multiplicity)));
    }
    factors.sort_by_cached_key(|(f, n)| (*n, ring.degree(f), f.terms().len(), ring.format(f, Style::Text)));
    let found = Factorisation { unit: lead.coefficient.clone(), factors };
    debug_assert_eq!(&found.product(ring), f);
    Ok(found)
}

/// The monic irreducible factors of a square-free polynomial.
fn irreducible_factors<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    watch: &Watch,
) -> Result<Vec<Polynomial<F::Element>>> {
    let Some(main) = main_variable(ring, f) else { return Ok(Vec::new()) };
    let content = content(ring, f, main, watch)?;
    let mut factors = irreducible_factors(ring, &content, watch)?;
    let f = ring.monic(&ring.exact_div(f, &content).expect("a content divides"));
    let inseparable = inseparable_part(ring, &f, main, watch)?;
    factors.extend(irreducible_factors(ring, &inseparable, watch)?);
    let f = ring.monic(&ring.exact_div(&f, &inseparable).expect("a gcd divides"));
    if ring.degree_in(&f, main) == 1 {
        factors.push(f);
    } else {
        factors.extend(split(ring, &f, main, watch)?);
    }
    Ok(factors)
}

/// The product of the factors of a square-free `f` whose derivative in `variable` vanishes.
fn inseparable_part<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    variable: usize,
    watch: &Watch,
) -> Result<Polynomial<F::Element>> {
    let p = ring.field().characteristic();
    if p == 0 || p > u64::from(ring.degree_in(f, variable)) {
        return Ok(ring.one());
    }
    gcd_within(ring, f, &ring.derivative(f, variable), watch)
}

/// Chooses the main variable: of degree one, else the one with the shortest leading coefficient. The derivative in it
/// is not zero. `None` for a constant.
fn main_variable<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> Option<usize> {
    let separable = (0..ring.variables().len()).filter(|&v| !ring.derivative(f, v).is_zero());
    separable.min_by_key(|&v| {
        let degree = ring.degree_in(f, v);
        let leading = f.terms().iter().filter(|term| ring.layout().exponent(&term.monomial, v) == degree);
        (degree > 1, leading.count(), degree)
    })
}

/// The monic irreducible factors of a square-free polynomial that is primitive in `main`.
fn split<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    main: usize,
    watch: &Watch,
) -> Result<Vec<Polynomial<F::Element>>> {
    let packing = convert::packing(ring, &[f]).ok_or_else(too_wide)?;
    let one = BigRational::one();
    let factors: Vec<_> = if let Some(flat) = convert::to_flat(ring, &packing, f) {
        let factors = split_over_prime(ring.field().characteristic(), &packing, &flat, main, watch)?;
        factors.iter().map(|factor| convert::from_flat(ring, &packing, factor)).collect()
    } else {
        let (integral, _) = convert::to_integral(ring, &packing, f).ok_or_else(unsupported)?;
        let factors = split_over_integers(&packing, &integral, main, watch)?;
        factors.iter().map(|factor| convert::from_integral(ring, &packing, factor, &one)).collect()
    };
    Ok(factors.iter().map(|factor| ring.monic(factor)).collect())
}

fn unsupported() -> Error {
    Error::new(ErrorKind::Unsupported, "factorisation works over the rationals and over GF(p) only")
}

fn too_wide() -> Error {
    Error::new(ErrorKind::Overflow, "the exponents of a term do not fit 128 bits; use fewer variables or lower degrees")
}
