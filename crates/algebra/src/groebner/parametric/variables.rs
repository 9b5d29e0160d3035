//! The basis with the parameters as variables of the lowest block.
//!
//! In an order that compares unknowns first, a Groebner basis over Q is also one over the rational functions of the parameters
//! (P. Gianni, B. Trager, G. Zacharias, J. Symbolic Computation 6, 1988). Relations between parameters are generators there.

use super::flat::{equations, flat_ring};
use super::{Ideal, Poly, Ring};
use crate::groebner::{Basis, Options, basis, reduced_basis};
use crate::number::{BigRational, Rationals};
use crate::poly::{Fractions, Polynomial, PolynomialRing, Term};
use crate::{Result, Watch};

/// The reduced basis over the rational functions, from one over Q.
///
/// # Errors
/// Those of [`basis`].
pub(super) fn basis_with_variables(ideal: &Ideal<'_>, watch: &Watch) -> Result<Basis<Fractions<Rationals>>> {
    let flat = flat_ring(ideal.ring, Rationals)?;
    let system: Vec<_> = equations(ideal, &flat)?.into_iter().map(|terms| flat.collect(terms)).collect();
    let full = basis(&flat, &system, &Options::default(), watch)?;
    let lifted = full.polynomials.iter().map(|f| lift(&full.ring, ideal.ring, f));
    reduced(ideal.ring, lifted.collect::<Result<_>>()?, watch)
}

/// The reduced basis of a basis over the rational functions.
pub(super) fn reduced(ring: &Ring, basis: Vec<Poly>, watch: &Watch) -> Result<Basis<Fractions<Rationals>>> {
    let cofactors = vec![Vec::new(); basis.len()];
    let mut found = reduced_basis(ring, basis, cofactors, watch)?;
    found.cofactors = Vec::new();
    Ok(found)
}

/// `f` as a polynomial over the rational functions; zero when it is a relation of the parameters.
pub fn lift(flat: &PolynomialRing<Rationals>, ring: &Ring, f: &Polynomial<BigRational>) -> Result<Poly> {
    let (field, count) = (ring.field(), ring.variables().len());
    let ground = field.ring();
    let terms = f.terms().iter().map(|term| {
        let exponents = flat.layout().exponents(&term.monomial);
        let monomial = ring.monomial(&exponents[..count])?;
        let part = ground.term(term.coefficient.clone(), ground.monomial(&exponents[count..])?);
        Ok(Term { coefficient: field.embed(&part), monomial })
    });
    Ok(ring.collect(terms.collect::<Result<Vec<_>>>()?))
}
