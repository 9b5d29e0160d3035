//! Dense univariate polynomials over any field: [`UnivariateRing`] is the ring, [`Univariate`] its elements.
//!
//! Source: von zur Gathen and Gerhard, Modern Computer Algebra, 3rd edition (2013), chapters 2, 3, 6 and 14.

use crate::number::{BigInt, Field, Ring, Style};

/// A polynomial as plain data: the coefficient of `x^i` has index `i`.
///
/// The last coefficient is never zero, so the zero polynomial is empty. [`UnivariateRing::polynomial`] ensures this.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Univariate<E> {
    /// The coefficients, constant term first, without trailing zeros.
    pub coefficients: Vec<E>,
}

impl<E> Univariate<E> {
    /// The degree; `None` for the zero polynomial.
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    /// The coefficient of the highest power; `None` for the zero polynomial.
    pub fn leading(&self) -> Option<&E> {
        self.coefficients.last()
    }
}

/// The ring `F[x]` of polynomials in one variable over the field `F`.
#[derive(Clone, Debug, PartialEq)]
pub struct UnivariateRing<F: Field> {
    field: F,
    variable: String,
}

/// An element of [`UnivariateRing<F>`].
type Element<F> = Univariate<<F as Ring>::Element>;

impl<F: Field> UnivariateRing<F> {
    /// Builds the ring of polynomials over `field` in one variable with the name `variable`.
    pub fn new(field: F, variable: impl Into<String>) -> Self {
        UnivariateRing { field, variable: variable.into() }
    }

    /// The field of the coefficients.
    pub fn field(&self) -> &F {
        &self.field
    }

    /// Builds the polynomial with these coefficients, constant term first. Trailing zeros are dropped.
    pub fn polynomial(&self, mut coefficients: Vec<F::Element>) -> Element<F> {
        while coefficients.last().is_some_and(|c| self.field.is_zero(c)) {
            coefficients.pop();
        }
        Univariate { coefficients }
    }

    /// The polynomial `a x^n`.
    pub fn monomial(&self, a: F::Element, n: usize) -> Element<F> {
        let mut coefficients = vec![self.field.zero(); n];
        coefficients.push(a);
        self.polynomial(coefficients)
    }

    /// `a` times a field element.
    pub fn scale(&self, a: &Element<F>, by: &F::Element) -> Element<F> {
        self.polynomial(a.coefficients.iter().map(|c| self.field.mul(c, by)).collect())
    }

    /// `a` divided by its leading coefficient; zero stays zero.
    pub(crate) fn monic(&self, a: &Element<F>) -> Element<F> {
        match a.leading().and_then(|leading| self.field.inverse(leading)) {
            Some(inverse) => self.scale(a, &inverse),
            None => a.clone(),
        }
    }

    /// Quotient and remainder: `a = q b + r` with `deg r < deg b`; `None` when `b` is zero.
    pub fn div_rem(&self, a: &Element<F>, b: &Element<F>) -> Option<(Element<F>, Element<F>)> {
        let inverse = self.field.inverse(b.leading()?)?;
        let low = &b.coefficients[..b.coefficients.len() - 1];
        let mut rest = a.coefficients.clone();
        let mut quotient = Vec::new();
        while rest.len() > low.len() {
            let factor = self.field.mul(&rest.pop()?, &inverse);
            let shift = rest.len() - low.len();
            for (target, c) in rest[shift..].iter_mut().zip(low) {
                *target = self.field.sub(target, &self.field.mul(&factor, c));
            }
            quotient.push(factor);
        }
        quotient.reverse();
        Some((self.polynomial(quotient), self.polynomial(rest)))
    }

    /// The monic greatest common divisor (Euclid's algorithm with monic remainders); zero only for two zeros.
    pub fn gcd(&self, a: &Element<F>, b: &Element<F>) -> Element<F> {
        let (mut a, mut b) = (self.monic(a), self.monic(b));
        while let Some((_, rest)) = self.div_rem(&a, &b) {
            a = b;
            b = self.monic(&rest);
        }
        a
    }

    /// The formal derivative.
    pub fn derivative(&self, a: &Element<F>) -> Element<F> {
        let indexed = a.coefficients.iter().enumerate().skip(1);
        self.polynomial(indexed.map(|(i, c)| self.field.mul(&self.field.from_integer(&BigInt::from(i)), c)).collect())
    }

    /// The monic product of the distinct irreducible factors, `a / gcd(a, a')`; zero stays zero.
    ///
    /// `None` when the characteristic is positive and at most the degree, because `a'` may vanish then.
    pub fn square_free_part(&self, a: &Element<F>) -> Option<Element<F>> {
        let p = self.field.characteristic();
        let Some(degree) = a.degree() else { return Some(a.clone()) };
        if p > 0 && p <= degree as u64 {
            return None;
        }
        let (quotient, _) = self.div_rem(a, &self.gcd(a, &self.derivative(a)))?;
        Some(self.monic(&quotient))
    }

    /// The value of `a` at `x`, by Horner's rule.
    pub fn evaluate(&self, a: &Element<F>, x: &F::Element) -> F::Element {
        let horner = |value, c| self.field.add(&self.field.mul(&value, x), c);
        a.coefficients.iter().rev().fold(self.field.zero(), horner)
    }

    /// The resultant, `lc(a)^deg(b)` times the product of the values of `b` at the roots of `a`; zero when either is
    /// zero.
    ///
    /// Uses `res(a, b) = (-1)^(deg a deg b) lc(b)^(deg a - deg r) res(b, r)` for `r = a mod b`.
    pub fn resultant(&self, a: &Element<F>, b: &Element<F>) -> F::Element {
        let (mut a, mut b, mut factor) = (a.clone(), b.clone(), self.field.one());
        while let (Some(m), Some(n), Some(leading)) = (a.degree(), b.degree(), b.leading()) {
            if n == 0 {
                return self.field.mul(&factor, &self.field.pow(leading, m as u32));
            }
            let Some((_, rest)) = self.div_rem(&a, &b) else { break };
            let Some(k) = rest.degree() else { break };
            factor = self.field.mul(&factor, &self.field.pow(leading, (m - k) as u32));
            if m * n % 2 == 1 {
                factor = self.field.neg(&factor);
            }
            a = b;
            b = rest;
        }
        self.field.zero()
    }

    /// One term without a leading plus; `c` is not zero.
    fn format_term(&self, c: &F::Element, n: usize, style: Style) -> String {
        let power = match (n, style) {
            (0, _) => return self.field.format(c, style),
            (1, _) => self.variable.clone(),
            (_, Style::Text | Style::Decimal) => format!("{}^{n}", self.variable),
            (_, Style::Latex) => format!("{}^{{{n}}}", self.variable),
        };
        if self.field.is_one(c) {
            return power;
        }
        if self.field.is_one(&self.field.neg(c)) {
            return format!("-{power}");
        }
        let text = self.field.format(c, style);
        let is_sum = text.chars().skip(1).any(|character| matches!(character, '+' | '-'));
        match style {
            Style::Text | Style::Decimal if is_sum => format!("({text})*{power}"),
            Style::Text | Style::Decimal => format!("{text}*{power}"),
            Style::Latex if is_sum => format!("\\left({text}\\right){power}"),
            Style::Latex => format!("{text}{power}"),
        }
    }
}

impl<F: Field> Ring for UnivariateRing<F> {
    type Element = Univariate<F::Element>;

    fn zero(&self) -> Self::Element {
        Univariate { coefficients: Vec::new() }
    }
    fn one(&self) -> Self::Element {
        self.monomial(self.field.one(), 0)
    }
    fn from_integer(&self, n: &BigInt) -> Self::Element {
        self.monomial(self.field.from_integer(n), 0)
    }
    fn add(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        let (long, short) = if a.coefficients.len() < b.coefficients.len() { (b, a) } else { (a, b) };
        let mut sum = long.coefficients.clone();
        for (target, c) in sum.iter_mut().zip(&short.coefficients) {
            *target = self.field.add(target, c);
        }
        self.polynomial(sum)
    }
    fn neg(&self, a: &Self::Element) -> Self::Element {
        Univariate { coefficients: a.coefficients.iter().map(|c| self.field.neg(c)).collect() }
    }
    fn mul(&self, a: &Self::Element, b: &Self::Element) -> Self::Element {
        let (Some(m), Some(n)) = (a.degree(), b.degree()) else { return self.zero() };
        let mut product = vec![self.field.zero(); m + n + 1];
        for (i, x) in a.coefficients.iter().enumerate() {
            for (target, y) in product[i..].iter_mut().zip(&b.coefficients) {
                *target = self.field.add(target, &self.field.mul(x, y));
            }
        }
        self.polynomial(product)
    }
    fn is_zero(&self, a: &Self::Element) -> bool {
        debug_assert!(a.leading().is_none_or(|c| !self.field.is_zero(c)), "trailing zero in {a:?}");
        a.coefficients.is_empty()
    }
    /// The exact quotient; `None` when `b` is zero or does not divide `a`.
    fn checked_div(&self, a: &Self::Element, b: &Self::Element) -> Option<Self::Element> {
        let (quotient, rest) = self.div_rem(a, b)?;
        self.is_zero(&rest).then_some(quotient)
    }
    fn format(&self, a: &Self::Element, style: Style) -> String {
        let mut text = String::new();
        for (n, c) in a.coefficients.iter().enumerate().rev().filter(|(_, c)| !self.field.is_zero(c)) {
            let term = self.format_term(c, n, style);
            match term.strip_prefix('-') {
                _ if text.is_empty() => text = term,
                Some(rest) => text = format!("{text} - {rest}"),
                None => text = format!("{text} + {term}"),
            }
        }
        if text.is_empty() { "0".into() } else { text }
    }
    /// The variable by its name, else a generator of the field.
    fn generator(&self, name: &str) -> Option<Self::Element> {
        if name == self.variable {
            return Some(self.monomial(self.field.one(), 1));
        }
        self.field.generator(name).map(|c| self.monomial(c, 0))
    }
}
