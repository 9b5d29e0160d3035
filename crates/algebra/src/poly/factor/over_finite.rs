//! Factors of a square-free polynomial over GF(p), in one or several variables.
//!
//! If GF(p) has too few points, the work is done over GF(p^k) for a prime `k`, preferably above a degree of the
//! polynomial. A polynomial that is irreducible over GF(p) either stays irreducible there or splits into `k`
//! conjugates. Factors with coefficients outside GF(p) are refused.

use super::finite;
use super::lift::{Lifting, Variables};
use crate::poly::words::dense::Dense;
use crate::poly::words::{Extension, Flat, Packing, Prime, WordField, dense};
use crate::random::SplitMix64;
use crate::{Error, ErrorKind, Result, Watch};

/// Maximum number of points that are tried in one field.
const POINTS: usize = 40;

/// The monic irreducible factors over GF(p) of a square-free `f` that is primitive in `main`.
pub fn split_over_prime(p: u64, packing: &Packing, f: &Flat, main: usize, watch: &Watch) -> Result<Vec<Flat>> {
    let field = Prime::new(p);
    let present: Vec<usize> = (0..packing.variables()).filter(|&v| f.degree_in(packing, v) > 0).collect();
    if present.len() == 1 {
        let factors = finite::factors(&field, &f.dense(packing, main), watch)?;
        return Ok(factors.iter().map(|factor| Flat::from_dense(packing, main, factor)).collect());
    }
    if let Some(factors) = split_in(&field, packing, f, main, watch)? {
        return Ok(factors);
    }
    let degree = present.iter().map(|&v| f.degree_in(packing, v)).min().unwrap_or(0);
    let above = (degree + 1..).filter(|&k| is_prime(k)).map_while(|k| Extension::new(p, k));
    let below = (2..=degree).rev().filter(|&k| is_prime(k)).filter_map(|k| Extension::new(p, k));
    for field in above.chain(below) {
        if let Some(factors) = split_in(&field, packing, f, main, watch)? {
            return Ok(factors);
        }
    }
    let text = format!("GF({p}) has too few points for a polynomial of these degrees; use a larger prime");
    Err(Error::new(ErrorKind::Unsupported, text))
}

fn is_prime(k: u32) -> bool {
    k > 1 && (2..k).all(|d| !k.is_multiple_of(d))
}

/// The factors, from points of one field; `None` when all points that were tried are unlucky.
///
/// Each point begins with another variable: `x^3 + y^3 z` splits at every point of `z` where all elements are cubes.
fn split_in<K: WordField>(
    field: &K,
    packing: &Packing,
    f: &Flat,
    main: usize,
    watch: &Watch,
) -> Result<Option<Vec<Flat>>> {
    let mut others: Vec<usize> =
        (0..packing.variables()).filter(|&v| v != main && f.degree_in(packing, v) > 0).collect();
    let mut random = SplitMix64::new(2);
    for _ in 0..POINTS {
        watch.check()?;
        others.rotate_left(1);
        let anchor = others.iter().map(|_| random.below(field.size())).collect();
        let Some(lifting) = Lifting::new(field, packing, f, Variables { main, others: &others, anchor }) else {
            continue;
        };
        let line = finite::factors(field, &lifting.line(), watch)?;
        if line.len() == 1 {
            return Ok(Some(vec![f.monic(field)]));
        }
        let Some(parts) = lifting.partition(&line, watch)? else { continue };
        if parts.len() == 1 {
            return Ok(Some(vec![f.monic(field)]));
        }
        let images: Vec<Dense> = parts.iter().map(|part| product(field, &line, part)).collect();
        if let Some(factors) = lifting.factors(&images, &mut random, watch)?
            && is_product(field, packing, f, &factors)
        {
            return Ok(Some(factors));
        }
    }
    Ok(None)
}

fn product<K: WordField>(field: &K, factors: &[Dense], chosen: &[usize]) -> Dense {
    chosen.iter().fold(vec![1], |product, &i| dense::mul(field, &product, &factors[i]))
}

/// Whether the product of `factors` is `f` up to a constant and all factors are over GF(p).
fn is_product<K: WordField>(field: &K, packing: &Packing, f: &Flat, factors: &[Flat]) -> bool {
    let over_prime = factors.iter().all(|factor| factor.values.iter().all(|&value| value < field.characteristic()));
    let rest = factors.iter().try_fold(f.clone(), |rest, factor| rest.exact_div(field, packing, factor));
    over_prime && rest.is_some_and(|rest| rest.is_constant())
}
