//! Square-free decomposition by derivatives (Musser 1975), in any characteristic.

use crate::number::{Field, Ring};
use crate::poly::gcd::{common_within, gcd_within, split_monomial};
use crate::poly::{Polynomial, PolynomialRing, Term};
use crate::{Result, Watch};

/// Polynomials with their multiplicities.
type Powers<F> = Vec<(Polynomial<<F as Ring>::Element>, u32)>;

/// Square-free, pairwise coprime, non-constant polynomials with multiplicities, such that `f` is the product of their
/// powers up to a constant. The field is a prime field or has characteristic zero.
///
/// # Errors
/// The error with which `watch` stops the work.
pub fn powers<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>, watch: &Watch) -> Result<Powers<F>> {
    let (monomial, rest) = split_monomial(ring, f);
    let exponents = (0..ring.variables().len()).map(|v| (ring.variable(v), ring.degree_in(&monomial, v)));
    let mut parts: Vec<_> = exponents.filter(|(_, exponent)| *exponent > 0).collect();
    let (mut rest, mut scale) = (rest, 1);
    while ring.as_constant(&rest).is_none() {
        let (found, repeated) = powers_by_derivatives(ring, &rest, watch)?;
        parts.extend(found.into_iter().map(|(part, n)| (part, n * scale)));
        if ring.as_constant(&repeated).is_some() {
            break;
        }
        let p = ring.field().characteristic() as u32;
        rest = root(ring, &repeated, p);
        scale *= p;
    }
    Ok(parts)
}

/// The parts whose multiplicity is not divisible by the characteristic, and the remaining factor, a `p`-th power.
fn powers_by_derivatives<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    watch: &Watch,
) -> Result<(Powers<F>, Polynomial<F::Element>)> {
    let mut variables = (0..ring.variables().len()).filter(|&v| ring.degree_in(f, v) > 0);
    let mut repeated =
        variables.try_fold(f.clone(), |shared, v| gcd_within(ring, &shared, &ring.derivative(f, v), watch))?;
    let mut distinct = ring.exact_div(f, &repeated).expect("a gcd divides");
    let (mut parts, mut multiplicity) = (Vec::new(), 1);
    while ring.as_constant(&distinct).is_none() {
        let shared = common_within(ring, &distinct, &repeated, watch)?;
        if ring.as_constant(&shared.left).is_none() {
            parts.push((ring.monic(&shared.left), multiplicity));
        }
        (distinct, repeated) = (shared.gcd, shared.right);
        multiplicity += 1;
    }
    Ok((parts, repeated))
}

/// The `p`-th root of a `p`-th power over GF(p).
fn root<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>, p: u32) -> Polynomial<F::Element> {
    let term = |term: &Term<F::Element>| {
        let exponents: Vec<u32> = ring.layout().exponents(&term.monomial).iter().map(|e| e / p).collect();
        Term {
            coefficient: term.coefficient.clone(),
            monomial: ring.layout().pack(&exponents).expect("a divisor fits"),
        }
    };
    ring.collect(f.terms().iter().map(term))
}
