//! Eigenvectors of a Hessenberg matrix for known eigenvalues, several at once (Golub and Van Loan, section 7.6.1).

use core::array::from_fn;

use super::hessenberg::Hessenberg;
use super::pencil::SIZE;
use super::vector::{largest, product};
use crate::lanes::{Lanes, Mask};
use crate::number::Number;

/// Number of iterations: solutions of `(H - x) y = b`. It is odd, because near a double eigenvalue with one eigenvector the inverse resembles that of a
/// perturbed Jordan block, whose square is close to the identity.
const ROUNDS: usize = 3;
/// Number of eigenvectors that are computed at once.
const WIDTH: usize = 4;

/// One value for each eigenvector.
type Several = Lanes<WIDTH>;
type Vectors = [Several; SIZE];

/// `H - x` after Gauss elimination of the subdiagonal with exchange of neighbouring rows.
struct Eliminated {
    /// The entries above the diagonal, by columns.
    columns: [Vectors; SIZE],
    /// Reciprocals of the diagonal.
    inverses: Vectors,
    /// Whether a row and the next one were exchanged.
    exchanged: [Mask<WIDTH>; SIZE],
    /// The multiple of the row that was subtracted from the next one.
    factors: Vectors,
}

impl Hessenberg {
    /// Eigenvectors of `A` for at most [`SIZE`] real eigenvalues, not normalised. Not finite only when the matrix is not.
    #[must_use]
    pub fn eigenvectors(&self, values: &[f64]) -> [[f64; SIZE]; SIZE] {
        let zero = [Lanes([0.0; WIDTH]); SIZE];
        let mut eliminated =
            Eliminated { columns: [zero; SIZE], inverses: zero, exchanged: [Mask::NONE; SIZE], factors: zero };
        let largest = largest(f64::MIN_POSITIVE, &self.matrix);
        let mut vectors = [[0.0; SIZE]; SIZE];
        for (values, vectors) in values.chunks(WIDTH).zip(vectors.chunks_mut(WIDTH)) {
            eliminated.take(self, largest, Lanes(from_fn(|lane| values[usize::min(lane, values.len() - 1)])));
            let y = self.turned_back(eliminated.iterated());
            for (lane, vector) in vectors.iter_mut().enumerate() {
                *vector = from_fn(|k| y[k].0[lane]);
            }
        }
        vectors
    }

    /// Replaces `y` by `Q y`.
    pub(super) fn turn_back(&self, y: &mut [f64; SIZE]) {
        for v in self.reflectors[..SIZE - 2].iter().rev() {
            let share = product(v, y);
            y.iter_mut().zip(v).for_each(|(entry, over)| *entry -= share * over);
        }
    }

    /// `Q y` for several vectors.
    #[inline(always)]
    fn turned_back(&self, mut y: Vectors) -> Vectors {
        for (column, v) in self.reflectors[..SIZE - 2].iter().enumerate().rev() {
            let mut share = Lanes([0.0; WIDTH]);
            for k in column + 1..SIZE {
                share = share + v[k] * y[k];
            }
            for k in column + 1..SIZE {
                y[k] = y[k] - share * v[k];
            }
        }
        y
    }
}

impl Eliminated {
    /// Eliminates; pivots have a lower bound relative to the largest entry.
    #[inline(always)]
    fn take(&mut self, form: &Hessenberg, largest: f64, x: Several) {
        let matrix = &form.matrix;
        let size = (0..SIZE).fold(Lanes::of(largest), |most, k| most.greater((matrix[k][k] - x).abs()));
        let least = size * f64::EPSILON;
        let mut upper: Vectors = matrix[0].map(Lanes::of);
        upper[0] = upper[0] - x;
        for k in 0..SIZE - 1 {
            let below = Lanes::of(matrix[k + 1][k]);
            let exchanged = below.abs().exceeds(upper[k].abs());
            let (pivot, other) = exchange(upper[k], below, exchanged);
            self.inverses[k] = inverse(pivot, least);
            let factor = other * self.inverses[k];
            for j in k + 1..SIZE {
                let below = if j == k + 1 { matrix[j][j] - x } else { Lanes::of(matrix[k + 1][j]) };
                let (pivot, other) = exchange(upper[j], below, exchanged);
                self.columns[j][k] = pivot;
                upper[j] = other - factor * pivot;
            }
            (self.exchanged[k], self.factors[k]) = (exchanged, factor);
        }
        self.inverses[SIZE - 1] = inverse(upper[SIZE - 1], least);
    }

    /// Inverse iteration.
    #[inline(always)]
    fn iterated(&self) -> Vectors {
        let mut y = [Lanes::of(1.0); SIZE];
        for round in 0..ROUNDS {
            if round > 0 {
                self.forward(&mut y);
            }
            self.backward(&mut y);
            let largest = y.iter().fold(Lanes::of(f64::MIN_POSITIVE), |most, entry| most.greater(entry.abs()));
            let inverse = 1.0 / largest;
            y.iter_mut().for_each(|entry| *entry = *entry * inverse);
        }
        y
    }

    #[inline(always)]
    fn forward(&self, y: &mut Vectors) {
        for k in 0..SIZE - 1 {
            let (upper, lower) = exchange(y[k], y[k + 1], self.exchanged[k]);
            (y[k], y[k + 1]) = (upper, lower - self.factors[k] * upper);
        }
    }

    #[inline(always)]
    fn backward(&self, y: &mut Vectors) {
        for k in (0..SIZE).rev() {
            y[k] = y[k] * self.inverses[k];
            for row in 0..k {
                y[row] = y[row] - y[k] * self.columns[k][row];
            }
        }
    }
}

/// Two numbers, exchanged in lanes where `is_so` is true.
#[inline(always)]
fn exchange(a: Several, b: Several, is_so: Mask<WIDTH>) -> (Several, Several) {
    let change = |lane: usize| (a.0[lane].to_bits() ^ b.0[lane].to_bits()) & is_so.0[lane];
    let changed = |number: Several| Lanes(from_fn(|lane| f64::from_bits(number.0[lane].to_bits() ^ change(lane))));
    (changed(a), changed(b))
}

/// The reciprocal of a pivot.
#[inline(always)]
fn inverse(pivot: Several, least: Several) -> Several {
    1.0 / least.or(pivot, least.exceeds(pivot.abs()))
}
