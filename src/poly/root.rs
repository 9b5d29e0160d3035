//! Square roots of polynomials and the factors that they give.

use super::gcd::gcd;
use super::ring::{Polynomial, PolynomialRing};
use crate::number::{BigInt, BigRational, Rationals, Ring};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

/// The polynomial whose square is `f`, up to sign, if `f` is a square over Q.
pub fn square_root(ring: &Ground, f: &Poly) -> Option<Poly> {
    let Some(lead) = f.leading() else { return Some(ring.zero()) };
    let exponents = ring.layout().exponents(&lead.monomial);
    if exponents.iter().any(|e| e % 2 == 1) {
        return None;
    }
    let halves: Vec<u32> = exponents.iter().map(|e| e / 2).collect();
    let top = ring.term(rational_root(&lead.coefficient)?, ring.layout().pack(&halves)?);
    let twice = ring.add(&top, &top);
    let mut root = top;
    let divisor = twice.leading()?.clone();
    loop {
        let rest = ring.sub(f, &ring.mul(&root, &root));
        let Some(term) = rest.leading() else { return Some(root) };
        let monomial = ring.layout().checked_div(&term.monomial, &divisor.monomial)?;
        if root.terms().iter().any(|t| ring.layout().compare(&t.monomial, &monomial).is_le()) {
            return None;
        }
        root = ring.add(&root, &ring.term(&term.coefficient / &divisor.coefficient, monomial));
    }
}

/// The positive square root of a rational number that is a square.
pub fn rational_root(q: &BigRational) -> Option<BigRational> {
    let root = |n: &BigInt| Some(n.sqrt()).filter(|r| r * r == *n);
    let positive = q.numer().sign() != num_bigint::Sign::Minus;
    positive.then(|| Some(BigRational::new(root(q.numer())?, root(q.denom())?)))?
}

/// Splits a square-free `f` that is quadratic in some variable with a square discriminant into two factors.
pub fn split_quadratic(ring: &Ground, f: &Poly) -> Option<(Poly, Poly)> {
    (0..ring.variables().len()).filter(|&v| ring.degree_in(f, v) == 2).find_map(|v| {
        let parts = ring.coefficients_in(f, v);
        let four = ring.from_integer(&BigInt::from(4));
        let product = ring.mul(&four, &ring.mul(&parts[0], &parts[2]));
        let root = square_root(ring, &ring.sub(&ring.mul(&parts[1], &parts[1]), &product))?;
        let twice = ring.mul(&ring.add(&parts[2], &parts[2]), &ring.variable(v));
        let factor = gcd(ring, f, &ring.add(&ring.add(&twice, &parts[1]), &root));
        let proper = ring.as_constant(&factor).is_none() && ring.degree(&factor) < ring.degree(f);
        proper.then(|| Some((factor.clone(), ring.exact_div(f, &factor)?)))?
    })
}
