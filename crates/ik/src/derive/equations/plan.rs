//! Selection of the order of the unknowns: its formulas are singular on the fewest and smallest strata.

use crate::derive::equations::setting::{Coefficients, Setting};
use crate::derive::equations::strata::{self, ZeroSet};
use crate::derive::equations::tree::collect_denominators;
use crate::derive::equations::triangular::triangularise;
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::groebner::{Basis, Quotient};
use groebot_algebra::poly::Order;

/// The maximum number of unknowns for which all orders are tried.
const ALL_ORDERS: usize = 5;

/// The singularities of an order's formulas. Smaller is better, compared field by field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub struct Score {
    /// Denominators whose zero set could not be described.
    pub open: usize,
    /// Denominators that vanish on a set of codimension one.
    pub surfaces: usize,
    /// Denominators that vanish on smaller sets only.
    pub thin: usize,
    /// The product of the degrees: the number of candidates of the triangular form.
    pub candidates: usize,
    /// The number of terms of all formulas.
    pub terms: usize,
}

/// The lexicographic basis with the best score. The setting's own order wins ties.
///
/// # Errors
/// The error of `watch` if it stops the search; [`ErrorKind::Overflow`].
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
/// If the setting's field cannot be built or the basis is not zero-dimensional.
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

/// The orders that are tried, the given one first. For few unknowns these are all orders, otherwise each unknown is once the smallest.
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
