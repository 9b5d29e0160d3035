//! Rotations about a direction: the cross-product matrix RH0 (2-4) and Rodrigues' formula RH0 (2-9).

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

/// The skew matrix of `w`: `skew(w) * x` is the cross product of `w` and `x`, RH0 (2-4).
pub fn skew(w: &Vector3<f64>) -> Matrix3<f64> {
    w.cross_matrix()
}

/// The rotation by `angle` \[rad\] about `direction`, right-handed, by Rodrigues' formula RH0 (2-9).
pub fn rodrigues(direction: &Unit<Vector3<f64>>, angle: f64) -> Rotation3<f64> {
    let w = skew(direction);
    Rotation3::from_matrix_unchecked(Matrix3::identity() + w * angle.sin() + w * w * versine(angle))
}

/// What the rotation by `angle` \[rad\] about `direction` adds to `x`: `R x - x`, exactly zero at angle zero.
pub fn displacement(direction: &Unit<Vector3<f64>>, angle: f64, x: &Vector3<f64>) -> Vector3<f64> {
    let tangent = direction.cross(x);
    tangent * angle.sin() + direction.cross(&tangent) * versine(angle)
}

/// `1 - cos(angle)` without cancellation.
fn versine(angle: f64) -> f64 {
    2.0 * (angle / 2.0).sin().powi(2)
}
