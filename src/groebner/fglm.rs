//! Change of order for zero-dimensional ideals by linear algebra in the quotient ring.
//!
//! J.-C. Faugere, P. Gianni, D. Lazard, T. Mora, "Efficient computation of zero-dimensional Groebner bases by change of
//! ordering", J. Symbolic Computation 16 (1993), the dense form.

use std::collections::BTreeMap;

use super::division::inverse;
use super::{Basis, normal_form};
use crate::number::{Field, Ring};
use crate::poly::{Monomial, Polynomial, PolynomialRing, Term};
use crate::{Error, ErrorKind, Result, Watch};

/// The action of the variables on the quotient ring of a zero-dimensional ideal.
#[derive(Clone, Debug)]
pub struct Quotient<F: Field> {
    ring: PolynomialRing<F>,
    /// `columns[v][j]`: variable `v` times standard monomial `j`, in coordinates.
    columns: Vec<Vec<Vec<F::Element>>>,
    one: Vec<F::Element>,
}

impl<F: Field> Quotient<F> {
    /// The multiplication matrices of the quotient ring by `basis`.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] or [`ErrorKind::Inconsistent`] when the quotient is not finite or is zero;
    /// [`ErrorKind::Overflow`].
    pub fn new(basis: &Basis<F>) -> Result<Self> {
        basis.require_zero_dimensional()?;
        let ring = basis.ring.clone();
        let Some(standard) = basis.quotient_basis() else {
            return Err(Error::new(ErrorKind::Overflow, "a standard monomial does not fit the ring; give a wider one"));
        };
        let coordinates = |f: &Polynomial<F::Element>| -> Vec<F::Element> {
            let coefficient = |m: &Monomial| f.terms().iter().find(|t| t.monomial == *m).map(|t| t.coefficient.clone());
            standard.iter().map(|m| coefficient(m).unwrap_or_else(|| ring.field().zero())).collect()
        };
        let product = |v: usize, m: &Monomial| -> Result<Vec<F::Element>> {
            let f = ring.mul_term(&ring.variable(v), &ring.field().one(), m)?;
            Ok(coordinates(&normal_form(&ring, &f, &basis.polynomials)?))
        };
        let variables = 0..ring.variables().len();
        let columns = variables.map(|v| standard.iter().map(|m| product(v, m)).collect()).collect::<Result<_>>()?;
        let one = coordinates(&normal_form(&ring, &ring.one(), &basis.polynomials)?);
        Ok(Quotient { columns, one, ring })
    }

    /// The dimension of the quotient ring.
    pub fn dimension(&self) -> usize {
        self.one.len()
    }

    fn multiply(&self, variable: usize, vector: &[F::Element]) -> Vec<F::Element> {
        let field = self.ring.field();
        let mut result = vec![field.zero(); vector.len()];
        for (factor, column) in vector.iter().zip(&self.columns[variable]).filter(|(factor, _)| !field.is_zero(factor))
        {
            for (sum, entry) in result.iter_mut().zip(column) {
                *sum = field.add(sum, &field.mul(factor, entry));
            }
        }
        result
    }

    /// The reduced Groebner basis in the order of `target`, a ring over the same field in the same variables. In fewer
    /// variables, it is the basis of the elimination ideal.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a variable that the quotient ring lacks; [`ErrorKind::BadValue`] for another field, or
    /// when a nonzero coefficient has no inverse; [`ErrorKind::Overflow`]; what `watch` stops with.
    pub fn basis_in(&self, target: &PolynomialRing<F>, watch: &Watch) -> Result<Basis<F>> {
        if target.field() != self.ring.field() {
            return Err(Error::new(ErrorKind::BadValue, "a change of order stays over the field of the basis"));
        }
        let sources = target.variables().iter().map(|name| {
            self.ring.index_of(name).ok_or_else(|| Error::new(ErrorKind::UnknownName, format!("no variable `{name}`")))
        });
        let sources: Vec<usize> = sources.collect::<Result<_>>()?;
        let mut walk = Walk { rows: Vec::new(), seen: Vec::new(), leads: Vec::new(), polynomials: Vec::new() };
        let mut candidates = vec![(target.layout().one(), self.one.clone())];
        while let Some((monomial, vector)) = take_smallest(target, &mut candidates) {
            watch.check()?;
            watch.report("change of order", walk.seen.len(), self.dimension() - walk.seen.len());
            if walk.leads.iter().any(|lead| target.layout().divides(lead, &monomial)) || walk.seen.contains(&monomial) {
                continue;
            }
            if walk.is_new(target, &monomial, &vector)? {
                for (variable, &source) in sources.iter().enumerate() {
                    let step = target.variable(variable);
                    let next = target.mul_term(&step, &target.field().one(), &monomial)?;
                    let next = next.leading().expect("a product of monomials is one").monomial.clone();
                    candidates.push((next, self.multiply(source, &vector)));
                }
            }
        }
        Ok(Basis { ring: target.clone(), polynomials: walk.polynomials, cofactors: Vec::new() })
    }
}

type Candidate<E> = (Monomial, Vec<E>);

fn take_smallest<F: Field>(
    ring: &PolynomialRing<F>,
    candidates: &mut Vec<Candidate<F::Element>>,
) -> Option<Candidate<F::Element>> {
    let smallest = candidates.iter().enumerate().min_by(|a, b| ring.layout().compare(&a.1.0, &b.1.0))?.0;
    Some(candidates.swap_remove(smallest))
}

/// An independent vector in echelon form: its pivot, its entries, and how it combines monomials.
struct Row<E> {
    pivot: usize,
    entries: Vec<E>,
    combination: BTreeMap<usize, E>,
}

/// The state of the walk through the monomials, smallest first.
struct Walk<E> {
    rows: Vec<Row<E>>,
    seen: Vec<Monomial>,
    leads: Vec<Monomial>,
    polynomials: Vec<Polynomial<E>>,
}

impl<E: Clone + PartialEq + std::fmt::Debug> Walk<E> {
    /// Reduces `vector` by the rows: a new row when something remains, else a new basis polynomial.
    fn is_new<F: Field<Element = E>>(
        &mut self,
        ring: &PolynomialRing<F>,
        monomial: &Monomial,
        vector: &[E],
    ) -> Result<bool> {
        let field = ring.field();
        let mut entries = vector.to_vec();
        let mut combination: BTreeMap<usize, E> = BTreeMap::new();
        for row in &self.rows {
            let factor = entries[row.pivot].clone();
            if field.is_zero(&factor) {
                continue;
            }
            for (entry, other) in entries.iter_mut().zip(&row.entries) {
                *entry = field.sub(entry, &field.mul(&factor, other));
            }
            for (index, other) in &row.combination {
                let sum = combination.entry(*index).or_insert_with(|| field.zero());
                *sum = field.sub(sum, &field.mul(&factor, other));
            }
        }
        match entries.iter().position(|entry| !field.is_zero(entry)) {
            Some(pivot) => {
                let inverse = inverse(ring, &entries[pivot])?;
                combination.insert(self.seen.len(), field.one());
                combination.values_mut().for_each(|value| *value = field.mul(value, &inverse));
                entries.iter_mut().for_each(|value| *value = field.mul(value, &inverse));
                self.rows.push(Row { pivot, entries, combination });
                self.seen.push(monomial.clone());
                Ok(true)
            }
            None => {
                let tail = combination
                    .into_iter()
                    .map(|(index, coefficient)| Term { coefficient, monomial: self.seen[index].clone() });
                let lead = Term { coefficient: field.one(), monomial: monomial.clone() };
                self.polynomials.push(ring.collect(tail.chain([lead])));
                self.leads.push(monomial.clone());
                Ok(false)
            }
        }
    }
}
