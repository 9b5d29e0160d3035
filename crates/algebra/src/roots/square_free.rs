//! Greatest common divisors and square-free parts of integer polynomials, through word-size primes.
//!
//! Source: von zur Gathen and Gerhard, Modern Computer Algebra, 3rd edition (2013), algorithms 6.38 (small primes modular gcd)
//! and 14.21 (Yun).

use num_integer::Integer;
use num_traits::{One, Zero};

use super::isolate::{Coefficients, derivative, primitive};
use crate::number::{BigInt, Ring, Zp};
use crate::poly::univariate::UnivariateRing;

/// The primitive greatest common divisor with a positive leading coefficient. Coefficients have the constant term
/// first. The result is empty only for two zero polynomials.
pub fn gcd(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let (a, b) = (primitive(a.to_vec()), primitive(b.to_vec()));
    let (Some(first), Some(second)) = (a.last(), b.last()) else {
        return positive(if a.is_empty() { b } else { a });
    };
    let lead = first.gcd(second);
    let mut image = Image { modulus: BigInt::one(), values: Vec::new() };
    for field in primes().filter(|field| !field.is_zero(&field.from_integer(&lead))) {
        let common = common_divisor_modulo(field, &a, &b, &lead);
        if common.len() == 1 {
            return vec![BigInt::one()];
        }
        let settled = image.refine(field, &common);
        if settled {
            let candidate = primitive(image.values.clone());
            if quotient(&a, &candidate).is_some() && quotient(&b, &candidate).is_some() {
                return positive(candidate);
            }
        }
    }
    vec![BigInt::one()]
}

/// Square-free factorization of a nonzero polynomial `p`: `p` is a constant times the product of the `p_m^m`. Returns
/// the multiplicities `m` and the pairwise coprime, square-free, primitive polynomials `p_m` of degree at least one.
pub fn square_free_parts(p: &[BigInt]) -> Vec<(usize, Vec<BigInt>)> {
    let p = positive(primitive(p.to_vec()));
    let common = gcd(&p, &derivative(&p));
    if p.len() <= 1 || common.len() == 1 {
        return if p.len() <= 1 { Vec::new() } else { vec![(1, p)] };
    }
    let (Some(mut rest), Some(mut slope)) = (quotient(&p, &common), quotient(&derivative(&p), &common)) else {
        return vec![(1, p)];
    };
    let mut parts = Vec::new();
    for multiplicity in 1.. {
        if rest.len() <= 1 {
            break;
        }
        let difference = difference(&slope, &derivative(&rest));
        let part = gcd(&rest, &difference);
        let divided = |f: &[BigInt]| quotient(f, &part).unwrap_or_default();
        (rest, slope) = (divided(&rest), divided(&difference));
        if part.len() > 1 {
            parts.push((multiplicity, part));
        }
    }
    parts
}

/// The product of two integer polynomials.
pub(super) fn product(a: &[BigInt], b: &[BigInt]) -> Coefficients {
    let mut product = vec![BigInt::zero(); (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate() {
        for (sum, y) in product[i..].iter_mut().zip(b) {
            *sum += x * y;
        }
    }
    product
}

/// Primes below `2^61` in descending order.
fn primes() -> impl Iterator<Item = Zp> {
    (3..Zp::LIMIT).rev().step_by(2).filter_map(|p| Zp::new(p).ok())
}

/// The gcd modulo a prime, with leading coefficient `lead` and the constant term first.
fn common_divisor_modulo(field: Zp, a: &[BigInt], b: &[BigInt], lead: &BigInt) -> Vec<u64> {
    let ring = UnivariateRing::new(field, "x");
    let image = |p: &[BigInt]| ring.polynomial(p.iter().map(|c| field.from_integer(c)).collect());
    ring.scale(&ring.gcd(&image(a), &image(b)), &field.from_integer(lead)).coefficients
}

/// A polynomial known modulo a growing product of primes, with coefficients of least magnitude.
struct Image {
    modulus: BigInt,
    values: Coefficients,
}

impl Image {
    /// Combines with the image modulo a new prime. Returns true when nothing changes. An image of higher degree comes
    /// from an unlucky prime and is ignored.
    fn refine(&mut self, field: Zp, residues: &[u64]) -> bool {
        if !self.values.is_empty() && residues.len() > self.values.len() {
            return false;
        }
        if residues.len() != self.values.len() {
            *self = Image { modulus: BigInt::one(), values: vec![BigInt::zero(); residues.len()] };
        }
        let Some(inverse) = field.checked_div(&1, &field.from_integer(&self.modulus)) else { return false };
        let next = &self.modulus * BigInt::from(field.modulus());
        let half = &next >> 1u32;
        let mut settled = true;
        for (value, wanted) in self.values.iter_mut().zip(residues) {
            let digit = field.mul(&field.sub(wanted, &field.from_integer(value)), &inverse);
            settled &= digit == 0;
            *value += &self.modulus * digit;
            if *value > half {
                *value -= &next;
            }
        }
        self.modulus = next;
        settled
    }
}

fn positive(p: Coefficients) -> Coefficients {
    let negative = p.last().is_some_and(|lead| lead < &BigInt::zero());
    if negative { p.into_iter().map(|c| -c).collect() } else { p }
}

fn difference(a: &[BigInt], b: &[BigInt]) -> Coefficients {
    let mut rest = a.to_vec();
    rest.resize(a.len().max(b.len()), BigInt::zero());
    rest.iter_mut().zip(b).for_each(|(target, c)| *target -= c);
    while rest.last().is_some_and(Zero::is_zero) {
        rest.pop();
    }
    rest
}

/// `a / b` when it is an integer polynomial; `b` is not zero.
fn quotient(a: &[BigInt], b: &[BigInt]) -> Option<Coefficients> {
    let (lead, low) = b.split_last()?;
    let mut rest = a.to_vec();
    let mut quotient = Vec::new();
    while rest.len() > low.len() {
        let (factor, remainder) = rest.pop()?.div_rem(lead);
        if !remainder.is_zero() {
            return None;
        }
        let shift = rest.len() - low.len();
        rest[shift..].iter_mut().zip(low).for_each(|(target, c)| *target -= &factor * c);
        quotient.push(factor);
    }
    quotient.reverse();
    rest.iter().all(Zero::is_zero).then_some(quotient)
}
