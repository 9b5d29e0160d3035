//! The reduction of a matrix to Hessenberg form by Householder reflections (Golub and Van Loan, Algorithm 7.4.2).

use core::array::from_fn;

use super::pencil::{Matrix, SIZE};
use crate::arithmetic::Arithmetic;

/// `A = Q H Q^T` with `H` zero below its first subdiagonal and `Q` orthogonal.
#[derive(Clone, Debug)]
pub struct Hessenberg {
    /// `H`, by rows.
    pub matrix: Matrix,
    /// `Q = P_0 P_1 ...` with `P_k = 1 - v v^T`: row `k` is `v`, of length `sqrt(2)`, or zero where no reflection is needed.
    pub reflectors: Matrix,
}

impl Hessenberg {
    /// Reduces the matrix with these rows.
    #[inline(always)]
    #[must_use]
    pub fn reduce(matrix: Matrix) -> Self {
        let mut form = Hessenberg { matrix, reflectors: [[0.0; SIZE]; SIZE] };
        for column in 0..SIZE - 2 {
            if let Some(reflector) = form.reflector(column) {
                form.reflect(&reflector, column);
                form.reflectors[column] = reflector;
            }
        }
        form
    }

    /// The vector `v`, of length `sqrt(2)`, whose reflection eliminates the entries below the subdiagonal in `column`.
    #[inline(always)]
    fn reflector(&self, column: usize) -> Option<[f64; SIZE]> {
        let mut v = [0.0; SIZE];
        for (entry, row) in v.iter_mut().zip(&self.matrix).skip(column + 1) {
            *entry = row[column];
        }
        let square = dot(&v, &v, 0);
        if square - v[column + 1] * v[column + 1] <= 0.0 {
            return None;
        }
        v[column + 1] += Arithmetic::sqrt(square).copysign(v[column + 1]);
        let scale = Arithmetic::sqrt(2.0 / dot(&v, &v, 0));
        v.iter_mut().for_each(|entry| *entry *= scale);
        scale.is_finite().then_some(v)
    }

    /// `H := P H P`: from the left on rows, and from the right on columns after `column`. The left product acts on groups of four columns, and the first group
    /// begins at `column` or before. There only `column` itself changes, because all columns before it are zero.
    #[inline(always)]
    fn reflect(&mut self, v: &[f64; SIZE], column: usize) {
        let (first, behind) = (column / 4, (column + 1) / 4);
        let mut sum = [0.0; SIZE];
        for (group, sum) in sum.as_chunks_mut::<4>().0.iter_mut().enumerate().skip(first) {
            for (share, row) in v.iter().zip(&self.matrix).skip(column + 1) {
                let row = &row.as_chunks::<4>().0[group];
                *sum = from_fn(|k| sum[k] + share * row[k]);
            }
        }
        for (share, row) in v.iter().zip(&mut self.matrix) {
            if *share != 0.0 {
                subtract(row, *share, &sum, first);
            }
            let across = dot(row, v, behind);
            subtract(row, across, v, behind);
        }
        self.matrix.iter_mut().skip(column + 2).for_each(|row| row[column] = 0.0);
    }
}

/// Subtracts a multiple of another row, without the first groups of columns.
#[inline(always)]
fn subtract(row: &mut [f64; SIZE], factor: f64, over: &[f64; SIZE], first: usize) {
    let (groups, over) = (row.as_chunks_mut::<4>().0, over.as_chunks::<4>().0);
    for (group, over) in groups[first..].iter_mut().zip(&over[first..]) {
        *group = from_fn(|k| group[k] - factor * over[k]);
    }
}

/// The scalar product without the first groups of four, in four independent partial sums.
#[inline(always)]
fn dot(a: &[f64; SIZE], b: &[f64; SIZE], first: usize) -> f64 {
    let groups = a.as_chunks::<4>().0[first..].iter().zip(&b.as_chunks::<4>().0[first..]);
    let sums = groups.fold([0.0; 4], |sums: [f64; 4], (a, b)| from_fn(|k| sums[k] + a[k] * b[k]));
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}
