//! Sparse multivariate polynomials over any field.

use std::collections::HashMap;
use std::sync::Arc;

use super::monomial::{Layout, Monomial, Width};
use super::order::Order;
use crate::number::{Field, Ring};
use crate::{Error, ErrorKind, Result};

/// Threshold for collecting products of terms. They are collected when there are this many, or twice as many as
/// distinct monomials so far.
const UNCOLLECTED: usize = 1 << 18;

/// One term: a nonzero coefficient and its monomial.
#[derive(Clone, Debug, PartialEq)]
pub struct Term<E> {
    /// The nonzero coefficient.
    pub coefficient: E,
    /// The packed exponents.
    pub monomial: Monomial,
}

/// A polynomial: nonzero terms in strictly descending monomial order. Plain data of a [`PolynomialRing`].
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial<E> {
    pub(super) terms: Vec<Term<E>>,
}

impl<E> Polynomial<E> {
    /// The terms, greatest first.
    pub fn terms(&self) -> &[Term<E>] {
        &self.terms
    }

    /// The leading term, `None` for zero.
    pub fn leading(&self) -> Option<&Term<E>> {
        self.terms.first()
    }

    /// Removes and returns the leading term; `None` for zero.
    pub(crate) fn take_leading(&mut self) -> Option<Term<E>> {
        (!self.terms.is_empty()).then(|| self.terms.remove(0))
    }

    /// Whether this is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }
}

/// The ring `F[x1, ..., xn]` with a monomial order; variables are listed greatest first.
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialRing<F: Field> {
    field: F,
    variables: Arc<[String]>,
    layout: Layout,
}

impl<F: Field> PolynomialRing<F> {
    /// Builds the ring over `field` in `variables` (greatest first) with 16-bit exponent lanes.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`] when a variable is listed twice or has the name of a field element;
    /// [`ErrorKind::BadValue`] when a block order does not cover the variables.
    pub fn new<S: AsRef<str>>(field: F, variables: &[S], order: Order) -> Result<Self> {
        let names: Vec<String> = variables.iter().map(|name| name.as_ref().to_owned()).collect();
        for (index, name) in names.iter().enumerate() {
            if names[..index].contains(name) || field.generator(name).is_some() {
                let text = format!("variable `{name}` is already taken; give each variable its own name");
                return Err(Error::new(ErrorKind::DuplicateName, text));
            }
        }
        if let Order::Block(blocks) = &order
            && blocks.iter().map(|block| block.size).sum::<usize>() != names.len()
        {
            let text = format!("order {order} does not cover the {} variables", names.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let layout = Layout::new(names.len(), Width::Bits16, order);
        Ok(PolynomialRing { field, variables: names.into(), layout })
    }

    /// Same ring, but with another lane width.
    #[must_use]
    pub fn with_width(&self, width: Width) -> Self {
        let layout = Layout::new(self.layout.variables(), width, self.layout.order().clone());
        PolynomialRing { layout, ..self.clone() }
    }

    /// The ring of the same monomials over another field. No element of the field has the name of a variable.
    pub(crate) fn over<G: Field>(&self, field: G) -> PolynomialRing<G> {
        debug_assert!(self.variables.iter().all(|name| field.generator(name).is_none()));
        PolynomialRing { field, variables: self.variables.clone(), layout: self.layout.clone() }
    }

    /// The coefficient field.
    pub fn field(&self) -> &F {
        &self.field
    }

    /// The variables' names, greatest first.
    pub fn variables(&self) -> &[String] {
        &self.variables
    }

    /// The layout of the monomials, which includes their order.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Builds a polynomial from `terms` in any order. Like terms are collected.
    pub fn collect(&self, terms: impl IntoIterator<Item = Term<F::Element>>) -> Polynomial<F::Element> {
        let mut sums: HashMap<Monomial, F::Element> = HashMap::new();
        for Term { coefficient, monomial } in terms {
            match sums.get_mut(&monomial) {
                Some(sum) => *sum = self.field.add(sum, &coefficient),
                None => drop(sums.insert(monomial, coefficient)),
            }
        }
        let nonzero = sums.into_iter().filter(|(_, coefficient)| !self.field.is_zero(coefficient));
        let mut terms: Vec<_> = nonzero.map(|(monomial, coefficient)| Term { coefficient, monomial }).collect();
        terms.sort_by(|a, b| self.layout.compare(&b.monomial, &a.monomial));
        Polynomial { terms }
    }

    /// Builds a polynomial from nonzero `terms` that are already in descending monomial order.
    pub(crate) fn descending(&self, terms: Vec<Term<F::Element>>) -> Polynomial<F::Element> {
        let f = Polynomial { terms };
        debug_assert!(self.is_sorted(&f), "terms descend and none is zero");
        f
    }

    /// The constant polynomial `c`.
    pub fn constant(&self, c: F::Element) -> Polynomial<F::Element> {
        self.term(c, self.layout.one())
    }

    /// The polynomial of one term (zero when `c` is zero).
    pub fn term(&self, c: F::Element, monomial: Monomial) -> Polynomial<F::Element> {
        let terms = if self.field.is_zero(&c) { Vec::new() } else { vec![Term { coefficient: c, monomial }] };
        Polynomial { terms }
    }

    /// The variable with this index.
    ///
    /// # Panics
    /// When there is no such variable.
    pub fn variable(&self, index: usize) -> Polynomial<F::Element> {
        let mut exponents = vec![0; self.variables.len()];
        exponents[index] = 1;
        let monomial = self.layout.pack(&exponents).expect("degree one always fits");
        self.term(self.field.one(), monomial)
    }

    /// The index of the variable called `name`.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.variables.iter().position(|variable| variable == name)
    }

    /// The value of `f`, if it is a constant.
    pub fn as_constant(&self, f: &Polynomial<F::Element>) -> Option<F::Element> {
        match f.terms.as_slice() {
            [] => Some(self.field.zero()),
            [term] if self.layout.degree(&term.monomial) == 0 => Some(term.coefficient.clone()),
            _ => None,
        }
    }

    /// The total degree; 0 for constants and for zero.
    pub fn degree(&self, f: &Polynomial<F::Element>) -> u32 {
        f.terms.iter().map(|term| self.layout.degree(&term.monomial)).max().unwrap_or(0)
    }

    /// The degree in one variable; 0 for zero.
    pub fn degree_in(&self, f: &Polynomial<F::Element>, variable: usize) -> u32 {
        f.terms.iter().map(|term| self.layout.exponent(&term.monomial, variable)).max().unwrap_or(0)
    }

    /// `c f`.
    pub fn scale(&self, f: &Polynomial<F::Element>, c: &F::Element) -> Polynomial<F::Element> {
        if self.field.is_zero(c) {
            return self.zero();
        }
        let scaled = |term: &Term<F::Element>| Term {
            coefficient: self.field.mul(&term.coefficient, c),
            monomial: term.monomial.clone(),
        };
        Polynomial { terms: f.terms.iter().map(scaled).collect() }
    }

    /// `c m f`.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when the degree does not fit the lanes.
    pub fn mul_term(&self, f: &Polynomial<F::Element>, c: &F::Element, m: &Monomial) -> Result<Polynomial<F::Element>> {
        let product = |term: &Term<F::Element>| {
            let monomial = self.layout.checked_mul(&term.monomial, m).ok_or_else(|| self.overflow())?;
            Ok(Term { coefficient: self.field.mul(&term.coefficient, c), monomial })
        };
        Ok(Polynomial { terms: f.terms.iter().map(product).collect::<Result<_>>()? })
    }

    /// `f - c m g`.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when the degree does not fit the lanes.
    pub(crate) fn sub_mul_term(
        &self,
        f: &Polynomial<F::Element>,
        c: &F::Element,
        m: &Monomial,
        g: &Polynomial<F::Element>,
    ) -> Result<Polynomial<F::Element>> {
        Ok(self.add(f, &self.mul_term(g, &self.field.neg(c), m)?))
    }

    /// `f g`.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when the degree does not fit the lanes.
    pub fn checked_mul(
        &self,
        f: &Polynomial<F::Element>,
        g: &Polynomial<F::Element>,
    ) -> Result<Polynomial<F::Element>> {
        let (short, long) = if f.terms.len() <= g.terms.len() { (f, g) } else { (g, f) };
        match short.terms.as_slice() {
            [] => Ok(self.zero()),
            [term] => self.mul_term(long, &term.coefficient, &term.monomial),
            _ => {
                let mut room = short.terms.len().saturating_mul(long.terms.len()).min(UNCOLLECTED);
                let mut products = Vec::with_capacity(room);
                for term in &short.terms {
                    products.extend(self.mul_term(long, &term.coefficient, &term.monomial)?.terms);
                    // Most of these products have few distinct monomials.
                    if products.len() > room {
                        products = self.collect(products).terms;
                        room = products.len().saturating_mul(2).max(UNCOLLECTED);
                    }
                }
                Ok(self.collect(products))
            }
        }
    }

    /// `f` with leading coefficient one; zero stays zero.
    pub fn monic(&self, f: &Polynomial<F::Element>) -> Polynomial<F::Element> {
        match f.leading().and_then(|term| self.field.inverse(&term.coefficient)) {
            Some(inverse) => self.scale(f, &inverse),
            None => f.clone(),
        }
    }

    /// `f / g` when `g` divides `f` exactly, else `None`; `None` for `g = 0`.
    pub fn exact_div(&self, f: &Polynomial<F::Element>, g: &Polynomial<F::Element>) -> Option<Polynomial<F::Element>> {
        let lead = g.leading()?;
        let inverse = self.field.inverse(&lead.coefficient)?;
        if g.terms.len() == 1 && self.layout.degree(&lead.monomial) == 0 {
            return Some(self.scale(f, &inverse));
        }
        let (mut rest, mut quotient) = (f.clone(), Vec::new());
        while let Some(term) = rest.leading() {
            let monomial = self.layout.checked_div(&term.monomial, &lead.monomial)?;
            let coefficient = self.field.mul(&term.coefficient, &inverse);
            rest = self.sub_mul_term(&rest, &coefficient, &monomial, g).ok()?;
            quotient.push(Term { coefficient, monomial });
        }
        Some(Polynomial { terms: quotient })
    }

    /// The least common multiple of two monomials.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when its degree does not fit the lanes.
    pub(crate) fn lcm(&self, a: &Monomial, b: &Monomial) -> Result<Monomial> {
        self.layout.lcm(a, b).ok_or_else(|| self.overflow())
    }

    /// Whether `f` satisfies the invariants of this ring: monomials in its layout, descending, without zero
    /// coefficients.
    pub fn is_well_formed(&self, f: &Polynomial<F::Element>) -> bool {
        let packed = |term: &Term<F::Element>| self.layout.is_packed(&term.monomial);
        f.terms.iter().all(packed) && self.is_sorted(f)
    }

    /// Whether the terms are descending without zero coefficients.
    pub(super) fn is_sorted(&self, f: &Polynomial<F::Element>) -> bool {
        let descending = |pair: &[Term<F::Element>]| self.layout.compare(&pair[0].monomial, &pair[1].monomial).is_gt();
        f.terms.windows(2).all(descending) && f.terms.iter().all(|term| !self.field.is_zero(&term.coefficient))
    }

    /// The monomial with these exponents, one for each variable.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when the degree does not fit the lanes.
    pub fn monomial(&self, exponents: &[u32]) -> Result<Monomial> {
        self.layout.pack(exponents).ok_or_else(|| self.overflow())
    }

    pub(super) fn overflow(&self) -> Error {
        let limit = self.layout.width().max_degree();
        Error::new(ErrorKind::Overflow, format!("a monomial's degree exceeds {limit}, the limit of this ring"))
    }
}
