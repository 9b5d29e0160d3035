//! Random sparse polynomials, first as plain data, so that one value can be converted to many rings.

use groebot_algebra::number::{BigInt, Field, Ring};
use groebot_algebra::poly::{Block, Fraction};
use groebot_algebra::poly::{Fractions, Order, Polynomial, PolynomialRing, Term};
use proptest::prelude::*;

/// Integer coefficients and exponents, like terms allowed.
pub type Sparse = Vec<(i64, Vec<u32>)>;

/// At most `terms` terms in `variables` variables with exponents up to `top`.
pub fn sparse(variables: usize, terms: usize, top: u32) -> impl Strategy<Value = Sparse> {
    let exponents = prop::collection::vec(0..=top, variables);
    prop::collection::vec((-9i64..=9, exponents), 0..=terms)
}

/// The polynomial of `ring` with these terms.
pub fn build<F: Field>(ring: &PolynomialRing<F>, sparse: &Sparse) -> Polynomial<F::Element> {
    let image = |n: i64| ring.field().from_integer(&BigInt::from(n));
    let term = |(c, exponents): &(i64, Vec<u32>)| Term {
        coefficient: image(*c),
        monomial: ring.layout().pack(exponents).expect("small exponents"),
    };
    ring.collect(sparse.iter().map(term))
}

/// One order of each kind for three variables.
pub fn orders() -> [Order; 4] {
    let blocks = [(1, false), (2, true)].map(|(size, graded)| Block { size, graded });
    [Order::Lex, Order::GrevLex, Order::elimination(2, 3), Order::Block(blocks.to_vec())]
}

/// A quotient of two polynomials of the parameters; the numerator alone for a zero denominator.
pub fn quotient<F: Field>(field: &Fractions<F>, top: &Sparse, bottom: &Sparse) -> Fraction<F::Element> {
    let (top, bottom) = (build(field.ring(), top), build(field.ring(), bottom));
    field.fraction(&top, &bottom).unwrap_or_else(|| field.embed(&top))
}

/// Rational functions of `c`, `s`, `h` over `field` with `s^2 = 1 - c^2` and `h^2 = 1/2`.
pub fn with_roots<F: Field>(field: F) -> Fractions<F> {
    let fractions = Fractions::new(field, &["c", "s", "h"]).expect("distinct names");
    let ring = fractions.ring().clone();
    let c = ring.variable(0);
    let half = ring.field().inverse(&ring.field().from_integer(&BigInt::from(2))).expect("not in characteristic two");
    let square = ring.sub(&ring.one(), &ring.mul(&c, &c));
    let fractions = fractions.with_square(1, &square).expect("a square of parameters before");
    fractions.with_square(2, &ring.constant(half)).expect("a constant square")
}
