//! A basis over the rational functions of the parameters, computed with the parameters as variables.
//!
//! In an order that compares unknowns first, a Groebner basis over Q is also one over the rational functions of the parameters. The computation divides no
//! coefficient, so it needs no gcd, and the cofactors have no denominators of their own. Only the final leading coefficients may vanish (Kapur, Sun and Wang,
//! ISSAC 2010, base their covers on this).

use crate::Result;
use crate::Watch;
use crate::derive::equations::setting::{Coefficients, Poly, Setting, Unknowns};
use crate::derive::equations::triangular::clear_denominators;
use groebot_algebra::groebner::parametric::lift;
use groebot_algebra::groebner::{Basis, Options, Strategy, basis, reduced_basis};
use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Block, Order, Polynomial, PolynomialRing};

type Flat = PolynomialRing<Rationals>;
type FlatPoly = Polynomial<BigRational>;

/// The reduced basis of `generators` in `ring`, with cofactors.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`]; the error of `watch` if it stops the computation.
pub(in crate::derive) fn generic_basis(
    setting: &Setting,
    ring: &Unknowns,
    generators: &[Poly],
    watch: &Watch,
) -> Result<Basis<Coefficients>> {
    let flat = flat_ring(ring)?;
    let mut system = Vec::new();
    let mut factors = Vec::new();
    for f in generators {
        let (cleared, denominator) = clear_denominators(ring, f);
        system.push(flatten(ring, &flat, &cleared)?);
        factors.push(ring.field().embed(&denominator));
    }
    for symbol in &setting.symbols {
        if let Some(square) = &symbol.square {
            let root = groebot_algebra::poly::Expression::name(symbol.name.clone()).power(2).evaluate(&flat)?;
            system.push(flat.sub(&root, &square.evaluate(&flat)?));
        }
    }
    let options = Options { strategy: Strategy::Sugar, cofactors: true };
    let full = basis(&flat, &system, &options, watch)?;
    let lifted = |f: &FlatPoly| lift(&full.ring, ring, f);
    let (mut polynomials, mut cofactors) = (Vec::new(), Vec::new());
    for (f, row) in full.polynomials.iter().zip(&full.cofactors) {
        let polynomial = lifted(f)?;
        if !ring.is_zero(&polynomial) {
            let row = row.iter().zip(&factors).map(|(cofactor, factor)| Ok(ring.scale(&lifted(cofactor)?, factor)));
            cofactors.push(row.collect::<Result<Vec<Poly>>>()?);
            polynomials.push(polynomial);
        }
    }
    reduced_basis(ring, polynomials, cofactors, watch)
}

/// Q[unknowns, parameters] with the unknowns compared first.
fn flat_ring(ring: &Unknowns) -> Result<Flat> {
    let parameters = ring.field().ring().variables();
    let names: Vec<&String> = ring.variables().iter().chain(parameters).collect();
    let sizes = [ring.variables().len(), parameters.len()];
    let blocks = sizes.into_iter().filter(|&size| size > 0).map(|size| Block { size, graded: true });
    PolynomialRing::new(Rationals, &names, Order::Block(blocks.collect()))
}

fn flatten(ring: &Unknowns, flat: &Flat, f: &Poly) -> Result<FlatPoly> {
    let ground = ring.field().ring();
    let mut terms = Vec::new();
    for term in f.terms() {
        let mut exponents = ring.layout().exponents(&term.monomial);
        exponents.resize(flat.variables().len(), 0);
        let monomial = flat.monomial(&exponents)?;
        let coefficient = ground.transfer(term.coefficient.numerator(), flat)?;
        terms.extend(flat.mul_term(&coefficient, &flat.field().one(), &monomial)?.terms().iter().cloned());
    }
    Ok(flat.collect(terms))
}
