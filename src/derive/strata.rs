//! Where a generic result may fail: the real zero sets of its denominators, as substitutions of parameters.

use super::setting::{ParameterPoly, Setting, Substitution, Symbol, expression_of};
use crate::Result;
use crate::number::{BigInt, Rationals, Ring, Style};
use crate::poly::{Expression, PolynomialRing, refine_factors, split_quadratic, square_free_factors};

/// What the zero set of a factor is, over the reals and under the assumptions.
#[derive(Clone, Debug, PartialEq)]
pub enum ZeroSet {
    /// It is empty, for this reason.
    Empty(String),
    /// It is where all these substitutions hold together.
    Graph(Vec<Substitution>),
    /// It is where `name` takes the value, an expression that mentions a new parameter whose square is given.
    Root {
        /// The substitution.
        substitution: Substitution,
        /// The new parameter.
        symbol: Symbol,
    },
    /// This version has no description of it.
    Open(String),
}

type Ground = PolynomialRing<Rationals>;

/// Pairwise coprime factors of `polynomials`, each as irreducible as square-free splitting and square discriminants make it.
pub fn factors(ring: &Ground, polynomials: &[ParameterPoly]) -> Vec<ParameterPoly> {
    let mut distinct: Vec<ParameterPoly> = Vec::new();
    for f in polynomials {
        let f = ring.monic(f);
        if !distinct.contains(&f) {
            distinct.push(f);
        }
    }
    let split: Vec<_> = distinct.iter().flat_map(|f| square_free_factors(ring, f)).collect();
    let mut queue = refine_factors(ring, &split);
    let mut done = Vec::new();
    while let Some(f) = queue.pop() {
        match split_quadratic(ring, &f) {
            Some((a, b)) => queue.extend([a, b]),
            None => done.push(f),
        }
    }
    refine_factors(ring, &done)
}

/// Describes the real zeros of `factor` in `setting`.
///
/// # Errors
/// When the setting's field cannot be built.
pub fn zero_set(setting: &Setting, factor: &ParameterPoly) -> Result<ZeroSet> {
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

/// `v = -b/2a + w` with `w^2 = (b^2 - 4ac)/4a^2`.
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

/// A sum of terms that are all of one sign wherever parameters keep their assumed signs vanishes only where each term does.
fn definite(setting: &Setting, ring: &Ground, f: &ParameterPoly) -> Option<ZeroSet> {
    let positive = |v: usize| setting.symbols[v].positive;
    let zero = BigInt::from(0);
    let signs: Vec<bool> = f.terms().iter().map(|term| *term.coefficient.numer() > zero).collect();
    let exponents: Vec<Vec<u32>> = f.terms().iter().map(|term| ring.layout().exponents(&term.monomial)).collect();
    let even = exponents.iter().all(|e| e.iter().enumerate().all(|(v, k)| positive(v) || k % 2 == 0));
    if f.is_zero() || !even || signs.iter().any(|sign| *sign != signs[0]) {
        return linear_power(setting, ring, f);
    }
    let free = |e: &Vec<u32>| (0..e.len()).filter(|&v| e[v] > 0 && !positive(v)).collect::<Vec<_>>();
    let supports: Vec<Vec<usize>> = exponents.iter().map(free).collect();
    if supports.iter().any(Vec::is_empty) {
        return Some(ZeroSet::Empty(format!("{} keeps its sign", ring.format(f, Style::Text))));
    }
    let mut vanishing: Vec<usize> = supports.iter().filter(|s| s.len() == 1).map(|s| s[0]).collect();
    vanishing.sort_unstable();
    vanishing.dedup();
    let covered = supports.iter().all(|support| support.iter().any(|v| vanishing.contains(v)));
    let substitution = |&v: &usize| Substitution { name: ring.variables()[v].clone(), value: Expression::integer(0) };
    covered.then(|| ZeroSet::Graph(vanishing.iter().map(substitution).collect()))
}

/// A single variable.
fn linear_power(setting: &Setting, ring: &Ground, f: &ParameterPoly) -> Option<ZeroSet> {
    let [term] = f.terms() else { return None };
    let (v, _) = ring.layout().pure_power(&term.monomial)?;
    let name = setting.symbols[v].name.clone();
    Some(ZeroSet::Graph(vec![Substitution { name, value: Expression::integer(0) }]))
}
