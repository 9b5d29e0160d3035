//! The reduction of a matrix to Hessenberg form by Householder reflections (Golub and Van Loan, Algorithm 7.4.2).

/// `A = Q H Q^T` with `H` zero below its first subdiagonal and `Q` orthogonal.
#[derive(Clone, Debug)]
pub struct Hessenberg<const N: usize> {
    /// `H`, by rows.
    pub(super) matrix: [[f64; N]; N],
    /// `Q = P_0 P_1 ...` with `P_k = 1 - v v^T`: row `k` is `v`, of length `sqrt(2)`, or zero where nothing was to be done.
    reflectors: [[f64; N]; N],
}

impl<const N: usize> Hessenberg<N> {
    /// Reduces the matrix with these rows.
    pub fn reduce(matrix: [[f64; N]; N]) -> Self {
        let mut form = Hessenberg { matrix, reflectors: [[0.0; N]; N] };
        for column in 0..N.saturating_sub(2) {
            if let Some(reflector) = form.reflector(column) {
                form.from_left(&reflector, column);
                form.from_right(&reflector, column);
                form.reflectors[column] = reflector;
            }
        }
        form
    }

    /// `H`, by rows.
    pub fn matrix(&self) -> &[[f64; N]; N] {
        &self.matrix
    }

    /// `Q y`.
    pub fn turned_back(&self, y: &[f64; N]) -> [f64; N] {
        let mut x = *y;
        for v in self.reflectors[..N.saturating_sub(2)].iter().rev() {
            let share = dot(v, &x);
            for (entry, coordinate) in x.iter_mut().zip(v) {
                *entry -= share * coordinate;
            }
        }
        x
    }

    /// The vector `v`, of length `sqrt(2)`, whose reflection makes zeros of what stands below the subdiagonal in `column`.
    fn reflector(&self, column: usize) -> Option<[f64; N]> {
        let mut v = [0.0; N];
        for (entry, row) in v.iter_mut().zip(&self.matrix).skip(column + 1) {
            *entry = row[column];
        }
        let below = dot(&v, &v) - v[column + 1] * v[column + 1];
        if below <= 0.0 {
            return None;
        }
        let length = dot(&v, &v).sqrt();
        v[column + 1] += length.copysign(v[column + 1]);
        let scale = (2.0 / dot(&v, &v)).sqrt();
        v.iter_mut().for_each(|entry| *entry *= scale);
        scale.is_finite().then_some(v)
    }

    /// `H := P H`; rows from `column + 1` on change.
    fn from_left(&mut self, v: &[f64; N], column: usize) {
        let mut sum = [0.0; N];
        for (share, row) in v.iter().zip(&self.matrix).skip(column + 1) {
            for (entry, value) in sum.iter_mut().zip(row) {
                *entry += share * value;
            }
        }
        for (share, row) in v.iter().zip(&mut self.matrix).skip(column + 1) {
            for (entry, value) in row.iter_mut().zip(&sum) {
                *entry -= share * value;
            }
        }
        self.matrix.iter_mut().skip(column + 2).for_each(|row| row[column] = 0.0);
    }

    /// `H := H P`; columns from `column + 1` on change.
    fn from_right(&mut self, v: &[f64; N], column: usize) {
        debug_assert!(v[..=column].iter().all(|entry| *entry == 0.0));
        for row in &mut self.matrix {
            let share = dot(row, v);
            for (entry, coordinate) in row.iter_mut().zip(v) {
                *entry -= share * coordinate;
            }
        }
    }
}

/// The scalar product, in four partial sums that do not wait for one another.
pub(super) fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut sums = [0.0; 4];
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a.zip(b) {
        for lane in 0..4 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
