//! Sums of powers: recovers `a(n) = sum of c[i] * r[i]^n` from its first values, modulo a prime.
//!
//! M. Ben-Or and P. Tiwari, "A deterministic algorithm for sparse multivariate polynomial interpolation", STOC 1988,
//! with the algorithms of Berlekamp and Massey and of Cantor and Zassenhaus.

use super::line::{divide, divide_by_root, product_of_roots};
use super::prime::Prime;
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// The monic polynomial whose roots are the bases `r[i]`, when it is determined with two values left for a check.
///
/// # Errors
/// The error with which `watch` stops the work, as in all functions of this file.
pub(super) fn minimal_polynomial(field: Prime, values: &[u64], watch: &Watch) -> Result<Option<Vec<u64>>> {
    let mut connection = connection_polynomial(field, values, watch)?;
    connection.reverse();
    Ok((2 * (connection.len() - 1) + 2 <= values.len()).then_some(connection))
}

/// The shortest recurrence `sum of c[k] a(n - k) = 0` with `c[0] = 1` (J. Massey, IEEE Trans. Inf. Theory 15, 1969); its length
/// is one more than the linear complexity.
fn connection_polynomial(field: Prime, values: &[u64], watch: &Watch) -> Result<Vec<u64>> {
    let (mut current, mut previous) = (vec![1u64], vec![1u64]);
    let (mut complexity, mut gap, mut previous_discrepancy) = (0, 1, 1);
    for n in 0..values.len() {
        watch.check()?;
        let window = values[n - complexity..=n].iter().rev();
        let discrepancy = field.dot(current.iter(), window);
        if discrepancy == 0 {
            gap += 1;
            continue;
        }
        let factor = field.mul(discrepancy, field.inverse(previous_discrepancy));
        let grows = 2 * complexity <= n;
        let saved = grows.then(|| current.clone());
        current.resize(current.len().max(previous.len() + gap), 0);
        field.sub_multiple(&mut current[gap..], factor, &previous);
        if let Some(saved) = saved {
            complexity = n + 1 - complexity;
            (previous, previous_discrepancy, gap) = (saved, discrepancy, 1);
        } else {
            gap += 1;
        }
    }
    current.resize(complexity + 1, 0);
    Ok(current)
}

/// The roots of a monic polynomial, when it has as many distinct nonzero ones as its degree.
pub(super) fn distinct_roots(
    field: Prime,
    f: &[u64],
    stream: &mut SplitMix64,
    watch: &Watch,
) -> Result<Option<Vec<u64>>> {
    if f[0] == 0 || f.len() > 2 && power_modulo(field, 0, field.p - 1, f, watch)? != [1] {
        return Ok(None);
    }
    let mut roots = Vec::with_capacity(f.len() - 1);
    split(field, f.to_vec(), stream, &mut roots, watch)?;
    Ok(Some(roots))
}

/// Splits a product of distinct linear factors at random (D. Cantor and H. Zassenhaus, Math. Comp. 36, 1981).
fn split(field: Prime, f: Vec<u64>, stream: &mut SplitMix64, roots: &mut Vec<u64>, watch: &Watch) -> Result<()> {
    match f.len() {
        0 | 1 => Ok(()),
        2 => {
            roots.push(field.neg(f[0]));
            Ok(())
        }
        _ => loop {
            let mut half = power_modulo(field, stream.unit(field.p), (field.p - 1) / 2, &f, watch)?;
            half.resize(half.len().max(1), 0);
            half[0] = field.sub(half[0], 1);
            let factor = gcd(field, f.clone(), half, watch)?;
            if factor.len() > 1 && factor.len() < f.len() {
                let mut rest = f;
                let cofactor = divide(field, &mut rest, &factor);
                split(field, factor, stream, roots, watch)?;
                return split(field, cofactor, stream, roots, watch);
            }
        },
    }
}

/// `(x + shift)^exponent` modulo the monic `f` of degree two or more.
fn power_modulo(field: Prime, shift: u64, exponent: u64, f: &[u64], watch: &Watch) -> Result<Vec<u64>> {
    let mut power = vec![1u64];
    for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
        watch.check()?;
        power = square(field, &power);
        if exponent >> bit & 1 == 1 {
            power.insert(0, 0);
            for k in 1..power.len() {
                power[k - 1] = field.reduce(power[k - 1] + shift * power[k]);
            }
        }
        watch.check()?;
        divide(field, &mut power, f);
    }
    Ok(power)
}

fn square(field: Prime, f: &[u64]) -> Vec<u64> {
    if f.is_empty() {
        return Vec::new();
    }
    let top = f.len() - 1;
    let coefficient = |k: usize| {
        let range = k.saturating_sub(top)..=k.min(top);
        field.dot(f[range.clone()].iter(), f[range].iter().rev())
    };
    (0..=2 * top).map(coefficient).collect()
}

/// The monic greatest common divisor.
pub(super) fn gcd(field: Prime, mut a: Vec<u64>, mut b: Vec<u64>, watch: &Watch) -> Result<Vec<u64>> {
    while b.last() == Some(&0) {
        b.pop();
    }
    while !b.is_empty() {
        watch.check()?;
        divide(field, &mut a, &b);
        (a, b) = (b, a);
    }
    let inverse = field.inverse(a.last().copied().unwrap_or(1));
    Ok(a.into_iter().map(|c| field.mul(c, inverse)).collect())
}

/// The factors `c[i]` for known distinct bases: a transposed Vandermonde system (E. Kaltofen and L. Yagati, ISSAC 1988); `None` when
/// two bases are equal.
pub(super) fn factors(field: Prime, bases: &[u64], values: &[u64], watch: &Watch) -> Result<Option<Vec<u64>>> {
    let master = product_of_roots(field, bases);
    let degrees = 1..master.len() as u64;
    let derivative: Vec<u64> = master[1..].iter().zip(degrees).map(|(&c, k)| field.mul(c, k)).collect();
    let norms: Vec<u64> = bases.iter().map(|&base| field.horner(&derivative, base)).collect();
    let Some(inverses) = field.inverses(&norms) else { return Ok(None) };
    let solve = |(&base, inverse): (&u64, u64)| {
        watch.check()?;
        let quotient = divide_by_root(field, &master, base);
        Ok(field.mul(field.dot(quotient.iter(), values.iter()), inverse))
    };
    bases.iter().zip(inverses).map(solve).collect::<Result<_>>().map(Some)
}
