//! The basis with the parameters as variables of the lowest block.
//!
//! In an order that compares unknowns first, a Groebner basis over Q is also one over the rational functions of the parameters
//! (P. Gianni, B. Trager, G. Zacharias, J. Symbolic Computation 6, 1988). Relations between parameters are generators there.

use super::{Ideal, Poly, Ring};
use crate::groebner::{Basis, Options, basis, reduced_basis};
use crate::number::{BigRational, Rationals, Ring as _};
use crate::poly::{Block, Fractions, Order, Polynomial, PolynomialRing, Term};
use crate::{Result, Watch};

type Flat = PolynomialRing<Rationals>;

/// The reduced basis over the rational functions, from one over Q.
///
/// # Errors
/// As [`basis`].
pub(super) fn basis_with_variables(ideal: &Ideal<'_>, watch: &Watch) -> Result<Basis<Fractions<Rationals>>> {
    let flat = flat_ring(ideal.ring)?;
    let mut system: Vec<_> = ideal.generators.iter().map(|f| flatten(ideal.ring, &flat, f)).collect::<Result<_>>()?;
    for (variable, square) in ideal.ring.field().squares() {
        let root = flat.variable(ideal.ring.variables().len() + variable);
        let square = ideal.ring.field().ring().transfer(square, &flat)?;
        system.push(flat.sub(&flat.checked_mul(&root, &root)?, &square));
    }
    let full = basis(&flat, &system, &Options::default(), watch)?;
    let lifted = full.polynomials.iter().map(|f| lift(&full.ring, ideal.ring, f));
    let polynomials: Vec<Poly> = lifted.collect::<Result<_>>()?;
    let cofactors = vec![Vec::new(); polynomials.len()];
    let mut found = reduced_basis(ideal.ring, polynomials, cofactors, watch)?;
    found.cofactors = Vec::new();
    Ok(found)
}

/// Q[unknowns, parameters]: the unknowns in their own order first.
fn flat_ring(ring: &Ring) -> Result<Flat> {
    let parameters = ring.field().ring().variables();
    let names: Vec<&String> = ring.variables().iter().chain(parameters).collect();
    let block = |size, graded| Block { size, graded };
    let mut blocks = match ring.layout().order() {
        Order::Lex => vec![block(ring.variables().len(), false)],
        Order::GrevLex => vec![block(ring.variables().len(), true)],
        Order::Block(blocks) => blocks.clone(),
    };
    blocks.push(block(parameters.len(), true));
    blocks.retain(|block| block.size > 0);
    PolynomialRing::new(Rationals, &names, Order::Block(blocks))
}

/// `f` times the product of its denominators.
fn flatten(ring: &Ring, flat: &Flat, f: &Poly) -> Result<Polynomial<BigRational>> {
    let ground = ring.field().ring();
    let multiple = super::system::common_multiple(ring, f.terms().iter().map(|term| term.coefficient.denominator()));
    let mut terms = Vec::new();
    for term in f.terms() {
        let mut exponents = ring.layout().exponents(&term.monomial);
        exponents.resize(flat.variables().len(), 0);
        let monomial = flat.monomial(&exponents)?;
        let factor = ground.exact_div(&multiple, term.coefficient.denominator()).expect("it divides the multiple");
        let coefficient = ground.transfer(&ground.checked_mul(term.coefficient.numerator(), &factor)?, flat)?;
        terms.extend(flat.mul_term(&coefficient, &flat.field().one(), &monomial)?.terms().iter().cloned());
    }
    Ok(flat.collect(terms))
}

/// `f` read over the rational functions; zero when it is a relation of the parameters.
fn lift(flat: &Flat, ring: &Ring, f: &Polynomial<BigRational>) -> Result<Poly> {
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
