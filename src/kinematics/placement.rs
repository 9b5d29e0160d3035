//! Exact frames: how the origins of chain files, URDF joints and DH rows reach the base frame. Main type: [`Placement`].

use num_traits::Zero;

use super::{ExactRotation, ExactVector};
use crate::number::BigRational;

/// A frame in another one, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Its rotation, outer_from_frame.
    pub rotation: ExactRotation,
    /// Its origin, in the length unit of the description.
    pub origin: ExactVector,
}

impl Placement {
    /// The outer frame itself.
    pub fn identity() -> Self {
        Placement { rotation: ExactRotation::identity(), origin: std::array::from_fn(|_| BigRational::zero()) }
    }

    /// A frame that is only turned.
    pub fn turned(rotation: ExactRotation) -> Self {
        Placement { rotation, ..Placement::identity() }
    }

    /// A frame that is only shifted, by `distance` along a coordinate axis: 0, 1, 2 (modulo 3) for x, y, z.
    pub fn shifted(axis: usize, distance: BigRational) -> Self {
        let mut placement = Placement::identity();
        placement.origin[axis % 3] = distance;
        placement
    }

    /// The frame that stands at `inner` in this frame.
    #[must_use]
    pub fn then(&self, inner: &Placement) -> Self {
        let moved = self.rotation.turn(&inner.origin);
        let origin = std::array::from_fn(|i| &self.origin[i] + &moved[i]);
        Placement { rotation: self.rotation.then(&inner.rotation), origin }
    }

    /// The outer frame in this frame.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        let origin = rotation.turn(&self.origin).map(|x| -x);
        Placement { rotation, origin }
    }
}
