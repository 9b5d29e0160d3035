//! An independent checker of covers: small, slow, and without the construction steps.

use super::emptiness::Regions;
use super::proof::{Claims, prove_basis, refused};
use super::{Cover, Region, Stratum};
use crate::number::{Field, Ring};
use crate::poly::{Fractions, Polynomial};
use crate::{Result, Watch};

/// Numbers of the statements that [`check`] has proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Checked {
    /// Strata whose bases are Groebner bases at each of their points.
    pub strata: usize,
    /// Pairs of strata that share no point.
    pub disjoint_pairs: usize,
    /// S-polynomials that reduce to zero on a whole stratum.
    pub s_polynomials: usize,
}

/// Proves that the strata of `cover` are disjoint and that their union is its whole space. Proves that each basis is a
/// Groebner basis of the specialised `generators`, at every point of its stratum over every extension field.
///
/// # Errors
/// [`crate::ErrorKind::Certificate`] with the statement that fails; [`crate::ErrorKind::Overflow`]; the error with
/// which `watch` stops the work.
pub fn check<'w, F: Field>(
    cover: &Cover<F>,
    generators: &[Polynomial<<Fractions<F> as Ring>::Element>],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Checked> {
    let watch = Watch::or_none(watch);
    let regions = Regions { ring: cover.ring.field().ring(), watch };
    regions.nothing_is_left(cover)?;
    let disjoint_pairs = regions.strata_are_disjoint(cover)?;
    let mut s_polynomials = 0;
    for (index, stratum) in cover.strata.iter().enumerate() {
        watch.report("check of a cover", index, cover.strata.len() - index);
        let claims = Claims { ring: &cover.ring, generators, stratum, watch };
        let proved = regions.leads_stay(cover, stratum).and_then(|()| prove_basis(&claims));
        s_polynomials += proved.map_err(|error| error.with_context(format!("stratum {}", index + 1)))?;
    }
    Ok(Checked { strata: cover.strata.len(), disjoint_pairs, s_polynomials })
}

fn both<E: Clone>(a: &Region<E>, b: &Region<E>) -> Region<E> {
    Region {
        equations: [a.equations.as_slice(), &b.equations].concat(),
        exclusions: [a.exclusions.as_slice(), &b.exclusions].concat(),
    }
}

impl<F: Field> Regions<'_, F> {
    /// Subtracts one stratum after the other from the space and checks that nothing is left.
    fn nothing_is_left(&self, cover: &Cover<F>) -> Result<()> {
        let exclusions = cover.space.nonzero.iter().map(|f| vec![f.clone()]).collect();
        let space = Region { equations: cover.space.equations.clone(), exclusions };
        let mut rest = if self.is_empty(&space)? { Vec::new() } else { vec![space] };
        for stratum in &cover.strata {
            let mut left = Vec::new();
            for part in &rest {
                for piece in difference(part, &stratum.region) {
                    if !self.is_empty(&piece)? {
                        left.push(piece);
                    }
                }
            }
            rest = left;
        }
        match rest.first() {
            Some(region) => Err(refused(format!("no stratum contains the points {}", cover.describe_region(region)))),
            None => Ok(()),
        }
    }

    /// Checks that no pair of strata shares a point. Returns the number of pairs.
    fn strata_are_disjoint(&self, cover: &Cover<F>) -> Result<usize> {
        let mut pairs = 0;
        for (index, second) in cover.strata.iter().enumerate() {
            for (other, first) in cover.strata[..index].iter().enumerate() {
                if !self.is_empty(&both(&first.region, &second.region))? {
                    return Err(refused(format!("strata {} and {} share points", other + 1, index + 1)));
                }
                pairs += 1;
            }
        }
        Ok(pairs)
    }

    /// Checks that at each point of the stratum some representative of each element keeps its leading coefficient.
    fn leads_stay(&self, cover: &Cover<F>, stratum: &Stratum<F>) -> Result<()> {
        for element in &stratum.basis {
            let leads = element.representatives.iter().filter_map(|f| f.leading());
            if leads.clone().any(|lead| lead.monomial != element.leading) {
                return Err(refused("a representative has another leading monomial than its element"));
            }
            let mut failure = stratum.region.clone();
            failure.equations.extend(leads.map(|lead| lead.coefficient.numerator().clone()));
            if !self.is_empty(&failure)? {
                return Err(refused(format!("leading coefficients vanish {}", cover.describe_region(&failure))));
            }
        }
        Ok(())
    }
}

/// The set difference `a` minus `b`: the points of `a` outside the zeros of `b`, or on one of its exclusions.
fn difference<E: Clone>(a: &Region<E>, b: &Region<E>) -> Vec<Region<E>> {
    let mut off = a.clone();
    off.exclusions.push(b.equations.clone());
    let on = |exclusion: &Vec<_>| {
        let mut part = a.clone();
        part.equations.extend_from_slice(&b.equations);
        part.equations.extend_from_slice(exclusion);
        part
    };
    b.exclusions.iter().map(on).chain([off]).collect()
}
