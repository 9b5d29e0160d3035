//! Greatest common divisors of multivariate polynomials over a field.
//!
//! Over Q and GF(p) the gcd is computed from images at points and modulo primes ([`modular`], [`rational`]) and proved
//! by division. Other fields, and small fields with too few points, use primitive remainder sequences ([`reference`]).

pub(super) mod modular;
pub(super) mod rational;
pub(super) mod reference;

use self::modular::Search;
use super::ring::{Polynomial, PolynomialRing};
use super::words::{Extension, Flat, Packing, Prime, convert};
use crate::number::{Field, PrimeElement, Ring};
use crate::{Result, Watch};

pub(super) use reference::split_monomial;

/// Sizes of extensions of GF(p) in which points are chosen when GF(p) has too few, in the order of trial.
const POINTS: [u64; 3] = [1 << 8, 1 << 12, 1 << 16];

/// A greatest common divisor of two polynomials and their cofactors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Common<T> {
    pub gcd: T,
    pub left: T,
    pub right: T,
}

/// The monic greatest common divisor of `f` and `g`; zero only for two zeros.
pub fn gcd<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Polynomial<F::Element> {
    gcd_within(ring, f, g, &Watch::none()).expect("nothing stops it")
}

/// Same as [`gcd`], but `watch` can stop it.
pub(super) fn gcd_within<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
    watch: &Watch,
) -> Result<Polynomial<F::Element>> {
    Ok(common_within(ring, f, g, watch)?.gcd)
}

/// The monic greatest common divisor of `f` and `g`, not both zero, and its cofactors.
pub(super) fn common<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Common<Polynomial<F::Element>> {
    common_within(ring, f, g, &Watch::none()).expect("nothing stops it")
}

/// Same as [`common`], but `watch` can stop it. The remainder sequences of small fields do not check `watch`.
pub(super) fn common_within<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
    watch: &Watch,
) -> Result<Common<Polynomial<F::Element>>> {
    if let Some(found) = trivial(ring, f, g).or_else(|| by_images(ring, f, g, watch)) {
        return Ok(found);
    }
    watch.check()?;
    let gcd = reference::gcd(ring, f, g);
    let [left, right] = [f, g].map(|part| ring.exact_div(part, &gcd).expect("a gcd divides"));
    Ok(Common { gcd, left, right })
}

/// The gcd of the coefficients of `f` as a polynomial in `variable`.
pub(super) fn content<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    variable: usize,
    watch: &Watch,
) -> Result<Polynomial<F::Element>> {
    let mut coefficients = ring.coefficients_in(f, variable);
    coefficients.sort_by_key(|c| c.terms().len());
    let mut content = ring.zero();
    for coefficient in &coefficients {
        content = gcd_within(ring, &content, coefficient, watch)?;
        if ring.is_one(&content) {
            break;
        }
    }
    Ok(content)
}

/// The result when one of the two is zero or constant, or both are equal.
fn trivial<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
) -> Option<Common<Polynomial<F::Element>>> {
    let lead = |h: &Polynomial<F::Element>| {
        h.leading().map_or_else(|| ring.zero(), |term| ring.constant(term.coefficient.clone()))
    };
    if g.is_zero() || f == g {
        let right = if g.is_zero() { ring.zero() } else { lead(g) };
        return Some(Common { gcd: ring.monic(f), left: lead(f), right });
    }
    if f.is_zero() {
        return Some(Common { gcd: ring.monic(g), left: ring.zero(), right: lead(g) });
    }
    let constant = ring.as_constant(f).is_some() || ring.as_constant(g).is_some();
    constant.then(|| Common { gcd: ring.one(), left: f.clone(), right: g.clone() })
}

/// The result over Q and GF(p); `None` over other fields, or when the images were unlucky repeatedly.
fn by_images<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
    watch: &Watch,
) -> Option<Common<Polynomial<F::Element>>> {
    let first = ring.field().prime_element(&f.leading()?.coefficient)?;
    let packing = convert::packing(ring, &[f, g])?;
    match first {
        PrimeElement::Rational(_) => rational::common_in(ring, &packing, f, g, watch),
        PrimeElement::Residue(_) => {
            let [a, b] = [convert::to_flat(ring, &packing, f)?, convert::to_flat(ring, &packing, g)?];
            let found = over_prime(ring.field().characteristic(), &packing, [&a, &b], watch)?;
            Some(in_ring(ring, &packing, found))
        }
    }
}

/// The result over GF(p). A gcd is unchanged in an extension of the field.
fn over_prime(p: u64, packing: &Packing, [f, g]: [&Flat; 2], watch: &Watch) -> Option<Common<Flat>> {
    POINTS.iter().find_map(|&points| match (1..).find(|&k| p.saturating_pow(k) >= points)? {
        1 => Search::new(&Prime::new(p), packing, watch).repeated(f, g),
        degree => Search::new(&Extension::new(p, degree)?, packing, watch).repeated(f, g),
    })
}

/// The monic gcd in the ring's own order, and its cofactors.
fn in_ring<F: Field>(
    ring: &PolynomialRing<F>,
    packing: &Packing,
    found: Common<Flat>,
) -> Common<Polynomial<F::Element>> {
    let [gcd, left, right] = [&found.gcd, &found.left, &found.right].map(|f| convert::from_flat(ring, packing, f));
    let lead = gcd.leading().expect("a gcd is not zero").coefficient.clone();
    Common { gcd: ring.monic(&gcd), left: ring.scale(&left, &lead), right: ring.scale(&right, &lead) }
}
