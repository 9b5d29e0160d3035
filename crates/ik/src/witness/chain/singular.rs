//! Small singular values and null vectors of small matrices.

use crate::tolerances::WITNESS;
use nalgebra::{DMatrix, DVector, SVD};

/// The maximum number of sweeps over all pairs of columns; usually few are sufficient.
const SWEEPS: usize = 30;

/// The smallest singular value; zero for a matrix with more columns than rows.
///
/// One-sided Jacobi rotations (Hestenes 1958), which keep small singular values accurate.
pub(in crate::witness) fn smallest_singular_value(mut a: DMatrix<f64>) -> f64 {
    let columns = a.ncols();
    if a.nrows() < columns || !a.iter().all(|entry| entry.is_finite()) {
        return 0.0;
    }
    for _ in 0..SWEEPS {
        let mut turned = false;
        for i in 0..columns {
            for j in i + 1..columns {
                turned |= rotate(&mut a, i, j);
            }
        }
        if !turned {
            break;
        }
    }
    a.column_iter().map(|column| column.norm()).fold(f64::INFINITY, f64::min)
}

/// Makes two columns orthogonal. Returns whether they were changed.
fn rotate(a: &mut DMatrix<f64>, i: usize, j: usize) -> bool {
    let (x, y) = (a.column(i).norm_squared(), a.column(j).norm_squared());
    let product = a.column(i).dot(&a.column(j));
    if product == 0.0 || product.abs() <= WITNESS.zero * (x * y).sqrt() {
        return false;
    }
    let (sine, cosine) = (0.5 * (2.0 * product).atan2(x - y)).sin_cos();
    for row in 0..a.nrows() {
        let (x, y) = (a[(row, i)], a[(row, j)]);
        (a[(row, i)], a[(row, j)]) = (x * cosine + y * sine, y * cosine - x * sine);
    }
    true
}

/// The unit vector with the smallest image under a matrix.
pub(super) fn null_vector(a: DMatrix<f64>) -> Option<DVector<f64>> {
    let columns = a.ncols();
    let rows = a.nrows().max(columns);
    let svd = SVD::try_new(a.resize(rows, columns, 0.0), false, true, f64::EPSILON, 200)?;
    let least = svd.singular_values.imin();
    Some(svd.v_t?.row(least).transpose())
}

/// The least-squares solution of `a x = b`. Singular values below `rank` times the largest count as zero.
pub(super) fn least_squares(a: DMatrix<f64>, b: &DVector<f64>, rank: f64) -> Option<DVector<f64>> {
    let svd = SVD::try_new(a, true, true, f64::EPSILON, 200)?;
    let cut = rank * svd.singular_values.max();
    svd.solve(b, cut).ok()
}
