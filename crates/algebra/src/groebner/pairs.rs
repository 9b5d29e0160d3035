//! Critical pairs: the Gebauer-Moeller criteria and the selection strategies.
//!
//! R. Gebauer, H. M. Moeller, "On an installation of Buchberger's algorithm", J. Symbolic Computation 6 (1988);
//! A. Giovini et al., "One sugar cube, please", ISSAC 1991.

use std::cmp::Ordering;

use crate::Result;
use crate::number::Field;
use crate::poly::{Monomial, PolynomialRing};

/// Selection strategy for critical pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// Normal strategy: the least common multiple that is smallest in the monomial order.
    Normal,
    /// Sugar strategy: the smallest sugar degree (that of homogenised input), then as `Normal`. Better for
    /// lexicographic orders.
    #[default]
    Sugar,
}

/// A pair of basis elements whose S-polynomial is not yet reduced.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub left: usize,
    pub right: usize,
    pub lcm: Monomial,
    pub sugar: u32,
}

/// Data of a basis element for the pair criteria.
#[derive(Clone, Debug)]
pub(super) struct Head {
    pub monomial: Monomial,
    pub sugar: u32,
    /// Whether its leading monomial is a multiple of a later one. No new pairs are made with it.
    pub redundant: bool,
}

/// The open pairs of a running computation.
#[derive(Clone, Debug)]
pub(super) struct Pairs {
    open: Vec<Pair>,
    strategy: Strategy,
}

impl Pairs {
    pub fn new(strategy: Strategy) -> Self {
        Pairs { open: Vec::new(), strategy }
    }

    pub fn len(&self) -> usize {
        self.open.len()
    }

    /// Removes and returns the next pair.
    pub fn select<F: Field>(&mut self, ring: &PolynomialRing<F>) -> Option<Pair> {
        let compare = |a: &Pair, b: &Pair| {
            let sugar = match self.strategy {
                Strategy::Normal => Ordering::Equal,
                Strategy::Sugar => a.sugar.cmp(&b.sugar),
            };
            let lcm = || ring.layout().compare(&a.lcm, &b.lcm);
            sugar.then_with(lcm).then_with(|| (a.right, a.left).cmp(&(b.right, b.left)))
        };
        let (index, _) = self.open.iter().enumerate().min_by(|a, b| compare(a.1, b.1))?;
        Some(self.open.swap_remove(index))
    }

    /// Adds the element with index `heads.len()`: removes old pairs by the chain criterion and marks redundant
    /// elements. Of the new pairs, it keeps those that no other new pair covers and whose heads are not coprime. A
    /// constant removes all pairs.
    ///
    /// One of several new pairs with the same least common multiple is kept, a coprime one if there is any. A coprime
    /// pair represents the others and is then removed.
    pub fn update<F: Field>(&mut self, ring: &PolynomialRing<F>, heads: &mut Vec<Head>, new: Head) -> Result<()> {
        let layout = ring.layout();
        let index = heads.len();
        let lcms: Vec<Monomial> =
            heads.iter().map(|head| ring.lcm(&head.monomial, &new.monomial)).collect::<Result<_>>()?;
        if layout.degree(&new.monomial) == 0 {
            self.open.clear();
        }
        self.open.retain(|pair| {
            let covered = layout.divides(&new.monomial, &pair.lcm);
            !covered || lcms[pair.left] == pair.lcm || lcms[pair.right] == pair.lcm
        });
        let coprime = |k: usize| layout.coprime(&heads[k].monomial, &new.monomial);
        let live: Vec<usize> = (0..index).filter(|&k| !heads[k].redundant).collect();
        let mut kept: Vec<usize> = Vec::new();
        for (position, &k) in live.iter().enumerate() {
            let covers = |&other: &usize| layout.divides(&lcms[other], &lcms[k]);
            let covered = live[position + 1..].iter().any(covers) || kept.iter().any(covers);
            if coprime(k) || !covered {
                kept.push(k);
            }
        }
        for k in kept.into_iter().filter(|&k| !coprime(k)) {
            let sugar = pair_sugar(ring, &heads[k], &new, &lcms[k]);
            self.open.push(Pair { left: k, right: index, lcm: lcms[k].clone(), sugar });
        }
        for head in heads.iter_mut().filter(|head| layout.divides(&new.monomial, &head.monomial)) {
            head.redundant = true;
        }
        heads.push(new);
        Ok(())
    }
}

/// The sugar degree: the degree of the S-polynomial if the input had been homogenised.
fn pair_sugar<F: Field>(ring: &PolynomialRing<F>, a: &Head, b: &Head, lcm: &Monomial) -> u32 {
    let degree = |m: &Monomial| ring.layout().degree(m);
    let excess = (a.sugar - degree(&a.monomial)).max(b.sugar - degree(&b.monomial));
    degree(lcm).saturating_add(excess)
}
