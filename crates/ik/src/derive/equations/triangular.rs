//! A lexicographic basis as a triangular form that gives one unknown at a time.
//!
//! The polynomials of a zero-dimensional lexicographic basis are grouped by their greatest unknown. The theorem of Gianni and Kalkbrener (EUROCAL 1987) applies
//! to each solution of the smaller unknowns. The first polynomial of a group whose leading coefficient does not vanish there has exactly the continuations of
//! that solution as its roots. So no candidate is lost, and none is spurious.

use std::fmt;

use num_traits::{One, Signed};

use crate::derive::equations::setting::{ParameterPoly, Poly, Unknowns};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{BigInt, BigRational, Field, Ring, Style};
use groebot_algebra::poly::{Fraction, Polynomial, gcd};

/// The polynomials that determine one unknown from the smaller ones.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stair {
    /// Index of the unknown in the ring.
    pub unknown: usize,
    /// The polynomials whose greatest unknown it is, smallest leading monomial first. They are primitive, without denominators.
    pub polynomials: Vec<Poly>,
}

/// A system solved one unknown at a time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Triangular {
    /// The ring, its variables greatest first, lexicographic.
    pub ring: Unknowns,
    /// One stair per unknown, the smallest unknown first.
    pub stairs: Vec<Stair>,
}

/// Groups a reduced zero-dimensional lexicographic basis by unknowns.
///
/// # Errors
/// [`ErrorKind::PositiveDimensional`] if some unknown has no polynomial.
pub(crate) fn triangularise(ring: &Unknowns, basis: &[Poly]) -> Result<Triangular> {
    let count = ring.variables().len();
    let mut groups: Vec<Vec<Poly>> = vec![Vec::new(); count];
    for f in basis {
        match (0..count).find(|&v| ring.degree_in(f, v) > 0) {
            Some(v) => groups[v].push(cleared(ring, f)),
            None => return Err(Error::new(ErrorKind::Inconsistent, "a constant is not a triangular form")),
        }
    }
    let mut stairs = Vec::new();
    for (unknown, mut polynomials) in groups.into_iter().enumerate().rev() {
        polynomials.sort_by(|a, b| match (a.leading(), b.leading()) {
            (Some(x), Some(y)) => ring.layout().compare(&x.monomial, &y.monomial),
            _ => std::cmp::Ordering::Equal,
        });
        if polynomials.is_empty() {
            let text = format!("no polynomial determines `{}`", ring.variables()[unknown]);
            return Err(Error::new(ErrorKind::PositiveDimensional, text));
        }
        stairs.push(Stair { unknown, polynomials });
    }
    Ok(Triangular { ring: ring.clone(), stairs })
}

impl Triangular {
    /// The degree of each stair's last polynomial, smallest unknown first.
    pub fn degrees(&self) -> Vec<u32> {
        let degree = |stair: &Stair| stair.polynomials.iter().map(|f| self.ring.degree_in(f, stair.unknown)).max();
        self.stairs.iter().map(|stair| degree(stair).unwrap_or(0)).collect()
    }

    /// The maximum number of solutions of the triangular form.
    pub fn bound(&self) -> usize {
        self.degrees().iter().map(|&degree| degree as usize).product()
    }
}

impl fmt::Display for Triangular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (stair, degree) in self.stairs.iter().zip(self.degrees()) {
            let name = &self.ring.variables()[stair.unknown];
            let method = match degree {
                1 => "linear: one value".to_owned(),
                2 => "quadratic: up to two real roots, closed form".to_owned(),
                3 | 4 => format!("degree {degree}: up to {degree} real roots, algebraic closed form"),
                _ => format!("degree {degree}: real-root isolation"),
            };
            writeln!(f, "{name}  ({method})")?;
            for polynomial in &stair.polynomials {
                writeln!(f, "    {} = 0", presented(&self.ring, polynomial))?;
            }
        }
        Ok(())
    }
}

/// A multiple of `f` with integer coefficients without common factor, and a positive leading one. All common factors of the coefficients are removed, also
/// polynomials of the parameters.
pub(crate) fn cleared(ring: &Unknowns, f: &Poly) -> Poly {
    let field = ring.field();
    let ground = field.ring();
    let (f, _) = clear_denominators(ring, f);
    let parts = f.terms().iter().flat_map(|term| field.parts_over_roots(term.coefficient.numerator()));
    let content = parts.fold(ground.zero(), |content, part| gcd(ground, &content, &part));
    match field.inverse(&field.embed(&content)) {
        Some(inverse) => oriented(ring, &ring.scale(&f, &inverse)),
        None => f,
    }
}

/// `f` times the least common multiple of its coefficients' denominators, and that multiple.
pub(crate) fn clear_denominators(ring: &Unknowns, f: &Poly) -> (Poly, ParameterPoly) {
    let field = ring.field();
    let ground = field.ring();
    let mut common = ground.one();
    for term in f.terms() {
        let denominator = term.coefficient.denominator();
        let shared = gcd(ground, &common, denominator);
        let rest = ground.exact_div(denominator, &shared).expect("a gcd divides");
        common = ground.mul(&common, &rest);
    }
    (ring.scale(f, &field.embed(&common)), common)
}

/// A cleared polynomial in the notation of the sources: `20580*c4 - px^2 - pz^2 + 20588.41`. It is divided by the largest power of ten that leaves no
/// coefficient below one.
pub(crate) fn presented(ring: &Unknowns, f: &Poly) -> String {
    let numbers = f.terms().iter().flat_map(|term| term.coefficient.numerator().terms());
    let least = numbers.map(|term| term.coefficient.abs()).min().unwrap_or_else(BigRational::one);
    let ten = BigRational::from_integer(BigInt::from(10));
    let mut divisor = BigRational::one();
    while &divisor * &ten <= least {
        divisor *= &ten;
    }
    let field = ring.field();
    let factor = field.embed(&field.ring().constant(divisor.recip()));
    ring.format(&ring.scale(f, &factor), Style::Decimal)
}

/// A multiple with integer coefficients without common factor, and a positive leading constant.
fn oriented(ring: &Unknowns, f: &Poly) -> Poly {
    let numbers = number_content(f.terms().iter().map(|term| term.coefficient.numerator()));
    let lead = f.leading().and_then(|term| term.coefficient.numerator().leading());
    let negative = lead.is_some_and(|term| term.coefficient.numer().sign() == num_bigint::Sign::Minus);
    let factor = if negative { -numbers.recip() } else { numbers.recip() };
    let factor = |field: &crate::derive::equations::setting::Coefficients| -> Fraction<BigRational> {
        field.embed(&field.ring().constant(factor.clone()))
    };
    ring.scale(f, &factor(ring.field()))
}

/// The positive rational number whose division gives integer coefficients without common factor; one for no polynomial.
fn number_content<'a>(polynomials: impl Iterator<Item = &'a ParameterPoly>) -> BigRational {
    let (mut top, mut bottom) = (BigInt::from(0), BigInt::from(1));
    for term in polynomials.flat_map(Polynomial::terms) {
        top = num_integer::gcd(top, term.coefficient.numer().clone());
        bottom = num_integer::lcm(bottom, term.coefficient.denom().clone());
    }
    if top == BigInt::from(0) { BigRational::from_integer(BigInt::from(1)) } else { BigRational::new(top, bottom) }
}
