//! Two equations that are linear in the cosine and sine of one angle, with constant factors. The subproblems of three
//! joints, four circles and planes reduce to them.
//!
//! The equations `a_i . R(q) y = b_i`, i = 1, 2, where y and b depend on another joint, determine R(q) y. Its length
//! must be that of y: an equation in the other joint alone, of degree two in its cosine and sine.

use nalgebra::{Matrix2, Unit, Vector2, Vector3};

/// The two equations of a rotation about an axis, in coordinates perpendicular to the axis.
pub(super) struct Turn {
    axis: Unit<Vector3<f64>>,
    across: [Vector3<f64>; 2],
    /// The components of the two vectors a_i along the axis.
    along: [f64; 2],
    /// The product of the two vectors' lengths.
    lengths: f64,
    matrix: Matrix2<f64>,
    determinant: f64,
}

/// The determinant counts as zero below this fraction of the product of the vectors' lengths.
const SINGULAR: f64 = 1e-9;

impl Turn {
    /// Builds the equations for the vectors a_1, a_2 and a rotation about `axis`.
    pub fn new(axis: &Unit<Vector3<f64>>, a: [Vector3<f64>; 2]) -> Turn {
        let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
        let across = [first, axis.cross(&first)];
        let row = |a: &Vector3<f64>| Vector2::new(across[0].dot(a), across[1].dot(a)).transpose();
        let matrix = Matrix2::from_rows(&[row(&a[0]), row(&a[1])]);
        let lengths = a[0].norm() * a[1].norm();
        let determinant = matrix.determinant();
        let determinant = if determinant.abs() <= SINGULAR * lengths { 0.0 } else { determinant };
        Turn { axis: *axis, across, along: [axis.dot(&a[0]), axis.dot(&a[1])], lengths, matrix, determinant }
    }

    /// Tolerance of the condition for y of at most this length: rounding, and a target that is missed by the fraction
    /// `miss` of that length.
    pub fn grain(&self, length: f64, miss: f64) -> f64 {
        let factor = if self.is_singular() { self.matrix.norm() } else { self.lengths };
        miss.max(256.0 * f64::EPSILON) * (factor * length).powi(2)
    }

    /// Whether the left sides of the two equations are linearly dependent.
    pub fn is_singular(&self) -> bool {
        self.determinant == 0.0
    }

    fn flat(&self, y: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(self.across[0].dot(y), self.across[1].dot(y))
    }

    /// The right sides minus the components along the axis.
    fn left(&self, y: &Vector3<f64>, b: [f64; 2]) -> Vector2<f64> {
        let height = self.axis.dot(y);
        Vector2::new(b[0] - self.along[0] * height, b[1] - self.along[1] * height)
    }

    /// Zero where some angle solves both equations. It is a polynomial in the variables in which y and b are linear: of
    /// degree two, or of degree one when the equations are singular and b is linear.
    pub fn condition(&self, y: &Vector3<f64>, b: [f64; 2]) -> f64 {
        let left = self.left(y, b);
        if self.is_singular() {
            // The combination of the two equations in which the angle cancels.
            let (r1, r2) = (self.matrix.row(0), self.matrix.row(1));
            return if r1.norm() >= r2.norm() {
                left.y * r1.norm_squared() - left.x * r1.dot(&r2)
            } else {
                left.x * r2.norm_squared() - left.y * r1.dot(&r2)
            };
        }
        let m = &self.matrix;
        let turned = Vector2::new(m.m22 * left.x - m.m12 * left.y, m.m11 * left.y - m.m21 * left.x);
        turned.norm_squared() - self.determinant * self.determinant * self.flat(y).norm_squared()
    }

    /// The angles \[rad\] with these y and b: one, or two where the equations are singular.
    pub fn angles(&self, y: &Vector3<f64>, b: [f64; 2]) -> [Option<f64>; 2] {
        let (left, have) = (self.left(y, b), self.flat(y));
        if !self.is_singular() {
            let m = &self.matrix;
            let sign = self.determinant.signum();
            let want = Vector2::new(m.m22 * left.x - m.m12 * left.y, m.m11 * left.y - m.m21 * left.x) * sign;
            return [Some(have.perp(&want).atan2(have.dot(&want))), None];
        }
        let rows = [self.matrix.row(0).transpose(), self.matrix.row(1).transpose()];
        let i = usize::from(rows[1].norm() > rows[0].norm());
        let (reach, target) = (rows[i].norm() * have.norm(), left[i]);
        let bearing = have.perp(&rows[i]).atan2(have.dot(&rows[i]));
        let turn = 2.0 * (reach - target).max(0.0).sqrt().atan2((reach + target).max(0.0).sqrt());
        [Some(bearing + turn), Some(bearing - turn)]
    }
}
