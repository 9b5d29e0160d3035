//! The field of rational numbers.

use num_traits::{One, Zero};

use super::{BigInt, BigRational, Field, Ring, Style};

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
            _ => a.to_string(),
        }
    }
}

impl Field for Rationals {
    fn characteristic(&self) -> u64 {
        0
    }
}
