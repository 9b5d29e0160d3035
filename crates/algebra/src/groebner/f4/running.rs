//! The running basis: elements, their leading monomials and the pairs between them.

use super::packing::{Key, Packing, quotient};
use crate::{Error, ErrorKind, Result};

/// A critical pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<const W: usize> {
    pub lcm: Key<W>,
    pub left: u32,
    pub right: u32,
    /// The degree that it would have had if the generators had been homogenised: its sugar.
    pub sugar: u32,
}

/// A leading monomial that may divide others.
#[derive(Clone, Copy, Debug)]
struct Lead<const W: usize> {
    key: Key<W>,
    element: u32,
    /// By how much its sugar exceeds the degree of its lead; the same for all its multiples.
    excess: u32,
}

/// Elements with their critical pairs, by the criteria of Gebauer and Moeller ("On an installation of Buchberger's
/// algorithm", J. Symbolic Computation 6, 1988).
#[derive(Clone, Debug)]
pub(super) struct Running<const W: usize> {
    pub packing: Packing<W>,
    /// The monomials of each element, greatest first; the coefficients are kept apart, so that replays share the rest.
    pub elements: Vec<Vec<Key<W>>>,
    /// The leads of the elements that are not redundant, in the order of their coming.
    leads: Vec<Lead<W>>,
    /// All leads, in an order that does not go by degree: there redundant elements reduce too. They are older, and their
    /// multiples have less sugar.
    all: Option<Vec<Lead<W>>>,
    pairs: Vec<Pair<W>>,
}

/// The error that makes the caller try again with wider lanes.
pub(super) fn overflow() -> Error {
    Error::new(ErrorKind::Overflow, "a monomial's degree exceeds what the widest lanes hold")
}

impl<const W: usize> Running<W> {
    /// Without elements; `by_degree` tells whether the order looks at the degree first.
    pub fn new(packing: Packing<W>, by_degree: bool) -> Self {
        let all = (!by_degree).then(Vec::new);
        Running { packing, elements: Vec::new(), leads: Vec::new(), all, pairs: Vec::new() }
    }

    /// The pairs that are still open.
    pub fn open(&self) -> usize {
        self.pairs.len()
    }

    /// The elements whose leads no other lead divides.
    pub fn live(&self) -> Vec<u32> {
        self.leads.iter().map(|lead| lead.element).collect()
    }

    /// The leading monomials of those elements.
    pub fn lead_keys(&self) -> impl Iterator<Item = &Key<W>> {
        self.leads.iter().map(|lead| &lead.key)
    }

    /// The first element, in the order of coming, whose leading monomial divides `key` and whose multiple's sugar is at most
    /// `bound`.
    #[inline]
    pub fn divisor(&self, key: &Key<W>, bound: u32) -> Option<u32> {
        let room = bound.saturating_sub(self.packing.degree(key));
        let reduces = |lead: &&Lead<W>| self.packing.divides(&lead.key, key) && lead.excess <= room;
        self.all.as_ref().unwrap_or(&self.leads).iter().find(reduces).map(|lead| lead.element)
    }

    /// Takes all pairs of the smallest sugar, grouped by their common multiple.
    pub fn select(&mut self) -> Vec<Pair<W>> {
        let Some(sugar) = self.pairs.iter().map(|pair| pair.sugar).min() else { return Vec::new() };
        let (mut selected, rest) =
            std::mem::take(&mut self.pairs).into_iter().partition::<Vec<_>, _>(|p| p.sugar == sugar);
        self.pairs = rest;
        selected.sort_by(|a, b| self.packing.compare(&a.lcm, &b.lcm).then(a.left.cmp(&b.left)));
        selected
    }

    /// Adds an element: old pairs that it makes superfluous go, those with it that no criterion drops come.
    pub fn adjoin(&mut self, keys: Vec<Key<W>>, sugar: u32) -> Result<()> {
        let lead = keys[0];
        let element = self.elements.len() as u32;
        let excess = sugar.saturating_sub(self.packing.degree(&lead));
        let fresh = self.fresh_pairs(&lead, element, excess)?;
        self.drop_covered(&lead);
        self.pairs.extend(fresh);
        let redundant = self.divisor(&lead, u32::MAX).is_some();
        let packing = &self.packing;
        self.leads.retain(|old| !packing.divides(&lead, &old.key));
        let head = Lead { key: lead, element, excess };
        if !redundant {
            self.leads.push(head);
        }
        if let Some(all) = &mut self.all {
            all.push(head);
        }
        self.elements.push(keys);
        Ok(())
    }

    /// Criterion B: a pair goes when the new lead divides its multiple strictly on both sides.
    fn drop_covered(&mut self, lead: &Key<W>) {
        let (packing, elements) = (&self.packing, &self.elements);
        let differs =
            |element: u32, lcm: &Key<W>| packing.lcm(lead, &elements[element as usize][0]).as_ref() != Some(lcm);
        self.pairs.retain(|pair| {
            !(packing.divides(lead, &pair.lcm) && differs(pair.left, &pair.lcm) && differs(pair.right, &pair.lcm))
        });
    }

    /// Criteria M and F and the product criterion among the pairs with the new element.
    fn fresh_pairs(&self, lead: &Key<W>, element: u32, excess: u32) -> Result<Vec<Pair<W>>> {
        let mut candidates = Vec::with_capacity(self.leads.len());
        for old in &self.leads {
            let lcm = self.packing.lcm(lead, &old.key).ok_or_else(overflow)?;
            let coprime = self.packing.coprime(lead, &old.key, &lcm);
            let degree = self.packing.degree(&lcm);
            let pair = Pair { lcm, left: old.element, right: element, sugar: degree + excess.max(old.excess) };
            candidates.push((degree, pair, coprime));
        }
        // Of equal multiples a coprime pair comes first: it drops the others, then goes itself.
        candidates.sort_by(|(d, a, x), (e, b, y)| {
            d.cmp(e).then(a.lcm.cmp(&b.lcm)).then(y.cmp(x)).then(a.sugar.cmp(&b.sugar)).then(a.left.cmp(&b.left))
        });
        let mut kept: Vec<(Pair<W>, bool)> = Vec::new();
        for (_, pair, coprime) in candidates {
            if !kept.iter().any(|(other, _)| self.packing.divides(&other.lcm, &pair.lcm)) {
                kept.push((pair, coprime));
            }
        }
        Ok(kept.into_iter().filter(|(_, coprime)| !coprime).map(|(pair, _)| pair).collect())
    }

    /// The multiplier that lifts `element` to `multiple`.
    pub fn multiplier(&self, element: u32, multiple: &Key<W>) -> Key<W> {
        quotient(multiple, &self.elements[element as usize][0])
    }
}
