//! Refinement of an isolated root to any precision, and signs of other polynomials there.
//!
//! Source: Abbott, "Quadratic interval refinement for real roots", ACM Communications in Computer Algebra 48 (2014).
//! Signs come from fixed-point arithmetic with error bounds. The precision grows until the sign is certain, at the
//! latest when the value is exact.

use std::cmp::Ordering;

use num_bigint::Sign;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::isolate::{Interval, sign_at};
use super::square_free::gcd;
use crate::number::{BigInt, BigRational};
use crate::{Error, ErrorKind, Result, Watch};

/// Guard bits of a fixed-point value, in addition to the requested ones.
const GUARD: u64 = 64;

/// Narrows an isolating interval of a root to at most `2^-bits`. `polynomial` is square-free with integer coefficients,
/// constant term first.
///
/// # Errors
/// [`ErrorKind::BadValue`] when the polynomial does not change its sign over the interval; the error with which `watch`
/// stops the work.
pub fn refine<'w>(
    polynomial: &[BigInt],
    interval: &Interval,
    bits: u64,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Interval> {
    let watch = Watch::or_none(watch);
    if interval.is_point() {
        return Ok(interval.clone());
    }
    let mut state = Refinement::new(polynomial, interval)?;
    while !state.is_point && -state.exponent < bits as i64 {
        watch.check()?;
        state.step(bits as i64);
    }
    Ok(state.interval())
}

/// Whether a square-free polynomial has a root in `interval`. It has at most one there.
pub(crate) fn has_root(polynomial: &[BigInt], interval: &Interval) -> bool {
    let (low, high) = (sign_at(polynomial, interval.low()), sign_at(polynomial, interval.high()));
    if interval.is_point() { low == Sign::NoSign } else { low == -high && low != Sign::NoSign }
}

/// The exact sign of `other` at the root of `polynomial` in `interval`. The polynomial and its interval are as for
/// [`refine()`].
///
/// # Errors
/// Those of [`refine()`].
pub fn sign_at_root<'w>(
    polynomial: &[BigInt],
    interval: &Interval,
    other: &[BigInt],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Ordering> {
    let watch = Watch::or_none(watch);
    let zero = BigInt::zero();
    let mut interval = interval.clone();
    for bits in (0..).map(|k| GUARD << k) {
        if interval.is_point() {
            return Ok(order(sign_at(other, interval.low())));
        }
        interval = refine(polynomial, &interval, bits, watch)?;
        let (low, high) = enclose(other, &interval, bits);
        if low > zero || high < zero {
            return Ok(low.cmp(&zero));
        }
        if bits == 4 * GUARD && has_root(&gcd(polynomial, other), &interval) {
            return Ok(Ordering::Equal);
        }
    }
    Ok(Ordering::Equal)
}

fn order(sign: Sign) -> Ordering {
    match sign {
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
        Sign::Plus => Ordering::Greater,
    }
}

/// Two integers `low <= high` such that the polynomial's values on `interval` are between `low / 2^bits` and `high /
/// 2^bits`: Horner's rule in interval arithmetic.
pub(crate) fn enclose(polynomial: &[BigInt], interval: &Interval, bits: u64) -> (BigInt, BigInt) {
    let scale = BigInt::one() << bits;
    let down = (interval.low().numer() * &scale).div_floor(interval.low().denom());
    let up = (interval.high().numer() * &scale).div_ceil(interval.high().denom());
    let mut value = (BigInt::zero(), BigInt::zero());
    for c in polynomial.iter().rev() {
        let products = [&value.0 * &down, &value.0 * &up, &value.1 * &down, &value.1 * &up];
        let low = products.iter().min().expect("four products") >> bits;
        let high = -((-products.iter().max().expect("four products")) >> bits);
        let constant = c << bits;
        value = (low + &constant, high + constant);
    }
    value
}

/// The interval `(number, number + 1) 2^exponent` around a root, with the number of parts of the next step.
struct Refinement<'a> {
    polynomial: &'a [BigInt],
    number: BigInt,
    exponent: i64,
    /// The next step divides the interval into `2^cut` parts.
    cut: u64,
    low_sign: Sign,
    is_point: bool,
}

impl<'a> Refinement<'a> {
    fn new(polynomial: &'a [BigInt], interval: &Interval) -> Result<Self> {
        let width = interval.width();
        let number = (interval.low() / &width).to_integer();
        let exponent = width.numer().bits() as i64 - width.denom().bits() as i64;
        let sign = |number: &BigInt| value_at(polynomial, number, exponent, GUARD).value.sign();
        let low_sign = sign(&number);
        if low_sign == Sign::NoSign || low_sign != -sign(&(&number + 1)) {
            let text = "the interval does not isolate a root of the polynomial; give an isolating interval";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Refinement { polynomial, number, exponent, cut: 2, low_sign, is_point: false })
    }

    fn interval(&self) -> Interval {
        let end = |number: &BigInt| {
            let power = BigInt::one() << self.exponent.unsigned_abs();
            if self.exponent < 0 { BigRational::new(number.clone(), power) } else { (number * power).into() }
        };
        if self.is_point {
            return Interval::point(end(&self.number));
        }
        Interval::between(end(&self.number), end(&(&self.number + 1)))
    }

    /// Divides the interval and selects the part in which the secant meets the axis. If the root is not there, the next
    /// step bisects.
    fn step(&mut self, wanted: i64) {
        let missing = (wanted + self.exponent).max(1) as u64;
        self.cut = self.cut.min(missing);
        let parts = BigInt::one() << self.cut;
        let guess = self.guess(&parts);
        let sign = self.sign_of_part(&guess);
        if sign == Sign::NoSign {
            return self.narrow(guess, self.cut, true);
        }
        let (first, neighbour) =
            if sign == self.low_sign { (guess.clone(), &guess + 1) } else { (&guess - 1, &guess - 1) };
        let other = self.sign_of_part(&neighbour);
        if other == Sign::NoSign {
            return self.narrow(neighbour, self.cut, true);
        }
        if other != sign {
            self.narrow(first, self.cut, false);
            self.cut *= 2;
        } else {
            self.cut = 1;
        }
    }

    /// The inner point of division nearest to the secant's zero.
    fn guess(&self, parts: &BigInt) -> BigInt {
        let bits = self.cut + GUARD;
        let low = value_at(self.polynomial, &self.number, self.exponent, bits);
        let high = value_at(self.polynomial, &(&self.number + 1), self.exponent, bits);
        let common = low.bits.max(high.bits);
        let (low, high) = (low.value.abs() << (common - low.bits), high.value.abs() << (common - high.bits));
        let nearest: BigInt = (((&low * parts) << 1u32) / (low + high) + 1) >> 1u32;
        nearest.max(BigInt::one()).min(parts - 1)
    }

    /// The sign at the point of division with this index. At the ends it is known.
    fn sign_of_part(&self, index: &BigInt) -> Sign {
        let number = (&self.number << self.cut) + index;
        value_at(self.polynomial, &number, self.exponent - self.cut as i64, GUARD).value.sign()
    }

    fn narrow(&mut self, part: BigInt, cut: u64, is_point: bool) {
        self.number = (&self.number << cut) + part;
        self.exponent -= cut as i64;
        self.is_point = is_point;
    }
}

/// A value times `2^bits`, rounded to an integer of the right sign.
struct Scaled {
    value: BigInt,
    bits: u64,
}

/// Evaluates the polynomial at `number 2^exponent`, with `guard` more bits than the point has.
fn value_at(polynomial: &[BigInt], number: &BigInt, exponent: i64, guard: u64) -> Scaled {
    if exponent >= 0 {
        let x = number << exponent as u64;
        return Scaled { value: polynomial.iter().rev().fold(BigInt::zero(), |value, c| value * &x + c), bits: 0 };
    }
    let places = exponent.unsigned_abs();
    let exact = places * polynomial.len() as u64;
    let mut bits = places + guard;
    while bits < exact {
        let (value, radius) = fixed_point(polynomial, number, places, bits);
        if value.magnitude() > radius.magnitude() {
            return Scaled { value, bits };
        }
        bits *= 2;
    }
    Scaled { value: fixed_point(polynomial, number, places, exact).0, bits: exact }
}

/// The value at `number / 2^places` times `2^bits`, with a bound on its error.
fn fixed_point(polynomial: &[BigInt], number: &BigInt, places: u64, bits: u64) -> (BigInt, BigInt) {
    let size = number.abs();
    let (mut value, mut radius) = (BigInt::zero(), BigInt::zero());
    for c in polynomial.iter().rev() {
        value = ((value * number) >> places) + (c << bits);
        radius = ((radius * &size) >> places) + 2;
    }
    (value, radius)
}
