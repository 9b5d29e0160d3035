//! Locally closed sets of parameters: [`Region`] is where equations hold and exclusions do not.

use super::ideals::{Ideal, Ideals};
use crate::Result;
use crate::number::Field;
use crate::poly::{Polynomial, PolynomialRing};

/// The zero set of `equations` without the zero sets of all `exclusions`. Plain data over the ring of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Region<E> {
    /// The reduced basis of the equations; empty where nothing is required.
    pub equations: Vec<Polynomial<E>>,
    /// Of each list, not all polynomials are zero.
    pub exclusions: Vec<Vec<Polynomial<E>>>,
}

impl<E> Region<E> {
    /// Whether `point`, one value a parameter of `ring`, lies in the region; `embed` takes the numbers of the region to the
    /// field of the point.
    pub fn contains<F: Field<Element = E>, G: Field>(
        &self,
        ring: &PolynomialRing<F>,
        field: &G,
        point: &[G::Element],
        embed: &impl Fn(&E) -> G::Element,
    ) -> bool {
        let vanishes = |f: &Polynomial<E>| field.is_zero(&ring.substitute(f, field, point, embed));
        self.equations.iter().all(vanishes) && !self.exclusions.iter().any(|list| list.iter().all(vanishes))
    }
}

impl<F: Field> Ideals<'_, F> {
    /// The canonical form of a region, `None` when it is empty: the equations are those of its closure, and exclusions
    /// that do not meet the closure, or lie inside another, are dropped.
    pub fn region(
        &self,
        equations: Ideal<F::Element>,
        exclusions: &[Ideal<F::Element>],
    ) -> Result<Option<Region<F::Element>>> {
        let mut closure = equations;
        for exclusion in exclusions {
            closure = self.saturate(&closure, exclusion)?;
        }
        if self.is_unit(&closure) {
            return Ok(None);
        }
        let met = exclusions.iter().map(|exclusion| self.sum(&closure, exclusion)).collect::<Result<Vec<_>>>()?;
        let exclusions = self.largest(met)?;
        Ok(Some(Region { equations: closure, exclusions }))
    }

    /// Ideals whose zero sets make those of `ideals`, as small as factors split them, none inside another.
    pub fn components(&self, ideals: &[Ideal<F::Element>]) -> Result<Vec<Ideal<F::Element>>> {
        let mut open = ideals.to_vec();
        let mut done = Vec::new();
        while let Some(ideal) = open.pop() {
            self.watch.check()?;
            let Some(parts) = self.reducible(&ideal)? else {
                done.push(ideal);
                continue;
            };
            for part in parts {
                open.push(self.sum(&ideal, &[part])?);
            }
        }
        self.largest(done)
    }

    /// The factors of some polynomial of the list that has several.
    pub fn reducible(&self, list: &[Polynomial<F::Element>]) -> Result<Option<Vec<Polynomial<F::Element>>>> {
        for f in list {
            let factors = self.factors(f)?;
            if factors.len() > 1 {
                return Ok(Some(factors));
            }
        }
        Ok(None)
    }

    /// The ideals whose zero sets are not empty and lie in no other's.
    pub fn largest(&self, ideals: Vec<Ideal<F::Element>>) -> Result<Vec<Ideal<F::Element>>> {
        let mut kept: Vec<Ideal<F::Element>> = Vec::new();
        for ideal in ideals {
            let mut covered = self.is_unit(&ideal);
            for other in &kept {
                covered = covered || self.contains_all(&ideal, other)?;
            }
            if !covered {
                let mut outside = Vec::new();
                for other in kept {
                    if !self.contains_all(&other, &ideal)? {
                        outside.push(other);
                    }
                }
                kept = outside;
                kept.push(ideal);
            }
        }
        Ok(kept)
    }

    /// The same region with exclusions as simple as factors and the equations make them.
    pub fn simplified(&self, region: Region<F::Element>) -> Result<Region<F::Element>> {
        let mut exclusions = Vec::new();
        for component in self.components(&region.exclusions)? {
            exclusions.push(self.generators_beside(&region.equations, component)?);
        }
        Ok(Region { exclusions, ..region })
    }

    /// The polynomials of `ideal` that give it together with `equations`, the most complicated left out where that goes.
    fn generators_beside(
        &self,
        equations: &[Polynomial<F::Element>],
        ideal: Ideal<F::Element>,
    ) -> Result<Ideal<F::Element>> {
        let mut kept = ideal;
        kept.sort_by_key(|f| (self.ring.degree(f), f.terms().len()));
        for index in (0..kept.len()).rev() {
            let mut others = kept.clone();
            let dropped = others.remove(index);
            let rest = self.sum(equations, &others)?;
            if self.contains(&rest, &dropped)? {
                kept = others;
            }
        }
        Ok(kept)
    }

    /// The part of `region` where all of `equations` hold.
    pub fn within(
        &self,
        region: &Region<F::Element>,
        equations: &[Polynomial<F::Element>],
    ) -> Result<Option<Region<F::Element>>> {
        if self.contains_all(&region.equations, equations)? {
            return Ok(Some(region.clone()));
        }
        self.region(self.sum(&region.equations, equations)?, &region.exclusions)
    }

    /// The part of `region` outside of the zero sets of `exclusions`.
    pub fn outside(
        &self,
        region: &Region<F::Element>,
        exclusions: &[Ideal<F::Element>],
    ) -> Result<Option<Region<F::Element>>> {
        self.region(region.equations.clone(), &[&region.exclusions, exclusions].concat())
    }

    /// Whether some polynomial of each ideal is not zero at each point of `region`.
    pub fn misses(&self, region: &Region<F::Element>, ideal: &[Polynomial<F::Element>]) -> Result<bool> {
        Ok(self.closure_of(region, ideal)?.is_none())
    }

    /// The closure of the part of `region` where `equations` hold, `None` when there is none.
    pub fn closure_of(
        &self,
        region: &Region<F::Element>,
        equations: &[Polynomial<F::Element>],
    ) -> Result<Option<Ideal<F::Element>>> {
        let mut closure = self.sum(&region.equations, equations)?;
        for exclusion in &region.exclusions {
            if self.is_unit(&closure) {
                return Ok(None);
            }
            closure = self.saturate(&closure, exclusion)?;
        }
        Ok((!self.is_unit(&closure)).then_some(closure))
    }
}
