//! Univariate factorization over the integers: factors modulo a prime, Hensel lifting to a power of it, and
//! recombination (Zassenhaus 1969; von zur Gathen and Gerhard, Modern Computer Algebra, algorithms 15.10, 15.17 and
//! 15.19).

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::finite;
use super::lift::first_subset;
use crate::number::{BigInt, Zp};
use crate::poly::words::dense::{self, Dense};
use crate::poly::words::{Prime, residue};
use crate::{Result, Watch};

/// A dense polynomial over the integers, constant term first, the last coefficient not zero.
pub type Integers = Vec<BigInt>;

/// Number of primes from which the one with the fewest factors is chosen.
const PRIMES: usize = 7;

/// The primitive irreducible factors of a square-free, primitive, non-constant polynomial.
pub fn factors(f: &Integers, watch: &Watch) -> Result<Vec<Integers>> {
    let (field, local) = few_factors(f, watch)?;
    if local.len() == 1 {
        return Ok(vec![f.clone()]);
    }
    let norm: BigInt = f.iter().map(BigInt::abs).sum();
    let bits = f.len() as u64 + norm.bits() + f[f.len() - 1].bits() + 2;
    let mut modulus = BigInt::from(field.modulus());
    let mut steps = 0;
    while modulus.bits() <= bits {
        modulus = &modulus * &modulus;
        steps += 1;
    }
    let inverse = inverse_modulo(&f[f.len() - 1], &modulus);
    let monic = reduced(&f.iter().map(|c| c * &inverse).collect::<Vec<_>>(), &modulus);
    let mut lifted = Vec::new();
    lift(&field, &monic, &local, steps, &mut lifted, watch)?;
    recombine(f.clone(), &lifted, &modulus, watch)
}

/// Chooses a prime modulo which `f` stays square-free and keeps its degree, and returns the factors there. Of several
/// primes it takes the one with the fewest factors.
fn few_factors(f: &Integers, watch: &Watch) -> Result<(Prime, Vec<Dense>)> {
    let mut best: Option<(Prime, Vec<Dense>)> = None;
    let mut found = 0;
    for p in (17u64..).filter(|&p| Zp::new(p).is_ok()) {
        let field = Prime::new(p);
        let image: Dense = f.iter().map(|c| residue(c, &field)).collect();
        if image.last() == Some(&0) || dense::gcd(&field, &image, &dense::derivative(&field, &image)).len() != 1 {
            continue;
        }
        let local = finite::factors(&field, &image, watch)?;
        if best.as_ref().is_none_or(|(_, factors)| local.len() < factors.len()) {
            best = Some((field, local));
        }
        found += 1;
        if found == PRIMES || best.as_ref().is_some_and(|(_, factors)| factors.len() == 1) {
            break;
        }
    }
    Ok(best.expect("a square-free polynomial is square-free modulo almost all primes"))
}

fn inverse_modulo(a: &BigInt, modulus: &BigInt) -> BigInt {
    a.mod_floor(modulus).extended_gcd(modulus).x.mod_floor(modulus)
}

fn reduced(f: &[BigInt], modulus: &BigInt) -> Integers {
    let mut result: Integers = f.iter().map(|c| c.mod_floor(modulus)).collect();
    while result.last().is_some_and(Zero::is_zero) {
        result.pop();
    }
    result
}

fn multiplied(f: &[BigInt], g: &[BigInt], modulus: &BigInt) -> Integers {
    let mut product = vec![BigInt::zero(); (f.len() + g.len()).saturating_sub(1)];
    for (i, a) in f.iter().enumerate() {
        g.iter().enumerate().for_each(|(j, b)| product[i + j] += a * b);
    }
    reduced(&product, modulus)
}

/// `f + sign g`.
fn added(f: &[BigInt], g: &[BigInt], sign: i32, modulus: &BigInt) -> Integers {
    let at = |h: &[BigInt], k: usize| h.get(k).cloned().unwrap_or_default();
    let sum: Integers = (0..f.len().max(g.len())).map(|k| at(f, k) + at(g, k) * sign).collect();
    reduced(&sum, modulus)
}

/// Quotient and remainder by a monic polynomial.
fn divided(f: &[BigInt], g: &[BigInt], modulus: &BigInt) -> (Integers, Integers) {
    let mut rest = f.to_vec();
    let mut quotient = vec![BigInt::zero(); (f.len() + 1).saturating_sub(g.len())];
    for shift in (0..quotient.len()).rev() {
        let factor = rest[shift + g.len() - 1].mod_floor(modulus);
        g.iter().enumerate().for_each(|(k, c)| rest[shift + k] -= &factor * c);
        quotient[shift] = factor;
    }
    (reduced(&quotient, modulus), reduced(&rest, modulus))
}

fn to_integers(f: &[u64]) -> Integers {
    f.iter().map(|&c| BigInt::from(c)).collect()
}

/// Lifts the monic `local` factors of the monic `f` from `p` to `p^(2^steps)`, halving the factors each time.
fn lift(
    field: &Prime,
    f: &Integers,
    local: &[Dense],
    steps: u32,
    lifted: &mut Vec<Integers>,
    watch: &Watch,
) -> Result<()> {
    if local.len() == 1 {
        lifted.push(f.clone());
        return Ok(());
    }
    let (left, right) = local.split_at(local.len() / 2);
    let [g, h] = [left, right].map(|part| part.iter().fold(vec![1], |product, u| dense::mul(field, &product, u)));
    let s = dense::inverse_modulo(field, &g, &h).expect("the factors are coprime");
    let rest = dense::sub(field, &[1], &dense::mul(field, &s, &g));
    let t = dense::div_rem(field, &rest, &h).0;
    let [mut g, mut h, mut s, mut t] = [g, h, s, t].map(|part| to_integers(&part));
    let mut modulus = BigInt::from(field.modulus());
    for _ in 0..steps {
        watch.check()?;
        modulus = &modulus * &modulus;
        [g, h, s, t] = hensel_step(f, [g, h, s, t], &modulus);
    }
    lift(field, &g, left, steps, lifted, watch)?;
    lift(field, &h, right, steps, lifted, watch)
}

/// Hensel step, algorithm 15.10: lifts `f = g h` and `s g + t h = 1` from modulo `m` to modulo `m^2 = modulus`.
fn hensel_step(f: &[BigInt], [g, h, s, t]: [Integers; 4], modulus: &BigInt) -> [Integers; 4] {
    let times = |a: &[BigInt], b: &[BigInt]| multiplied(a, b, modulus);
    let error = added(f, &times(&g, &h), -1, modulus);
    let (quotient, rest) = divided(&times(&s, &error), &h, modulus);
    let correction = added(&times(&t, &error), &times(&quotient, &g), 1, modulus);
    let (g, h) = (added(&g, &correction, 1, modulus), added(&h, &rest, 1, modulus));
    let sum = added(&times(&s, &g), &times(&t, &h), 1, modulus);
    let error = added(&sum, &[BigInt::one()], -1, modulus);
    let (quotient, rest) = divided(&times(&s, &error), &h, modulus);
    let correction = added(&times(&t, &error), &times(&quotient, &g), 1, modulus);
    let (s, t) = (added(&s, &rest, -1, modulus), added(&t, &correction, -1, modulus));
    [g, h, s, t]
}

/// Finds the true factors among the products of the lifted ones, products of few factors first.
fn recombine(mut f: Integers, lifted: &[Integers], modulus: &BigInt, watch: &Watch) -> Result<Vec<Integers>> {
    let mut open: Vec<usize> = (0..lifted.len()).collect();
    let (mut factors, mut size) = (Vec::new(), 1);
    while 2 * size <= open.len() {
        let mut found = None;
        let part = first_subset(&open, size, watch, |chosen| {
            found = true_factor(&f, lifted, chosen, modulus);
            found.is_some()
        })?;
        match (part, found) {
            (Some(part), Some((factor, rest))) => {
                factors.push(factor);
                f = rest;
                open.retain(|i| !part.contains(i));
            }
            _ => size += 1,
        }
    }
    factors.push(f);
    Ok(factors)
}

fn symmetric(c: BigInt, modulus: &BigInt) -> BigInt {
    let c = c.mod_floor(modulus);
    if &c + &c > *modulus { c - modulus } else { c }
}

/// The factor of `f` that is the product of the `chosen` lifted factors, and its cofactor. The constant term is tested
/// first.
fn true_factor(f: &Integers, lifted: &[Integers], chosen: &[usize], modulus: &BigInt) -> Option<(Integers, Integers)> {
    let lead = &f[f.len() - 1];
    let constants = chosen.iter().fold(lead.clone(), |product, &i| (product * &lifted[i][0]).mod_floor(modulus));
    let constant = symmetric(constants, modulus);
    if constant.is_zero() != f[0].is_zero() || !constant.is_zero() && !(lead * &f[0]).is_multiple_of(&constant) {
        return None;
    }
    let start = vec![lead.clone()];
    let product = chosen.iter().fold(start, |product, &i| multiplied(&product, &lifted[i], modulus));
    let candidate: Integers = product.into_iter().map(|c| symmetric(c, modulus)).collect();
    let content = candidate.iter().fold(BigInt::zero(), |content, c| content.gcd(c));
    let factor: Integers = candidate.into_iter().map(|c| c / &content).collect();
    exact_quotient(f, &factor).map(|rest| (factor, rest))
}

/// `f / g` over the integers.
fn exact_quotient(f: &[BigInt], g: &[BigInt]) -> Option<Integers> {
    let mut rest = f.to_vec();
    let mut quotient = vec![BigInt::zero(); (f.len() + 1).checked_sub(g.len())?];
    for shift in (0..quotient.len()).rev() {
        let (factor, left) = rest[shift + g.len() - 1].div_rem(g.last()?);
        if !left.is_zero() {
            return None;
        }
        g.iter().enumerate().for_each(|(k, c)| rest[shift + k] -= &factor * c);
        quotient[shift] = factor;
    }
    rest.iter().all(Zero::is_zero).then_some(quotient)
}
