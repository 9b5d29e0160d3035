//! Maps from a polynomial ring: to other rings, to values, to the coefficients in one variable, to derivatives.

use super::ring::{Polynomial, PolynomialRing, Term};
use crate::number::{BigInt, Field, Ring};
use crate::{Error, ErrorKind, Result};

impl<F: Field> PolynomialRing<F> {
    /// Converts `f` to another ring with the same variables, in any order or width.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when `f` uses a variable that `target` lacks; [`ErrorKind::Overflow`].
    pub fn transfer<G: Field<Element = F::Element>>(
        &self,
        f: &Polynomial<F::Element>,
        target: &PolynomialRing<G>,
    ) -> Result<Polynomial<F::Element>> {
        self.map_into(f, target, |coefficient| Ok(coefficient.clone()))
    }

    /// Maps `f` to another ring: variables by name, coefficients by `map`.
    ///
    /// # Errors
    /// Those of [`PolynomialRing::transfer`] and of `map`.
    pub fn map_into<G: Field>(
        &self,
        f: &Polynomial<F::Element>,
        target: &PolynomialRing<G>,
        map: impl Fn(&F::Element) -> Result<G::Element>,
    ) -> Result<Polynomial<G::Element>> {
        let indices: Vec<Option<usize>> = self.variables().iter().map(|name| target.index_of(name)).collect();
        let image = |term: &Term<F::Element>| {
            let mut exponents = vec![0; target.variables().len()];
            for (variable, index) in indices.iter().enumerate() {
                let exponent = self.layout().exponent(&term.monomial, variable);
                match index {
                    Some(index) => exponents[*index] = exponent,
                    None if exponent > 0 => return Err(self.unknown_variable(variable)),
                    None => {}
                }
            }
            let monomial = target.layout().pack(&exponents).ok_or_else(|| target.overflow())?;
            Ok(Term { coefficient: map(&term.coefficient)?, monomial })
        };
        let terms: Vec<_> = f.terms.iter().map(image).collect::<Result<_>>()?;
        Ok(target.collect(terms))
    }

    /// Substitutes the elements `values` of `target` for all variables of `f`.
    pub fn substitute<R: Ring>(
        &self,
        f: &Polynomial<F::Element>,
        target: &R,
        values: &[R::Element],
        map: impl Fn(&F::Element) -> R::Element,
    ) -> R::Element {
        f.terms.iter().fold(target.zero(), |sum, term| {
            let powers = values.iter().enumerate().map(|(v, value)| (value, self.layout().exponent(&term.monomial, v)));
            let product = powers
                .filter(|(_, exponent)| *exponent > 0)
                .fold(map(&term.coefficient), |product, power| target.mul(&product, &target.pow(power.0, power.1)));
            target.add(&sum, &product)
        })
    }

    /// The coefficients of `f` as a polynomial in one variable: `result[k]` is the coefficient of the `k`-th power.
    pub fn coefficients_in(&self, f: &Polynomial<F::Element>, variable: usize) -> Vec<Polynomial<F::Element>> {
        let mut parts = vec![Vec::new(); self.degree_in(f, variable) as usize + 1];
        for term in &f.terms {
            let mut exponents = self.layout().exponents(&term.monomial);
            let power = std::mem::take(&mut exponents[variable]) as usize;
            let monomial = self.layout().pack(&exponents).expect("a divisor fits");
            parts[power].push(Term { coefficient: term.coefficient.clone(), monomial });
        }
        parts.into_iter().map(|terms| self.collect(terms)).collect()
    }

    /// The partial derivative with respect to one variable.
    pub fn derivative(&self, f: &Polynomial<F::Element>, variable: usize) -> Polynomial<F::Element> {
        let differentiate = |term: &Term<F::Element>| {
            let mut exponents = self.layout().exponents(&term.monomial);
            let power = exponents[variable];
            exponents[variable] = power.checked_sub(1)?;
            let factor = self.field().from_integer(&BigInt::from(power));
            let coefficient = self.field().mul(&term.coefficient, &factor);
            Some(Term { coefficient, monomial: self.layout().pack(&exponents)? })
        };
        self.collect(f.terms.iter().filter_map(differentiate))
    }

    fn unknown_variable(&self, variable: usize) -> Error {
        let text = format!("variable `{}` has no place in the target ring", self.variables()[variable]);
        Error::new(ErrorKind::UnknownName, text)
    }
}
