//! One elimination pass over `N` lanes: sums in all columns, cleared from the left by the rows that lead there.

use std::ops::Range;

use super::lanes::{Coefficient, Instructions, Moduli};
use super::symbolic::{Row, Shape};
use crate::{Result, Watch};

/// A monic sparse row: columns ascending, no coefficient zero in all lanes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sparse<C> {
    pub columns: Vec<u32>,
    pub coefficients: Vec<C>,
}

const NONE: u32 = u32::MAX;
/// Initial capacity of a row's lists.
const CAPACITY: usize = 32;
/// Number of columns that are cleared between two checks of the watch.
const PART: usize = 1024;

/// The working memory: the sums of the lanes, and the found rows with their leading columns.
pub(super) struct Sweep<'a, C, const N: usize> {
    pub moduli: Moduli<N>,
    instructions: Instructions,
    shape: &'a Shape,
    /// The coefficients of each element.
    coefficients: &'a [Vec<C>],
    pub sums: Vec<[u64; N]>,
    /// The index in `rows` of the row that leads a column, from the first free column on.
    leaders: Vec<u32>,
    pub rows: Vec<Sparse<C>>,
}

/// Clears the columns of the reducers, then those of the found rows. Lane `l` keeps the column `own[l]`.
#[inline(always)]
fn clear<C: Coefficient<N>, const N: usize>(sweep: &mut Sweep<'_, C, N>, part: Range<usize>, own: &[u32; N]) {
    let free = sweep.shape.upper.len();
    for column in part.start..part.end.min(free) {
        if sweep.sums[column] != [0; N] {
            let factor = sweep.moduli.residues(&sweep.sums[column]);
            sweep.sums[column] = [0; N];
            if factor != [0; N] {
                let row = &sweep.shape.upper[column];
                let (columns, coefficients) = (sweep.shape.columns_of(row), &sweep.coefficients[row.element as usize]);
                sweep.moduli.subtract(&mut sweep.sums, &columns[1..], &coefficients[1..], &factor);
            }
        }
    }
    for column in part.start.max(free)..part.end {
        let leader = sweep.leaders[column - free];
        if leader == NONE || sweep.sums[column] == [0; N] {
            continue;
        }
        let mut factor = sweep.moduli.residues(&sweep.sums[column]);
        for l in 0..N {
            if own[l] == column as u32 {
                factor[l] = 0;
            } else {
                sweep.sums[column][l] = 0;
            }
        }
        if factor != [0; N] {
            let row = &sweep.rows[leader as usize];
            sweep.moduli.subtract(&mut sweep.sums, &row.columns[1..], &row.coefficients[1..], &factor);
        }
    }
}

#[inline(always)]
fn accumulate<C: Coefficient<N>, const N: usize>(sweep: &mut Sweep<'_, C, N>, row: &Row, factor: &[u32; N]) {
    let coefficients = &sweep.coefficients[row.element as usize];
    let columns = sweep.shape.columns_of(row);
    let skip = coefficients.len() - columns.len();
    sweep.moduli.subtract(&mut sweep.sums, columns, &coefficients[skip..], factor);
}

#[inline(always)]
fn load<C: Coefficient<N>, const N: usize>(sweep: &mut Sweep<'_, C, N>, row: &Sparse<C>, factor: &[u32; N]) {
    sweep.moduli.subtract(&mut sweep.sums, &row.columns, &row.coefficients, factor);
}

/// Moves the residues of the sums in the free columns to `taken`.
#[inline(always)]
fn take<C: Coefficient<N>, const N: usize>(sweep: &mut Sweep<'_, C, N>, taken: &mut Sparse<[u32; N]>) {
    for column in sweep.shape.upper.len()..sweep.sums.len() {
        if sweep.sums[column] != [0; N] {
            let residues = sweep.moduli.residues(&sweep.sums[column]);
            sweep.sums[column] = [0; N];
            if residues != [0; N] {
                taken.columns.push(column as u32);
                taken.coefficients.push(residues);
            }
        }
    }
}

/// `target - factor * row`, dense residues of the first lane's modulus.
#[inline(always)]
fn dense<const N: usize>(moduli: &Moduli<N>, target: &mut [u32], row: &[u32], factor: u32) {
    let negative = u64::from(moduli.p[0] - factor);
    for (entry, &other) in target.iter_mut().zip(row) {
        *entry = moduli.residue(0, u64::from(*entry) + negative * u64::from(other));
    }
}

/// Compiles `$body` for each set of vector instructions and calls the one that the processor has.
macro_rules! dispatch {
    ($instructions:expr, [$($generic:tt)*], ($($name:ident : $type:ty),*), $body:ident) => {{
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2")]
        fn avx2<$($generic)*>($($name: $type),*) { $body($($name),*) }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx512f,avx512dq,avx2")]
        fn avx512<$($generic)*>($($name: $type),*) { $body($($name),*) }
        match $instructions {
            Instructions::Portable => $body($($name),*),
            // Sound: `Instructions::detect` found these instructions on this processor. Nothing else in the functions
            // is unsafe.
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            Instructions::Avx2 => unsafe { avx2($($name),*) },
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            Instructions::Avx512 => unsafe { avx512($($name),*) },
        }
    }};
}

impl<'a, C: Coefficient<N>, const N: usize> Sweep<'a, C, N> {
    pub fn new(moduli: [u32; N], instructions: Instructions, shape: &'a Shape, coefficients: &'a [Vec<C>]) -> Self {
        Sweep {
            moduli: Moduli::new(moduli),
            instructions,
            shape,
            coefficients,
            sums: vec![[0; N]; shape.columns],
            leaders: vec![NONE; shape.columns - shape.upper.len()],
            rows: Vec::new(),
        }
    }

    /// The first column that no reducer leads.
    pub fn free(&self) -> usize {
        self.shape.upper.len()
    }

    /// Subtracts `factor[l]` times a row of the matrix from each lane.
    pub fn accumulate(&mut self, row: &Row, factor: &[u32; N]) {
        let sweep = self;
        dispatch!(sweep.instructions, [C: Coefficient<N>, const N: usize],
            (sweep: &mut Sweep<'_, C, N>, row: &Row, factor: &[u32; N]), accumulate);
    }

    /// Subtracts `factor[l]` times a found row from each lane.
    pub fn load(&mut self, row: &Sparse<C>, factor: &[u32; N]) {
        let sweep = self;
        dispatch!(sweep.instructions, [C: Coefficient<N>, const N: usize],
            (sweep: &mut Sweep<'_, C, N>, row: &Sparse<C>, factor: &[u32; N]), load);
    }

    /// Clears all columns from `from` on that some row leads. Lane `l` keeps the column `own[l]`.
    pub fn clear(&mut self, from: usize, own: &[u32; N], watch: &Watch) -> Result<()> {
        let end = self.shape.columns;
        for start in (from..end).step_by(PART) {
            watch.check()?;
            let (sweep, part) = (&mut *self, start..end.min(start + PART));
            dispatch!(sweep.instructions, [C: Coefficient<N>, const N: usize],
                (sweep: &mut Sweep<'_, C, N>, part: Range<usize>, own: &[u32; N]), clear);
        }
        Ok(())
    }

    /// `target - factor * row` modulo the first lane's prime.
    pub fn dense(&self, target: &mut [u32], row: &[u32], factor: u32) {
        let moduli = &self.moduli;
        dispatch!(self.instructions, [const N: usize],
            (moduli: &Moduli<N>, target: &mut [u32], row: &[u32], factor: u32), dense);
    }

    /// Adds a row. From now on it clears its leading column.
    pub fn adopt(&mut self, row: Sparse<C>) {
        let free = self.free();
        self.leaders[row.columns[0] as usize - free] = self.rows.len() as u32;
        self.rows.push(row);
    }

    /// Returns the lanes' residues in the free columns. All sums are zero afterwards.
    pub fn take(&mut self) -> Sparse<[u32; N]> {
        let mut rows = Sparse { columns: Vec::with_capacity(CAPACITY), coefficients: Vec::with_capacity(CAPACITY) };
        let (sweep, taken) = (self, &mut rows);
        dispatch!(sweep.instructions, [C: Coefficient<N>, const N: usize],
            (sweep: &mut Sweep<'_, C, N>, taken: &mut Sparse<[u32; N]>), take);
        rows
    }
}
