//! Univariate factorization over a finite field: distinct-degree and equal-degree factorization (Cantor and Zassenhaus
//! 1981; von zur Gathen and Gerhard, Modern Computer Algebra, chapter 14).

use crate::poly::words::WordField;
use crate::poly::words::dense::{self, Dense};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// The monic irreducible factors of a square-free polynomial, sorted by degree and coefficients.
pub fn factors<K: WordField>(field: &K, f: &[u64], watch: &Watch) -> Result<Vec<Dense>> {
    let mut random = SplitMix64::new(1);
    let mut factors = Vec::new();
    for (part, degree) in distinct_degrees(field, f, watch)? {
        let mut open = vec![part];
        while let Some(part) = open.pop() {
            watch.check()?;
            if part.len() == degree + 1 {
                factors.push(part);
            } else {
                open.extend(equal_degree_split(field, part, degree, &mut random));
            }
        }
    }
    factors.sort_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
    Ok(factors)
}

/// The products of the irreducible factors of each degree.
fn distinct_degrees<K: WordField>(field: &K, f: &[u64], watch: &Watch) -> Result<Vec<(Dense, usize)>> {
    let mut rest = dense::monic(field, f);
    let (mut parts, mut degree, mut frobenius) = (Vec::new(), 0, vec![0, 1]);
    while rest.len() > 2 * (degree + 1) {
        watch.check()?;
        degree += 1;
        frobenius = dense::pow_modulo(field, &frobenius, field.size(), &rest);
        let part = dense::gcd(field, &rest, &dense::sub(field, &frobenius, &[0, 1]));
        if part.len() > 1 {
            rest = dense::div_rem(field, &rest, &part).0;
            frobenius = dense::rem(field, &frobenius, &rest);
            parts.push((part, degree));
        }
    }
    if rest.len() > 1 {
        let degree = rest.len() - 1;
        parts.push((rest, degree));
    }
    Ok(parts)
}

/// Splits a product of several irreducible polynomials of one degree into two.
fn equal_degree_split<K: WordField>(field: &K, f: Dense, degree: usize, random: &mut SplitMix64) -> [Dense; 2] {
    loop {
        let mut start: Dense = (0..f.len() - 1).map(|_| random.below(field.size())).collect();
        dense::trim(&mut start);
        let image = if field.characteristic() == 2 {
            trace(field, &start, degree, &f)
        } else {
            let norm = norm(field, &start, degree, &f);
            let root = dense::pow_modulo(field, &norm, (field.size() - 1) / 2, &f);
            dense::sub(field, &root, &[1])
        };
        let part = dense::gcd(field, &f, &image);
        if part.len() > 1 && part.len() < f.len() {
            let other = dense::div_rem(field, &f, &part).0;
            return [part, other];
        }
    }
}

/// The product of the conjugates of `a` modulo `f` in a field of degree `degree`.
fn norm<K: WordField>(field: &K, a: &[u64], degree: usize, f: &[u64]) -> Dense {
    let mut product = a.to_vec();
    for _ in 1..degree {
        let conjugate = dense::pow_modulo(field, &product, field.size(), f);
        product = dense::rem(field, &dense::mul(field, &conjugate, a), f);
    }
    product
}

/// The sum of `a^(2^i)` modulo `f` over all automorphisms of a field of degree `degree`, in characteristic two.
fn trace<K: WordField>(field: &K, a: &[u64], degree: usize, f: &[u64]) -> Dense {
    let steps = degree as u32 * field.size().trailing_zeros();
    let (mut sum, mut power) = (a.to_vec(), a.to_vec());
    for _ in 1..steps {
        power = dense::rem(field, &dense::mul(field, &power, &power), f);
        dense::add_scaled(field, &mut sum, 1, &power, 0);
    }
    sum
}
