//! Evaluation of polynomials at the points of a representation: `h(g_1 / f', ..., g_n / f') = P / (c f'^d)`.

use std::collections::HashMap;
use std::rc::Rc;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::One;

use super::integral;
use crate::number::{BigRational, Rationals};
use crate::poly::{Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// Products of numerators and of `f'`, each computed once.
pub(super) struct Substitution<'a> {
    /// The numerators, then `f'`.
    factors: Vec<&'a [BigInt]>,
    products: HashMap<Vec<u32>, Rc<Vec<BigInt>>>,
}

impl<'a> Substitution<'a> {
    pub(super) fn new(numerators: impl Iterator<Item = &'a [BigInt]>, slope: &'a [BigInt]) -> Self {
        Substitution { factors: numerators.chain([slope]).collect(), products: HashMap::new() }
    }

    /// The integer polynomial `P` and the positive integer `c`; `d` is the total degree of `h`.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(super) fn apply(
        &mut self,
        ring: &PolynomialRing<Rationals>,
        h: &Polynomial<BigRational>,
        watch: &Watch,
    ) -> Result<(Vec<BigInt>, BigInt)> {
        let denominator = h.terms().iter().fold(BigInt::one(), |lcm, term| lcm.lcm(term.coefficient.denom()));
        let degree = ring.degree(h);
        let mut sum = Vec::new();
        for term in h.terms() {
            watch.check()?;
            let mut exponents = ring.layout().exponents(&term.monomial);
            exponents.push(degree - ring.layout().degree(&term.monomial));
            let factor = term.coefficient.numer() * (&denominator / term.coefficient.denom());
            integral::add_scaled(&mut sum, &factor, &self.product(exponents));
        }
        Ok((integral::trim(sum), denominator))
    }

    fn product(&mut self, mut exponents: Vec<u32>) -> Rc<Vec<BigInt>> {
        let Some(factor) = exponents.iter().position(|&e| e > 0) else { return Rc::new(vec![BigInt::one()]) };
        if let Some(known) = self.products.get(&exponents) {
            return known.clone();
        }
        exponents[factor] -= 1;
        let rest = self.product(exponents.clone());
        exponents[factor] += 1;
        let product = Rc::new(integral::product(self.factors[factor], &rest));
        self.products.insert(exponents, product.clone());
        product
    }
}
