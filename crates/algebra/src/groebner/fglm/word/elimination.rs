//! Gaussian elimination of rows of residues with their combinations of the inserted vectors.

use super::kernel::{Modulus, Sums, padded};

/// Rows of a block are reduced by one another, so that their factors do not depend on one another.
const BLOCK: usize = 4;

/// The independent vectors inserted so far, in echelon form.
///
/// Row `r` of block `b = r / BLOCK` has its pivot in column `r`, zeros in the columns before its block, and combines
/// only the first `BLOCK (b + 1)` vectors. So one row stores both: the combination, then the columns from `BLOCK b` on,
/// shifted `BLOCK` positions to the right.
#[derive(Clone, Debug)]
pub(super) struct Elimination {
    modulus: Modulus,
    dimension: usize,
    stride: usize,
    rows: Vec<u32>,
    rank: usize,
    /// The coordinate of each column.
    columns: Vec<usize>,
    sums: Sums,
}

impl Elimination {
    /// An empty elimination for vectors with `dimension` coordinates.
    pub fn new(modulus: Modulus, dimension: usize) -> Self {
        let stride = padded(dimension + BLOCK);
        let sums = Sums::new(modulus, stride);
        Elimination { modulus, dimension, stride, rows: Vec::new(), rank: 0, columns: (0..dimension).collect(), sums }
    }

    /// The number of independent vectors.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Inserts `vector` when it is independent. Otherwise returns the factors `c` with `vector + sum of c[k] * (k-th
    /// independent vector) = 0`.
    pub fn insert(&mut self, vector: &[u32]) -> Option<Vec<u32>> {
        self.reduce(vector);
        let row = self.sums.residues();
        match (self.rank..self.dimension).find(|&column| row[column + BLOCK] != 0) {
            None => Some(row[..self.rank].to_vec()),
            Some(pivot) => {
                self.adjoin(row, pivot);
                None
            }
        }
    }

    /// Computes in `sums` the vector with zeros at all pivots, and the combination that was added.
    fn reduce(&mut self, vector: &[u32]) {
        self.sums.clear(0..self.stride);
        for (lo, &coordinate) in self.sums.lo[BLOCK..].iter_mut().zip(&self.columns) {
            *lo = u64::from(vector[coordinate]);
        }
        for start in (0..self.rank).step_by(BLOCK) {
            let block = start..self.rank.min(start + BLOCK);
            let pivots: Vec<u32> = block.clone().map(|row| self.sums.get(row + BLOCK)).collect();
            let (modulus, rows, stride) = (self.modulus, &self.rows, self.stride);
            let terms =
                block.clone().zip(pivots).map(|(row, entry)| (modulus.neg(entry), &rows[row * stride..][..stride]));
            self.sums.add(terms);
            self.sums.clear(block.start + BLOCK..block.end + BLOCK);
        }
    }

    /// Inserts a reduced row that is not zero in column `pivot`.
    fn adjoin(&mut self, mut row: Vec<u32>, pivot: usize) {
        let (rank, block) = (self.rank, self.rank / BLOCK * BLOCK);
        row[rank] = 1;
        self.swap_columns(&mut row, pivot);
        let inverse = self.modulus.inverse(row[rank + BLOCK]);
        row.iter_mut().for_each(|entry| *entry = self.modulus.mul(*entry, inverse));
        for other in block..rank {
            let place = other * self.stride..(other + 1) * self.stride;
            let factor = self.modulus.neg(self.rows[place.start + rank + BLOCK]);
            self.sums.set(&self.rows[place.clone()]);
            self.sums.add_at(0, factor, &row);
            self.rows[place].copy_from_slice(&self.sums.residues());
        }
        self.rows.extend(row);
        self.rank += 1;
    }

    /// Exchanges column `pivot` and the first one without a pivot.
    fn swap_columns(&mut self, row: &mut [u32], pivot: usize) {
        self.columns.swap(self.rank, pivot);
        for row in self.rows.chunks_exact_mut(self.stride).chain([row]) {
            row.swap(self.rank + BLOCK, pivot + BLOCK);
        }
    }
}
