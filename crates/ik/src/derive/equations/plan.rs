//! Which order of the unknowns to solve in: the one whose formulas break down on the fewest, smallest strata.

use crate::derive::equations::setting::{Coefficients, Setting};
use crate::derive::equations::strata::{self, ZeroSet};
use crate::derive::equations::tree::collect_denominators;
use crate::derive::equations::triangular::triangularise;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::{Basis, Quotient};
use groebot_algebra::poly::Order;

/// Up to this many unknowns, all orders are tried.
const ALL_ORDERS: usize = 5;

/// How badly the formulas of an order break down; smaller is better, compared field by field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub struct Score {
    /// Denominators whose zero set could not be described.
    pub open: usize,
    /// Denominators that vanish on a set of codimension one.
    pub surfaces: usize,
    /// Denominators that vanish on smaller sets only.
    pub thin: usize,
    /// The product of the stairs' degrees: candidates that are tried.
    pub candidates: usize,
    /// Terms of all formulas.
    pub terms: usize,
}

/// The lexicographic basis with the best score; the setting's own order wins ties.
///
/// # Errors
/// What `watch` stops with; [`ErrorKind::Overflow`].
pub(in crate::derive) fn best_order(
    setting: &Setting,
    quotient: &Quotient<Coefficients>,
    watch: &Watch,
) -> Result<Basis<Coefficients>> {
    let orders = orders(&setting.unknowns);
    let mut best: Option<(Score, Basis<Coefficients>)> = None;
    for (index, names) in orders.iter().enumerate() {
        watch.check()?;
        watch.report("search of orders", index, orders.len() - index);
        let basis = quotient.basis_in(&setting.ring(names, Order::Lex)?, watch)?;
        let score = score(setting, &basis)?;
        if best.as_ref().is_none_or(|(least, _)| score < *least) {
            best = Some((score, basis));
        }
    }
    best.map(|(_, basis)| basis).ok_or_else(|| Error::new(ErrorKind::BadValue, "a system without unknowns"))
}

/// The score of a basis' formulas in `setting`.
///
/// # Errors
/// When the setting's field cannot be built or the basis is not zero-dimensional.
pub fn score(setting: &Setting, basis: &Basis<Coefficients>) -> Result<Score> {
    let ground = basis.ring.field().ring();
    let mut denominators = Vec::new();
    collect_denominators(ground, basis.polynomials.iter(), &mut denominators);
    let triangular = triangularise(&basis.ring, &basis.polynomials)?;
    let terms = basis.polynomials.iter().map(|f| f.terms().len()).sum();
    let mut score = Score { open: 0, surfaces: 0, thin: 0, candidates: triangular.bound(), terms };
    for factor in strata::factors(ground, &denominators)? {
        match strata::zero_set(setting, &factor)? {
            ZeroSet::Empty(_) => {}
            ZeroSet::Open(_) => score.open += 1,
            ZeroSet::Graph(substitutions) if substitutions.len() > 1 => score.thin += 1,
            ZeroSet::Graph(_) | ZeroSet::Root { .. } => score.surfaces += 1,
        }
    }
    Ok(score)
}

/// The orders that are tried, the given one first: all of them for few unknowns, else each unknown once in the smallest place.
fn orders(unknowns: &[String]) -> Vec<Vec<String>> {
    if unknowns.len() <= ALL_ORDERS {
        let mut orders = Vec::new();
        permute(unknowns, &mut Vec::new(), &mut orders);
        return orders;
    }
    let last_moved = |k: usize| {
        let mut order = unknowns.to_vec();
        let name = order.remove(k);
        order.push(name);
        order
    };
    (0..unknowns.len()).rev().map(last_moved).collect()
}

fn permute(names: &[String], chosen: &mut Vec<String>, orders: &mut Vec<Vec<String>>) {
    if chosen.len() == names.len() {
        orders.push(chosen.clone());
        return;
    }
    for name in names {
        if !chosen.contains(name) {
            chosen.push(name.clone());
            permute(names, chosen, orders);
            chosen.pop();
        }
    }
}
