//! A polynomial ring as a [`Ring`]: sums, products and printed elements.

use std::cmp::Ordering;

use super::print::format_polynomial;
use super::ring::{Polynomial, PolynomialRing, Term};
use crate::number::{BigInt, Field, Ring, Style};

impl<F: Field> Ring for PolynomialRing<F> {
    type Element = Polynomial<F::Element>;

    fn zero(&self) -> Self::Element {
        Polynomial { terms: Vec::new() }
    }
    fn one(&self) -> Self::Element {
        self.constant(self.field().one())
    }
    fn from_integer(&self, n: &BigInt) -> Self::Element {
        self.constant(self.field().from_integer(n))
    }
    fn add(&self, f: &Self::Element, g: &Self::Element) -> Self::Element {
        let mut terms = Vec::with_capacity(f.terms.len() + g.terms.len());
        let (mut left, mut right) = (f.terms.iter().peekable(), g.terms.iter().peekable());
        while let (Some(a), Some(b)) = (left.peek(), right.peek()) {
            match self.layout().compare(&a.monomial, &b.monomial) {
                Ordering::Greater => terms.extend(left.next().cloned()),
                Ordering::Less => terms.extend(right.next().cloned()),
                Ordering::Equal => {
                    let coefficient = self.field().add(&a.coefficient, &b.coefficient);
                    if !self.field().is_zero(&coefficient) {
                        terms.push(Term { coefficient, monomial: a.monomial.clone() });
                    }
                    left.next();
                    right.next();
                }
            }
        }
        terms.extend(left.chain(right).cloned());
        let sum = Polynomial { terms };
        debug_assert!(self.is_sorted(&sum));
        sum
    }
    fn neg(&self, f: &Self::Element) -> Self::Element {
        let negated = |term: &Term<F::Element>| Term {
            coefficient: self.field().neg(&term.coefficient),
            monomial: term.monomial.clone(),
        };
        Polynomial { terms: f.terms.iter().map(negated).collect() }
    }
    /// The product. A degree that overflows the lanes panics, like integer overflow. Engines and readers use
    /// [`PolynomialRing::checked_mul`].
    ///
    /// # Panics
    /// When the degree exceeds that of the ring's [`Width`](super::Width).
    fn mul(&self, f: &Self::Element, g: &Self::Element) -> Self::Element {
        self.checked_mul(f, g).unwrap_or_else(|error| panic!("{error}"))
    }
    fn is_zero(&self, f: &Self::Element) -> bool {
        f.is_zero()
    }
    fn checked_div(&self, f: &Self::Element, g: &Self::Element) -> Option<Self::Element> {
        self.exact_div(f, g)
    }
    fn format(&self, f: &Self::Element, style: Style) -> String {
        format_polynomial(self, f, style)
    }
    fn generator(&self, name: &str) -> Option<Self::Element> {
        let variable = self.index_of(name).map(|index| self.variable(index));
        variable.or_else(|| self.field().generator(name).map(|element| self.constant(element)))
    }
}
