//! Homogenisation with a last variable.

use crate::Result;
use crate::number::{BigRational, Rationals};
use crate::poly::{Order, Polynomial, PolynomialRing, Term};

/// Whether all terms have one total degree.
pub(super) fn is_homogeneous(ring: &PolynomialRing<Rationals>, f: &Polynomial<BigRational>) -> bool {
    f.terms().iter().all(|term| ring.layout().degree(&term.monomial) == ring.degree(f))
}

/// Generators made homogeneous, in graded reverse order.
pub(super) struct Homogeneous {
    /// The ring with one more variable, the smallest.
    pub ring: PolynomialRing<Rationals>,
    /// The ring without it.
    pub plain: PolynomialRing<Rationals>,
    pub generators: Vec<Polynomial<BigRational>>,
}

impl Homogeneous {
    pub(super) fn new(ring: &PolynomialRing<Rationals>, generators: &[Polynomial<BigRational>]) -> Result<Self> {
        let width = ring.layout().width();
        let plain = PolynomialRing::new(Rationals, ring.variables(), Order::GrevLex)?.with_width(width);
        let mut names = ring.variables().to_vec();
        names.push(fresh_name(&names));
        let larger = PolynomialRing::new(Rationals, &names, Order::GrevLex)?.with_width(width);
        let homogenised = |f: &Polynomial<BigRational>| {
            let degree = ring.degree(f);
            let term = |term: &Term<BigRational>| {
                let mut exponents = ring.layout().exponents(&term.monomial);
                exponents.push(degree - ring.layout().degree(&term.monomial));
                Ok(Term { coefficient: term.coefficient.clone(), monomial: larger.monomial(&exponents)? })
            };
            Ok(larger.collect(f.terms().iter().map(term).collect::<Result<Vec<_>>>()?))
        };
        let generators = generators.iter().map(homogenised).collect::<Result<_>>()?;
        Ok(Homogeneous { plain, generators, ring: larger })
    }

    /// `f`, a polynomial of `ring`, with the last variable put to one.
    pub(super) fn at_one(
        &self,
        ring: &PolynomialRing<Rationals>,
        f: &Polynomial<BigRational>,
    ) -> Result<Polynomial<BigRational>> {
        let last = self.plain.variables().len();
        let term = |term: &Term<BigRational>| {
            let mut exponents = ring.layout().exponents(&term.monomial);
            exponents[last] = 0;
            Ok(Term { coefficient: term.coefficient.clone(), monomial: ring.monomial(&exponents)? })
        };
        Ok(ring.collect(f.terms().iter().map(term).collect::<Result<Vec<_>>>()?))
    }
}

/// A name that none of `names` has.
fn fresh_name(names: &[String]) -> String {
    let mut name = "h".to_owned();
    while names.contains(&name) {
        name.push('h');
    }
    name
}
