//! The running basis: elements, their leading monomials and the critical pairs.

use super::packing::{Key, Packing, quotient};
use crate::{Error, ErrorKind, Result};

/// A critical pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<const W: usize> {
    pub lcm: Key<W>,
    pub left: u32,
    pub right: u32,
    /// The sugar degree: the degree of the S-polynomial if the generators had been homogenised.
    pub sugar: u32,
}

/// A leading monomial as a possible divisor.
#[derive(Clone, Copy, Debug)]
struct Lead<const W: usize> {
    key: Key<W>,
    element: u32,
    /// Sugar minus degree of the leading monomial. It is equal for all multiples.
    excess: u32,
}

/// Elements with their critical pairs, by the criteria of Gebauer and Moeller ("On an installation of Buchberger's
/// algorithm", J. Symbolic Computation 6, 1988).
#[derive(Clone, Debug)]
pub(super) struct Running<const W: usize> {
    pub packing: Packing<W>,
    /// The monomials of each element, greatest first. The coefficients are stored separately, so that replays share the
    /// monomials.
    pub elements: Vec<Vec<Key<W>>>,
    /// The leading monomials of the elements that are not redundant, in the order of insertion.
    leads: Vec<Lead<W>>,
    /// All leading monomials, for orders that do not compare degrees first. There redundant elements are used as
    /// reducers too: they are older, and their multiples have less sugar.
    all: Option<Vec<Lead<W>>>,
    pairs: Vec<Pair<W>>,
}

/// The error after which the caller tries again with wider lanes.
pub(super) fn overflow() -> Error {
    Error::new(ErrorKind::Overflow, "a monomial's degree exceeds the widest lanes")
}

impl<const W: usize> Running<W> {
    /// An empty running basis. `by_degree` is true if the order compares degrees first.
    pub fn new(packing: Packing<W>, by_degree: bool) -> Self {
        let all = (!by_degree).then(Vec::new);
        Running { packing, elements: Vec::new(), leads: Vec::new(), all, pairs: Vec::new() }
    }

    /// The number of open pairs.
    pub fn open(&self) -> usize {
        self.pairs.len()
    }

    /// The elements that are not redundant.
    pub fn live(&self) -> Vec<u32> {
        self.leads.iter().map(|lead| lead.element).collect()
    }

    /// The leading monomials of those elements.
    pub fn lead_keys(&self) -> impl Iterator<Item = &Key<W>> {
        self.leads.iter().map(|lead| &lead.key)
    }

    /// The first inserted element whose leading monomial divides `key` and whose multiple's sugar is at most `bound`.
    #[inline]
    pub fn divisor(&self, key: &Key<W>, bound: u32) -> Option<u32> {
        let room = bound.saturating_sub(self.packing.degree(key));
        let reduces = |lead: &&Lead<W>| self.packing.divides(&lead.key, key) && lead.excess <= room;
        self.all.as_ref().unwrap_or(&self.leads).iter().find(reduces).map(|lead| lead.element)
    }

    /// Removes and returns all pairs of the smallest sugar, grouped by their least common multiple.
    pub fn select(&mut self) -> Vec<Pair<W>> {
        let Some(sugar) = self.pairs.iter().map(|pair| pair.sugar).min() else { return Vec::new() };
        let (mut selected, rest) =
            std::mem::take(&mut self.pairs).into_iter().partition::<Vec<_>, _>(|p| p.sugar == sugar);
        self.pairs = rest;
        selected.sort_by(|a, b| self.packing.compare(&a.lcm, &b.lcm).then(a.left.cmp(&b.left)));
        selected
    }

    /// Adds an element. Removes old pairs that it makes redundant and adds its own pairs that no criterion excludes.
    pub fn adjoin(&mut self, keys: Vec<Key<W>>, sugar: u32) -> Result<()> {
        let lead = keys[0];
        let element = self.elements.len() as u32;
        let excess = sugar.saturating_sub(self.packing.degree(&lead));
        let fresh = self.fresh_pairs(&lead, element, excess)?;
        self.drop_covered(&lead);
        self.pairs.extend(fresh);
        let head = Lead { key: lead, element, excess };
        // An old element of the same leading monomial stays: it may have had too much sugar to reduce the new one.
        if self.divisor(&lead, u32::MAX).is_none() {
            let packing = &self.packing;
            self.leads.retain(|old| !packing.divides(&lead, &old.key));
            self.leads.push(head);
        }
        if let Some(all) = &mut self.all {
            all.push(head);
        }
        self.elements.push(keys);
        Ok(())
    }

    /// Criterion B: removes a pair when the new leading monomial divides its least common multiple strictly on both
    /// sides.
    fn drop_covered(&mut self, lead: &Key<W>) {
        let (packing, elements) = (&self.packing, &self.elements);
        let differs =
            |element: u32, lcm: &Key<W>| packing.lcm(lead, &elements[element as usize][0]).as_ref() != Some(lcm);
        self.pairs.retain(|pair| {
            !(packing.divides(lead, &pair.lcm) && differs(pair.left, &pair.lcm) && differs(pair.right, &pair.lcm))
        });
    }

    /// The pairs with the new element that pass criteria M and F and the product criterion.
    fn fresh_pairs(&self, lead: &Key<W>, element: u32, excess: u32) -> Result<Vec<Pair<W>>> {
        let mut candidates = Vec::with_capacity(self.leads.len());
        for old in &self.leads {
            let lcm = self.packing.lcm(lead, &old.key).ok_or_else(overflow)?;
            let coprime = self.packing.coprime(lead, &old.key, &lcm);
            let degree = self.packing.degree(&lcm);
            let pair = Pair { lcm, left: old.element, right: element, sugar: degree + excess.max(old.excess) };
            candidates.push((degree, pair, coprime));
        }
        // Among pairs with equal least common multiples, a coprime pair is first. It removes the others and is then
        // removed.
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

    /// The monomial by which `element` is multiplied to have the leading monomial `multiple`.
    pub fn multiplier(&self, element: u32, multiple: &Key<W>) -> Key<W> {
        quotient(multiple, &self.elements[element as usize][0])
    }
}
