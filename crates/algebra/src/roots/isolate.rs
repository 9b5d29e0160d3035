//! Exact real-root isolation over Q: [`Sturm`] counts roots, isolates them and refines the [`Interval`]s.
//!
//! Source: Basu, Pollack and Roy, Algorithms in Real Algebraic Geometry, 2nd edition (2006), section 2.2.2
//! (Theorem 2.50, Sturm) and section 10.1 (bounds on roots).

use num_bigint::Sign;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::number::{BigInt, BigRational};
use crate::{Error, ErrorKind, Result};

/// An isolating interval, which contains exactly one root of its polynomial: the open interval `(low, high)`, or the
/// rational root itself when `low = high`.
///
/// The ends are dyadic. The ends of an open interval are not roots, and the square-free part has opposite signs there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interval {
    low: BigRational,
    high: BigRational,
}

impl Interval {
    /// The lower end.
    pub fn low(&self) -> &BigRational {
        &self.low
    }

    /// The upper end.
    pub fn high(&self) -> &BigRational {
        &self.high
    }

    /// `high - low`; zero when the root is known exactly.
    pub fn width(&self) -> BigRational {
        &self.high - &self.low
    }

    /// Whether the root is known exactly.
    pub fn is_point(&self) -> bool {
        self.low == self.high
    }

    pub(super) fn point(x: BigRational) -> Self {
        Interval { low: x.clone(), high: x }
    }

    pub(super) fn between(low: BigRational, high: BigRational) -> Self {
        Interval { low, high }
    }

    /// The interval of `-x`.
    pub(super) fn mirrored(&self) -> Self {
        Interval { low: -&self.high, high: -&self.low }
    }

    fn middle(&self) -> BigRational {
        (&self.low + &self.high) / BigInt::from(2)
    }
}

/// Integer coefficients, constant term first, the last not zero.
pub(super) type Coefficients = Vec<BigInt>;

/// The Sturm sequence of the square-free part of a polynomial over Q, in primitive integer polynomials.
///
/// Roots are counted without multiplicity throughout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sturm {
    sequence: Vec<Coefficients>,
}

/// Isolates all distinct real roots in ascending, disjoint intervals. `coefficients` has the constant term first.
///
/// # Errors
/// [`ErrorKind::BadValue`] for the zero polynomial.
pub fn isolate(coefficients: &[BigRational]) -> Result<Vec<Interval>> {
    Ok(Sturm::new(coefficients)?.intervals())
}

/// All distinct real roots, ascending, each rounded to the nearest `f64` (distinct roots may round to one value);
/// `coefficients` has the constant term first.
///
/// # Errors
/// [`ErrorKind::BadValue`] for the zero polynomial.
pub fn rounded_roots(coefficients: &[BigRational]) -> Result<Vec<f64>> {
    let sturm = Sturm::new(coefficients)?;
    Ok(sturm.intervals().iter().map(|interval| sturm.round(interval)).collect())
}

impl Sturm {
    /// Builds the Sturm sequence of a polynomial. Coefficients have the constant term first; trailing zeros are
    /// allowed.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for the zero polynomial.
    pub fn new(coefficients: &[BigRational]) -> Result<Self> {
        let first = integral(coefficients);
        if first.is_empty() {
            return Err(Error::new(
                ErrorKind::BadValue,
                "every number is a root of the zero polynomial; give a nonzero polynomial",
            ));
        }
        let mut sequence = vec![first.clone()];
        let mut next = primitive(derivative(&first));
        while !next.is_empty() {
            let rest = negated_remainder(&sequence[sequence.len() - 1], &next);
            sequence.push(next);
            next = rest;
        }
        let divisor = sequence[sequence.len() - 1].clone();
        let sequence = sequence.into_iter().map(|p| exact_quotient(p, &divisor)).collect();
        Ok(Sturm { sequence })
    }

    /// The square-free part as a primitive integer polynomial, constant term first, up to sign.
    pub fn square_free_part(&self) -> &[BigInt] {
        &self.sequence[0]
    }

    /// The number of distinct real roots.
    pub fn count(&self) -> usize {
        let at_minus_infinity = self.sequence.iter().map(|p| {
            let sign = leading(p).sign();
            if p.len() % 2 == 0 { -sign } else { sign }
        });
        let at_infinity = self.sequence.iter().map(|p| leading(p).sign());
        variations(at_minus_infinity) - variations(at_infinity)
    }

    /// The number of distinct real roots in the half-open interval `(low, high]`; none when `low >= high`.
    pub fn count_between(&self, low: &BigRational, high: &BigRational) -> usize {
        if low >= high { 0 } else { self.variations_at(low) - self.variations_at(high) }
    }

    /// The isolating intervals of all distinct real roots, ascending and disjoint.
    pub fn intervals(&self) -> Vec<Interval> {
        let bound = root_bound(self.square_free_part());
        let mut open = vec![self.cell(-bound.clone(), bound)];
        let mut found = Vec::new();
        while let Some(cell) = open.pop() {
            match self.isolated(&cell) {
                Some(interval) => found.push(interval),
                None if cell.count() > 0 => open.extend(self.halves(cell)),
                None => {}
            }
        }
        found
    }

    /// Narrows `interval` around its root to at most `width`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `width` is not positive.
    pub fn refine(&self, interval: &Interval, width: &BigRational) -> Result<Interval> {
        if !width.is_positive() {
            return Err(Error::new(
                ErrorKind::BadValue,
                format!("the width {width} is not positive; give a positive one"),
            ));
        }
        let mut interval = interval.clone();
        while interval.width() > *width {
            interval = self.halve(interval);
        }
        Ok(interval)
    }

    /// The root in `interval` rounded to the nearest `f64`; infinite when it is outside the range of `f64`.
    pub(crate) fn round(&self, interval: &Interval) -> f64 {
        let finest = BigRational::new(BigInt::one(), BigInt::one() << 1100);
        let mut interval = interval.clone();
        loop {
            let (low, high) = (nearest(&interval.low), nearest(&interval.high));
            if low == high || interval.width() < finest {
                return low + 0.0;
            }
            interval = self.halve(interval);
        }
    }

    /// The half of an isolating interval that contains its root, or the root when it is the midpoint.
    fn halve(&self, interval: Interval) -> Interval {
        let polynomial = self.square_free_part();
        let middle = interval.middle();
        let sign = sign_at(polynomial, &middle);
        if sign == Sign::NoSign {
            Interval::point(middle)
        } else if sign == sign_at(polynomial, &interval.low) {
            Interval { low: middle, high: interval.high }
        } else {
            Interval { low: interval.low, high: middle }
        }
    }

    fn variations_at(&self, x: &BigRational) -> usize {
        variations(self.sequence.iter().map(|p| sign_at(p, x)))
    }

    fn cell(&self, low: BigRational, high: BigRational) -> Cell {
        let (at_low, at_high) = (self.variations_at(&low), self.variations_at(&high));
        Cell { range: Interval { low, high }, at_low, at_high }
    }

    /// The two halves of a cell, the upper one first.
    fn halves(&self, cell: Cell) -> [Cell; 2] {
        let middle = cell.range.middle();
        let at_middle = self.variations_at(&middle);
        let upper = Interval { low: middle.clone(), high: cell.range.high };
        let lower = Interval { low: cell.range.low, high: middle };
        [
            Cell { range: upper, at_low: at_middle, at_high: cell.at_high },
            Cell { range: lower, at_low: cell.at_low, at_high: at_middle },
        ]
    }

    /// The isolating interval of a cell with one root; `None` for other counts, and while the lower end is a root.
    fn isolated(&self, cell: &Cell) -> Option<Interval> {
        if cell.count() != 1 {
            return None;
        }
        let polynomial = self.square_free_part();
        if sign_at(polynomial, &cell.range.high) == Sign::NoSign {
            return Some(Interval::point(cell.range.high.clone()));
        }
        (sign_at(polynomial, &cell.range.low) != Sign::NoSign).then(|| cell.range.clone())
    }
}

/// A half-open interval `(low, high]` with the sign variations of the sequence at its ends.
struct Cell {
    range: Interval,
    at_low: usize,
    at_high: usize,
}

impl Cell {
    fn count(&self) -> usize {
        self.at_low - self.at_high
    }
}

fn leading(p: &[BigInt]) -> &BigInt {
    &p[p.len() - 1]
}

/// The positive multiple of a rational polynomial that is integral and primitive; empty for zero.
pub(super) fn integral(coefficients: &[BigRational]) -> Coefficients {
    let denominator = coefficients.iter().fold(BigInt::one(), |lcm, c| lcm.lcm(c.denom()));
    primitive(coefficients.iter().map(|c| c.numer() * (&denominator / c.denom())).collect())
}

/// `p` without trailing zeros, divided by the positive gcd of its coefficients.
pub(super) fn primitive(mut p: Coefficients) -> Coefficients {
    while p.last().is_some_and(Zero::is_zero) {
        p.pop();
    }
    let content = p.iter().fold(BigInt::zero(), |gcd, c| gcd.gcd(c));
    if !content.is_one() {
        p.iter_mut().for_each(|c| *c /= &content);
    }
    p
}

pub(super) fn derivative(p: &[BigInt]) -> Coefficients {
    p.iter().enumerate().skip(1).map(|(i, c)| c * BigInt::from(i)).collect()
}

/// A positive multiple of `-(a mod b)`, primitive.
fn negated_remainder(a: &[BigInt], b: &[BigInt]) -> Coefficients {
    let (scale, low) = (leading(b).abs(), &b[..b.len() - 1]);
    let mut rest = a.to_vec();
    while rest.len() > low.len() {
        let Some(top) = rest.pop() else { break };
        let factor = top * leading(b).signum();
        rest.iter_mut().for_each(|c| *c *= &scale);
        let shift = rest.len() - low.len();
        for (target, c) in rest[shift..].iter_mut().zip(low) {
            *target -= &factor * c;
        }
    }
    primitive(rest.into_iter().map(|c| -c).collect())
}

/// `a / b` for primitive `b` that divides `a`: integral by Gauss's lemma.
fn exact_quotient(mut rest: Coefficients, b: &[BigInt]) -> Coefficients {
    let low = &b[..b.len() - 1];
    let mut quotient = Vec::new();
    while rest.len() > low.len() {
        let Some(top) = rest.pop() else { break };
        let factor = top / leading(b);
        let shift = rest.len() - low.len();
        for (target, c) in rest[shift..].iter_mut().zip(low) {
            *target -= &factor * c;
        }
        quotient.push(factor);
    }
    debug_assert!(rest.iter().all(Zero::is_zero), "the division is exact");
    quotient.reverse();
    quotient
}

/// The sign of `p(n / d)`, from `d^deg(p) p(n / d)` by Horner's rule in integers.
pub(super) fn sign_at(p: &[BigInt], x: &BigRational) -> Sign {
    let mut power = BigInt::one();
    let mut value = BigInt::zero();
    for c in p.iter().rev() {
        value = value * x.numer() + c * &power;
        power *= x.denom();
    }
    value.sign()
}

/// The number of sign changes, zeros left out.
fn variations(signs: impl Iterator<Item = Sign>) -> usize {
    let signs: Vec<Sign> = signs.filter(|sign| *sign != Sign::NoSign).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// A power of two above Cauchy's bound `1 + max |a_i / a_n|`.
fn root_bound(p: &[BigInt]) -> BigRational {
    let widest = p.iter().map(BigInt::bits).max().unwrap_or(0);
    let exponent = (widest + 1).saturating_sub(leading(p).bits()) + 1;
    BigRational::from_integer(BigInt::one() << exponent)
}

/// The `f64` nearest to `x`.
pub(super) fn nearest(x: &BigRational) -> f64 {
    x.to_f64().unwrap_or(f64::NAN)
}
