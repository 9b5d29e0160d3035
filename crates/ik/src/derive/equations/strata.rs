//! The strata where a generic result may fail: the real zero sets of its denominators, as substitutions of parameters.

use std::collections::BTreeSet;

use crate::derive::equations::setting::{ParameterPoly, Setting, Substitution, Symbol, expression_of};
use crate::{Result, Watch};
use groebot_algebra::groebner::cover::forced_zeros;
use groebot_algebra::number::{BigInt, Rationals, Ring, Style};
use groebot_algebra::poly::{Expression, PolynomialRing, factor};

/// The zero set of a factor over the reals, under the assumptions on the parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum ZeroSet {
    /// The empty set, with the reason.
    Empty(String),
    /// The set where all these substitutions hold together.
    Graph(Vec<Substitution>),
    /// The set where `name` takes the value, an expression with a new parameter whose square is given.
    Root {
        /// The substitution.
        substitution: Substitution,
        /// The new parameter.
        symbol: Symbol,
    },
    /// A set without a known description, with the reason.
    Open(String),
}

type Ground = PolynomialRing<Rationals>;

/// The irreducible factors of `polynomials`, each once, the simplest first: by degree, number of terms, and text.
///
/// # Errors
/// As [`factor`].
pub(crate) fn factors(ring: &Ground, polynomials: &[ParameterPoly]) -> Result<Vec<ParameterPoly>> {
    let mut distinct: Vec<ParameterPoly> = Vec::new();
    for f in polynomials {
        for (part, _) in factor(ring, f, &Watch::none())?.factors {
            if !distinct.contains(&part) {
                distinct.push(part);
            }
        }
    }
    distinct.sort_by_cached_key(|f| (ring.degree(f), f.terms().len(), ring.format(f, Style::Text)));
    Ok(distinct)
}

/// Describes the real zeros of `factor` in `setting`.
///
/// # Errors
/// If the setting's field cannot be built.
pub(crate) fn zero_set(setting: &Setting, factor: &ParameterPoly) -> Result<ZeroSet> {
    let ring = setting.field()?.ring().clone();
    if let Some(definite) = definite(setting, &ring, factor) {
        return Ok(definite);
    }
    let solvable = |degree: u32| {
        (0..ring.variables().len()).rev().find(|&v| {
            let parts = ring.coefficients_in(factor, v);
            let related = setting.symbols.iter().any(|s| s.square.is_some() && s.name == ring.variables()[v]);
            let lead = &parts[parts.len() - 1];
            let used = setting.symbols[..=v].iter().chain(&setting.symbols[v + 1..]);
            let early =
                used.filter_map(|s| s.square.as_ref()).all(|e| !e.names().contains(&ring.variables()[v].as_str()));
            ring.degree_in(factor, v) == degree
                && !related
                && (early || degree == 1)
                && never_zero(setting, &ring, lead)
        })
    };
    if let Some(v) = solvable(1) {
        let parts = ring.coefficients_in(factor, v);
        let value = quotient(&ring, &ring.neg(&parts[0]), &parts[1]);
        let name = ring.variables()[v].clone();
        return Ok(ZeroSet::Graph(vec![Substitution { name, value }]));
    }
    Ok(match solvable(2) {
        Some(v) => root_of(setting, &ring, factor, v),
        None => ZeroSet::Open("it is not solvable for one parameter by a division or a square root".to_owned()),
    })
}

/// The zero set of a quadratic: `v = -b/2a + w` with `w^2 = (b^2 - 4ac)/4a^2`.
fn root_of(setting: &Setting, ring: &Ground, factor: &ParameterPoly, v: usize) -> ZeroSet {
    let parts = ring.coefficients_in(factor, v);
    let (c, b, a) = (&parts[0], &parts[1], &parts[2]);
    if ring.as_constant(a).is_none() {
        return ZeroSet::Open("its quadratic coefficient is not a number".to_owned());
    }
    let four = ring.from_integer(&BigInt::from(4));
    let discriminant = ring.sub(&ring.mul(b, b), &ring.mul(&four, &ring.mul(a, c)));
    let square = ring.exact_div(&discriminant, &ring.mul(&four, &ring.mul(a, a))).expect("a number divides");
    let centre = ring.exact_div(&ring.neg(b), &ring.add(a, a)).expect("a number divides");
    let name = ring.variables()[v].clone();
    let taken = |w: &str| setting.symbols.iter().any(|s| s.name == w) || setting.unknowns.iter().any(|u| u == w);
    let fresh = (1..).map(|k| format!("w{k}")).find(|w| !taken(w)).expect("there are infinitely many names");
    let value = Expression::sum(vec![expression_of(ring, &centre), Expression::name(fresh.clone())]);
    let symbol = Symbol { name: fresh, square: Some(expression_of(ring, &square)), positive: false };
    ZeroSet::Root { substitution: Substitution { name, value }, symbol }
}

fn quotient(ring: &Ground, top: &ParameterPoly, bottom: &ParameterPoly) -> Expression {
    match ring.exact_div(top, bottom) {
        Some(value) => expression_of(ring, &value),
        None => Expression::product(vec![
            expression_of(ring, top),
            Expression::Inverse(Box::new(expression_of(ring, bottom))),
        ]),
    }
}

fn never_zero(setting: &Setting, ring: &Ground, f: &ParameterPoly) -> bool {
    matches!(definite(setting, ring, f), Some(ZeroSet::Empty(_)))
}

/// The zero set of a sum of terms of one sign, such as squares: all its terms must vanish.
fn definite(setting: &Setting, ring: &Ground, f: &ParameterPoly) -> Option<ZeroSet> {
    let positive: Vec<bool> = setting.symbols.iter().map(|symbol| symbol.positive).collect();
    let Some(zeros) = forced_zeros(ring, f, &positive) else { return linear_power(setting, ring, f) };
    if zeros.iter().any(|zero| ring.as_constant(zero).is_some()) {
        return Some(ZeroSet::Empty(format!("{} keeps its sign", ring.format(f, Style::Text))));
    }
    let variable = |zero: &ParameterPoly| (0..ring.variables().len()).find(|&v| ring.variable(v) == *zero);
    let vanishing: BTreeSet<usize> = zeros.iter().filter_map(variable).collect();
    let is_zero_there =
        |zero: &ParameterPoly| vanishing.iter().any(|&v| ring.exact_div(zero, &ring.variable(v)).is_some());
    let substitution = |&v: &usize| Substitution { name: ring.variables()[v].clone(), value: Expression::integer(0) };
    zeros.iter().all(is_zero_there).then(|| ZeroSet::Graph(vanishing.iter().map(substitution).collect()))
}

/// The zero set of a power of a single variable.
fn linear_power(setting: &Setting, ring: &Ground, f: &ParameterPoly) -> Option<ZeroSet> {
    let [term] = f.terms() else { return None };
    let (v, _) = ring.layout().pure_power(&term.monomial)?;
    let name = setting.symbols[v].name.clone();
    Some(ZeroSet::Graph(vec![Substitution { name, value: Expression::integer(0) }]))
}
