//! Elimination of `n - 1` linear equations in `n` unknowns: the null vector and least solutions ([`Elimination`]).

use super::arm::{MOST_JOINTS, Q};
use crate::arithmetic::Arithmetic;

/// Maximal number of equations.
pub(super) const MOST_ROWS: usize = MOST_JOINTS - 1;

/// One number for each equation. Entries beyond the number of equations are not read.
pub(super) type Rows = [f64; MOST_ROWS];

/// Factors of a matrix by columns, `L U = J P`, with columns exchanged so that each pivot is the largest of its row.
#[derive(Clone, Copy)]
pub(super) struct Elimination {
    /// The number of pivots; there is one more unknown.
    rank: usize,
    /// `U`. Column `j` is that of unknown `order[j]`. Entries below the diagonal are 0, so that loops run over all rows.
    columns: [Rows; MOST_JOINTS],
    /// `L` without its diagonal, by columns.
    lower: [Rows; MOST_ROWS],
    /// The reciprocals of the pivots; 0 for a pivot of 0.
    inverses: Rows,
    order: [usize; MOST_JOINTS],
    /// Row `k` is that of equation `rows[k]`.
    rows: [usize; MOST_ROWS],
    /// The null vector of length one, oriented such that the matrix with this vector as last row has a positive determinant. It is continuous along a curve of
    /// regular points.
    pub tangent: Q,
    /// The square root of `det(J J^T)`.
    pub volume: f64,
    /// The least magnitude of a pivot relative to the largest.
    pub pivot: f64,
}

impl Elimination {
    /// Factors the matrix with `rank + 1` columns and as many rows as `rank`.
    pub fn of(columns: &[Rows; MOST_JOINTS], rank: usize) -> Elimination {
        // The compiler unrolls the loops of the most frequent case.
        if rank == MOST_ROWS { Elimination::factors(columns, MOST_ROWS) } else { Elimination::factors(columns, rank) }
    }

    #[inline(always)]
    fn factors(columns: &[Rows; MOST_JOINTS], rank: usize) -> Elimination {
        let mut done = Elimination::start(columns, rank);
        let mut sign = 1.0;
        for k in 0..rank {
            let mut best = k;
            for j in k + 1..=rank {
                if done.columns[j][k].abs() > done.columns[best][k].abs() {
                    best = j;
                }
            }
            if best != k {
                done.exchange(k, best);
                sign = -sign;
            }
            done.eliminate(k, rank, rank);
        }
        done.orient(sign, rank);
        done
    }

    /// Factors a matrix of `rank + 2` columns and `rank + 1` rows without one of its columns. The remaining rows are dependent, and one of them is left out.
    pub fn without(columns: &[Rows; MOST_JOINTS], rank: usize, left_out: usize) -> Elimination {
        let mut done = Elimination::start(columns, rank);
        done.exchange(left_out, rank + 1);
        let mut sign = 1.0;
        for k in 0..rank {
            let mut best = [k, k];
            for j in k..=rank {
                for r in k..=rank {
                    if done.columns[j][r].abs() > done.columns[best[0]][best[1]].abs() {
                        best = [j, r];
                    }
                }
            }
            if best[0] != k {
                done.exchange(k, best[0]);
                sign = -sign;
            }
            if best[1] != k {
                done.rows.swap(k, best[1]);
                for column in &mut done.columns {
                    column.swap(k, best[1]);
                }
                for column in &mut done.lower {
                    column.swap(k, best[1]);
                }
                sign = -sign;
            }
            done.eliminate(k, rank + 1, rank);
        }
        done.orient(sign, rank);
        done
    }

    #[inline(always)]
    fn start(columns: &[Rows; MOST_JOINTS], rank: usize) -> Elimination {
        Elimination {
            rank,
            columns: *columns,
            lower: [[0.0; MOST_ROWS]; MOST_ROWS],
            inverses: [0.0; MOST_ROWS],
            order: [0, 1, 2, 3, 4, 5, 6],
            rows: [0, 1, 2, 3, 4, 5],
            tangent: [0.0; MOST_JOINTS],
            volume: 0.0,
            pivot: 0.0,
        }
    }

    #[inline(always)]
    fn exchange(&mut self, k: usize, j: usize) {
        self.columns.swap(k, j);
        self.order.swap(k, j);
    }

    /// Subtracts row `k` from those below it.
    #[inline(always)]
    fn eliminate(&mut self, k: usize, rows: usize, rank: usize) {
        let pivot = self.columns[k][k];
        let inverse = if pivot == 0.0 { 0.0 } else { 1.0 / pivot };
        let mut multipliers = [0.0; MOST_ROWS];
        for r in k + 1..rows {
            multipliers[r] = self.columns[k][r] * inverse;
            self.columns[k][r] = 0.0;
        }
        for j in k + 1..=rank {
            let upper = self.columns[j][k];
            for r in 0..MOST_ROWS {
                self.columns[j][r] -= multipliers[r] * upper;
            }
        }
        self.lower[k] = multipliers;
        self.inverses[k] = inverse;
    }

    /// The solution of `U y = z` for the unknowns with pivots, in their order.
    #[inline(always)]
    fn back(&self, mut z: Rows, rank: usize) -> Rows {
        let mut y = [0.0; MOST_ROWS];
        for k in (0..rank).rev() {
            y[k] = z[k] * self.inverses[k];
            for r in 0..MOST_ROWS {
                z[r] -= self.columns[k][r] * y[k];
            }
        }
        y
    }

    /// Computes the null vector.
    #[inline(always)]
    fn orient(&mut self, sign: f64, rank: usize) {
        let (mut determinant, mut least, mut largest) = (sign, f64::INFINITY, 0.0);
        for k in 0..rank {
            let pivot = self.columns[k][k];
            determinant *= pivot;
            least = f64::min(least, pivot.abs());
            largest = f64::max(largest, pivot.abs());
        }
        self.pivot = if largest > 0.0 { least / largest } else { 0.0 };
        let y = self.back(self.columns[rank], rank);
        let mut square = 1.0;
        for k in 0..rank {
            square += y[k] * y[k];
        }
        let norm = Arithmetic::sqrt(square);
        let factor = if determinant < 0.0 { -1.0 / norm } else { 1.0 / norm };
        for k in 0..rank {
            self.tangent[self.order[k]] = -y[k] * factor;
        }
        self.tangent[self.order[rank]] = factor;
        self.volume = determinant.abs() * norm;
    }

    /// Reverses the null vector.
    pub fn reverse(&mut self) {
        for value in &mut self.tangent {
            *value = -*value;
        }
    }

    /// A solution of `J x = values`, not the least one.
    pub fn some(&self, values: &Rows) -> Q {
        if self.rank == MOST_ROWS { self.solved(values, MOST_ROWS) } else { self.solved(values, self.rank) }
    }

    #[inline(always)]
    fn solved(&self, values: &Rows, rank: usize) -> Q {
        let mut z = [0.0; MOST_ROWS];
        for k in 0..rank {
            z[k] = values[self.rows[k]];
        }
        for k in 0..rank {
            let value = z[k];
            for r in 0..MOST_ROWS {
                z[r] -= self.lower[k][r] * value;
            }
        }
        let y = self.back(z, rank);
        let mut x = [0.0; MOST_JOINTS];
        for k in 0..rank {
            x[self.order[k]] = y[k];
        }
        x
    }

    /// The least solution of `J x = values`: the one that is orthogonal to the null vector.
    pub fn least(&self, values: &Rows) -> Q {
        let mut x = self.some(values);
        let mut along = 0.0;
        for k in 0..MOST_JOINTS {
            along += x[k] * self.tangent[k];
        }
        for k in 0..MOST_JOINTS {
            x[k] -= along * self.tangent[k];
        }
        x
    }

    /// The solution of `J x = values` with a given value of one unknown; `None` if that unknown does not change along the null vector.
    pub fn with(&self, values: &Rows, unknown: usize, value: f64) -> Option<Q> {
        let mut x = self.least(values);
        if self.tangent[unknown].abs() < f64::MIN_POSITIVE {
            return None;
        }
        let along = (value - x[unknown]) / self.tangent[unknown];
        for k in 0..MOST_JOINTS {
            x[k] += along * self.tangent[k];
        }
        Some(x)
    }
}
