//! Locally closed sets of parameters: a [`Region`] satisfies equations and avoids exclusions.

use super::ideals::{Ideal, Ideals};
use crate::Result;
use crate::number::Field;
use crate::poly::{Polynomial, PolynomialRing};

/// The zero set of `equations` without the zero sets of all `exclusions`. Plain data over the ring of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Region<E> {
    /// The reduced basis of the equations; empty when there are none.
    pub equations: Vec<Polynomial<E>>,
    /// Lists of polynomials. In each list, at least one polynomial is not zero.
    pub exclusions: Vec<Vec<Polynomial<E>>>,
}

impl<E> Region<E> {
    /// Whether `point` belongs to the region. It has one value for each parameter of `ring`. `embed` maps the numbers
    /// of the region to the field of the point.
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
    /// The canonical form of a region; `None` when it is empty. The equations are those of its closure. Exclusions that
    /// do not intersect the closure, or are contained in another one, are dropped.
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

    /// Ideals whose zero sets have the same union as those of `ideals`. They are split by factors, and none is
    /// contained in another.
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

    /// The factors of the first reducible polynomial in the list.
    pub fn reducible(&self, list: &[Polynomial<F::Element>]) -> Result<Option<Vec<Polynomial<F::Element>>>> {
        for f in list {
            let factors = self.factors(f)?;
            if factors.len() > 1 {
                return Ok(Some(factors));
            }
        }
        Ok(None)
    }

    /// The ideals whose zero sets are not empty and not contained in another one.
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

    /// Simplifies the exclusions of a region by factors and by its equations.
    pub fn simplified(&self, region: Region<F::Element>) -> Result<Region<F::Element>> {
        let mut exclusions = Vec::new();
        for component in self.components(&region.exclusions)? {
            exclusions.push(self.generators_beside(&region.equations, component)?);
        }
        Ok(Region { exclusions, ..region })
    }

    /// A subset of `ideal` that generates it together with `equations`. The most complicated polynomials are left out
    /// first.
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

    /// The part of `region` where all `equations` hold.
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

    /// The part of `region` outside the zero sets of `exclusions`.
    pub fn outside(
        &self,
        region: &Region<F::Element>,
        exclusions: &[Ideal<F::Element>],
    ) -> Result<Option<Region<F::Element>>> {
        self.region(region.equations.clone(), &[&region.exclusions, exclusions].concat())
    }

    /// Whether at each point of `region` some polynomial of `ideal` is not zero.
    pub fn misses(&self, region: &Region<F::Element>, ideal: &[Polynomial<F::Element>]) -> Result<bool> {
        Ok(self.closure_of(region, ideal)?.is_none())
    }

    /// The closure of the part of `region` where `equations` hold; `None` when it is empty.
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
