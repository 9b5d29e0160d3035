//! All eigenvalues of a Hessenberg matrix by implicit double-shift QR steps (Golub and Van Loan, Algorithms 7.5.1 and 7.5.2). Only eigenvalues are computed, so
//! rows and columns outside the active block are not updated.
//!
//! J. G. F. Francis, The QR transformation, Computer Journal 4 (1961/62) 265-271 and 332-345.

use core::array::from_fn;

use super::hessenberg::Hessenberg;
use super::pencil::{Matrix, SIZE};
use crate::arithmetic::Arithmetic;
use crate::tolerances::ROOTS;

/// Maximal number of QR steps for one deflation; every tenth has an exceptional shift.
const MAX_STEPS: usize = 60;

/// An eigenvalue of a real matrix.
#[derive(Clone, Copy, Debug)]
pub struct Eigenvalue {
    /// Its real part.
    pub re: f64,
    /// Its imaginary part; exactly zero when it is real.
    pub im: f64,
}

/// The active block: rows and columns `low..=high`.
struct Window<'a> {
    h: &'a mut Matrix,
    low: usize,
    high: usize,
}

impl Eigenvalue {
    /// The imaginary part relative to `1 + |x|^2`: for the tangent of half an angle, half the distance of that angle from the real line.
    pub(super) fn depth(&self) -> f64 {
        self.im.abs() / (1.0 + self.re * self.re + self.im * self.im)
    }
}

impl Hessenberg {
    /// All eigenvalues, complex ones in conjugate pairs. `None` when an entry is not finite or the iteration does not converge, which is not known to happen.
    #[must_use]
    pub fn eigenvalues(&self) -> Option<[Eigenvalue; SIZE]> {
        let mut h = self.matrix;
        let mut found = [Eigenvalue { re: 0.0, im: 0.0 }; SIZE];
        let (mut left, mut steps) = (SIZE, 0);
        while left > 0 {
            let low = start_of_block(&mut h, left - 1);
            match left - low {
                1 => found[low].re = h[low][low],
                2 => (found[low], found[low + 1]) = pair(&h, low),
                _ => {
                    steps += 1;
                    if steps > MAX_STEPS {
                        return None;
                    }
                    Window { h: &mut h, low, high: left - 1 }.step(steps % 10 == 0);
                    continue;
                }
            }
            (left, steps) = (low, 0);
        }
        found.iter().all(|value| value.re.is_finite() && value.im.is_finite()).then_some(found)
    }
}

/// The first row of the irreducible block that ends at row `high`; a negligible subdiagonal entry is set to zero.
#[inline(always)]
fn start_of_block(h: &mut Matrix, high: usize) -> usize {
    for row in (1..=high).rev() {
        let entry = h[row][row - 1].abs();
        let size = h[row][row].abs() + h[row - 1][row - 1].abs();
        if entry <= f64::EPSILON * size || entry < f64::MIN_POSITIVE {
            h[row][row - 1] = 0.0;
            return row;
        }
    }
    0
}

/// The eigenvalues of the 2x2 block whose first row is `low`, without cancellation.
fn pair(h: &Matrix, low: usize) -> (Eigenvalue, Eigenvalue) {
    let (a, b, c, d) = (h[low][low], h[low][low + 1], h[low + 1][low], h[low + 1][low + 1]);
    let half = 0.5 * (a - d);
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let (re, im) = (0.5 * (a + d), Arithmetic::sqrt(-discriminant));
        return (Eigenvalue { re, im }, Eigenvalue { re, im: -im });
    }
    let sum = half + Arithmetic::sqrt(discriminant).copysign(half);
    let first = d + sum;
    let second = if sum == 0.0 { d } else { d - b * c / sum };
    (Eigenvalue { re: first, im: 0.0 }, Eigenvalue { re: second, im: 0.0 })
}

impl Window<'_> {
    /// One double step: the bulge that the shifts create at the top is chased to the bottom.
    #[inline(always)]
    fn step(&mut self, is_exceptional: bool) {
        let mut column = self.first_column(self.shifts(is_exceptional));
        for top in self.low..self.high - 1 {
            if top > self.low {
                column = [0, 1, 2].map(|below| self.h[top + below][top - 1]);
            }
            self.reflect(top, column);
        }
        let top = self.high - 1;
        let column = [self.h[top][top - 1], self.h[top + 1][top - 1]];
        self.reflect(top, column);
    }

    /// The sum and the product of the shifts. These are the eigenvalues of the last 2x2 block, or numbers of the magnitude of the last subdiagonal entries.
    fn shifts(&self, is_exceptional: bool) -> [f64; 2] {
        let (h, m) = (&self.h, self.high);
        if is_exceptional {
            let size = h[m][m - 1].abs() + h[m - 1][m - 2].abs();
            let centre = h[m][m] + 0.75 * size;
            return [2.0 * centre, centre * centre + 0.4375 * size * size];
        }
        [h[m - 1][m - 1] + h[m][m], h[m - 1][m - 1] * h[m][m] - h[m - 1][m] * h[m][m - 1]]
    }

    /// The non-zero entries of the first column of `(H - a)(H - b)` for the two shifts, from their sum and product.
    fn first_column(&self, [sum, product]: [f64; 2]) -> [f64; 3] {
        let (h, i) = (&self.h, self.low);
        let x = h[i][i] * (h[i][i] - sum) + product + h[i][i + 1] * h[i + 1][i];
        let y = h[i + 1][i] * (h[i][i] + h[i + 1][i + 1] - sum);
        [x, y, h[i + 1][i] * h[i + 2][i + 1]]
    }

    /// Reflects rows and columns `top..top + N` so that `column`, which is left of them, becomes a multiple of its first unit vector. The reflection is `1 - u
    /// w^T`, where the first entry of `u` is one, and `w` is a multiple of `u`.
    #[inline(always)]
    fn reflect<const N: usize>(&mut self, top: usize, column: [f64; N]) {
        let square = column.iter().map(|entry| entry * entry).sum::<f64>();
        let length = Arithmetic::sqrt(square).copysign(column[0]);
        if square >= ROOTS.zero {
            let (head, share) = (column[0] + length, 1.0 + column[0] / length);
            let u: [f64; N] = from_fn(|k| if k == 0 { 1.0 } else { column[k] / head });
            let w = u.map(|entry| entry * share);
            self.reflect_rows(top, &u, &w);
            self.reflect_columns(top, &u, &w);
        }
        if top > self.low {
            self.h[top][top - 1] = -length;
            (1..N).for_each(|below| self.h[top + below][top - 1] = 0.0);
        }
    }

    /// Reflects columns in groups of four. Columns after the block may change freely, and those before `top` are overwritten.
    #[inline(always)]
    fn reflect_rows<const N: usize>(&mut self, top: usize, u: &[f64; N], w: &[f64; N]) {
        let Some(rows) = self.h[top..].first_chunk_mut::<N>() else { return };
        for group in top / 4..=self.high / 4 {
            let group = 4 * usize::min(group, SIZE / 4 - 1);
            let shares: [f64; 4] = from_fn(|lane| (0..N).map(|k| w[k] * rows[k][group + lane]).sum());
            for (row, factor) in rows.iter_mut().zip(u) {
                (0..4).for_each(|lane| row[group + lane] -= shares[lane] * factor);
            }
        }
    }

    #[inline(always)]
    fn reflect_columns<const N: usize>(&mut self, top: usize, u: &[f64; N], w: &[f64; N]) {
        let last = usize::min(top + 3, self.high);
        for row in &mut self.h[self.low..=last] {
            let Some(entries) = row[top..].first_chunk_mut::<N>() else { return };
            let share: f64 = (0..N).map(|k| w[k] * entries[k]).sum();
            (0..N).for_each(|k| entries[k] -= share * u[k]);
        }
    }
}
