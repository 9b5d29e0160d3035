//! Where a chain of placements leads, exactly, multiples of 45 and 30 degrees included. Main type: [`Frame`].

use super::exact_rotation::over_common;
use super::surd::{SurdVector, directed, recognised, surds};
use super::{ExactRotation, ExactVector, Placement, Tip};
use crate::number::{BigInt, BigRational};
use num_integer::Integer;
use num_traits::Zero;

/// Bits of the integers that a direction is told in.
const SHORT: u64 = 24;

/// What a description's frames miss by rounding, in radians and metres: axes that are nearer to a relation than this are in it.
pub const ROUNDING: f64 = 1e-12;

/// A frame in the base frame: exactly, but for long rows of general rotations, within 1e-24 then.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// base_from_frame.
    rotation: ExactRotation,
    origin: SurdVector,
}

impl Frame {
    /// The base frame.
    pub fn base() -> Self {
        Frame { rotation: ExactRotation::identity(), origin: Default::default() }
    }

    /// The frame that stands at `inner` in this one.
    #[must_use]
    pub fn then(&self, inner: &Placement) -> Self {
        let moved = self.rotation.turned(&surds(&inner.origin));
        let origin = std::array::from_fn(|i| self.origin[i].add(&moved[i]).shortened());
        Frame { rotation: self.rotation.then(&inner.rotation).shortened(), origin }
    }

    /// The frame in which this one stands at `inner`.
    #[must_use]
    pub fn before(&self, inner: &Placement) -> Self {
        let rotation = self.rotation.then(&inner.rotation.inverse()).shortened();
        let moved = rotation.turned(&surds(&inner.origin));
        let origin = std::array::from_fn(|i| self.origin[i].sub(&moved[i]).shortened());
        Frame { rotation, origin }
    }

    /// The direction `axis` of this frame in the base frame (0.866025 stands for sqrt 3 / 2 in a unit vector), in coprime integers when
    /// it is rational and they are short, else as it is; what is not rational within 2^-80 of the greatest entry.
    pub fn direction(&self, axis: &ExactVector) -> ExactVector {
        let axis = recognised(axis).unwrap_or_else(|| surds(axis));
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

/// The direction of `axis` in coprime integers, (0, 1, -1) for (0, 0.7071, -0.7071), unless they are longer than [`SHORT`].
fn shortest(axis: ExactVector) -> ExactVector {
    let (integers, _) = over_common(axis.each_ref());
    let divisor = integers.iter().fold(BigInt::zero(), |divisor, x| divisor.gcd(x));
    let integers = integers.map(|x| if divisor.is_zero() { x } else { x / &divisor });
    if integers.iter().any(|x| x.bits() > SHORT) { axis } else { integers.map(BigRational::from_integer) }
}
