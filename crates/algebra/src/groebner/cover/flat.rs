//! The equations as polynomials in unknowns and parameters together, and their leading coefficients in the parameters.
//!
//! Source: Kapur, Sun and Wang, "A new algorithm for computing comprehensive Groebner systems", ISSAC 2010, theorem
//! 4.3.

use super::ideals::{Ideal, groebner};
use crate::groebner::normal_form;
use crate::number::{Field, Ring};
use crate::poly::{Block, Fractions, Monomial, Order, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

type Unknowns<F> = PolynomialRing<Fractions<F>>;
type Parametric<F> = Polynomial<<Fractions<F> as Ring>::Element>;
type Poly<F> = Polynomial<<F as Ring>::Element>;

/// `F[unknowns, parameters]` in an order that compares the unknowns first.
#[derive(Clone, Debug)]
pub(super) struct Flat<F: Field> {
    unknowns: Unknowns<F>,
    ring: PolynomialRing<F>,
    generators: Vec<Poly<F>>,
}

/// A leading monomial of the unknowns with all polynomials that have it. A polynomial represents the basis element
/// where its leading coefficient is not zero.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Head<E> {
    pub monomial: Monomial,
    pub representatives: Vec<Polynomial<E>>,
}

/// A basis over unknowns and parameters, split by its leading monomials.
#[derive(Clone, Debug)]
pub(super) struct Parts<E> {
    /// The elements in the parameters alone.
    pub conditions: Ideal<E>,
    /// The minimal leading monomials of the other elements.
    pub heads: Vec<Head<E>>,
}

impl<F: Field> Flat<F> {
    /// Builds the flat form of `generators`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a coefficient with a denominator.
    pub fn new(unknowns: &Unknowns<F>, generators: &[Parametric<F>]) -> Result<Self> {
        let ground = unknowns.field().ring();
        let names: Vec<&String> = unknowns.variables().iter().chain(ground.variables()).collect();
        let order = Order::Block(blocks(unknowns.layout().order(), unknowns.variables().len(), ground));
        let ring = PolynomialRing::new(ground.field().clone(), &names, order)?;
        let mut flat = Flat { unknowns: unknowns.clone(), ring, generators: Vec::new() };
        flat.generators = generators.iter().map(|f| flat.flattened(f)).collect::<Result<_>>()?;
        Ok(flat)
    }

    /// The ring of the unknowns over the rational functions of the parameters.
    pub fn unknowns(&self) -> &Unknowns<F> {
        &self.unknowns
    }

    /// The polynomial 1.
    pub fn one(&self) -> Poly<F> {
        self.ring.one()
    }

    fn parameters(&self) -> &PolynomialRing<F> {
        self.unknowns.field().ring()
    }

    fn flattened(&self, f: &Parametric<F>) -> Result<Poly<F>> {
        let mut terms = Vec::new();
        for term in f.terms() {
            if !self.parameters().is_one(term.coefficient.denominator()) {
                let text = self.unknowns.field().format(&term.coefficient, crate::number::Style::Text);
                let text = format!("the coefficient {text} has a denominator; multiply the equation by it");
                return Err(Error::new(ErrorKind::BadValue, text));
            }
            let mut exponents = self.unknowns.layout().exponents(&term.monomial);
            exponents.resize(self.ring.variables().len(), 0);
            let coefficient = self.parameters().transfer(term.coefficient.numerator(), &self.ring)?;
            let product =
                self.ring.mul_term(&coefficient, &self.ring.field().one(), &self.ring.monomial(&exponents)?)?;
            terms.extend_from_slice(product.terms());
        }
        Ok(self.ring.collect(terms))
    }

    /// The reduced basis of the equations under the `conditions` on the parameters, split by leading monomials.
    pub fn basis(&self, conditions: &[Poly<F>], watch: &Watch) -> Result<Parts<F::Element>> {
        let mut parts = Parts { conditions: Vec::new(), heads: Vec::new() };
        for f in groebner(&self.ring, &self.system(conditions)?, watch)? {
            let monomial = self.leading_monomial(&f)?;
            if self.unknowns.layout().degree(&monomial) == 0 {
                parts.conditions.push(self.ring.transfer(&f, self.parameters())?);
                continue;
            }
            match parts.heads.iter_mut().find(|head| head.monomial == monomial) {
                Some(head) => head.representatives.push(f),
                None => parts.heads.push(Head { monomial, representatives: vec![f] }),
            }
        }
        parts.heads = self.minimal(parts.heads);
        Ok(parts)
    }

    /// Polynomials of the parameters that multiply `f` into the ideal of the equations and the `conditions`. Where one
    /// of them is not zero, `f` belongs to that ideal.
    pub fn multipliers(&self, conditions: &[Poly<F>], f: &Parametric<F>, watch: &Watch) -> Result<Ideal<F::Element>> {
        let f = self.flattened(f)?;
        let ideal = groebner(&self.ring, &self.system(conditions)?, watch)?;
        if normal_form(&self.ring, &f, &ideal)?.is_zero() {
            return Ok(vec![self.parameters().one()]);
        }
        let quotient = groebner(&self.ring, &self.quotient(&ideal, &f, watch)?, watch)?;
        let mut multipliers = Vec::new();
        for g in quotient {
            if self.unknowns.layout().degree(&self.leading_monomial(&g)?) == 0 {
                multipliers.push(self.ring.transfer(&g, self.parameters())?);
            }
        }
        Ok(multipliers)
    }

    /// Generators of the ideal quotient by `f`: the elements of `t ideal + (1 - t) f` without `t`, divided by `f`.
    fn quotient(&self, ideal: &[Poly<F>], f: &Poly<F>, watch: &Watch) -> Result<Vec<Poly<F>>> {
        if self.ring.as_constant(f).is_some() {
            return Ok(ideal.to_vec());
        }
        let fresh = (0..).map(|k| format!("t{k}")).find(|name| self.ring.generator(name).is_none());
        let mut names = vec![fresh.expect("there are infinitely many names")];
        names.extend_from_slice(self.ring.variables());
        let order = Order::elimination(1, names.len());
        let ring = PolynomialRing::new(self.ring.field().clone(), &names, order)?;
        let t = ring.variable(0);
        let mut system = vec![ring.checked_mul(&ring.sub(&ring.one(), &t), &self.ring.transfer(f, &ring)?)?];
        for g in ideal {
            system.push(ring.checked_mul(&t, &self.ring.transfer(g, &ring)?)?);
        }
        let shared = groebner(&ring, &system, watch)?;
        let shared = shared.iter().filter(|g| ring.degree_in(g, 0) == 0);
        let divided = |g| Ok(self.ring.exact_div(&ring.transfer(g, &self.ring)?, f).expect("a common multiple"));
        shared.map(divided).collect()
    }

    fn system(&self, conditions: &[Poly<F>]) -> Result<Vec<Poly<F>>> {
        let mut system = self.generators.clone();
        for f in conditions {
            system.push(self.parameters().transfer(f, &self.ring)?);
        }
        Ok(system)
    }

    /// The heads whose monomials no other monomial divides: the minimal Dickson basis.
    fn minimal(&self, heads: Vec<Head<F::Element>>) -> Vec<Head<F::Element>> {
        let layout = self.unknowns.layout();
        let divided = |head: &Head<F::Element>| {
            heads.iter().any(|other| other.monomial != head.monomial && layout.divides(&other.monomial, &head.monomial))
        };
        heads.iter().filter(|head| !divided(head)).cloned().collect()
    }

    fn leading_monomial(&self, f: &Poly<F>) -> Result<Monomial> {
        let lead = f.leading().expect("a basis element is not zero");
        self.unknowns.monomial(&self.ring.layout().exponents(&lead.monomial)[..self.unknowns.variables().len()])
    }

    /// The leading coefficients of the representatives of `head`: polynomials of the parameters.
    pub fn leading_coefficients(&self, head: &Head<F::Element>) -> Result<Vec<Poly<F>>> {
        head.representatives.iter().map(|f| self.leading_coefficient(f)).collect()
    }

    fn leading_coefficient(&self, f: &Poly<F>) -> Result<Poly<F>> {
        let first = self.lift(f)?.take_leading();
        Ok(first.expect("a basis element is not zero").coefficient.numerator().clone())
    }

    /// Converts `f` to a polynomial in the unknowns with the parameters in its coefficients.
    pub fn lift(&self, f: &Poly<F>) -> Result<Parametric<F>> {
        let count = self.unknowns.variables().len();
        let mut parts: Vec<(Monomial, Vec<Term<F::Element>>)> = Vec::new();
        for term in f.terms() {
            let exponents = self.ring.layout().exponents(&term.monomial);
            let monomial = self.unknowns.monomial(&exponents[..count])?;
            let part = Term {
                coefficient: term.coefficient.clone(),
                monomial: self.parameters().monomial(&exponents[count..])?,
            };
            match parts.last_mut() {
                Some((last, terms)) if *last == monomial => terms.push(part),
                _ => parts.push((monomial, vec![part])),
            }
        }
        let coefficient = |terms| self.unknowns.field().embed(&self.parameters().collect(terms));
        Ok(self
            .unknowns
            .collect(parts.into_iter().map(|(monomial, terms)| Term { coefficient: coefficient(terms), monomial })))
    }
}

/// The blocks of the unknowns' order, followed by the parameters.
fn blocks<F: Field>(order: &Order, unknowns: usize, parameters: &PolynomialRing<F>) -> Vec<Block> {
    let mut blocks = match order {
        Order::Lex => vec![Block { size: unknowns, graded: false }],
        Order::GrevLex => vec![Block { size: unknowns, graded: true }],
        Order::Block(blocks) => blocks.clone(),
    };
    blocks.push(Block { size: parameters.variables().len(), graded: true });
    blocks.retain(|block| block.size > 0);
    blocks
}
