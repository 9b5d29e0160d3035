//! One real solution: a box that holds it, and exact answers to questions about it.

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

    /// Whether `x` lies in it.
    pub fn contains(&self, x: &BigRational) -> bool {
        self.low <= *x && *x <= self.high
    }

    fn meets(&self, other: &Enclosure) -> bool {
        self.low <= other.high && other.low <= self.high
    }
}

/// Bits between the width asked for and the grid that enclosures are rounded to.
const GUARD: u64 = 2;

/// Relative bits at which a coordinate between two doubles is taken to lie on their midpoint.
const TIE: u64 = 256;

/// An isolated real solution of a system.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RealSolution {
    /// One interval a variable: the sides of a box in which no other real solution lies.
    pub coordinates: Vec<Enclosure>,
    /// The multiplicity: the dimension of the local ring at the solution.
    pub multiplicity: usize,
    root: Interval,
    precision: u64,
    representation: Arc<UnivariateRepresentation>,
}

impl RealSolution {
    /// The solution at the root of the representation's polynomial in `root`, to `precision` bits.
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

    /// The bits asked for: every coordinate is at most `2^-precision` wide.
    pub fn precision(&self) -> u64 {
        self.precision
    }

    /// The representation of all solutions that this one belongs to.
    pub fn representation(&self) -> &UnivariateRepresentation {
        &self.representation
    }

    /// The same solution with coordinates at most `2^-precision` wide.
    ///
    /// # Errors
    /// What `watch` stops with.
    pub fn refine(&self, precision: u64, watch: &Watch) -> Result<RealSolution> {
        let (coordinates, root) = locate(&self.representation, self.root.clone(), precision, watch)?;
        Ok(RealSolution { coordinates, root, precision, ..self.clone() })
    }

    /// How `polynomial` compares with zero at the solution, exactly. `ring` has the variables of the system in its order.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when `ring` has other variables; what `watch` stops with.
    pub fn sign(
        &self,
        ring: &PolynomialRing<Rationals>,
        polynomial: &Polynomial<BigRational>,
        watch: &Watch,
    ) -> Result<Ordering> {
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

    /// The coordinates as doubles, each the nearest one (or, for a number half-way between two, one of them).
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

    /// The double nearest to a coordinate, if the box tells.
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

/// The box of the solution at a root, and the root refined as far as that took.
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
