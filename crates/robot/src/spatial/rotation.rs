//! The rotations SO(3): Rodrigues' formula RH0 (2-9), exponential, logarithm, angle and axis.

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use crate::{Error, ErrorKind, Result};

/// Maximum Frobenius norm of `R' R - 1` for a given rotation matrix.
pub(crate) const ORTHONORMAL: f64 = 1e-9;
/// Tolerance of the length of a given quaternion.
#[doc(hidden)]
pub const UNIT: f64 = 1e-6;

/// The rotation by `angle` \[rad\] about `direction`, right-handed, by Rodrigues' formula RH0 (2-9).
pub fn rodrigues(direction: &Unit<Vector3<f64>>, angle: f64) -> Rotation3<f64> {
    let w = direction.cross_matrix();
    Rotation3::from_matrix_unchecked(Matrix3::identity() + w * angle.sin() + w * w * versine(angle))
}

/// The displacement of `x` by the rotation by `angle` \[rad\] about `direction`: `R x - x`, exactly zero at angle zero.
pub fn displacement(direction: &Unit<Vector3<f64>>, angle: f64, x: &Vector3<f64>) -> Vector3<f64> {
    displacement_by_half(direction, (angle / 2.0).sin_cos(), x)
}

/// Same as [`displacement`], but from the sine and cosine of half the angle: `sin a = 2 sin(a/2) cos(a/2)`, `1 - cos a
/// = 2 sin(a/2)^2`.
pub(super) fn displacement_by_half(
    direction: &Unit<Vector3<f64>>,
    (sine, cosine): (f64, f64),
    x: &Vector3<f64>,
) -> Vector3<f64> {
    let tangent = direction.cross(x);
    (tangent * cosine + direction.cross(&tangent) * sine) * (2.0 * sine)
}

/// The exponential of `skew(w)`: the rotation about `w` by its length \[rad\], RH0 (2-9) for `w` of any length.
pub fn exp(w: &Vector3<f64>) -> UnitQuaternion<f64> {
    let half = w.norm() / 2.0;
    UnitQuaternion::new_normalize(Quaternion::from_parts(half.cos(), w * (sinc(half) / 2.0)))
}

/// The logarithm: the vector `w` with [`exp`]`(w) = rotation`, of length [`angle`] \[rad\].
///
/// Accurate to a few units in the last place at all angles, small ones and those near pi included. An exact half turn
/// (scalar part zero) has two logarithms; this is the one whose first nonzero coordinate is positive.
pub fn log(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (cosine, vector) = shorter_rotation(rotation);
    let sine = vector.norm();
    let tangent = sine / cosine;
    vector * if tangent < 1e-4 { (2.0 - tangent * tangent / 1.5) / cosine } else { 2.0 * sine.atan2(cosine) / sine }
}

/// The angle of the rotation, in \[0, pi\] \[rad\]: the theta of RH0 (2-9).
pub fn angle(rotation: &UnitQuaternion<f64>) -> f64 {
    2.0 * length(&rotation.imag()).atan2(rotation.scalar().abs())
}

/// The axis of the right-handed rotation by [`angle`]: the omega of RH0 (2-9). `None` for the identity.
///
/// Of the two axes of an exact half turn it is the one whose first nonzero coordinate is positive.
pub fn axis(rotation: &UnitQuaternion<f64>) -> Option<Unit<Vector3<f64>>> {
    let (_, vector) = shorter_rotation(rotation);
    let size = vector.amax();
    (size > 0.0).then(|| Unit::new_normalize(vector / size))
}

/// Converts a rotation matrix.
///
/// # Errors
/// [`ErrorKind::BadValue`] when the columns are not a right-handed orthonormal frame, to 1e-9.
pub fn from_matrix(matrix: &Matrix3<f64>) -> Result<UnitQuaternion<f64>> {
    let off = (matrix.transpose() * matrix - Matrix3::identity()).norm();
    let determinant = matrix.determinant();
    if off <= ORTHONORMAL && determinant > 0.0 {
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*matrix));
        return Ok(UnitQuaternion::new_normalize(rotation.into_inner()));
    }
    let text = format!(
        "not a rotation matrix: R'R differs from the identity by {off:e}, det R = {determinant}; \
         give orthonormal columns (to {ORTHONORMAL:e}) and determinant 1"
    );
    Err(Error::new(ErrorKind::BadValue, text))
}

/// Converts a unit quaternion x, y, z, w to a rotation matrix, row by row.
///
/// # Errors
/// The length, when it is not one to [`UNIT`].
pub fn rows_of_quaternion(quaternion: [f64; 4]) -> std::result::Result<[f64; 9], f64> {
    let length = quaternion.iter().map(|value| value * value).sum::<f64>().sqrt();
    if length.is_nan() || (length - 1.0).abs() > UNIT {
        return Err(length);
    }
    let [x, y, z, w] = quaternion.map(|value| value / length);
    Ok([
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - z * w),
        2.0 * (x * z + y * w),
        2.0 * (x * y + z * w),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - x * w),
        2.0 * (x * z - y * w),
        2.0 * (y * z + x * w),
        1.0 - 2.0 * (x * x + y * y),
    ])
}

/// Cosine and vector part of the quaternion of `rotation` with an angle of at most pi; at pi the one of [`log`].
fn shorter_rotation(rotation: &UnitQuaternion<f64>) -> (f64, Vector3<f64>) {
    let (cosine, vector) = (rotation.scalar(), rotation.imag());
    let leading = vector.iter().copied().find(|x| *x != 0.0).unwrap_or(0.0);
    let turns_back = if cosine == 0.0 { leading < 0.0 } else { cosine < 0.0 };
    (cosine.abs(), if turns_back { -vector } else { vector })
}

/// `1 - cos(angle)` without cancellation.
fn versine(angle: f64) -> f64 {
    2.0 * (angle / 2.0).sin().powi(2)
}

/// `sin(x) / x`.
pub(super) fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

/// The length of `x`, zero only when `x` is zero: the squares of its entries do not underflow or overflow.
pub(super) fn length(x: &Vector3<f64>) -> f64 {
    x.x.hypot(x.y).hypot(x.z)
}

/// Pitch and roll \[rad\] of a rotation Rz(yaw) Ry(pitch) Rx(roll), from its third row: -sin pitch, cos pitch sin roll,
/// cos pitch cos roll.
pub fn pitch_and_roll(rotation: &UnitQuaternion<f64>) -> (f64, f64) {
    let matrix = rotation.to_rotation_matrix();
    let [along, across, up] = [0, 1, 2].map(|k| matrix[(2, k)]);
    ((-along).atan2(across.hypot(up)), across.atan2(up))
}

/// The third row of a rotation with this pitch and roll: the vertical in the tip frame.
pub fn vertical(pitch: f64, roll: f64) -> Vector3<f64> {
    Vector3::new(-pitch.sin(), pitch.cos() * roll.sin(), pitch.cos() * roll.cos())
}

/// Roll, pitch and yaw of a URDF \[rad\]: `R = Rz(yaw) Ry(pitch) Rx(roll)`, pitch in \[-pi/2, pi/2\]. Where roll and
/// yaw rotate about one line, yaw is zero.
pub(crate) fn rpy(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let r = rotation.to_rotation_matrix().into_inner();
    let level = r[(0, 0)].hypot(r[(1, 0)]);
    let yaw = if level <= 4.0 * f64::EPSILON { 0.0 } else { r[(1, 0)].atan2(r[(0, 0)]) };
    let (s, c) = yaw.sin_cos();
    let roll = (s * r[(0, 2)] - c * r[(1, 2)]).atan2(c * r[(1, 1)] - s * r[(0, 1)]);
    [roll, (-r[(2, 0)]).atan2(level), yaw]
}
