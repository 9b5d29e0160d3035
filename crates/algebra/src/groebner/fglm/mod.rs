//! The quotient ring of a zero-dimensional ideal by linear algebra: change of order, elimination, minimal polynomials.
//!
//! [`Quotient`] works over any field; [`WordQuotient`] does the same modulo primes below 2^31 on machine words.
//! [`change_order`] chooses the fastest algorithm there.
//!
//! J.-C. Faugere, P. Gianni, D. Lazard, T. Mora, "Efficient computation of zero-dimensional Groebner bases by change of
//! ordering", J. Symbolic Computation 16 (1993).

mod echelon;
mod staircase;
mod word;

pub use word::{WordQuotient, change_order};

use std::collections::HashMap;

use self::echelon::Echelon;
use self::staircase::{Origin, Product, Staircase, Walk};
use super::division::inverse;
use super::{Basis, normal_form};
use crate::number::Field;
use crate::poly::univariate::Univariate;
use crate::poly::{Monomial, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

/// The action of the variables on the quotient ring of a zero-dimensional ideal.
#[derive(Clone, Debug)]
pub struct Quotient<F: Field> {
    ring: PolynomialRing<F>,
    stairs: Staircase,
    /// The normal form of each border monomial, in coordinates.
    forms: Vec<Vec<F::Element>>,
}

impl<F: Field> Quotient<F> {
    /// Computes the multiplication matrices of the quotient ring by `basis`.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] or [`ErrorKind::Inconsistent`] when the quotient is not finite or is zero;
    /// [`ErrorKind::Overflow`].
    pub fn new(basis: &Basis<F>) -> Result<Self> {
        basis.require_zero_dimensional()?;
        let stairs = Staircase::new(basis)?;
        let mut ascending: Vec<usize> = (0..stairs.border.len()).collect();
        let layout = basis.ring.layout();
        ascending.sort_by(|&a, &b| layout.compare(&stairs.border[a], &stairs.border[b]));
        let forms = vec![Vec::new(); stairs.border.len()];
        let mut quotient = Quotient { ring: basis.ring.clone(), stairs, forms };
        let indices = indices(&quotient.stairs.standard);
        for border in ascending {
            quotient.forms[border] = match quotient.stairs.origins[border] {
                Origin::Lead(index) => coordinates(&indices, &lead_tail(basis, index, &indices)?, &quotient.ring),
                Origin::Multiple(variable, smaller) => quotient.multiply(variable, &quotient.forms[smaller]),
            };
        }
        Ok(quotient)
    }

    /// The dimension of the quotient ring.
    pub fn dimension(&self) -> usize {
        self.stairs.standard.len()
    }

    fn one(&self) -> Vec<F::Element> {
        let mut one = vec![self.ring.field().zero(); self.dimension()];
        one[0] = self.ring.field().one();
        one
    }

    fn multiply(&self, variable: usize, vector: &[F::Element]) -> Vec<F::Element> {
        let field = self.ring.field();
        let mut result = vec![field.zero(); vector.len()];
        let products = vector.iter().zip(&self.stairs.products[variable]);
        for (factor, product) in products.filter(|(factor, _)| !field.is_zero(factor)) {
            match *product {
                Product::Standard(index) => result[index] = field.add(&result[index], factor),
                Product::Border(index) => add_scaled(field, &mut result, factor, &self.forms[index]),
            }
        }
        result
    }

    /// Computes the reduced Groebner basis in the order of `target`, a ring over the same field in the same variables.
    /// If `target` has fewer variables, it is the basis of the elimination ideal.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a variable that the quotient ring lacks; [`ErrorKind::BadValue`] for another
    /// field, or when a nonzero coefficient has no inverse; [`ErrorKind::Overflow`]; the error with which `watch` stops
    /// the work.
    pub fn basis_in<'w>(&self, target: &PolynomialRing<F>, watch: impl Into<Option<&'w Watch>>) -> Result<Basis<F>> {
        let watch = Watch::or_none(watch);
        let sources = sources(&self.ring, target)?;
        let mut walk = Walk::new(target);
        let mut echelon = Echelon::new(target);
        let mut vectors = vec![self.one()];
        echelon.insert(&vectors[0])?;
        let mut polynomials = Vec::new();
        while let Some(candidate) = walk.next()? {
            watch.check()?;
            watch.report("change of order", vectors.len(), self.dimension() - vectors.len());
            let vector = self.multiply(sources[candidate.variable], &vectors[candidate.factor]);
            match echelon.insert(&vector)? {
                None => {
                    walk.standard.push(candidate.monomial);
                    vectors.push(vector);
                }
                Some(tail) => polynomials.push(relation(target, &walk.standard, candidate.monomial, tail)),
            }
        }
        Ok(Basis { ring: target.clone(), polynomials, cofactors: Vec::new() })
    }

    /// The minimal polynomial of `f` in the quotient ring. Over an algebraically closed field its roots are the values
    /// of `f` at the solutions.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `f` is not a polynomial of the ring of the basis, or when a nonzero coefficient has
    /// no inverse; the error with which `watch` stops the work.
    pub fn minimal_polynomial<'w>(
        &self,
        f: &Polynomial<F::Element>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Univariate<F::Element>> {
        let watch = Watch::or_none(watch);
        let field = self.ring.field();
        let columns = self.multiplication(f, watch)?;
        let mut echelon = Echelon::new(&self.ring);
        let mut power = self.one();
        loop {
            watch.check()?;
            watch.report("minimal polynomial", echelon.rank(), self.dimension() - echelon.rank());
            if let Some(tail) = echelon.insert(&power)? {
                let coefficients = (0..echelon.rank()).map(|k| tail.get(&k).cloned().unwrap_or_else(|| field.zero()));
                return Ok(Univariate { coefficients: coefficients.chain([field.one()]).collect() });
            }
            power = combine(field, &power, &columns);
        }
    }

    /// `f` times each standard monomial, in coordinates.
    fn multiplication(&self, f: &Polynomial<F::Element>, watch: &Watch) -> Result<Vec<Vec<F::Element>>> {
        require_member(&self.ring, f)?;
        let field = self.ring.field();
        let mut columns = vec![vec![field.zero(); self.dimension()]; self.dimension()];
        for term in f.terms() {
            let mut vector = self.one();
            for variable in 0..self.ring.variables().len() {
                for _ in 0..self.ring.layout().exponent(&term.monomial, variable) {
                    watch.check()?;
                    vector = self.multiply(variable, &vector);
                }
            }
            add_scaled(field, &mut columns[0], &term.coefficient, &vector);
        }
        for (index, variable, factor) in self.stairs.descents() {
            watch.check()?;
            columns[index] = self.multiply(variable, &columns[factor]);
        }
        Ok(columns)
    }
}

fn add_scaled<F: Field>(field: &F, sum: &mut [F::Element], factor: &F::Element, vector: &[F::Element]) {
    for (sum, entry) in sum.iter_mut().zip(vector).filter(|(_, entry)| !field.is_zero(entry)) {
        *sum = field.add(sum, &field.mul(factor, entry));
    }
}

/// The sum of `columns` with these `factors`.
fn combine<F: Field>(field: &F, factors: &[F::Element], columns: &[Vec<F::Element>]) -> Vec<F::Element> {
    let mut sum = vec![field.zero(); factors.len()];
    for (factor, column) in factors.iter().zip(columns).filter(|(factor, _)| !field.is_zero(factor)) {
        add_scaled(field, &mut sum, factor, column);
    }
    sum
}

fn indices(standard: &[Monomial]) -> HashMap<&Monomial, usize> {
    standard.iter().enumerate().map(|(index, monomial)| (monomial, index)).collect()
}

/// The normal form of the leading monomial of a basis polynomial: its negated tail, if the basis is reduced.
fn lead_tail<F: Field>(
    basis: &Basis<F>,
    index: usize,
    standard: &HashMap<&Monomial, usize>,
) -> Result<Polynomial<F::Element>> {
    let ring = &basis.ring;
    let mut tail = basis.polynomials[index].clone();
    let lead = tail.take_leading().expect("a leading monomial belongs to a nonzero polynomial");
    let factor = ring.field().neg(&inverse(ring, &lead.coefficient)?);
    let tail = ring.scale(&tail, &factor);
    if tail.terms().iter().all(|term| standard.contains_key(&term.monomial)) {
        return Ok(tail);
    }
    normal_form(ring, &tail, &basis.polynomials)
}

/// The coordinates of a combination of standard monomials.
fn coordinates<F: Field>(
    standard: &HashMap<&Monomial, usize>,
    f: &Polynomial<F::Element>,
    ring: &PolynomialRing<F>,
) -> Vec<F::Element> {
    let mut vector = vec![ring.field().zero(); standard.len()];
    for term in f.terms() {
        vector[standard[&term.monomial]] = term.coefficient.clone();
    }
    vector
}

/// The polynomial `lead + sum of tail[k] * standard[k]`.
fn relation<F: Field>(
    ring: &PolynomialRing<F>,
    standard: &[Monomial],
    lead: Monomial,
    tail: impl IntoIterator<Item = (usize, F::Element)>,
) -> Polynomial<F::Element> {
    let tail = tail.into_iter().map(|(index, coefficient)| Term { coefficient, monomial: standard[index].clone() });
    ring.collect(tail.chain([Term { coefficient: ring.field().one(), monomial: lead }]))
}

/// The index in `ring` of each variable of `target`.
///
/// # Errors
/// [`ErrorKind::UnknownName`], [`ErrorKind::BadValue`] for another field.
fn sources<F: Field>(ring: &PolynomialRing<F>, target: &PolynomialRing<F>) -> Result<Vec<usize>> {
    if target.field() != ring.field() {
        return Err(Error::new(ErrorKind::BadValue, "a change of order needs the field of the basis"));
    }
    let source = |name: &String| {
        let known = || ring.variables().join(", ");
        let unknown = || Error::new(ErrorKind::UnknownName, format!("no variable `{name}`; there are {}", known()));
        ring.index_of(name).ok_or_else(unknown)
    };
    target.variables().iter().map(source).collect()
}

fn require_member<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> Result<()> {
    if ring.is_well_formed(f) {
        return Ok(());
    }
    Err(Error::new(ErrorKind::BadValue, "the polynomial must be in the ring of the basis"))
}
