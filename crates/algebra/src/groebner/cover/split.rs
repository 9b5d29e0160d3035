//! Partition of the parameter space into pieces with one basis each.
//!
//! Source: Kapur, Sun and Wang, ISSAC 2010, the algorithm PGBMain. All polynomials with the same leading monomial are
//! kept together. So a piece ends only where all their leading coefficients vanish.

use super::flat::{Flat, Head};
use super::ideals::{Ideal, Ideals};
use super::region::Region;
use crate::Result;
use crate::number::Field;
use crate::poly::Polynomial;

/// A region with constant leading monomials.
#[derive(Clone, Debug)]
pub(super) struct Piece<E> {
    pub region: Region<E>,
    /// The basis; empty where every point is a solution, the monomial 1 where there is none.
    pub heads: Vec<Head<E>>,
}

/// Pieces that are pairwise disjoint and whose union is `space`.
pub(super) fn pieces<F: Field>(
    ideals: &Ideals<'_, F>,
    flat: &Flat<F>,
    space: Region<F::Element>,
) -> Result<Vec<Piece<F::Element>>> {
    let mut open = vec![space];
    let mut done = Vec::new();
    while let Some(region) = open.pop() {
        ideals.watch.check()?;
        ideals.watch.report("cover: pieces", done.len(), open.len() + 1);
        let parts = flat.basis(&region.equations, ideals.watch)?;
        let inconsistent = ideals.outside(&region, std::slice::from_ref(&parts.conditions))?;
        done.extend(inconsistent.map(|region| Piece { region, heads: vec![unit(flat)] }));
        let Some(region) = ideals.within(&region, &parts.conditions)? else { continue };
        if region.equations != parts.conditions {
            open.push(region);
            continue;
        }
        let failures = failures(ideals, flat, &parts.heads, &region)?;
        let regular = ideals.outside(&region, &failures)?;
        done.extend(regular.map(|region| Piece { region, heads: parts.heads }));
        open.extend(one_after_the_other(ideals, &region, &failures)?);
    }
    Ok(done)
}

/// The basis element 1.
fn unit<F: Field>(flat: &Flat<F>) -> Head<F::Element> {
    Head { monomial: flat.unknowns().layout().one(), representatives: vec![flat.one()] }
}

/// Ideals with the union of zero sets where some head has no nonzero leading coefficient.
fn failures<F: Field>(
    ideals: &Ideals<'_, F>,
    flat: &Flat<F>,
    heads: &[Head<F::Element>],
    region: &Region<F::Element>,
) -> Result<Vec<Ideal<F::Element>>> {
    let mut failures = Vec::new();
    for head in heads {
        let coefficients = flat.leading_coefficients(head)?;
        let ideal = ideals.ideal(&coefficients)?;
        let parts: Vec<Ideal<F::Element>> = match ideal.as_slice() {
            [single] => ideals.factors(single)?.into_iter().map(|factor| vec![factor]).collect(),
            _ => vec![ideal],
        };
        for part in parts {
            failures.push(ideals.sum(&region.equations, &part)?);
        }
    }
    ideals.largest(failures)
}

/// The part of `region` in the first zero set, then the part in the second but not in the first, and so on.
fn one_after_the_other<F: Field>(
    ideals: &Ideals<'_, F>,
    region: &Region<F::Element>,
    zero_sets: &[Ideal<F::Element>],
) -> Result<Vec<Region<F::Element>>> {
    let mut parts = Vec::new();
    for (index, zero_set) in zero_sets.iter().enumerate() {
        if let Some(inside) = ideals.within(region, zero_set)? {
            parts.extend(ideals.outside(&inside, &zero_sets[..index])?);
        }
    }
    Ok(parts)
}

/// The first representative of `head` whose leading coefficient is nowhere zero on `region`, if there is one. Otherwise
/// the representatives that are not redundant.
pub(super) fn sufficient<F: Field>(
    ideals: &Ideals<'_, F>,
    flat: &Flat<F>,
    head: &Head<F::Element>,
    regions: &[&Region<F::Element>],
) -> Result<Option<Vec<Polynomial<F::Element>>>> {
    let coefficients = flat.leading_coefficients(head)?;
    let suffice = |chosen: &[usize]| -> Result<bool> {
        let ideal = ideals.ideal(&chosen.iter().map(|&i| coefficients[i].clone()).collect::<Vec<_>>())?;
        for region in regions {
            if !ideals.misses(region, &ideal)? {
                return Ok(false);
            }
        }
        Ok(true)
    };
    let mut chosen: Vec<usize> = (0..coefficients.len()).collect();
    chosen.sort_by_key(|&i| (head.representatives[i].terms().len(), ideals.ring.degree(&coefficients[i])));
    if !suffice(&chosen)? {
        return Ok(None);
    }
    for index in (0..chosen.len()).rev() {
        let mut fewer = chosen.clone();
        fewer.remove(index);
        if !fewer.is_empty() && suffice(&fewer)? {
            chosen = fewer;
        }
    }
    Ok(Some(chosen.iter().map(|&i| head.representatives[i].clone()).collect()))
}
