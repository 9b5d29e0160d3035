//! The field of rational numbers.

use num_traits::{One, Pow, Zero};

use super::{BigInt, BigRational, Field, PrimeElement, Ring, Style};

/// The rational numbers Q; elements are [`BigRational`] in lowest terms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rationals;

impl Ring for Rationals {
    type Element = BigRational;

    fn zero(&self) -> BigRational {
        BigRational::zero()
    }
    fn one(&self) -> BigRational {
        BigRational::one()
    }
    fn from_integer(&self, n: &BigInt) -> BigRational {
        BigRational::from_integer(n.clone())
    }
    fn add(&self, a: &BigRational, b: &BigRational) -> BigRational {
        a + b
    }
    fn sub(&self, a: &BigRational, b: &BigRational) -> BigRational {
        a - b
    }
    fn neg(&self, a: &BigRational) -> BigRational {
        -a
    }
    fn mul(&self, a: &BigRational, b: &BigRational) -> BigRational {
        a * b
    }
    fn is_zero(&self, a: &BigRational) -> bool {
        a.is_zero()
    }
    fn is_one(&self, a: &BigRational) -> bool {
        a.is_one()
    }
    fn checked_div(&self, a: &BigRational, b: &BigRational) -> Option<BigRational> {
        (!b.is_zero()).then(|| a / b)
    }
    fn format(&self, a: &BigRational, style: Style) -> String {
        match style {
            Style::Latex if !a.is_integer() => {
                let sign = if a < &BigRational::zero() { "-" } else { "" };
                format!("{sign}\\frac{{{}}}{{{}}}", a.numer().magnitude(), a.denom())
            }
            Style::Decimal => decimal(a).unwrap_or_else(|| a.to_string()),
            _ => a.to_string(),
        }
    }
}

impl Field for Rationals {
    fn characteristic(&self) -> u64 {
        0
    }
    fn from_rational(&self, q: &BigRational) -> Option<BigRational> {
        Some(q.clone())
    }
    fn prime_element<'a>(&self, a: &'a BigRational) -> Option<PrimeElement<'a>> {
        Some(PrimeElement::Rational(a))
    }
}

/// The finite decimal expansion of `a`, if it has one of at most 30 places.
fn decimal(a: &BigRational) -> Option<String> {
    let ten = BigInt::from(10);
    let places = (0u32..=30).find(|&k| (ten.clone().pow(k) % a.denom()).is_zero())?;
    let scaled = (a * BigRational::from_integer(ten.pow(places))).to_integer();
    let digits = format!("{:0width$}", scaled.magnitude(), width = places as usize + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places as usize);
    let sign = if scaled.sign() == num_bigint::Sign::Minus { "-" } else { "" };
    Some(if fraction.is_empty() { format!("{sign}{whole}") } else { format!("{sign}{whole}.{fraction}") })
}
