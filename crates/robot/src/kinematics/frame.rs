//! Exact composition of placements, including multiples of 45 and 30 degrees. Main type: [`Frame`].
//!
//! A chain has rational numbers. If all of its axes are rational, as in a leg whose hip is rotated by 45 degrees and
//! back, nothing is rounded. If some are irrational, as in an arm on a base rotated by 30 degrees, each rotation is
//! rounded to one that is exactly orthogonal, within 1e-17. Rounding the square roots separately would destroy exact
//! intersections and right angles of axes.

use super::{ExactRotation, ExactVector, Placement, Tip};
use crate::spatial::exact::rotation::over_common;
use crate::spatial::exact::surd::{SurdVector, directed, recognised, surds};
use groebot_algebra::number::{BigInt, BigRational};
use num_integer::Integer;
use num_traits::Zero;

/// Maximum number of bits of a direction's integers.
const SHORT: u64 = 24;

/// A frame in the base frame. It is exact, except after many general rotations; then it is within 1e-24.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// base_from_frame.
    rotation: ExactRotation,
    origin: SurdVector,
    /// Whether rotations are made rational.
    rounds: bool,
    /// The interpretation of numbers.
    reading: Reading,
}

/// The interpretation of a description's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// Every digit is exact.
    AsDescribed,
    /// Rounded multiples of 45 and 30 degrees, and rounded unit vectors, mean the exact values.
    AsMeant,
}

impl Frame {
    fn base(reading: Reading) -> Self {
        Frame { rotation: ExactRotation::identity(), origin: Default::default(), rounds: false, reading }
    }

    /// The result of `walk` for the joints of a chain, starting at the base frame. If the axes are not all rational,
    /// `walk` runs again with rational rotations. `walk` reports whether they are.
    pub fn walked<T, E>(reading: Reading, walk: impl Fn(Frame) -> Result<(T, Rationality), E>) -> Result<T, E> {
        let (exact, rationality) = walk(Frame::base(reading))?;
        if rationality.is_exact() {
            Ok(exact)
        } else {
            walk(Frame { rounds: true, ..Frame::base(reading) }).map(|(rounded, _)| rounded)
        }
    }

    /// Whether the line along `axis` of this frame through its origin is rational in the base frame, and whether its
    /// direction has a rational length.
    pub fn rationality(&self, axis: &ExactVector) -> [bool; 2] {
        let direction = directed(&self.rotation.turned(&surds(axis)));
        let is_rational = direction.iter().chain(&self.origin).all(|entry| entry.rational().is_some());
        let square: BigRational = direction.iter().filter_map(|entry| entry.rational()).map(|x| x * x).sum();
        let is_square = |n: &BigInt| n.sqrt().pow(2) == *n;
        [is_rational, is_rational && is_square(square.numer()) && is_square(square.denom())]
    }

    /// The frame with the pose `inner` in this frame.
    #[must_use]
    pub fn then(&self, inner: &Placement) -> Self {
        let moved = self.rotation.turned(&surds(&inner.origin));
        let origin = std::array::from_fn(|i| self.origin[i].add(&moved[i]).shortened());
        self.turned(&self.rotation_of(inner), origin)
    }

    /// The rotation of a placement in this frame, rounded to a rational one if rotations are rounded.
    fn rotation_of(&self, inner: &Placement) -> ExactRotation {
        let rotation = match self.reading {
            Reading::AsDescribed => inner.rotation.clone(),
            Reading::AsMeant => inner.meant().clone(),
        };
        if self.rounds { rotation.made_rational() } else { rotation }
    }

    /// This frame rotated by `rotation`, with the origin `origin`.
    fn turned(&self, rotation: &ExactRotation, origin: SurdVector) -> Self {
        Frame { rotation: self.rotation.then(rotation).shortened(), origin, ..*self }
    }

    /// The frame in which this frame has the pose `inner`.
    #[must_use]
    pub fn before(&self, inner: &Placement) -> Self {
        let turned = self.turned(&self.rotation_of(inner).inverse(), self.origin.clone());
        let moved = turned.rotation.turned(&surds(&inner.origin));
        let origin = std::array::from_fn(|i| self.origin[i].sub(&moved[i]).shortened());
        Frame { origin, ..turned }
    }

    /// The direction `axis` of this frame in the base frame. It has coprime integers if it is rational and they are
    /// short, else its own entries. Irrational entries are within 2^-80 of the greatest one. In a unit vector, 0.866025
    /// [means](Reading::AsMeant) sqrt 3 / 2.
    pub fn direction(&self, axis: &ExactVector) -> ExactVector {
        let meant = (self.reading == Reading::AsMeant).then(|| recognised(axis)).flatten();
        let axis = meant.unwrap_or_else(|| surds(axis));
        let direction = directed(&self.rotation.turned(&axis));
        match direction.each_ref().map(|entry| entry.rational().cloned()) {
            [Some(x), Some(y), Some(z)] if !self.rotation.is_long() => shortest([x, y, z]),
            _ => direction.each_ref().map(|entry| entry.nearby()),
        }
    }

    /// The origin in the base frame. Rational coordinates are exact, others within 2^-80.
    pub fn point(&self) -> ExactVector {
        self.origin.each_ref().map(|entry| entry.nearby())
    }

    /// This frame as the tip of a chain.
    pub fn tip(&self) -> Tip {
        Tip { point: self.point(), rotation: self.rotation.matrix() }
    }
}

/// Counts of a chain's axes: irrational ones, rational ones with directions of irrational length, and others.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rationality {
    rational: usize,
    slanted: usize,
    irrational: usize,
}

impl Rationality {
    /// Counts an axis with this [`Frame::rationality`].
    pub fn add(&mut self, [is_rational, has_length]: [bool; 2]) {
        match (is_rational, has_length) {
            (false, _) => self.irrational += 1,
            (true, false) => self.slanted += 1,
            (true, true) => self.rational += 1,
        }
    }

    /// Whether the chain is kept exact: all axes are rational, and those along diagonals, whose lengths are square
    /// roots, are a minority. This holds for a hip, but not for an arm on a slanted base.
    fn is_exact(self) -> bool {
        self.irrational == 0 && self.slanted <= self.rational
    }
}

/// The direction of `axis` in coprime integers, unless they are longer than [`SHORT`]: (0, 1, -1) for (0, 0.7071,
/// -0.7071).
fn shortest(axis: ExactVector) -> ExactVector {
    let (integers, _) = over_common(axis.each_ref());
    let divisor = integers.iter().fold(BigInt::zero(), |divisor, x| divisor.gcd(x));
    let integers = integers.map(|x| if divisor.is_zero() { x } else { x / &divisor });
    if integers.iter().any(|x| x.bits() > SHORT) { axis } else { integers.map(BigRational::from_integer) }
}
