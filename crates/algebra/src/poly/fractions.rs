//! Rational functions of parameters as a field, with square-root relations between the parameters.
//!
//! A relation `v^2 = e` makes `v` algebraic over the parameters before it. Examples are the sine of an angle whose
//! cosine is a parameter (`v^2 = 1 - c^2`), and a constant such as `sqrt(1/2)`. Numerators are reduced modulo the
//! relations and denominators are free of algebraic parameters. So equal elements have equal data, and a relation
//! between parameters is never used as a unit.

use super::gcd::{common, gcd};
use super::order::Order;
use super::ring::{Polynomial, PolynomialRing};
use crate::number::{BigInt, Field, Ring, Style};
use crate::{Error, ErrorKind, Result};

/// A rational function in lowest terms with a monic denominator. Plain data of [`Fractions`].
#[derive(Clone, Debug, PartialEq)]
pub struct Fraction<E> {
    numerator: Polynomial<E>,
    denominator: Polynomial<E>,
}

impl<E> Fraction<E> {
    /// The numerator.
    pub fn numerator(&self) -> &Polynomial<E> {
        &self.numerator
    }
    /// The monic denominator, free of algebraic parameters.
    pub fn denominator(&self) -> &Polynomial<E> {
        &self.denominator
    }
}

/// `v^2 = square`, where `square` uses parameters before `v` only.
#[derive(Clone, Debug, PartialEq)]
struct Relation<E> {
    variable: usize,
    square: Polynomial<E>,
}

/// The field of fractions of `F[p1, ..., pk]` modulo its square-root relations.
#[derive(Clone, Debug, PartialEq)]
pub struct Fractions<F: Field> {
    ring: PolynomialRing<F>,
    relations: Vec<Relation<F::Element>>,
}

impl<F: Field> Fractions<F> {
    /// Builds the field of rational functions of `parameters` over `field`.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`] when a parameter is listed twice.
    pub fn new<S: AsRef<str>>(field: F, parameters: &[S]) -> Result<Self> {
        let ring = PolynomialRing::new(field, parameters, Order::GrevLex)?;
        Ok(Fractions { ring, relations: Vec::new() })
    }

    /// Adds the relation `variable^2 = square`. The caller ensures that `square` is not yet a square, so that the ideal
    /// of the relations is prime. Otherwise some inverses do not exist.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when there is no such parameter, when `square` uses `variable` or a later parameter or
    /// is zero modulo the relations before, or when relations are not added in the order of their variables.
    #[doc(hidden)]
    pub fn with_square(mut self, variable: usize, square: &Polynomial<F::Element>) -> Result<Self> {
        let names = self.ring.variables();
        let Some(name) = names.get(variable) else {
            let text = format!("there is no parameter {variable}; there are {}, counted from 0", names.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        };
        let uses_later = (variable..names.len()).any(|v| self.ring.degree_in(square, v) > 0);
        let ordered = self.relations.last().is_none_or(|relation| relation.variable < variable);
        let square = self.reduce(square);
        if uses_later || !ordered || square.is_zero() {
            let text = format!("the square of `{name}` must be a nonzero polynomial of the parameters before it");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        self.relations.push(Relation { variable, square });
        Ok(self)
    }

    /// The polynomial ring of numerators and denominators.
    pub fn ring(&self) -> &PolynomialRing<F> {
        &self.ring
    }

    /// Whether `variable` is algebraic over the parameters before it.
    pub fn is_algebraic(&self, variable: usize) -> bool {
        self.relations.iter().any(|relation| relation.variable == variable)
    }

    /// The relations: a parameter and the polynomial equal to its square.
    pub(crate) fn squares(&self) -> impl Iterator<Item = (usize, &Polynomial<F::Element>)> {
        self.relations.iter().map(|relation| (relation.variable, &relation.square))
    }

    /// Reduces `f` modulo the relations: every algebraic parameter has exponent 0 or 1 afterwards.
    #[doc(hidden)]
    pub fn reduce(&self, f: &Polynomial<F::Element>) -> Polynomial<F::Element> {
        self.relations.iter().rev().fold(f.clone(), |f, relation| {
            if self.ring.degree_in(&f, relation.variable) < 2 {
                return f;
            }
            let root = self.ring.variable(relation.variable);
            let powers = self.ring.coefficients_in(&f, relation.variable).into_iter().enumerate();
            powers.fold(self.ring.zero(), |sum, (k, coefficient)| {
                let even = self.ring.mul(&coefficient, &self.ring.pow(&relation.square, k as u32 / 2));
                let part = if k % 2 == 1 { self.ring.mul(&even, &root) } else { even };
                self.ring.add(&sum, &part)
            })
        })
    }

    /// The polynomial `f` of the parameters as an element of the field.
    pub fn embed(&self, f: &Polynomial<F::Element>) -> Fraction<F::Element> {
        Fraction { numerator: self.reduce(f), denominator: self.ring.one() }
    }

    /// `numerator / denominator` in canonical form; `None` when the denominator is zero.
    pub fn fraction(
        &self,
        numerator: &Polynomial<F::Element>,
        denominator: &Polynomial<F::Element>,
    ) -> Option<Fraction<F::Element>> {
        let (mut top, mut bottom) = (self.reduce(numerator), self.reduce(denominator));
        for relation in self.relations.iter().rev() {
            if self.ring.degree_in(&bottom, relation.variable) > 0 {
                let conjugate = self.conjugate(&bottom, relation.variable);
                top = self.reduce(&self.ring.mul(&top, &conjugate));
                bottom = self.reduce(&self.ring.mul(&bottom, &conjugate));
            }
        }
        (!bottom.is_zero()).then(|| self.lowest_terms(top, bottom))
    }

    /// `numerator / denominator` for coprime arguments. The denominator is monic and free of algebraic parameters.
    pub(crate) fn coprime_fraction(
        &self,
        numerator: Polynomial<F::Element>,
        denominator: Polynomial<F::Element>,
    ) -> Fraction<F::Element> {
        debug_assert!(self.fraction(&numerator, &denominator).is_some_and(|a| a.denominator == denominator));
        Fraction { numerator, denominator }
    }

    /// Replaces the root `variable` by its negative in a reduced `f`.
    fn conjugate(&self, f: &Polynomial<F::Element>, variable: usize) -> Polynomial<F::Element> {
        let parts = self.ring.coefficients_in(f, variable);
        let root = self.ring.variable(variable);
        self.ring.sub(&parts[0], &self.ring.mul(&parts[1], &root))
    }

    /// Divides by the common factor of the denominator and all coefficients of the numerator with respect to the roots.
    fn lowest_terms(
        &self,
        numerator: Polynomial<F::Element>,
        denominator: Polynomial<F::Element>,
    ) -> Fraction<F::Element> {
        let (top, bottom) = self.cancel(numerator, denominator);
        let lead = &bottom.leading().expect("a denominator is not zero").coefficient;
        let inverse = self.ring.field().inverse(lead).expect("a leading coefficient is not zero");
        Fraction { numerator: self.ring.scale(&top, &inverse), denominator: self.ring.scale(&bottom, &inverse) }
    }

    /// Divides `f` and `divisor` by their common factor. `divisor` is free of roots.
    fn cancel(
        &self,
        f: Polynomial<F::Element>,
        divisor: Polynomial<F::Element>,
    ) -> (Polynomial<F::Element>, Polynomial<F::Element>) {
        if self.relations.is_empty() {
            let common = common(&self.ring, &f, &divisor);
            return (common.left, common.right);
        }
        let shared = self.shared_factor(&f, &divisor);
        if self.ring.is_one(&shared) {
            return (f, divisor);
        }
        (self.divided(&f, &shared), self.divided(&divisor, &shared))
    }

    /// The gcd of `divisor` and all coefficients of `f` with respect to the roots. `divisor` is free of roots.
    fn shared_factor(&self, f: &Polynomial<F::Element>, divisor: &Polynomial<F::Element>) -> Polynomial<F::Element> {
        let mut parts = self.parts_over_roots(f);
        parts.sort_by_key(|part| part.terms().len());
        parts.iter().fold(self.ring.monic(divisor), |common, part| gcd(&self.ring, &common, part))
    }

    fn divided(&self, f: &Polynomial<F::Element>, divisor: &Polynomial<F::Element>) -> Polynomial<F::Element> {
        self.ring.exact_div(f, divisor).expect("a gcd divides")
    }

    /// The sum for different denominators. Only a common factor of the denominators can cancel (Henrici 1956; Knuth
    /// 4.5.1).
    fn add_unlike(&self, a: &Fraction<F::Element>, b: &Fraction<F::Element>) -> Fraction<F::Element> {
        let denominators = common(&self.ring, &a.denominator, &b.denominator);
        let (left, right) = (denominators.left, denominators.right);
        let sum = self.ring.add(&self.ring.mul(&a.numerator, &right), &self.ring.mul(&b.numerator, &left));
        let (numerator, shared) = self.cancel(sum, denominators.gcd);
        Fraction { numerator, denominator: self.ring.mul(&self.ring.mul(&left, &right), &shared) }
    }

    /// The product after cancelling crosswise. A product of roots may require one more cancellation.
    fn mul_crosswise(&self, a: &Fraction<F::Element>, b: &Fraction<F::Element>) -> Fraction<F::Element> {
        let (a_top, b_bottom) = self.cancel(a.numerator.clone(), b.denominator.clone());
        let (b_top, a_bottom) = self.cancel(b.numerator.clone(), a.denominator.clone());
        let (top, bottom) = (self.ring.mul(&a_top, &b_top), self.ring.mul(&a_bottom, &b_bottom));
        let reduced = self.reduce(&top);
        if reduced == top {
            return Fraction { numerator: reduced, denominator: bottom };
        }
        self.lowest_terms(reduced, bottom)
    }

    /// The coefficients of `f` as a polynomial in the algebraic parameters.
    #[doc(hidden)]
    pub fn parts_over_roots(&self, f: &Polynomial<F::Element>) -> Vec<Polynomial<F::Element>> {
        self.relations.iter().fold(vec![f.clone()], |parts, relation| {
            parts.iter().flat_map(|part| self.ring.coefficients_in(part, relation.variable)).collect()
        })
    }

    /// The element as a constant of the base field, if it is one.
    pub fn as_constant(&self, a: &Fraction<F::Element>) -> Option<F::Element> {
        self.ring.as_constant(&a.denominator)?;
        self.ring.as_constant(&a.numerator)
    }
}

impl<F: Field> Ring for Fractions<F> {
    type Element = Fraction<F::Element>;

    fn zero(&self) -> Self::Element {
        self.embed(&self.ring.zero())
    }
    fn one(&self) -> Self::Element {
        self.embed(&self.ring.one())
    }
    fn from_integer(&self, n: &BigInt) -> Self::Element {
        self.embed(&self.ring.from_integer(n))
    }
    fn add(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        if a.denominator == b.denominator {
            let sum = self.ring.add(&a.numerator, &b.numerator);
            return if self.ring.is_one(&a.denominator) {
                Fraction { numerator: sum, denominator: a.denominator.clone() }
            } else {
                self.lowest_terms(sum, a.denominator.clone())
            };
        }
        self.add_unlike(a, b)
    }
    fn neg(&self, a: &Self::Element) -> Self::Element {
        Fraction { numerator: self.ring.neg(&a.numerator), denominator: a.denominator.clone() }
    }
    fn mul(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        if self.ring.is_one(&a.denominator) && self.ring.is_one(&b.denominator) {
            let numerator = self.reduce(&self.ring.mul(&a.numerator, &b.numerator));
            return Fraction { numerator, denominator: a.denominator.clone() };
        }
        self.mul_crosswise(a, b)
    }
    fn is_zero(&self, a: &Self::Element) -> bool {
        a.numerator.is_zero()
    }
    fn checked_div(&self, a: &Self::Element, b: &Self::Element) -> Option<Self::Element> {
        let numerator = self.ring.mul(&a.numerator, &b.denominator);
        self.fraction(&numerator, &self.ring.mul(&a.denominator, &b.numerator))
    }
    fn format(&self, a: &Self::Element, style: Style) -> String {
        let numerator = self.ring.format(&a.numerator, style);
        if self.ring.is_one(&a.denominator) {
            return numerator;
        }
        let denominator = self.ring.format(&a.denominator, style);
        match style {
            Style::Text | Style::Decimal => format!("({numerator})/({denominator})"),
            Style::Latex => format!("\\frac{{{numerator}}}{{{denominator}}}"),
        }
    }
    fn generator(&self, name: &str) -> Option<Self::Element> {
        self.ring.generator(name).map(|f| self.embed(&f))
    }
}

impl<F: Field> Field for Fractions<F> {
    fn characteristic(&self) -> u64 {
        self.ring.field().characteristic()
    }
}
