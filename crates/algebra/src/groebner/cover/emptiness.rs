//! Emptiness test for regions of parameters, by Rabinowitsch's trick with one new variable for each exclusion.

use super::Region;
use super::ideals::groebner;
use crate::groebner::normal_form;
use crate::number::{Field, Ring};
use crate::poly::{Order, Polynomial, PolynomialRing};
use crate::{Result, Watch};

/// Tests of regions of the parameters of `ring`.
pub(super) struct Regions<'a, F: Field> {
    pub ring: &'a PolynomialRing<F>,
    pub watch: &'a Watch,
}

impl<F: Field> Regions<'_, F> {
    /// Whether `region` has no point over any extension field. The test tries each choice of one polynomial per
    /// exclusion: the equations must contradict that all chosen polynomials are invertible.
    pub fn is_empty(&self, region: &Region<F::Element>) -> Result<bool> {
        let taken = |name: &String| self.ring.generator(name).is_some();
        let fresh = (0..).map(|k| format!("t{k}")).filter(|name| !taken(name)).take(region.exclusions.len());
        let names: Vec<String> = fresh.chain(self.ring.variables().iter().cloned()).collect();
        let ring = PolynomialRing::new(self.ring.field().clone(), &names, Order::GrevLex)?;
        let moved = |list: &[Polynomial<F::Element>]| -> Result<Vec<_>> {
            list.iter().map(|f| self.ring.transfer(f, &ring)).collect()
        };
        let exclusions = region.exclusions.iter().map(|exclusion| moved(exclusion)).collect::<Result<Vec<_>>>()?;
        self.contradicts(&ring, &moved(&region.equations)?, &exclusions)
    }

    fn contradicts(
        &self,
        ring: &PolynomialRing<F>,
        equations: &[Polynomial<F::Element>],
        exclusions: &[Vec<Polynomial<F::Element>>],
    ) -> Result<bool> {
        let basis = groebner(ring, equations, self.watch)?;
        let unit = basis.iter().any(|f| ring.as_constant(f).is_some());
        let Some((first, rest)) = exclusions.split_first() else { return Ok(unit) };
        for f in if unit { &[] } else { first.as_slice() } {
            let f = normal_form(ring, f, &basis)?;
            let inverse = ring.checked_mul(&ring.variable(rest.len()), &f)?;
            let step = ring.sub(&inverse, &ring.one());
            if !self.contradicts(ring, &[basis.as_slice(), &[step]].concat(), rest)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
