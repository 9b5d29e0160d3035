//! A basis modulo one prime: [`Seen`], its monomials ([`Shape`]) and its coefficients ([`Image`]).

use super::super::Basis;
use crate::number::Zp;
use crate::poly::{Monomial, Polynomial, Width};

/// The coefficients of all polynomials of a [`Shape`] modulo one prime.
pub(super) type Image = Vec<Vec<u32>>;

/// The monomials of the basis polynomials, followed by those of their cofactors, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub supports: Vec<Vec<Monomial>>,
    /// The number of basis polynomials.
    pub elements: usize,
}

/// A basis modulo a prime.
pub(super) struct Seen {
    pub prime: u32,
    /// The width of the monomials' lanes.
    pub width: Width,
    pub shape: Shape,
    pub image: Image,
}

impl Shape {
    /// The coefficients of `basis` on the supports; `None` when it has other leading monomials, or a term outside.
    pub(super) fn image(&self, basis: &Basis<Zp>) -> Option<Image> {
        let fits = basis.polynomials.len() == self.supports.len();
        let rows = basis.polynomials.iter().zip(&self.supports).map(|(f, support)| on_support(f, support));
        if fits { rows.collect() } else { None }
    }
}

/// The coefficients of `f` on `support`, both greatest first and with the same leading monomial.
fn on_support(f: &Polynomial<u64>, support: &[Monomial]) -> Option<Vec<u32>> {
    let mut terms = f.terms().iter().peekable();
    let coefficient =
        |m: &Monomial| terms.next_if(|term| term.monomial == *m).map_or(0, |term| term.coefficient as u32);
    let row: Vec<u32> = support.iter().map(coefficient).collect();
    (terms.next().is_none() && row.first() != Some(&0)).then_some(row)
}

impl Seen {
    /// Builds the record of `basis` modulo `prime`.
    pub(super) fn new(prime: u32, basis: &Basis<Zp>) -> Self {
        let all = || basis.polynomials.iter().chain(basis.cofactors.iter().flatten());
        let support = |f: &Polynomial<u64>| f.terms().iter().map(|term| term.monomial.clone()).collect();
        let coefficients = |f: &Polynomial<u64>| f.terms().iter().map(|term| term.coefficient as u32).collect();
        let shape = Shape { supports: all().map(support).collect(), elements: basis.polynomials.len() };
        Seen { prime, width: basis.ring.layout().width(), shape, image: all().map(coefficients).collect() }
    }
}
