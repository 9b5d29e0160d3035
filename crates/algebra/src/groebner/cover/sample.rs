//! Sample points of a region, computed one parameter at a time.

use super::ideals::groebner;
use super::region::Region;
use crate::number::{Field, Ring};
use crate::poly::univariate::{Univariate, UnivariateRing};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// Maximum number of values that are tried.
const ATTEMPTS: usize = 300;

/// Candidate values of a parameter: the roots of a polynomial if it must satisfy one, else any values.
pub type Candidates<'a, E> = dyn FnMut(Option<&Univariate<E>>) -> Vec<E> + 'a;

/// Searches a point of `region` with coordinates in the field of `ring`. It has one value for each parameter of `ring`.
///
/// `None` does not prove that the region is empty.
///
/// # Errors
/// [`crate::ErrorKind::Overflow`]; the error with which `watch` stops the work.
pub fn sample<'w, F: Field>(
    ring: &PolynomialRing<F>,
    region: &Region<F::Element>,
    candidates: &mut Candidates<'_, F::Element>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Option<Vec<F::Element>>> {
    let watch = Watch::or_none(watch);
    let lex = PolynomialRing::new(ring.field().clone(), ring.variables(), Order::Lex)?;
    let moved =
        |list: &[Polynomial<F::Element>]| -> Result<Vec<_>> { list.iter().map(|f| ring.transfer(f, &lex)).collect() };
    let equations = groebner(&lex, &moved(&region.equations)?, watch)?;
    let exclusions = region.exclusions.iter().map(|exclusion| moved(exclusion)).collect::<Result<_>>()?;
    let mut search = Search { ring: lex, exclusions, candidates, attempts: ATTEMPTS, watch };
    search.extend(equations, Vec::new())
}

struct Search<'a, 'b, F: Field> {
    ring: PolynomialRing<F>,
    exclusions: Vec<Vec<Polynomial<F::Element>>>,
    candidates: &'a mut Candidates<'b, F::Element>,
    attempts: usize,
    watch: &'a Watch,
}

impl<F: Field> Search<'_, '_, F> {
    /// A point that satisfies `equations` and whose last coordinates are `values`.
    fn extend(
        &mut self,
        equations: Vec<Polynomial<F::Element>>,
        values: Vec<F::Element>,
    ) -> Result<Option<Vec<F::Element>>> {
        let Some(variable) = (self.ring.variables().len() - values.len()).checked_sub(1) else {
            return Ok(self.is_outside_of_exclusions(&values).then_some(values));
        };
        let condition = equations.iter().find_map(|f| self.univariate(f, variable));
        for value in (self.candidates)(condition.as_ref()) {
            self.watch.check()?;
            let Some(left) = self.attempts.checked_sub(1) else { return Ok(None) };
            self.attempts = left;
            let step = self.ring.sub(&self.ring.variable(variable), &self.ring.constant(value.clone()));
            let narrowed = groebner(&self.ring, &[equations.as_slice(), &[step]].concat(), self.watch)?;
            if narrowed.iter().any(|f| self.ring.as_constant(f).is_some()) {
                continue;
            }
            let found = self.extend(narrowed, [&[value], values.as_slice()].concat())?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    fn is_outside_of_exclusions(&self, point: &[F::Element]) -> bool {
        let field = self.ring.field();
        let vanishes =
            |f: &Polynomial<F::Element>| field.is_zero(&self.ring.substitute(f, field, point, |c| c.clone()));
        self.exclusions.iter().all(|exclusion| !exclusion.iter().all(vanishes))
    }

    /// `f` as a polynomial in `variable`, if it has no other variable.
    fn univariate(&self, f: &Polynomial<F::Element>, variable: usize) -> Option<Univariate<F::Element>> {
        let ring = UnivariateRing::new(self.ring.field().clone(), self.ring.variables()[variable].clone());
        let parts = self.ring.coefficients_in(f, variable);
        let coefficients = parts.iter().map(|part| self.ring.as_constant(part)).collect::<Option<Vec<_>>>()?;
        (coefficients.len() > 1).then(|| ring.polynomial(coefficients))
    }
}
