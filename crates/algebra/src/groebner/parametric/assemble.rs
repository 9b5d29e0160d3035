//! Elements over Q in unknowns and parameters, converted to polynomials over the rational functions of the parameters.

use std::collections::VecDeque;

use num_traits::One as _;

use super::on_a_line::Line;
use super::variables::reduced;
use super::{Poly, Ring};
use crate::groebner::Basis;
use crate::number::{BigInt, BigRational, Rationals, Ring as _, Zp, common_divisor};
use crate::poly::{Fractions, Monomial, Polynomial, PolynomialRing, Term, gcd};
use crate::{Result, Watch};

type Ground = Polynomial<BigRational>;
/// A polynomial in the unknowns, greatest monomials first.
type Parts = Vec<(Monomial, Ground)>;

/// The monomials of one element: for each monomial of the unknowns, greatest first, those of the parameters.
pub(super) struct Element {
    parts: Vec<(Vec<u32>, Vec<Monomial>)>,
}

impl Element {
    /// The support of `f`.
    pub fn new(ring: &Ring, flat: &PolynomialRing<Zp>, f: &Polynomial<u64>) -> Result<Self> {
        let count = ring.variables().len();
        let mut parts: Vec<(Vec<u32>, Vec<Monomial>)> = Vec::with_capacity(f.terms().len());
        for term in f.terms() {
            let mut exponents = flat.layout().exponents(&term.monomial);
            let monomial = ring.field().ring().monomial(&exponents[count..])?;
            exponents.truncate(count);
            match parts.last_mut().filter(|(unknowns, _)| *unknowns == exponents) {
                Some((_, monomials)) => monomials.push(monomial),
                None => parts.push((exponents, vec![monomial])),
            }
        }
        Ok(Element { parts })
    }

    /// The element with the given coefficients.
    fn with_values(self, ring: &Ring, values: &mut impl Iterator<Item = BigRational>) -> Result<Parts> {
        let part = |(exponents, monomials): (Vec<u32>, Vec<Monomial>)| {
            let terms = monomials.into_iter().zip(values.by_ref());
            let terms = terms.map(|(monomial, coefficient)| Term { coefficient, monomial });
            Ok((ring.monomial(&exponents)?, ring.field().ring().descending(terms.collect())))
        };
        self.parts.into_iter().map(part).collect()
    }
}

/// Multiplies polynomials, not all zero, by a number that makes their coefficients coprime integers.
fn make_integral(ground: &PolynomialRing<Rationals>, mut polynomials: Vec<&mut Ground>) {
    let numbers = || polynomials.iter().flat_map(|f| f.terms()).map(|term| &term.coefficient);
    let multiple = numbers()
        .filter(|q| !q.is_integer())
        .fold(BigInt::one(), |lcm, q| &lcm / common_divisor(&lcm, q.denom()) * q.denom());
    let mut divisor = BigInt::ZERO;
    for q in numbers() {
        if divisor.is_one() {
            break;
        }
        divisor = common_divisor(&divisor, q.numer());
    }
    let factor = BigRational::new(multiple, divisor);
    if !factor.is_one() {
        polynomials.iter_mut().for_each(|f| **f = ground.scale(f, &factor));
    }
}

/// Builds the reduced basis of elements with these coefficients, smallest first.
pub(super) fn assemble(
    ring: &Ring,
    elements: impl Iterator<Item = Result<Element>>,
    values: Vec<BigRational>,
    watch: &Watch,
) -> Result<Basis<Fractions<Rationals>>> {
    let mut values = values.into_iter();
    let elements = elements.map(|element| element?.with_values(ring, &mut values)).collect::<Result<Vec<Parts>>>()?;
    if ring.field().squares().next().is_some() {
        let polynomials = elements.into_iter().map(|parts| embedded(ring, parts)).filter(|f| !f.is_zero());
        return reduced(ring, polynomials.collect(), watch);
    }
    if elements.iter().any(|parts| parts[0].0 == ring.layout().one()) {
        return Ok(Basis { ring: ring.clone(), polynomials: vec![ring.one()], cofactors: Vec::new() });
    }
    let line = Line::new(ring);
    let elements = if are_reduced(ring, &elements) { elements } else { reduce_tails(ring, &line, elements, watch)? };
    let polynomials = elements.into_iter().map(|parts| line.divide_by_first(ring, parts)).collect();
    Ok(Basis { ring: ring.clone(), polynomials, cofactors: Vec::new() })
}

fn embedded(ring: &Ring, parts: Parts) -> Poly {
    ring.collect(parts.into_iter().map(|(monomial, c)| Term { coefficient: ring.field().embed(&c), monomial }))
}

/// Whether no leading monomial divides a monomial in another tail.
fn are_reduced(ring: &Ring, elements: &[Parts]) -> bool {
    elements.iter().enumerate().all(|(index, f)| !elements[..index].iter().any(|g| reduces(ring, g, f)))
}

/// Whether `g` may reduce the tail of `f`.
fn reduces(ring: &Ring, g: &Parts, f: &Parts) -> bool {
    f[1..].iter().any(|(monomial, _)| ring.layout().divides(&g[0].0, monomial))
}

/// Reduces all tails, smallest element first, with integer coefficients.
fn reduce_tails(ring: &Ring, line: &Line, elements: Vec<Parts>, watch: &Watch) -> Result<Vec<Parts>> {
    let mut done: Vec<Parts> = Vec::with_capacity(elements.len());
    let takes_part = |(index, f): (usize, &Parts)| {
        elements[..index].iter().any(|g| reduces(ring, g, f)) || elements[index..].iter().any(|g| reduces(ring, f, g))
    };
    let part: Vec<bool> = elements.iter().enumerate().map(takes_part).collect();
    for (mut parts, takes_part) in elements.into_iter().zip(part) {
        watch.check()?;
        if takes_part {
            make_integral(ring.field().ring(), parts.iter_mut().map(|(_, c)| c).collect());
        }
        done.push(reduce_tail(ring, line, parts, &done)?);
    }
    Ok(done)
}

/// Reduces the tail of `f` by the elements `smaller` without fractions: `f` is multiplied instead.
fn reduce_tail(ring: &Ring, line: &Line, f: Parts, smaller: &[Parts]) -> Result<Parts> {
    let layout = ring.layout();
    let mut done: Parts = Vec::with_capacity(f.len());
    let mut rest: VecDeque<(Monomial, Ground)> = f.into();
    let mut scales = Vec::new();
    while let Some((monomial, c)) = rest.pop_front() {
        let reducer = smaller.iter().find(|g| layout.divides(&g[0].0, &monomial)).filter(|_| !done.is_empty());
        let Some(reducer) = reducer else {
            done.push((monomial, c));
            continue;
        };
        let (scale, factor) = cross_factors(ring, &reducer[0].1, c);
        if let Some(scale) = scale {
            let multiply = |(_, c): &mut (Monomial, Ground)| *c = ring.field().ring().mul(c, &scale);
            done.iter_mut().chain(&mut rest).for_each(multiply);
            scales.push(scale);
        }
        let shift = layout.checked_div(&monomial, &reducer[0].0).expect("it divides");
        for (other, c) in &reducer[1..] {
            let product = layout.checked_mul(other, &shift).expect("a smaller monomial of the same ring");
            subtract(ring, &mut rest, product, &ring.field().ring().checked_mul(c, &factor)?);
        }
    }
    Ok(if scales.is_empty() { done } else { without_content(ring, line, done, &scales) })
}

/// The factor for `f`, if not one, and the factor for a reducer with the coefficient `lead`, so that `c` vanishes.
fn cross_factors(ring: &Ring, lead: &Ground, c: Ground) -> (Option<Ground>, Ground) {
    let ground = ring.field().ring();
    if ground.is_one(lead) {
        return (None, c);
    }
    if let Some(quotient) = ground.exact_div(&c, lead) {
        return (None, quotient);
    }
    let shared = gcd(ground, &c, lead);
    let divide = |f: &Ground| ground.exact_div(f, &shared).expect("a gcd divides");
    let (mut scale, mut factor) = (divide(lead), divide(&c));
    make_integral(ground, vec![&mut scale, &mut factor]);
    (Some(scale), factor)
}

/// Subtracts `c` from the coefficient of `monomial` in descending parts.
fn subtract(ring: &Ring, parts: &mut VecDeque<(Monomial, Ground)>, monomial: Monomial, c: &Ground) {
    let ground = ring.field().ring();
    let place = parts.partition_point(|(other, _)| ring.layout().compare(other, &monomial).is_gt());
    match parts.get_mut(place).filter(|(other, _)| *other == monomial) {
        None => parts.insert(place, (monomial, ground.neg(c))),
        Some((_, sum)) => {
            *sum = ground.sub(sum, c);
            if sum.is_zero() {
                parts.remove(place);
            }
        }
    }
}

/// Divides the parts by their common divisor, which is usually a product of these `scales`.
fn without_content(ring: &Ring, line: &Line, mut parts: Parts, scales: &[Ground]) -> Parts {
    let ground = ring.field().ring();
    let mut bound = line.content_bound(ring, &parts).unwrap_or(usize::MAX);
    for scale in scales {
        let degree = ground.degree(scale) as usize;
        while (1..=bound).contains(&degree)
            && let Some(quotients) = divided(ground, &parts, scale)
        {
            parts.iter_mut().zip(quotients).for_each(|((_, c), quotient)| *c = quotient);
            bound -= degree;
        }
    }
    if bound > 0 {
        let quotients = divided_by_content(ground, &parts);
        parts.iter_mut().zip(quotients).for_each(|((_, c), quotient)| *c = quotient);
    }
    make_integral(ground, parts.iter_mut().map(|(_, c)| c).collect());
    parts
}

/// All parts divided by `divisor`, if it divides them.
fn divided(ground: &PolynomialRing<Rationals>, parts: &Parts, divisor: &Ground) -> Option<Vec<Ground>> {
    parts.iter().map(|(_, c)| ground.exact_div(c, divisor)).collect()
}

/// All parts divided by their greatest common divisor.
fn divided_by_content(ground: &PolynomialRing<Rationals>, parts: &Parts) -> Vec<Ground> {
    let mut shortest: Vec<&Ground> = parts.iter().map(|(_, c)| c).collect();
    shortest.sort_by_key(|c| c.terms().len());
    let mut content = shortest[0].clone();
    for c in &shortest[1..] {
        if ground.degree(&content) > 0 {
            content = gcd(ground, &content, c);
        }
    }
    divided(ground, parts, &content).expect("a content divides")
}
