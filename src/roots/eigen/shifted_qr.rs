//! All eigenvalues of a Hessenberg matrix by implicit double-shift QR steps (Golub and Van Loan, Algorithms 7.5.1 and 7.5.2), the
//! eigenvalues only: rows and columns outside the block that is being reduced are left alone.

use super::{Eigenvalue, Hessenberg};

/// QR steps for one deflation; every tenth has an exceptional shift.
pub(super) const MAX_STEPS: usize = 60;

/// The block that is being reduced: rows and columns `low..=high`.
struct Window<'a, const N: usize> {
    h: &'a mut [[f64; N]; N],
    low: usize,
    high: usize,
}

/// The first column of `(H - a)(H - b)` for the two shifts, as far as it is not zero, from the sum and product of the shifts.
struct Shifts {
    sum: f64,
    product: f64,
}

impl<const N: usize> Hessenberg<N> {
    /// All eigenvalues, complex ones in conjugate pairs; `None` when an entry is not finite or the iteration does not end, which is
    /// not known to happen.
    pub fn eigenvalues(&self) -> Option<[Eigenvalue; N]> {
        let mut h = self.matrix;
        let mut found = [Eigenvalue::default(); N];
        let (mut left, mut steps) = (N, 0);
        while left > 0 {
            let low = start_of_block(&mut h, left - 1)?;
            match left - low {
                1 => found[low] = Eigenvalue { re: h[low][low], im: 0.0 },
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

/// The first row of the lowest block that does not fall apart, which ends at row `high`; negligible subdiagonal entries become zero.
fn start_of_block<const N: usize>(h: &mut [[f64; N]; N], high: usize) -> Option<usize> {
    for row in (1..=high).rev() {
        let entry = h[row][row - 1].abs();
        let size = h[row][row].abs() + h[row - 1][row - 1].abs();
        if !entry.is_finite() || !size.is_finite() {
            return None;
        }
        if entry <= f64::EPSILON * size || entry < f64::MIN_POSITIVE {
            h[row][row - 1] = 0.0;
            return Some(row);
        }
    }
    Some(0)
}

/// The eigenvalues of the 2x2 block whose first row is `low`, without cancellation.
fn pair<const N: usize>(h: &[[f64; N]; N], low: usize) -> (Eigenvalue, Eigenvalue) {
    let (a, b, c, d) = (h[low][low], h[low][low + 1], h[low + 1][low], h[low + 1][low + 1]);
    let half = 0.5 * (a - d);
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let (re, im) = (0.5 * (a + d), (-discriminant).sqrt());
        return (Eigenvalue { re, im }, Eigenvalue { re, im: -im });
    }
    let way = half + discriminant.sqrt().copysign(half);
    let first = d + way;
    let second = if way == 0.0 { d } else { d - b * c / way };
    (Eigenvalue { re: first, im: 0.0 }, Eigenvalue { re: second, im: 0.0 })
}

impl<const N: usize> Window<'_, N> {
    /// One double step: the bulge that the shifts make at the top is chased out at the bottom.
    fn step(&mut self, is_exceptional: bool) {
        let mut column = self.first_column(&self.shifts(is_exceptional));
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

    /// The eigenvalues of the last 2x2 block are the shifts, or numbers of the size of the last subdiagonal entries.
    fn shifts(&self, is_exceptional: bool) -> Shifts {
        let (h, m) = (&self.h, self.high);
        if is_exceptional {
            let size = h[m][m - 1].abs() + h[m - 1][m - 2].abs();
            let centre = h[m][m] + 0.75 * size;
            return Shifts { sum: 2.0 * centre, product: centre * centre + 0.4375 * size * size };
        }
        let sum = h[m - 1][m - 1] + h[m][m];
        Shifts { sum, product: h[m - 1][m - 1] * h[m][m] - h[m - 1][m] * h[m][m - 1] }
    }

    fn first_column(&self, shifts: &Shifts) -> [f64; 3] {
        let (h, i) = (&self.h, self.low);
        let x = h[i][i] * (h[i][i] - shifts.sum) + shifts.product + h[i][i + 1] * h[i + 1][i];
        let y = h[i + 1][i] * (h[i][i] + h[i + 1][i + 1] - shifts.sum);
        [x, y, h[i + 1][i] * h[i + 2][i + 1]]
    }

    /// Reflects rows and columns `top..top + SIZE` so that `column`, which stands left of them, becomes a multiple of its first unit
    /// vector: with `1 - u w^T`.
    fn reflect<const SIZE: usize>(&mut self, top: usize, column: [f64; SIZE]) {
        let largest = column.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        if largest == 0.0 {
            return;
        }
        let scaled = column.map(|entry| entry / largest);
        let length = scaled.iter().map(|entry| entry * entry).sum::<f64>().sqrt().copysign(scaled[0]);
        let head = scaled[0] + length;
        let u = std::array::from_fn::<f64, SIZE, _>(|k| if k == 0 { 1.0 } else { scaled[k] / head });
        let w = u.map(|entry| entry * head / length);
        if top > self.low {
            self.h[top][top - 1] = -length * largest;
            (1..SIZE).for_each(|below| self.h[top + below][top - 1] = 0.0);
        }
        self.reflect_rows(top, &u, &w);
        self.reflect_columns(top, &u, &w);
    }

    fn reflect_rows<const SIZE: usize>(&mut self, top: usize, u: &[f64; SIZE], w: &[f64; SIZE]) {
        let rows = &mut self.h[top..top + SIZE];
        (top..=self.high).for_each(|column| {
            let share: f64 = (0..SIZE).map(|k| w[k] * rows[k][column]).sum();
            (0..SIZE).for_each(|k| rows[k][column] -= share * u[k]);
        });
    }

    fn reflect_columns<const SIZE: usize>(&mut self, top: usize, u: &[f64; SIZE], w: &[f64; SIZE]) {
        let last = (top + 3).min(self.high);
        for row in &mut self.h[self.low..=last] {
            let entries = &mut row[top..top + SIZE];
            let share: f64 = (0..SIZE).map(|k| w[k] * entries[k]).sum();
            (0..SIZE).for_each(|k| entries[k] -= share * u[k]);
        }
    }
}
