//! Coprime square-free factors of polynomials, as the strata of a parametric basis need them.

use crate::Watch;
use crate::number::{Field, Ring};
use crate::poly::gcd::{content, gcd, split_monomial};
use crate::poly::ring::{Polynomial, PolynomialRing};

/// Pairwise coprime, monic, square-free, non-constant factors with the same zero set as `f`, over a field of
/// characteristic zero: single variables, contents in each variable, and the remaining square-free part.
pub fn square_free_factors<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
) -> Vec<Polynomial<F::Element>> {
    let mut factors = Vec::new();
    if f.is_zero() || ring.as_constant(f).is_some() {
        return factors;
    }
    let (power, rest) = split_monomial(ring, f);
    let variables = 0..ring.variables().len();
    factors.extend(variables.clone().filter(|&v| ring.degree_in(&power, v) > 0).map(|v| ring.variable(v)));
    let mut rest = ring.monic(&rest);
    for v in variables.filter(|&v| ring.degree_in(f, v) > 0) {
        let content = content(ring, &rest, v, &Watch::none()).expect("nothing stops it");
        if ring.as_constant(&content).is_none() {
            factors.extend(square_free_factors(ring, &content));
            rest = ring.exact_div(&rest, &content).expect("a content divides");
        }
    }
    factors.push(square_free_part(ring, &rest));
    refine_factors(ring, &factors)
}

/// `f` divided by its repeated factors.
fn square_free_part<F: Field>(ring: &PolynomialRing<F>, f: &Polynomial<F::Element>) -> Polynomial<F::Element> {
    let variables = (0..ring.variables().len()).filter(|&v| ring.degree_in(f, v) > 0);
    let repeated = variables.fold(f.clone(), |common, v| gcd(ring, &common, &ring.derivative(f, v)));
    ring.monic(&ring.exact_div(f, &repeated).expect("a gcd divides"))
}

/// Pairwise coprime, monic, non-constant polynomials such that every polynomial of `polynomials` is a product of their
/// powers, up to constants: a gcd-free basis (Bach, Driscoll and Shallit 1993, the simple quadratic form).
pub fn refine_factors<F: Field>(
    ring: &PolynomialRing<F>,
    polynomials: &[Polynomial<F::Element>],
) -> Vec<Polynomial<F::Element>> {
    let mut basis: Vec<Polynomial<F::Element>> = Vec::new();
    let mut queue: Vec<_> = polynomials.iter().rev().map(|f| ring.monic(f)).collect();
    while let Some(f) = queue.pop() {
        if f.is_zero() || ring.as_constant(&f).is_some() || basis.contains(&f) {
            continue;
        }
        let hit = basis.iter().map(|g| gcd(ring, &f, g)).position(|common| ring.as_constant(&common).is_none());
        match hit {
            None => basis.push(f),
            Some(index) => {
                let g = basis.swap_remove(index);
                let common = gcd(ring, &f, &g);
                for part in [&f, &g] {
                    queue.push(ring.exact_div(part, &common).expect("a gcd divides"));
                }
                queue.push(common);
            }
        }
    }
    basis.sort_by_key(|f| (ring.degree(f), f.terms().len(), ring.format(f, crate::number::Style::Text)));
    basis
}
