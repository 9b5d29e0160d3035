//! Linear least squares with covariance. Main type: [`Fit`].

use nalgebra::{DMatrix, DVector};

use crate::{Error, ErrorKind, Result};

/// Threshold for an undetermined parameter: least singular value relative to the greatest.
const UNDETERMINED: f64 = 1e-10;
/// Maximum number of iterations for the singular values. Usually about three times their number are needed.
const ITERATIONS: usize = 100_000;

/// Result of linear least squares.
pub(super) struct Fit {
    pub(super) values: DVector<f64>,
    /// The standard deviations for a residual deviation of one.
    pub(super) spread: DVector<f64>,
    /// The triangular factor of the matrix.
    pub(super) root: DMatrix<f64>,
    /// The leverage of each row. Their sum is the number of unknowns.
    pub(super) leverage: Vec<f64>,
    /// The condition number of the matrix with its columns scaled to equal length.
    pub(super) condition: f64,
}

impl Fit {
    /// Solves `matrix * values = right` in the least-squares sense. `name` returns the name of an unknown.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for an unknown that the rows do not determine, with its name.
    pub(super) fn of(matrix: &DMatrix<f64>, right: &DVector<f64>, name: impl Fn(usize) -> String) -> Result<Self> {
        // Columns of equal length give the best condition.
        let sizes = DVector::from_iterator(matrix.ncols(), matrix.column_iter().map(|column| column.norm()));
        let blind = |unknown: usize| {
            let text = format!(
                "the log does not determine `{}`; record a motion of more joints at higher velocities",
                name(unknown)
            );
            Error::new(ErrorKind::BadValue, text)
        };
        if let Some(unknown) = sizes.iter().position(|size| *size <= 1e-12 * sizes.amax()) {
            return Err(blind(unknown));
        }
        let mut scaled = matrix.clone();
        scaled.column_iter_mut().zip(sizes.iter()).for_each(|(mut column, size)| column /= *size);
        // The triangular factor of a QR decomposition is smaller and has the same singular values.
        let factors = scaled.qr();
        let (orthogonal, triangle) = (factors.q(), factors.r());
        let reduced = orthogonal.transpose() * right;
        let turned = triangle.clone().try_svd(true, true, 5.0 * f64::EPSILON, ITERATIONS);
        let unsolved = || Error::new(ErrorKind::BadValue, "the singular values of the log do not converge");
        let turned = turned.ok_or_else(unsolved)?;
        let (values, turn) = (&turned.singular_values, turned.v_t.as_ref().ok_or_else(unsolved)?);
        let (least, greatest) = (values.imin(), values.max());
        if values[least] <= UNDETERMINED * greatest {
            return Err(blind(turn.row(least).iamax_full().1));
        }
        let found = turned.solve(&reduced, 0.0).map_err(|text| Error::new(ErrorKind::BadValue, text))?;
        let spread = |unknown: usize| {
            let parts = values.iter().enumerate().map(|(at, value)| (turn[(at, unknown)] / value).powi(2));
            parts.sum::<f64>().sqrt() / sizes[unknown]
        };
        let mut root = triangle;
        root.column_iter_mut().zip(sizes.iter()).for_each(|(mut column, size)| column *= *size);
        Ok(Fit {
            values: found.component_div(&sizes),
            spread: DVector::from_fn(matrix.ncols(), |unknown, _| spread(unknown)),
            root,
            leverage: orthogonal.row_iter().map(|row| row.norm_squared()).collect(),
            condition: greatest / values[least],
        })
    }
}
