//! Exact frames, for the origins of chain files, URDF joints and DH rows. Main type: [`Placement`].

use nalgebra::{Matrix3, Point3, Rotation3, Unit, UnitQuaternion, Vector3};
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{ExactMatrix, ExactRotation, ExactVector, Turn};
use crate::spatial::Pose;
use groebot_algebra::number::BigRational;

/// A frame in another one, exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// Its rotation, outer_from_frame.
    pub rotation: ExactRotation,
    /// The exact rotation that its rounded numbers approximate, if it differs: 1.5708 means a quarter turn.
    pub meant: Option<ExactRotation>,
    /// Its origin, in the length unit of the description.
    pub origin: ExactVector,
}

impl Placement {
    /// The identity.
    pub fn identity() -> Self {
        let origin = std::array::from_fn(|_| BigRational::zero());
        Placement { rotation: ExactRotation::identity(), meant: None, origin }
    }

    /// A rotation by Rz(yaw) Ry(pitch) Rx(roll) about the outer axes, as in a URDF's `rpy`.
    pub(crate) fn turned(turns: [Turn; 3]) -> Self {
        let rotation = ExactRotation::from_rpy(turns);
        let meant = turns.map(Turn::meant);
        let meant = (meant != turns).then(|| ExactRotation::from_rpy(meant));
        Placement { rotation, meant, ..Placement::identity() }
    }

    /// A translation by `distance` along a coordinate axis: 0, 1, 2 (modulo 3) for x, y, z.
    pub fn shifted(axis: usize, distance: BigRational) -> Self {
        let mut placement = Placement::identity();
        placement.origin[axis % 3] = distance;
        placement
    }

    /// A rotation by `angle` \[rad\] about an axis of any length through the origin, within rounding.
    pub(crate) fn turned_about(axis: &ExactVector, angle: &BigRational) -> Self {
        let length = rounded_length(axis);
        let half = angle.to_f64().unwrap_or(0.0) / 2.0;
        let [sine, cosine] = [half.sin(), half.cos()].map(|x| BigRational::from_float(x).unwrap_or_default());
        let [x, y, z] = axis.each_ref().map(|entry| entry * &sine / &length);
        let rotation = ExactRotation::from_quaternion(&[x, y, z, cosine]).unwrap_or_else(ExactRotation::identity);
        Placement { rotation, ..Placement::identity() }
    }

    /// A translation by `distance` along an axis of any length, within rounding.
    pub(crate) fn shifted_along(axis: &ExactVector, distance: &BigRational) -> Self {
        let length = rounded_length(axis);
        Placement { origin: axis.each_ref().map(|entry| entry * distance / &length), ..Placement::identity() }
    }

    /// Composes with `inner`, a frame in this frame.
    #[must_use]
    pub fn then(&self, inner: &Placement) -> Self {
        let moved = self.rotation.turn(&inner.origin);
        let origin = std::array::from_fn(|i| &self.origin[i] + &moved[i]);
        let [outer, within] = [self, inner].map(Placement::meant);
        let meant = (self.meant.is_some() || inner.meant.is_some()).then(|| outer.then(within));
        Placement { rotation: self.rotation.then(&inner.rotation), meant, origin }
    }

    /// The inverse: the outer frame in this frame.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        let origin = rotation.turn(&self.origin).map(|x| -x);
        Placement { rotation, meant: self.meant.as_ref().map(ExactRotation::inverse), origin }
    }

    /// The exact rotation that its numbers approximate.
    pub(crate) fn meant(&self) -> &ExactRotation {
        self.meant.as_ref().unwrap_or(&self.rotation)
    }

    /// The frame in doubles, lengths in the unit of the description.
    pub fn pose(&self) -> Pose {
        Pose::from_parts(point(&self.origin).coords.into(), rotation(&self.rotation.matrix()))
    }
}

/// The length of a vector, rounded to a double; one for the zero vector.
fn rounded_length(vector: &ExactVector) -> BigRational {
    let square: BigRational = vector.iter().map(|entry| entry * entry).sum();
    let root = BigRational::from_float(square.to_f64().unwrap_or(1.0).sqrt());
    root.filter(|root| !root.is_zero()).unwrap_or_else(BigRational::one)
}

fn double(exact: &BigRational) -> f64 {
    exact.to_f64().unwrap_or(0.0)
}

/// An exact point in doubles.
pub fn point(exact: &ExactVector) -> Point3<f64> {
    Point3::from(exact.each_ref().map(double))
}

/// An exact rotation matrix in doubles.
pub fn rotation(exact: &ExactMatrix) -> UnitQuaternion<f64> {
    let matrix = Matrix3::from_fn(|i, j| double(&exact[i][j]));
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix))
}

/// The unit vector of a nonzero exact vector.
pub fn normalized(vector: &ExactVector) -> Unit<Vector3<f64>> {
    let greatest = vector.iter().map(Signed::abs).max().unwrap_or_default();
    let [x, y, z] = vector.each_ref().map(|entry| double(&(entry / &greatest)));
    Unit::new_normalize(Vector3::new(x, y, z))
}
