//! Square roots of polynomials and of rational numbers.

use super::ring::{Polynomial, PolynomialRing};
use crate::number::{BigInt, BigRational, Rationals, Ring};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

/// The square root of `f`, up to sign, if `f` is a square over Q.
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

/// The positive square root of a rational number, if it is rational.
pub fn rational_root(q: &BigRational) -> Option<BigRational> {
    let root = |n: &BigInt| Some(n.sqrt()).filter(|r| r * r == *n);
    let positive = q.numer().sign() != num_bigint::Sign::Minus;
    positive.then(|| Some(BigRational::new(root(q.numer())?, root(q.denom())?)))?
}
