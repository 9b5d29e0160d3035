//! Dense linear equations of fixed size by Gauss elimination with partial pivoting (Golub and Van Loan, Algorithm 3.4.1).

use super::vector::largest;

/// Eliminates a column from a row with a pivot row whose entry there is one.
#[inline(always)]
pub(super) fn clear<const N: usize>(row: &mut [f64; N], pivot: &[f64; N], column: usize) {
    let factor = row[column];
    row.iter_mut().zip(pivot).for_each(|(entry, over)| *entry -= factor * over);
    row[column] = 0.0;
}

/// Solves `L X = R` in place: `rows` has the `N` columns of `L`, then those of `R`. `R` becomes `X`, and `L` is destroyed. Returns the smallest pivot relative
/// to the largest entry of `L`. It is zero when `L` is singular or not finite; `R` is then undefined. `N` and `W` are even.
#[inline(always)]
pub(super) fn solve<const N: usize, const W: usize>(rows: &mut [[f64; W]; N]) -> f64 {
    let largest = largest(0.0, &rows.each_ref().map(|row| *row.first_chunk::<N>().unwrap_or(&[0.0; N])));
    let (mut least, mut inverses) = (largest, [0.0; N]);
    for k in 0..N {
        let mut best = k;
        for row in k + 1..N {
            best = if rows[row][k].abs() > rows[best][k].abs() { row } else { best };
        }
        let size = rows[best][k].abs();
        if size <= 0.0 || !size.is_finite() {
            return 0.0;
        }
        least = f64::min(least, size);
        rows.swap(k, best);
        inverses[k] = 1.0 / rows[k][k];
        let (above, below) = rows.split_at_mut(k + 1);
        below.iter_mut().for_each(|row| subtract(row, row[k] * inverses[k], &above[k], k.div_ceil(2)));
    }
    for k in (0..N).rev() {
        let (above, below) = rows.split_at_mut(k);
        below[0][N..].iter_mut().for_each(|entry| *entry *= inverses[k]);
        above.iter_mut().for_each(|row| subtract(row, row[k], &below[0], N / 2));
    }
    least / largest
}

/// Subtracts a multiple of another row, without the first pairs of columns.
#[inline(always)]
fn subtract<const W: usize>(row: &mut [f64; W], factor: f64, over: &[f64; W], first: usize) {
    let (pairs, over) = (row.as_chunks_mut::<2>().0, over.as_chunks::<2>().0);
    for (pair, over) in pairs[first..].iter_mut().zip(&over[first..]) {
        *pair = [pair[0] - factor * over[0], pair[1] - factor * over[1]];
    }
}
