//! The field of rational numbers.

use num_bigint::Sign;
use num_integer::Integer as _;
use num_traits::{One, Pow, Signed as _, ToPrimitive as _, Zero};

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
        if are_integers(a, b) { integer(a.numer() + b.numer()) } else { a + b }
    }
    fn sub(&self, a: &BigRational, b: &BigRational) -> BigRational {
        if are_integers(a, b) { integer(a.numer() - b.numer()) } else { a - b }
    }
    fn neg(&self, a: &BigRational) -> BigRational {
        -a
    }
    fn mul(&self, a: &BigRational, b: &BigRational) -> BigRational {
        if are_integers(a, b) { integer(a.numer() * b.numer()) } else { product(a, (b.numer(), b.denom())) }
    }
    fn is_zero(&self, a: &BigRational) -> bool {
        a.is_zero()
    }
    fn is_one(&self, a: &BigRational) -> bool {
        a.is_one()
    }
    fn checked_div(&self, a: &BigRational, b: &BigRational) -> Option<BigRational> {
        match b.numer().sign() {
            Sign::NoSign => None,
            Sign::Plus => Some(product(a, (b.denom(), b.numer()))),
            Sign::Minus => Some(-product(a, (b.denom(), &-b.numer()))),
        }
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

/// Whether both denominators are one. Then no gcd is needed.
fn are_integers(a: &BigRational, b: &BigRational) -> bool {
    a.denom().is_one() && b.denom().is_one()
}

fn integer(n: BigInt) -> BigRational {
    BigRational::new_raw(n, BigInt::one())
}

/// `a` times the fraction `n / d` in lowest terms with `d > 0`.
fn product(a: &BigRational, (n, d): (&BigInt, &BigInt)) -> BigRational {
    if let (Some(a), Some(n), Some(d)) = (words(a.numer(), a.denom()), n.to_i64(), d.to_i64()) {
        let (first, second) = (gcd_of_words(a.0, d), gcd_of_words(n, a.1));
        let numerator = i128::from(a.0 / first) * i128::from(n / second);
        let denominator = i128::from(a.1 / second) * i128::from(d / first);
        return BigRational::new_raw(integer_of(numerator), integer_of(denominator));
    }
    let (first, second) = (common_divisor(a.numer(), d), common_divisor(n, a.denom()));
    let divided = |n: &BigInt, by: &BigInt| if by.is_one() { n.clone() } else { n / by };
    BigRational::new_raw(
        divided(a.numer(), &first) * divided(n, &second),
        divided(a.denom(), &second) * divided(d, &first),
    )
}

/// Converting a word is faster than converting a double word.
fn integer_of(n: i128) -> BigInt {
    i64::try_from(n).map_or_else(|_| n.into(), BigInt::from)
}

fn words(n: &BigInt, d: &BigInt) -> Option<(i64, i64)> {
    n.to_i64().zip(d.to_i64())
}

/// The greatest common divisor of `a` and `b > 0`. It fits the type of `b`.
fn gcd_of_words(a: i64, b: i64) -> i64 {
    if b == 1 { 1 } else { a.unsigned_abs().gcd(&b.unsigned_abs()) as i64 }
}

/// The greatest common divisor of two integers, not both zero. If one fits a word, the other is first reduced modulo
/// it.
pub(crate) fn common_divisor(a: &BigInt, b: &BigInt) -> BigInt {
    let by_word = |word: u64, other: &BigInt| {
        let rest = if word == 0 { return other.abs() } else { (other.magnitude() % word).to_u64() };
        word.gcd(&rest.expect("a residue of a word")).into()
    };
    match (a.magnitude().to_u64(), b.magnitude().to_u64()) {
        (Some(1), _) | (_, Some(1)) => BigInt::one(),
        (Some(a), Some(b)) => a.gcd(&b).into(),
        (Some(word), None) => by_word(word, b),
        (None, Some(word)) => by_word(word, a),
        (None, None) => a.gcd(b),
    }
}

/// The finite decimal expansion of `a`, if it has one with at most 30 places.
pub fn decimal(a: &BigRational) -> Option<String> {
    let ten = BigInt::from(10);
    let places = (0u32..=30).find(|&k| (ten.clone().pow(k) % a.denom()).is_zero())?;
    let scaled = (a * BigRational::from_integer(ten.pow(places))).to_integer();
    let digits = format!("{:0width$}", scaled.magnitude(), width = places as usize + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places as usize);
    let sign = if scaled.sign() == Sign::Minus { "-" } else { "" };
    Some(if fraction.is_empty() { format!("{sign}{whole}") } else { format!("{sign}{whole}.{fraction}") })
}
