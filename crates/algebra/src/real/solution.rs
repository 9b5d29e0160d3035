//! One real solution: a box that contains it, and exact tests on it.

use std::cmp::Ordering;
use std::sync::Arc;

use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::groebner::UnivariateRepresentation;
use crate::number::{BigInt, BigRational, Rationals};
use crate::poly::univariate::Univariate;
use crate::poly::{Polynomial, PolynomialRing};
use crate::roots::{Interval, enclose, has_root, refine, sign_at_root};
use crate::{Result, Watch};

/// A closed interval of rationals around a real number.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Enclosure {
    /// The lower end.
    pub low: BigRational,
    /// The upper end; equal to the lower one when the number is known exactly.
    pub high: BigRational,
}

impl Enclosure {
    /// `high - low`.
    pub fn width(&self) -> BigRational {
        &self.high - &self.low
    }

    /// Whether the interval contains `x`.
    pub fn contains(&self, x: &BigRational) -> bool {
        self.low <= *x && *x <= self.high
    }

    fn meets(&self, other: &Enclosure) -> bool {
        self.low <= other.high && other.low <= self.high
    }
}

/// Guard bits between the requested width and the grid to which enclosures are rounded.
const GUARD: u64 = 2;

/// Relative precision in bits at which a coordinate between two doubles is treated as their midpoint.
const TIE: u64 = 256;

/// An isolated real solution of a system.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RealSolution {
    /// One interval for each variable: the sides of a box that contains no other real solution.
    pub coordinates: Vec<Enclosure>,
    /// The multiplicity: the dimension of the local ring at the solution.
    pub multiplicity: usize,
    root: Interval,
    precision: u64,
    representation: Arc<UnivariateRepresentation>,
}

impl RealSolution {
    /// Builds the solution at the root `root` of the representation's polynomial, to `precision` bits.
    pub(super) fn new(
        representation: Arc<UnivariateRepresentation>,
        root: Interval,
        precision: u64,
        watch: &Watch,
    ) -> Result<Self> {
        let class = representation.multiplicities.iter().find(|(_, factor)| has_root(&factor.coefficients, &root));
        let multiplicity = class.map_or(1, |(multiplicity, _)| *multiplicity);
        let (coordinates, root) = locate(&representation, root, precision, watch)?;
        Ok(RealSolution { coordinates, multiplicity, root, precision, representation })
    }

    /// The requested precision in bits: every coordinate is at most `2^-precision` wide.
    pub(crate) fn precision(&self) -> u64 {
        self.precision
    }

    /// The univariate representation of the system's solutions.
    pub fn representation(&self) -> &UnivariateRepresentation {
        &self.representation
    }

    /// Refines the solution until every coordinate is at most `2^-precision` wide.
    ///
    /// # Errors
    /// The error with which `watch` stops the work.
    pub(crate) fn refine<'w>(&self, precision: u64, watch: impl Into<Option<&'w Watch>>) -> Result<RealSolution> {
        let watch = Watch::or_none(watch);
        let (coordinates, root) = locate(&self.representation, self.root.clone(), precision, watch)?;
        Ok(RealSolution { coordinates, root, precision, ..self.clone() })
    }

    /// The exact sign of `polynomial` at the solution. `ring` has the variables of the system in its order.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when `ring` has other variables; the error with which `watch` stops the work.
    pub fn sign<'w>(
        &self,
        ring: &PolynomialRing<Rationals>,
        polynomial: &Polynomial<BigRational>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Ordering> {
        let watch = Watch::or_none(watch);
        let (value, _) = self.representation.substitute(ring, polynomial, watch)?;
        let value = self.sign_at_parameter(&value, watch)?;
        let odd = ring.degree(polynomial) % 2 == 1;
        let slope = self.representation.slope();
        let reversed = odd && self.sign_at_parameter(&slope, watch)?.is_lt();
        Ok(if reversed { value.reverse() } else { value })
    }

    fn sign_at_parameter(&self, polynomial: &Univariate<BigInt>, watch: &Watch) -> Result<Ordering> {
        let f = &self.representation.polynomial.coefficients;
        sign_at_root(f, &self.root, &polynomial.coefficients, watch)
    }

    /// The coordinates as doubles, each the nearest one. A number at equal distance from two doubles gives one of them.
    pub fn approximate(&self) -> Vec<f64> {
        let mut solution = self.clone();
        let rounded = |solution: &RealSolution, v: usize| solution.rounded(v);
        (0..self.coordinates.len())
            .map(|v| {
                loop {
                    if let Some(x) = rounded(&solution, v) {
                        break x;
                    }
                    let precision = 2 * solution.precision.max(32);
                    match solution.refine(precision, &Watch::none()) {
                        Ok(refined) => solution = refined,
                        Err(_) => break f64::NAN,
                    }
                }
            })
            .collect()
    }

    /// The double nearest to a coordinate, if the box determines it.
    fn rounded(&self, v: usize) -> Option<f64> {
        let Enclosure { low, high } = &self.coordinates[v];
        let nearest = |x: &BigRational| x.to_f64().unwrap_or(f64::NAN) + 0.0;
        let (below, above) = (nearest(low), nearest(high));
        if below == above || below.is_nan() || above.is_nan() {
            return Some(below);
        }
        if !low.is_positive() && !high.is_negative() {
            let numerator = &self.representation.numerators[v];
            let zero = self.sign_at_parameter(numerator, &Watch::none()).is_ok_and(Ordering::is_eq);
            return zero.then_some(0.0);
        }
        let ratio = self.coordinates[v].width() / low.abs().max(high.abs());
        (ratio.denom().bits() > ratio.numer().bits() + TIE).then_some(below)
    }

    pub(super) fn meets(&self, other: &RealSolution) -> bool {
        self.coordinates.iter().zip(&other.coordinates).all(|(a, b)| a.meets(b))
    }
}

/// The box of the solution at a root, and the root as refined for it.
fn locate(
    representation: &UnivariateRepresentation,
    mut root: Interval,
    precision: u64,
    watch: &Watch,
) -> Result<(Vec<Enclosure>, Interval)> {
    let slope = representation.slope();
    for bits in (0..).map(|k| (precision + 64) << k) {
        root = refine(&representation.polynomial.coefficients, &root, bits, watch)?;
        let numerators = representation.numerators.iter();
        let coordinates: Option<Vec<_>> = if root.is_point() {
            numerators.map(|g| exact_quotient(g, &slope, root.low())).collect()
        } else {
            let below = enclose(&slope.coefficients, &root, bits);
            numerators.map(|g| quotient(&enclose(&g.coefficients, &root, bits), &below, precision)).collect()
        };
        if let Some(coordinates) = coordinates {
            return Ok((coordinates, root));
        }
    }
    Ok((Vec::new(), root))
}

/// The value of `a / b` at a rational number.
fn exact_quotient(a: &Univariate<BigInt>, b: &Univariate<BigInt>, x: &BigRational) -> Option<Enclosure> {
    let value = |p: &Univariate<BigInt>| p.coefficients.iter().rev().fold(BigRational::zero(), |sum, c| sum * x + c);
    let (a, b) = (value(a), value(b));
    (!b.is_zero()).then(|| Enclosure { low: &a / &b, high: a / b })
}

/// The quotients of two ranges, rounded outwards; `None` when the divisor may be zero or the result is too wide.
fn quotient(a: &(BigInt, BigInt), b: &(BigInt, BigInt), precision: u64) -> Option<Enclosure> {
    if !b.0.is_positive() && !b.1.is_negative() {
        return None;
    }
    let grid = BigInt::one() << (precision + GUARD);
    let ends = [(&a.0, &b.0), (&a.0, &b.1), (&a.1, &b.0), (&a.1, &b.1)];
    let ends = ends.map(|(x, y)| BigRational::new(x * &grid, y.clone()));
    let (low, high) = (ends.iter().min()?.floor().to_integer(), ends.iter().max()?.ceil().to_integer());
    let narrow = &high - &low <= BigInt::one() << GUARD;
    narrow.then(|| Enclosure { low: BigRational::new(low, grid.clone()), high: BigRational::new(high, grid) })
}
