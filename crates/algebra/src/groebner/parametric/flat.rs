//! The system with the parameters as variables of the lowest block. The unknowns are first, in their own order.

use super::lift::image;
use super::prime::Prime;
use super::{Ideal, Poly, Ring};
use crate::Result;
use crate::number::{BigRational, Field, Rationals, Ring as _, Zp};
use crate::poly::{Block, Order, Polynomial, PolynomialRing, Term, gcd};

/// The terms of each equation over Q, greatest first.
pub(super) type Equations = Vec<Vec<Term<BigRational>>>;

/// The ring of unknowns and parameters over `field`.
///
/// # Errors
/// Those of [`PolynomialRing::new`].
pub(super) fn flat_ring<F: Field>(ring: &Ring, field: F) -> Result<PolynomialRing<F>> {
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
    PolynomialRing::new(field, &names, Order::Block(blocks))
}

/// The generators without denominators and the relations of the parameters, greatest terms first.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`] when a degree overflows the flat ring.
pub(super) fn equations<F: Field>(ideal: &Ideal<'_>, flat: &PolynomialRing<F>) -> Result<Equations> {
    let field = ideal.ring.field();
    let ground = field.ring();
    let mut equations = Vec::with_capacity(ideal.generators.len());
    for f in ideal.generators {
        equations.push(flatten(ideal.ring, flat, f)?);
    }
    for (variable, square) in field.squares() {
        let root = ground.variable(variable);
        let relation = ground.sub(&ground.checked_mul(&root, &root)?, square);
        let mut terms = Vec::new();
        append(&mut terms, ground, flat, vec![0; flat.variables().len()], &relation)?;
        equations.push(terms);
    }
    Ok(equations)
}

/// `f` times the least common multiple of its denominators.
fn flatten<F: Field>(ring: &Ring, flat: &PolynomialRing<F>, f: &Poly) -> Result<Vec<Term<BigRational>>> {
    let ground = ring.field().ring();
    let multiple = common_multiple(ring, f.terms().iter().map(|term| term.coefficient.denominator()));
    let mut terms = Vec::with_capacity(2 * f.terms().len());
    for term in f.terms() {
        let mut exponents = ring.layout().exponents(&term.monomial);
        exponents.resize(flat.variables().len(), 0);
        let (top, bottom) = (term.coefficient.numerator(), term.coefficient.denominator());
        if *bottom == multiple {
            append(&mut terms, ground, flat, exponents, top)?;
        } else {
            let factor = ground.exact_div(&multiple, bottom).expect("it divides the multiple");
            append(&mut terms, ground, flat, exponents, &ground.checked_mul(top, &factor)?)?;
        }
    }
    Ok(terms)
}

/// The least common multiple of denominators.
pub(super) fn common_multiple<'a>(
    ring: &Ring,
    denominators: impl Iterator<Item = &'a Polynomial<BigRational>>,
) -> Polynomial<BigRational> {
    let ground = ring.field().ring();
    denominators.fold(ground.one(), |product, f| {
        if ground.is_one(f) || product == *f {
            return if ground.is_one(f) { product } else { f.clone() };
        }
        let shared = gcd(ground, &product, f);
        ground.mul(&product, &ground.exact_div(f, &shared).expect("a gcd divides"))
    })
}

/// The terms of `coefficient` times the monomial of unknowns with these exponents.
fn append<F: Field>(
    terms: &mut Vec<Term<BigRational>>,
    ground: &PolynomialRing<Rationals>,
    flat: &PolynomialRing<F>,
    mut exponents: Vec<u32>,
    coefficient: &Polynomial<BigRational>,
) -> Result<()> {
    let first = exponents.len() - ground.variables().len();
    for term in coefficient.terms() {
        for (variable, exponent) in exponents[first..].iter_mut().enumerate() {
            *exponent = ground.layout().exponent(&term.monomial, variable);
        }
        terms.push(Term { coefficient: term.coefficient.clone(), monomial: flat.monomial(&exponents)? });
    }
    Ok(())
}

/// The equations modulo a prime; `None` when it divides a coefficient.
pub(super) fn image_of(flat: &PolynomialRing<Zp>, equations: &Equations, field: Prime) -> Option<Vec<Polynomial<u64>>> {
    let term = |term: &Term<BigRational>| {
        let coefficient = image(field, &term.coefficient);
        (coefficient != 0).then(|| Term { coefficient, monomial: term.monomial.clone() })
    };
    let image = |terms: &Vec<Term<BigRational>>| Some(flat.descending(terms.iter().map(term).collect::<Option<_>>()?));
    equations.iter().map(image).collect()
}

/// Whether the prime divides no numerator and no denominator of a coefficient.
pub(super) fn admit(equations: &Equations, field: Prime) -> bool {
    equations.iter().flatten().all(|term| image(field, &term.coefficient) != 0)
}
