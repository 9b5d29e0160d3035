//! Rigid transforms SE(3): logarithm RH0 (2-8), adjoint (2-10) and its dual, their parts and matrices.

use nalgebra::{Matrix3, Matrix4, Matrix6, Point3, Translation3, Vector3};

use super::matrix::skew;
use super::{Pose, Twist, rotation};
use crate::{Error, ErrorKind, Result};

/// The logarithm, RH0 (2-8): the twist with `log(g).exp(1.0) = g`, whose `w` is [`rotation::log`].
///
/// Accurate to a few units in the last place of `v` and of `w` at all angles, small ones and those near pi included. At
/// an exact half turn, where there are two, it is the one of [`rotation::log`].
pub fn log(g: &Pose) -> Twist {
    let (w, d) = (rotation::log(&g.rotation), g.translation.vector);
    let turned = w.cross(&d);
    Twist { v: d - turned / 2.0 + w.cross(&turned) * cotangent_defect(w.norm()), w }
}

/// The magnitude of the motion, RH0 (2-8), (2-13): its angle \[rad\], or its distance \[m\] for a pure translation.
///
/// Any rotation that is not exactly the identity counts as a rotation.
pub fn magnitude(g: &Pose) -> f64 {
    log(g).magnitude()
}

/// The twist of magnitude one with `unit_twist(g).exp(magnitude(g)) = g`, RH0 (2-8); zero for the identity.
///
/// For a pure translation, `v` is its direction and `w = 0`.
pub fn unit_twist(g: &Pose) -> Twist {
    log(g).unit()
}

/// The adjoint of `a_from_b`, RH0 (2-10): converts the coordinates (v, w) of a twist from frame b to frame a.
///
/// [`Twist::transform`] does the same without the 6x6 matrix.
pub fn adjoint(a_from_b: &Pose) -> Matrix6<f64> {
    let r = orientation(a_from_b);
    block_triangle(&r, &(skew(&a_from_b.translation.vector) * r))
}

/// The inverse of [`adjoint`]: converts twists from frame a to frame b.
pub fn adjoint_inverse(a_from_b: &Pose) -> Matrix6<f64> {
    let back = orientation(a_from_b).transpose();
    block_triangle(&back, &(-back * skew(&a_from_b.translation.vector)))
}

/// The dual of the adjoint, its inverse transposed: converts the coordinates (f, tau) of a wrench from frame b to frame
/// a.
///
/// [`Wrench::transform`](super::Wrench::transform) does the same without the 6x6 matrix.
pub fn coadjoint(a_from_b: &Pose) -> Matrix6<f64> {
    adjoint_inverse(a_from_b).transpose()
}

/// The rotation matrix `R` of RH0 (2-1).
pub fn orientation(g: &Pose) -> Matrix3<f64> {
    g.rotation.to_rotation_matrix().into_inner()
}

/// The position `d` of RH0 (2-1): the image of the origin \[m\].
pub fn position(g: &Pose) -> Point3<f64> {
    Point3::from(g.translation.vector)
}

/// Builds the rigid transform with the rotation matrix `orientation` and the translation `position` \[m\], RH0 (2-1).
///
/// # Errors
/// [`ErrorKind::BadValue`] when `orientation` is not a rotation matrix, as in [`rotation::from_matrix`], or `position`
/// is not finite.
pub fn from_parts(orientation: &Matrix3<f64>, position: &Point3<f64>) -> Result<Pose> {
    if !position.iter().all(|x| x.is_finite()) {
        let [x, y, z] = (*position).into();
        return Err(Error::new(ErrorKind::BadValue, format!("position [{x}, {y}, {z}]: give finite coordinates")));
    }
    Ok(Pose::from_parts(Translation3::from(position.coords), rotation::from_matrix(orientation)?))
}

/// Builds the rigid transform with the homogeneous 4x4 matrix `matrix`, RH0 (2-1).
///
/// # Errors
/// [`ErrorKind::BadValue`] as in [`from_parts`], or when the last row is not 0, 0, 0, 1.
pub fn from_matrix(matrix: &Matrix4<f64>) -> Result<Pose> {
    let row: [f64; 4] = matrix.row(3).transpose().into();
    if row != [0.0, 0.0, 0.0, 1.0] {
        return Err(Error::new(ErrorKind::BadValue, format!("last row {row:?}: a rigid transform has [0, 0, 0, 1]")));
    }
    let position: Vector3<f64> = matrix.fixed_view::<3, 1>(0, 3).into_owned();
    from_parts(&matrix.fixed_view::<3, 3>(0, 0).into_owned(), &Point3::from(position))
}

/// A block matrix with `diagonal` twice on the diagonal, `corner` in the upper right, and zeros in the lower left.
fn block_triangle(diagonal: &Matrix3<f64>, corner: &Matrix3<f64>) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    for (block, i, j) in [(diagonal, 0, 0), (corner, 0, 3), (diagonal, 3, 3)] {
        matrix.fixed_view_mut::<3, 3>(i, j).copy_from(block);
    }
    matrix
}

/// `(1 - (x/2) cot(x/2)) / x^2`. Its cancellation error is small relative to the `d` to which it is added.
fn cotangent_defect(x: f64) -> f64 {
    let half = x / 2.0;
    if x < 1e-3 { 1.0 / 12.0 + x * x / 720.0 } else { (1.0 - half / half.tan()) / (x * x) }
}
