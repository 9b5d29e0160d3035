//! Eigenvectors of a Hessenberg matrix for known eigenvalues (Golub and Van Loan, section 7.6.1).

use super::Hessenberg;

/// Solutions of `(H - x) y = b`, each from the one before. Their number is odd: next to a double eigenvalue with one eigenvector the
/// inverse is like that of a Jordan block that rounding has disturbed, whose square is like the identity.
pub(super) const ROUNDS: usize = 3;

impl<const N: usize> Hessenberg<N> {
    /// An eigenvector of `A`, of length one, for the real eigenvalue `x`, by inverse iteration; not finite only when the matrix is not.
    pub fn eigenvector(&self, x: f64) -> [f64; N] {
        let mut h = self.matrix;
        (0..N).for_each(|k| h[k][k] -= x);
        let size = h.iter().flatten().fold(f64::MIN_POSITIVE, |most: f64, entry| most.max(entry.abs()));
        let multipliers = eliminate(&mut h, f64::EPSILON * size);
        let mut y = [1.0; N];
        for round in 0..ROUNDS {
            if round > 0 {
                forward(&multipliers, &mut y);
            }
            backward(&h, &mut y);
            normalise(&mut y);
        }
        self.turned_back(&y)
    }
}

/// What eliminating a subdiagonal entry did: whether the two rows were exchanged, and what multiple was subtracted.
type Multipliers<const N: usize> = [(bool, f64); N];

/// Gauss elimination of the subdiagonal with exchange of neighbouring rows; pivots are at least `least`.
fn eliminate<const N: usize>(h: &mut [[f64; N]; N], least: f64) -> Multipliers<N> {
    let mut done = [(false, 0.0); N];
    for k in 0..N - 1 {
        let exchanged = h[k + 1][k].abs() > h[k][k].abs();
        if exchanged {
            h.swap(k, k + 1);
        }
        if h[k][k].abs() < least {
            h[k][k] = least;
        }
        let factor = h[k + 1][k] / h[k][k];
        let (above, below) = h.split_at_mut(k + 1);
        for (entry, over) in below[0][k..].iter_mut().zip(&above[k][k..]) {
            *entry -= factor * over;
        }
        done[k] = (exchanged, factor);
    }
    if h[N - 1][N - 1].abs() < least {
        h[N - 1][N - 1] = least;
    }
    done
}

fn forward<const N: usize>(multipliers: &Multipliers<N>, y: &mut [f64; N]) {
    for k in 0..N - 1 {
        let (exchanged, factor) = multipliers[k];
        if exchanged {
            y.swap(k, k + 1);
        }
        y[k + 1] -= factor * y[k];
    }
}

fn backward<const N: usize>(h: &[[f64; N]; N], y: &mut [f64; N]) {
    for k in (0..N).rev() {
        y[k] /= h[k][k];
        for row in 0..k {
            y[row] -= y[k] * h[row][k];
        }
    }
}

fn normalise<const N: usize>(y: &mut [f64; N]) {
    let largest = y.iter().fold(f64::MIN_POSITIVE, |most: f64, entry| most.max(entry.abs()));
    y.iter_mut().for_each(|entry| *entry /= largest);
    let length = y.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    y.iter_mut().for_each(|entry| *entry /= length);
}
