//! Exact real-root isolation by Descartes' rule of signs and bisection: [`real_roots_of`]. It is faster than Sturm's
//! method for high degrees.
//!
//! Source: Collins and Akritas, "Polynomial real root isolation using Descartes' rule of signs", SYMSAC (1976); Basu,
//! Pollack and Roy, Algorithms in Real Algebraic Geometry, 2nd edition (2006), section 10.2.

use num_bigint::Sign;
use num_traits::{One, Zero};

use super::isolate::{Coefficients, Interval, derivative, integral, primitive};
use super::refine::has_root;
use super::square_free::{gcd, product, square_free_parts};
use crate::number::{BigInt, BigRational};
use crate::{Error, ErrorKind, Result, Watch};

/// A real root: its isolating interval and its multiplicity.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct RealRoot {
    /// The isolating interval. Its open ends are not roots of the whole polynomial.
    pub interval: Interval,
    /// The multiplicity of the root.
    pub multiplicity: usize,
}

/// Isolates all distinct real roots, ascending, in disjoint intervals. `coefficients` has the constant term first.
///
/// # Errors
/// [`ErrorKind::BadValue`] for the zero polynomial; the error with which `watch` stops the work.
pub fn real_roots_of<'w>(coefficients: &[BigRational], watch: impl Into<Option<&'w Watch>>) -> Result<Vec<RealRoot>> {
    let watch = Watch::or_none(watch);
    let polynomial = integral(coefficients);
    if polynomial.is_empty() {
        return Err(Error::new(
            ErrorKind::BadValue,
            "every number is a root of the zero polynomial; give a nonzero polynomial",
        ));
    }
    let parts = square_free_parts(&polynomial);
    let radical = parts.iter().fold(vec![BigInt::one()], |f, (_, part)| product(&f, part));
    let intervals = isolate(&radical, watch)?;
    let multiplicity = |interval: &Interval| {
        let part = parts.iter().find(|(_, part)| has_root(part, interval));
        part.map_or(1, |(multiplicity, _)| *multiplicity)
    };
    Ok(intervals.into_iter().map(|i| RealRoot { multiplicity: multiplicity(&i), interval: i }).collect())
}

/// Isolates the real roots of a square-free integer polynomial, in ascending, disjoint intervals.
///
/// # Errors
/// [`ErrorKind::BadValue`] when the polynomial is zero or has a multiple root; the error with which `watch` stops the
/// work.
pub fn isolate_square_free<'w>(polynomial: &[BigInt], watch: impl Into<Option<&'w Watch>>) -> Result<Vec<Interval>> {
    let watch = Watch::or_none(watch);
    let polynomial = primitive(polynomial.to_vec());
    if polynomial.is_empty() || gcd(&polynomial, &derivative(&polynomial)).len() > 1 {
        let text = "the polynomial is not square-free; give its square-free parts";
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    isolate(&polynomial, watch)
}

fn isolate(polynomial: &[BigInt], watch: &Watch) -> Result<Vec<Interval>> {
    let mut roots: Vec<Interval> = positive_roots(&mirrored(polynomial), watch)?;
    roots.reverse();
    roots.iter_mut().for_each(|interval| *interval = interval.mirrored());
    if polynomial.first().is_some_and(Zero::is_zero) {
        roots.push(Interval::point(BigRational::zero()));
    }
    roots.extend(positive_roots(polynomial, watch)?);
    Ok(roots)
}

/// `p(-x)`.
fn mirrored(p: &[BigInt]) -> Coefficients {
    p.iter().enumerate().map(|(i, c)| if i % 2 == 1 { -c } else { c.clone() }).collect()
}

/// A part of the positive axis: `(number, number + 1) 2^exponent`, and the polynomial mapped from this part to `(0,
/// 1)`.
struct Cell {
    number: BigInt,
    exponent: i64,
    polynomial: Coefficients,
}

fn positive_roots(p: &[BigInt], watch: &Watch) -> Result<Vec<Interval>> {
    let Some(exponent) = root_exponent(p) else { return Ok(Vec::new()) };
    let mut open = vec![Cell { number: BigInt::zero(), exponent, polynomial: stretched(p, exponent) }];
    let mut found = Vec::new();
    while let Some(cell) = open.pop() {
        watch.check()?;
        match sign_changes(&cell.polynomial) {
            Changes::None => {}
            Changes::One if cell.has_clean_ends() => found.push(cell.interval()),
            _ => {
                let [left, right] = cell.halves();
                if right.polynomial[0].is_zero() {
                    found.push(Interval::point(right.low()));
                }
                open.extend([right, left]);
            }
        }
    }
    found.sort_by(|a, b| a.low().cmp(b.low()));
    Ok(found)
}

/// An `e` such that all positive roots are below `2^e` (Fujiwara's bound in powers of two); `None` for constants.
fn root_exponent(p: &[BigInt]) -> Option<i64> {
    let (lead, low) = p.split_last()?;
    let excess = |c: &BigInt| c.bits() as i64 - lead.bits() as i64 + 1;
    let steps = low.iter().rev().zip(1..).filter(|(c, _)| !c.is_zero());
    Some(1 + steps.map(|(c, i): (_, i64)| excess(c).div_euclid(i) + 1).max()?)
}

/// `p(2^exponent x)` up to a positive factor.
fn stretched(p: &[BigInt], exponent: i64) -> Coefficients {
    let last = p.len() as i64 - 1;
    let shift = |i: i64| if exponent >= 0 { i * exponent } else { (i - last) * exponent };
    without_twos(p.iter().zip(0..).map(|(c, i)| c << shift(i) as u64).collect())
}

/// `p` divided by the largest power of two in all its coefficients.
fn without_twos(mut p: Coefficients) -> Coefficients {
    let twos = p.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    if twos > 0 {
        p.iter_mut().for_each(|c| *c >>= twos);
    }
    p
}

/// `p(x + 1)`.
fn shifted(mut p: Coefficients) -> Coefficients {
    for start in 0..p.len() {
        shift_step(&mut p, start);
    }
    p
}

/// One pass of Horner's scheme: afterwards `p[start]` is a coefficient of `p(x + 1)`.
fn shift_step(p: &mut [BigInt], start: usize) {
    for i in (start..p.len() - 1).rev() {
        let (low, high) = p.split_at_mut(i + 1);
        low[i] += &high[0];
    }
}

enum Changes {
    None,
    One,
    More,
}

/// Descartes' rule for the interval (0, 1): the sign changes of `(x + 1)^n p(1 / (x + 1))`, counted up to two.
fn sign_changes(p: &[BigInt]) -> Changes {
    let mut reversed: Coefficients = p.iter().rev().cloned().collect();
    let (mut changes, mut last) = (0, Sign::NoSign);
    for start in 0..reversed.len() {
        shift_step(&mut reversed, start);
        let sign = reversed[start].sign();
        if sign != Sign::NoSign {
            changes += usize::from(last == -sign);
            last = sign;
        }
        if changes > 1 {
            return Changes::More;
        }
    }
    if changes == 0 { Changes::None } else { Changes::One }
}

impl Cell {
    /// The left and the right half.
    fn halves(self) -> [Cell; 2] {
        let last = self.polynomial.len() - 1;
        let halved = self.polynomial.iter().enumerate().map(|(i, c)| c << (last - i)).collect();
        let left = without_twos(halved);
        let right = shifted(left.clone());
        let (number, exponent): (BigInt, i64) = (self.number << 1, self.exponent - 1);
        [
            Cell { number: number.clone(), exponent, polynomial: left },
            Cell { number: number + 1, exponent, polynomial: right },
        ]
    }

    /// Whether neither end is a root.
    fn has_clean_ends(&self) -> bool {
        !self.polynomial[0].is_zero() && !self.polynomial.iter().sum::<BigInt>().is_zero()
    }

    fn low(&self) -> BigRational {
        scaled(&self.number, self.exponent)
    }

    fn interval(&self) -> Interval {
        Interval::between(self.low(), scaled(&(&self.number + 1), self.exponent))
    }
}

/// `number 2^exponent`.
fn scaled(number: &BigInt, exponent: i64) -> BigRational {
    let power = BigInt::one() << exponent.unsigned_abs();
    if exponent >= 0 { BigRational::from_integer(number * power) } else { BigRational::new(number.clone(), power) }
}
