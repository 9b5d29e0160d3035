//! Where a chain of placements leads, exactly, multiples of 45 and 30 degrees included. Main type: [`Frame`].
//!
//! A chain is told in rational numbers. Where all of its axes are, exactly, as in a leg whose hip is turned by 45 degrees and back, nothing is
//! rounded. Where some are not, as in an arm on a base turned by 30 degrees, roots are not rounded number by number, for axes that meet or are
//! perpendicular would miss it by a hair; but each rotation that leads to them is, to one that is exactly orthogonal and within 1e-17.

use super::{ExactRotation, ExactVector, Placement, Tip};
use crate::spatial::exact::rotation::over_common;
use crate::spatial::exact::surd::{SurdVector, directed, recognised, surds};
use groebot_algebra::number::{BigInt, BigRational};
use num_integer::Integer;
use num_traits::Zero;

/// Bits of the integers that a direction is told in.
const SHORT: u64 = 24;

/// A frame in the base frame: exactly, but for long rows of general rotations, within 1e-24 then.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// base_from_frame.
    rotation: ExactRotation,
    origin: SurdVector,
    /// Whether rotations are made rational.
    rounds: bool,
    /// How numbers are read.
    reading: Reading,
}

/// How the numbers of a description are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// As they stand.
    AsDescribed,
    /// Rounded multiples of 45 and 30 degrees, and rounded unit vectors, as what they are the decimals of.
    AsMeant,
}

impl Frame {
    fn base(reading: Reading) -> Self {
        Frame { rotation: ExactRotation::identity(), origin: Default::default(), rounds: false, reading }
    }

    /// What `walk` makes of the joints of a chain, starting at the base frame; where that is not rational, what it makes of them when rotations
    /// are. It tells of all axes whether they are.
    pub fn walked<T, E>(reading: Reading, walk: impl Fn(Frame) -> Result<(T, Rationality), E>) -> Result<T, E> {
        let (exact, told) = walk(Frame::base(reading))?;
        if told.is_exact() {
            Ok(exact)
        } else {
            walk(Frame { rounds: true, ..Frame::base(reading) }).map(|(rounded, _)| rounded)
        }
    }

    /// Whether the line along `axis` of this frame through its origin is rational in the base frame, and whether its direction has a rational
    /// length.
    pub fn rationality(&self, axis: &ExactVector) -> [bool; 2] {
        let direction = directed(&self.rotation.turned(&surds(axis)));
        let is_rational = direction.iter().chain(&self.origin).all(|entry| entry.rational().is_some());
        let square: BigRational = direction.iter().filter_map(|entry| entry.rational()).map(|x| x * x).sum();
        let is_square = |n: &BigInt| n.sqrt().pow(2) == *n;
        [is_rational, is_rational && is_square(square.numer()) && is_square(square.denom())]
    }

    /// The frame that stands at `inner` in this one.
    #[must_use]
    pub fn then(&self, inner: &Placement) -> Self {
        let moved = self.rotation.turned(&surds(&inner.origin));
        let origin = std::array::from_fn(|i| self.origin[i].add(&moved[i]).shortened());
        self.turned(&self.told(inner), origin)
    }

    /// The rotation of a placement in this frame, made rational where rotations are.
    fn told(&self, inner: &Placement) -> ExactRotation {
        let rotation = match self.reading {
            Reading::AsDescribed => inner.rotation.clone(),
            Reading::AsMeant => inner.meant().clone(),
        };
        if self.rounds { rotation.made_rational() } else { rotation }
    }

    /// This frame turned by `rotation`, its origin moved to `origin`.
    fn turned(&self, rotation: &ExactRotation, origin: SurdVector) -> Self {
        Frame { rotation: self.rotation.then(rotation).shortened(), origin, ..*self }
    }

    /// The frame in which this one stands at `inner`.
    #[must_use]
    pub fn before(&self, inner: &Placement) -> Self {
        let turned = self.turned(&self.told(inner).inverse(), self.origin.clone());
        let moved = turned.rotation.turned(&surds(&inner.origin));
        let origin = std::array::from_fn(|i| self.origin[i].sub(&moved[i]).shortened());
        Frame { origin, ..turned }
    }

    /// The direction `axis` of this frame in the base frame, in coprime integers when it is rational and they are short, else as it is;
    /// what is not rational within 2^-80 of the greatest entry. In a unit vector 0.866025 [means](Reading::AsMeant) sqrt 3 / 2.
    pub fn direction(&self, axis: &ExactVector) -> ExactVector {
        let meant = (self.reading == Reading::AsMeant).then(|| recognised(axis)).flatten();
        let axis = meant.unwrap_or_else(|| surds(axis));
        let direction = directed(&self.rotation.turned(&axis));
        match direction.each_ref().map(|entry| entry.rational().cloned()) {
            [Some(x), Some(y), Some(z)] if !self.rotation.is_long() => shortest([x, y, z]),
            _ => direction.each_ref().map(|entry| entry.nearby()),
        }
    }

    /// The origin in the base frame, each coordinate itself when it is rational, else within 2^-80.
    pub fn point(&self) -> ExactVector {
        self.origin.each_ref().map(|entry| entry.nearby())
    }

    /// This frame as the tip of a chain.
    pub fn tip(&self) -> Tip {
        Tip { point: self.point(), rotation: self.rotation.matrix() }
    }
}

/// What a walk met: axes that are not rational, axes that are but have directions of an irrational length, and others.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rationality {
    rational: usize,
    slanted: usize,
    irrational: usize,
}

impl Rationality {
    /// Counts an axis by its [`Frame::rationality`].
    pub fn add(&mut self, [is_rational, has_length]: [bool; 2]) {
        match (is_rational, has_length) {
            (false, _) => self.irrational += 1,
            (true, false) => self.slanted += 1,
            (true, true) => self.rational += 1,
        }
    }

    /// Whether the chain is to be told as it is: all axes are rational, and those along diagonals, whose lengths are roots, are the fewer, as
    /// that of a hip is, and not those of an arm on a slanted base.
    fn is_exact(self) -> bool {
        self.irrational == 0 && self.slanted <= self.rational
    }
}

/// The direction of `axis` in coprime integers, (0, 1, -1) for (0, 0.7071, -0.7071), unless they are longer than [`SHORT`].
fn shortest(axis: ExactVector) -> ExactVector {
    let (integers, _) = over_common(axis.each_ref());
    let divisor = integers.iter().fold(BigInt::zero(), |divisor, x| divisor.gcd(x));
    let integers = integers.map(|x| if divisor.is_zero() { x } else { x / &divisor });
    if integers.iter().any(|x| x.bits() > SHORT) { axis } else { integers.map(BigRational::from_integer) }
}
