//! Merging of pieces that have the same leading monomials and a common basis.
//!
//! Source: Montes and Wibmer, "Groebner bases for polynomial systems with parameters", J. Symbolic Computation 45
//! (2010): a segment is locally closed, and an element of its basis may need several polynomials, each valid on an open
//! part; Brunat and Montes, "Computing the canonical representation of constructible sets", Math. Comput. Sci. 10
//! (2016).

use super::flat::{Flat, Head};
use super::ideals::{Ideal, Ideals};
use super::region::Region;
use super::split::{Piece, sufficient};
use super::tidy::tidy;
use super::{Element, Kind, RealPoints, Stratum};
use crate::Result;
use crate::number::Field;
use crate::poly::Monomial;

/// Input of the merging.
struct Merging<'a, F: Field> {
    ideals: &'a Ideals<'a, F>,
    flat: &'a Flat<F>,
    pieces: &'a [Piece<F::Element>],
    /// Zero sets outside the parameter space.
    forbidden: &'a [Ideal<F::Element>],
}

/// Merges `pieces` with the same leading monomials to strata as far as possible.
pub(super) fn merged<F: Field>(
    ideals: &Ideals<'_, F>,
    flat: &Flat<F>,
    pieces: &[Piece<F::Element>],
    forbidden: &[Ideal<F::Element>],
) -> Result<Vec<Stratum<F>>> {
    let merging = Merging { ideals, flat, pieces, forbidden };
    let mut strata = Vec::new();
    for group in merging.groups() {
        strata.extend(merging.joined(&group)?);
    }
    strata.sort_by_key(|stratum| (stratum.region.equations.len(), stratum.kind == Kind::Inconsistent));
    Ok(strata)
}

impl<F: Field> Merging<'_, F> {
    /// The indices of pieces with the same leading monomials.
    fn groups(&self) -> Vec<Vec<usize>> {
        let leads = |index: usize| self.pieces[index].heads.iter().map(|head| &head.monomial).collect::<Vec<_>>();
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for index in 0..self.pieces.len() {
            match groups.iter_mut().find(|group| leads(group[0]) == leads(index)) {
                Some(group) => group.push(index),
                None => groups.push(vec![index]),
            }
        }
        groups
    }

    /// Merges all of `group` to one stratum if possible. Otherwise adds one piece after the other to the first stratum
    /// that can be merged with it.
    fn joined(&self, group: &[usize]) -> Result<Vec<Stratum<F>>> {
        if let Some(stratum) = self.stratum(group)? {
            return Ok(vec![stratum]);
        }
        let mut open: Vec<usize> = group.to_vec();
        let mut strata = Vec::new();
        while let Some((&first, rest)) = open.split_first() {
            let mut members = vec![first];
            let mut best = self.stratum(&members)?.expect("a part has a separate basis");
            let mut left = rest.to_vec();
            let mut grew = true;
            while std::mem::take(&mut grew) {
                for candidate in std::mem::take(&mut left) {
                    let larger = [members.as_slice(), &[candidate]].concat();
                    match self.stratum(&larger)? {
                        Some(stratum) => (members, best, grew) = (larger, stratum, true),
                        None => left.push(candidate),
                    }
                }
            }
            strata.push(best);
            open = left;
        }
        Ok(strata)
    }

    /// The union of `members`, if it is locally closed and has one basis.
    fn stratum(&self, members: &[usize]) -> Result<Option<Stratum<F>>> {
        self.ideals.watch.check()?;
        self.ideals.watch.report("cover: strata", members.len(), self.pieces.len());
        let Some(region) = self.union(members)? else { return Ok(None) };
        let heads = match members {
            [single] => self.pieces[*single].heads.clone(),
            _ => self.flat.basis(&region.equations, self.ideals.watch)?.heads,
        };
        let leads: Vec<_> = self.pieces[members[0]].heads.iter().map(|head| &head.monomial).collect();
        let kind = Kind::of(self.flat.unknowns(), &leads);
        let mut basis = Vec::new();
        for lead in leads {
            match self.element(members, lead, &heads)? {
                Some(element) => basis.push(element),
                None => return Ok(None),
            }
        }
        let basis = tidy(self.ideals, self.flat.unknowns(), &region, basis)?;
        let region = self.ideals.simplified(region)?;
        let parts = self.ideals.components(std::slice::from_ref(&region.equations))?;
        Ok(Some(Stratum { region, parts, basis, kind, real: RealPoints::Unknown }))
    }

    /// The union of `members` as closure and holes; `None` when it is not locally closed, that is, when the closure of
    /// a hole intersects it.
    fn union(&self, members: &[usize]) -> Result<Option<Region<F::Element>>> {
        if let [single] = members {
            return Ok(Some(self.pieces[*single].region.clone()));
        }
        let closures: Vec<_> = members.iter().map(|&i| self.pieces[i].region.equations.clone()).collect();
        let closure = self.ideals.union(&closures)?;
        let mut holes = Vec::new();
        for other in (0..self.pieces.len()).filter(|index| !members.contains(index)) {
            holes.extend(self.ideals.closure_of(&self.pieces[other].region, &closure)?);
        }
        for outside in self.forbidden {
            holes.push(self.ideals.sum(&closure, outside)?);
        }
        let holes = self.ideals.largest(holes)?;
        for hole in &holes {
            for &member in members {
                if !self.ideals.misses(&self.pieces[member].region, hole)? {
                    return Ok(None);
                }
            }
        }
        Ok(Some(Region { equations: closure, exclusions: holes }))
    }

    /// The basis element with the leading monomial `lead` on `members`, if the polynomials of `heads` determine it
    /// everywhere.
    fn element(&self, members: &[usize], lead: &Monomial, heads: &[Head<F::Element>]) -> Result<Option<Element<F>>> {
        let one = self.flat.unknowns().layout().one();
        if *lead == one {
            let unit = self.flat.lift(&self.flat.one())?;
            return Ok(Some(Element { leading: one, representatives: vec![unit] }));
        }
        let Some(head) = heads.iter().find(|head| head.monomial == *lead) else { return Ok(None) };
        let regions: Vec<_> = members.iter().map(|&i| &self.pieces[i].region).collect();
        let Some(chosen) = sufficient(self.ideals, self.flat, head, &regions)? else { return Ok(None) };
        let representatives = chosen.iter().map(|f| self.flat.lift(f)).collect::<Result<_>>()?;
        Ok(Some(Element { leading: lead.clone(), representatives }))
    }
}
