//! Twists and points as matrices: the operators hat and vee, RH0 (2-4) to (2-6), and homogeneous coordinates.

use nalgebra::{Matrix3, Matrix4, Point3, Vector3, Vector4};

use super::Twist;
use crate::{Error, ErrorKind, Result};

/// The skew-symmetric matrix of `w`: `skew(w) * x` is the cross product of `w` and `x`, RH0 (2-4).
pub fn skew(w: &Vector3<f64>) -> Matrix3<f64> {
    w.cross_matrix()
}

/// The vector whose skew-symmetric matrix is `matrix`, RH0 (2-4). For another matrix, its skew-symmetric part is used.
pub fn unskew(matrix: &Matrix3<f64>) -> Vector3<f64> {
    let half = |i, j| 0.5 * matrix[(i, j)] - 0.5 * matrix[(j, i)];
    Vector3::new(half(2, 1), half(0, 2), half(1, 0))
}

/// The 4x4 matrix of a twist in se(3): the skew-symmetric matrix of `w`, the column `v`, and a zero row, RH0 (2-2),
/// (2-6).
pub fn wedge(twist: &Twist) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&skew(&twist.w));
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&twist.v);
    matrix
}

/// The twist of a 4x4 matrix of se(3), RH0 (2-5): [`unskew`] of the upper left block, and the last column.
///
/// The last row, zero in se(3), is ignored.
pub fn vee(matrix: &Matrix4<f64>) -> Twist {
    let block = matrix.fixed_view::<3, 3>(0, 0).into_owned();
    Twist { v: matrix.fixed_view::<3, 1>(0, 3).into_owned(), w: unskew(&block) }
}

/// The homogeneous coordinates (x, y, z, 1) of a point, which a rigid transform rotates and translates; RobotMan f(17).
pub fn point_to_homogeneous(point: &Point3<f64>) -> Vector4<f64> {
    point.to_homogeneous()
}

/// The homogeneous coordinates (x, y, z, 0) of a free vector, which a rigid transform only rotates; RobotMan f(44).
pub fn vector_to_homogeneous(vector: &Vector3<f64>) -> Vector4<f64> {
    vector.to_homogeneous()
}

/// The point with the homogeneous coordinates `coordinates`: the first three divided by the fourth; RobotMan f(5).
///
/// # Errors
/// [`ErrorKind::BadValue`] when the result is not a finite point: a coordinate is not finite, or the fourth is zero.
pub fn point_from_homogeneous(coordinates: &Vector4<f64>) -> Result<Point3<f64>> {
    let point = Point3::from(coordinates.xyz() / coordinates.w);
    if coordinates.w.is_finite() && point.iter().all(|x| x.is_finite()) {
        return Ok(point);
    }
    let [x, y, z, w] = (*coordinates).into();
    let text = format!("[{x}, {y}, {z}, {w}] is not a point; give finite coordinates, the fourth not zero");
    Err(Error::new(ErrorKind::BadValue, text))
}
