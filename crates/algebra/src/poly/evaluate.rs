//! Evaluation of an [`Expression`] in any [`Ring`], or in floating point.

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::Expression;
use crate::number::Ring;
use crate::{Error, ErrorKind, Result};

impl Expression {
    /// Evaluates the expression in `ring`. The names are generators of the ring.
    ///
    /// The ring expands powers and products. The caller limits the work with [`Expression::expansion_bound`].
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a name that `ring` does not have; [`ErrorKind::BadValue`] for a divisor (or the
    /// denominator of a number) that has no inverse in `ring`.
    pub fn evaluate<R: Ring>(&self, ring: &R) -> Result<R::Element> {
        self.evaluate_with(ring, &|_| None)
    }

    /// Same as [`Expression::evaluate`], but a name for which `values` has an element is replaced by that element.
    ///
    /// # Errors
    /// Those of [`Expression::evaluate`].
    #[doc(hidden)]
    pub fn evaluate_with<R: Ring>(&self, ring: &R, values: &dyn Fn(&str) -> Option<R::Element>) -> Result<R::Element> {
        match self {
            Expression::Number(q) => number_in(ring, q),
            Expression::Name(name) => values(name).or_else(|| ring.generator(name)).ok_or_else(|| unknown(name)),
            Expression::Negation(a) => Ok(ring.neg(&a.evaluate_with(ring, values)?)),
            Expression::Inverse(a) => divided(ring, &ring.one(), a, values),
            Expression::Sum(terms) => {
                let terms = terms.iter().map(|term| term.evaluate_with(ring, values));
                Ok(sum_in(ring, terms.collect::<Result<_>>()?))
            }
            Expression::Product(factors) => factors.iter().try_fold(ring.one(), |product, factor| match factor {
                Expression::Inverse(a) => divided(ring, &product, a, values),
                _ => Ok(ring.mul(&product, &factor.evaluate_with(ring, values)?)),
            }),
            Expression::Power(a, n) => Ok(ring.pow(&a.evaluate_with(ring, values)?, *n)),
        }
    }

    /// Evaluates the expression in floating point, from left to right. A division by zero gives an infinity or NaN, as
    /// in IEEE 754.
    pub fn evaluate_f64(&self, values: &dyn Fn(&str) -> Option<f64>) -> Result<f64> {
        match self {
            Expression::Number(q) => Ok(q.to_f64().unwrap_or(f64::NAN)),
            Expression::Name(name) => values(name).ok_or_else(|| unknown(name)),
            Expression::Negation(a) => Ok(-a.evaluate_f64(values)?),
            Expression::Inverse(a) => Ok(1.0 / a.evaluate_f64(values)?),
            Expression::Sum(terms) => terms.iter().try_fold(0.0, |sum, term| Ok(sum + term.evaluate_f64(values)?)),
            Expression::Product(factors) => factors.iter().try_fold(1.0, |product, factor| match factor {
                Expression::Inverse(a) => Ok(product / a.evaluate_f64(values)?),
                _ => Ok(product * factor.evaluate_f64(values)?),
            }),
            Expression::Power(a, n) => Ok(a.evaluate_f64(values)?.powi(i32::try_from(*n).unwrap_or(i32::MAX))),
        }
    }

    /// An upper bound of the total degree of the expanded polynomial. Divisors count like factors.
    pub fn degree_bound(&self) -> u64 {
        match self {
            Expression::Number(_) => 0,
            Expression::Name(_) => 1,
            Expression::Negation(a) | Expression::Inverse(a) => a.degree_bound(),
            Expression::Sum(parts) => parts.iter().map(Expression::degree_bound).max().unwrap_or(0),
            Expression::Product(parts) => parts.iter().map(Expression::degree_bound).fold(0, u64::saturating_add),
            Expression::Power(a, n) => a.degree_bound().saturating_mul(u64::from(*n)),
        }
    }

    /// Upper bounds on the expanded polynomial, with names as variables. A caller refuses too large an expansion before
    /// it evaluates.
    pub fn expansion_bound(&self) -> ExpansionBound {
        let size = self.size();
        ExpansionBound { terms: size.terms, bits: size.numerator + size.denominator }
    }

    fn size(&self) -> Size {
        match self {
            Expression::Number(q) => {
                let denominator = if q.is_integer() { 0 } else { q.denom().bits() };
                Size { terms: 1.0, numerator: q.numer().bits() as f64, denominator: denominator as f64 }
            }
            Expression::Name(_) => Size::ONE,
            Expression::Negation(a) => a.size(),
            Expression::Inverse(a) => a.size().inverse(),
            Expression::Sum(terms) => Size::sum(&terms.iter().map(Expression::size).collect::<Vec<_>>()),
            Expression::Product(factors) => factors.iter().map(Expression::size).fold(Size::ONE, Size::product),
            Expression::Power(a, n) => a.size().power(*n),
        }
    }
}

/// Bounds on an expanded polynomial. They are infinite when they exceed a double.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ExpansionBound {
    /// The number of terms.
    pub terms: f64,
    /// The bits of a coefficient: its numerator and the common denominator of all coefficients together.
    pub bits: f64,
}

/// Bounds on a polynomial: its number of terms, the bits of a numerator, the bits of the common denominator.
#[derive(Clone, Copy)]
struct Size {
    terms: f64,
    numerator: f64,
    denominator: f64,
}

impl Size {
    const ONE: Size = Size { terms: 1.0, numerator: 0.0, denominator: 0.0 };

    fn inverse(self) -> Size {
        Size { terms: self.terms, numerator: self.denominator, denominator: self.numerator }
    }

    fn sum(parts: &[Size]) -> Size {
        let denominator: f64 = parts.iter().map(|part| part.denominator).sum();
        let scaled = parts.iter().map(|part| part.numerator + denominator - part.denominator);
        let carry = (parts.len().max(1) as f64).log2();
        let terms = parts.iter().map(|part| part.terms).sum();
        Size { terms, numerator: scaled.fold(0.0, f64::max) + carry, denominator }
    }

    fn product(self, other: Size) -> Size {
        let carry = self.terms.min(other.terms).max(1.0).log2();
        let numerator = self.numerator + other.numerator + carry;
        Size { terms: self.terms * other.terms, numerator, denominator: self.denominator + other.denominator }
    }

    /// One term for each multiset of `n` terms, and at most `terms^n` products in one coefficient.
    fn power(self, n: u32) -> Size {
        let n = f64::from(n);
        let (choices, count) = (n.min(self.terms - 1.0), n.max(self.terms - 1.0));
        let (mut terms, mut k) = (1.0_f64, 1.0_f64);
        while k <= choices && terms.is_finite() {
            terms *= (count + k) / k;
            k += 1.0;
        }
        let numerator = n * (self.numerator + self.terms.max(1.0).log2());
        Size { terms, numerator, denominator: n * self.denominator }
    }
}

fn unknown(name: &str) -> Error {
    let shown: String = name.chars().take(40).collect();
    Error::new(ErrorKind::UnknownName, format!("`{shown}` is not declared here; declare it or correct its spelling"))
}

fn number_in<R: Ring>(ring: &R, q: &BigRational) -> Result<R::Element> {
    let numerator = ring.from_integer(q.numer());
    if q.is_integer() {
        return Ok(numerator);
    }
    ring.checked_div(&numerator, &ring.from_integer(q.denom())).ok_or_else(|| no_inverse(&q.denom().to_string()))
}

fn divided<R: Ring>(
    ring: &R,
    dividend: &R::Element,
    divisor: &Expression,
    values: &dyn Fn(&str) -> Option<R::Element>,
) -> Result<R::Element> {
    let value = divisor.evaluate_with(ring, values)?;
    ring.checked_div(dividend, &value).ok_or_else(|| no_inverse(&divisor.to_string()))
}

fn no_inverse(divisor: &str) -> Error {
    let shown: String = divisor.chars().take(40).collect();
    let text =
        format!("division by `{shown}`, which is zero or has no inverse here; multiply the equation by it instead");
    Error::new(ErrorKind::BadValue, text)
}

/// Adds neighbours until one is left, so that sums with many terms take `n log n` steps.
fn sum_in<R: Ring>(ring: &R, mut terms: Vec<R::Element>) -> R::Element {
    while terms.len() > 1 {
        terms = terms.chunks(2).map(|pair| pair.iter().skip(1).fold(pair[0].clone(), |a, b| ring.add(&a, b))).collect();
    }
    terms.pop().unwrap_or_else(|| ring.zero())
}
