//! Gaussian elimination modulo one prime, eight rows at a time.

use super::lanes::Instructions;
use super::sweep::{Sparse, Sweep};
use super::symbolic::{Row, Shape};
use crate::random::SplitMix64;
use crate::{Result, Watch};

/// Number of rows that are reduced together.
pub(super) const LANES: usize = 8;
/// Number of rows that are combined at random together.
const BLOCK: usize = 64;
/// A block is finished when its rest is zero with a probability of error below two to the minus this number.
const CERTAINTY: u32 = 50;
/// Marker for no column.
const NOWHERE: [u32; LANES] = [u32::MAX; LANES];

/// Options of the row reduction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Elimination {
    /// Whether to reduce random combinations, as many as the rank, so that rows that become zero cost little. Otherwise
    /// rows are reduced one by one, which shows the rows that are independent of those before them.
    pub combinations: bool,
    pub instructions: Instructions,
}

/// The new rows of a matrix: monic, reduced by the matrix and by one another, greatest leading column first.
pub(super) struct Echelon {
    pub rows: Vec<Sparse<u32>>,
    /// Without combinations: the independent lower rows, each with its leading column when it was found.
    pub independent: Vec<(usize, u32)>,
}

/// Reduces the lower rows of `shape` modulo `p`.
pub(super) fn eliminate(
    shape: &Shape,
    coefficients: &[Vec<u32>],
    p: u32,
    elimination: Elimination,
    watch: &Watch,
) -> Result<Echelon> {
    let mut sweep = Sweep::<u32, LANES>::new([p; LANES], elimination.instructions, shape, coefficients);
    let mut independent = Vec::new();
    let combine = elimination.combinations && LANES as u32 / 2 * p.ilog2() >= CERTAINTY;
    let mut random = SplitMix64::new(0);
    for (index, rows) in shape.lower.chunks(if combine { BLOCK } else { LANES }).enumerate() {
        watch.check()?;
        if rows.len() <= LANES {
            take_each(&mut sweep, rows, watch)?;
            let fresh = extract(&mut sweep, rows.len());
            independent.extend(fresh.into_iter().map(|(lane, column)| (index * LANES + lane, column)));
        } else {
            take_combinations(&mut sweep, rows, p, &mut random, watch)?;
        }
    }
    interreduce(&mut sweep, watch)?;
    let mut rows = sweep.rows;
    rows.sort_unstable_by_key(|row| row.columns[0]);
    Ok(Echelon { rows, independent })
}

/// Adds random combinations of `rows` until their rest is zero with high probability.
fn take_combinations(
    sweep: &mut Sweep<'_, u32, LANES>,
    rows: &[Row],
    p: u32,
    random: &mut SplitMix64,
    watch: &Watch,
) -> Result<()> {
    let zeros = CERTAINTY.div_ceil(p.ilog2()) as usize;
    let mut rank = 0;
    loop {
        watch.check()?;
        for row in rows {
            sweep.accumulate(row, &std::array::from_fn(|_| residue(random, p)));
        }
        sweep.clear(0, &NOWHERE, watch)?;
        let fresh = extract(sweep, LANES).len();
        rank += fresh;
        if fresh + zeros <= LANES || rank == rows.len() {
            return Ok(());
        }
    }
}

/// Puts one row in each lane.
fn take_each(sweep: &mut Sweep<'_, u32, LANES>, rows: &[Row], watch: &Watch) -> Result<()> {
    for (lane, row) in rows.iter().enumerate() {
        sweep.accumulate(row, &unit(lane, sweep.moduli.p[0]));
    }
    sweep.clear(0, &NOWHERE, watch)
}

/// The factor that adds a row to one lane.
fn unit(lane: usize, p: u32) -> [u32; LANES] {
    std::array::from_fn(|l| if l == lane { p - 1 } else { 0 })
}

/// Extracts the lanes as new rows. Each is reduced by those before it. Returns the lanes that were not zero with their
/// leading columns.
fn extract(sweep: &mut Sweep<'_, u32, LANES>, lanes: usize) -> Vec<(usize, u32)> {
    let Sparse { columns, coefficients } = sweep.take();
    let mut found: Vec<(usize, usize, Vec<u32>)> = Vec::new();
    for lane in 0..lanes {
        let mut row: Vec<u32> = coefficients.iter().map(|lanes| lanes[lane]).collect();
        // Leading columns of this batch, from the left. A row found later may lead further left.
        let mut earlier: Vec<_> = found.iter().collect();
        earlier.sort_by_key(|(_, lead, _)| *lead);
        for (_, lead, other) in earlier {
            if row[*lead] != 0 {
                let factor = row[*lead];
                sweep.dense(&mut row[*lead..], &other[*lead..], factor);
            }
        }
        if let Some(lead) = row.iter().position(|&entry| entry != 0) {
            let inverse = sweep.moduli.inverse(0, row[lead]);
            row[lead..].iter_mut().for_each(|entry| *entry = sweep.moduli.product(0, *entry, inverse));
            found.push((lane, lead, row));
        }
    }
    let adopt = |(lane, lead, row): (usize, usize, Vec<u32>)| {
        sweep.adopt(sparse(&columns, row.into_iter()));
        (lane, columns[lead])
    };
    found.into_iter().map(adopt).collect()
}

/// The nonzero entries among those of `columns`.
fn sparse(columns: &[u32], entries: impl Iterator<Item = u32>) -> Sparse<u32> {
    let nonzero = columns.iter().copied().zip(entries).filter(|(_, entry)| *entry != 0);
    let (columns, coefficients) = nonzero.unzip();
    Sparse { columns, coefficients }
}

/// The rows of one lane.
fn apart(rows: &Sparse<[u32; LANES]>, lane: usize) -> Sparse<u32> {
    sparse(&rows.columns, rows.coefficients.iter().map(|lanes| lanes[lane]))
}

/// Reduces the found rows by one another, those with the smallest leading columns first.
fn interreduce(sweep: &mut Sweep<'_, u32, LANES>, watch: &Watch) -> Result<()> {
    if sweep.rows.len() < 2 {
        return Ok(());
    }
    let mut order: Vec<usize> = (0..sweep.rows.len()).collect();
    order.sort_unstable_by_key(|&row| std::cmp::Reverse(sweep.rows[row].columns[0]));
    for group in order.chunks(LANES) {
        watch.check()?;
        let mut own = NOWHERE;
        for (lane, &row) in group.iter().enumerate() {
            own[lane] = sweep.rows[row].columns[0];
            let row = sweep.rows[row].clone();
            sweep.load(&row, &unit(lane, sweep.moduli.p[0]));
        }
        let first = own.iter().min().copied().unwrap_or(0);
        sweep.clear(first as usize, &own, watch)?;
        let rows = sweep.take();
        for (lane, &row) in group.iter().enumerate() {
            sweep.rows[row] = apart(&rows, lane);
        }
    }
    Ok(())
}

/// Reduces the lower rows of `shape` by its upper rows alone. Returns one list of residues in the free columns for each
/// row.
pub(super) fn normal_forms(
    shape: &Shape,
    coefficients: &[Vec<u32>],
    p: u32,
    elimination: Elimination,
    watch: &Watch,
) -> Result<Vec<Sparse<u32>>> {
    let mut sweep = Sweep::<u32, LANES>::new([p; LANES], elimination.instructions, shape, coefficients);
    let mut forms = Vec::with_capacity(shape.lower.len());
    for rows in shape.lower.chunks(LANES) {
        watch.check()?;
        take_each(&mut sweep, rows, watch)?;
        let taken = sweep.take();
        forms.extend((0..rows.len()).map(|lane| apart(&taken, lane)));
    }
    Ok(forms)
}

/// A random residue, by the upper bits of a product instead of a division.
fn residue(random: &mut SplitMix64, p: u32) -> u32 {
    ((u128::from(random.word()) * u128::from(p)) >> 64) as u32
}
