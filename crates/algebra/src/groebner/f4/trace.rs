//! Trace of one run: the matrices without the rows that became zero, and the supports of the results. A replay repeats
//! the arithmetic for `N` other coefficient vectors at once and processes no monomials (C. Traverso, "Groebner trace
//! algorithms", ISSAC 1988).

use super::eliminate::Echelon;
use super::lanes::Instructions;
use super::sweep::{Sparse, Sweep};
use super::symbolic::{Row, Shape};
use crate::{Error, ErrorKind, Result, Watch};

/// One matrix of the run.
#[derive(Clone, Debug)]
pub(super) struct Round {
    shape: Shape,
    /// The leading column of each lower row after reduction by the rows before it.
    leads: Vec<u32>,
    /// The columns of each new row, greatest leading column first.
    supports: Vec<Box<[u32]>>,
}

/// A computation that can be repeated modulo other primes or with other coefficients. [`Trace::learn`] creates it.
///
/// [`Trace::learn`]: super::Trace::learn
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// The index and the number of terms of each nonzero generator.
    pub(super) generators: Vec<(usize, usize)>,
    pub(super) rounds: Vec<Round>,
    /// Tails of the basis elements to be reduced; the elements, and the remaining columns of each.
    pub(super) last: Shape,
    pub(super) supports: Vec<Box<[u32]>>,
    pub(super) unit: bool,
}

impl Trace {
    /// Records the part of a round that led to new rows.
    pub(super) fn record(&mut self, shape: Shape, echelon: &Echelon) {
        let lower = echelon.independent.iter().map(|(index, _)| shape.lower[*index]).collect();
        let shape = pruned(&Shape { lower, ..shape });
        let leads = echelon.independent.iter().map(|(_, lead)| *lead).collect();
        let supports = echelon.rows.iter().map(|row| row.columns.clone().into()).collect();
        self.rounds.push(Round { shape, leads, supports });
    }

    /// Entries of the matrices of a replay.
    pub(crate) fn terms(&self) -> usize {
        self.rounds.iter().map(|round| round.shape.entries.len()).sum::<usize>() + self.last.entries.len()
    }

    /// Size of the trace in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let supports = |list: &[Box<[u32]>]| list.iter().map(|s| 4 * s.len()).sum::<usize>();
        let rounds: usize = self.rounds.iter().map(|round| round.shape.bytes() + supports(&round.supports)).sum();
        rounds + self.last.bytes() + supports(&self.supports)
    }

    /// Repeats the run for `N` coefficient vectors at once: `generators[i][j][l]` is the coefficient of term `j`
    /// (greatest first) of generator `i` in lane `l`, modulo `moduli[l]`, a prime below 2^31.
    ///
    /// Returns for each lane the coefficients of the monic basis polynomials, in the order of terms of the learned
    /// basis. A lane is `None` when it differs from the learned run: its prime or its parameters are unlucky, or those
    /// of the learned run were. Rows that became zero in the learned run are not computed again. If one is not zero
    /// here, the result belongs to the ideal but is not a basis of it. Callers guard against that with a separate
    /// computation at another prime or point.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the numbers of terms of the generators differ from the learned ones; the error with
    /// which `watch` stops the work.
    pub fn replay<'w, const N: usize>(
        &self,
        moduli: [u32; N],
        generators: &[Vec<[u32; N]>],
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<[Option<Vec<Vec<u32>>>; N]> {
        let watch = Watch::or_none(watch);
        let mut coefficients = self.nonzero_generators(generators)?;
        let mut alive = [true; N];
        for (index, round) in self.rounds.iter().enumerate() {
            watch.report("replay", index, self.rounds.len() - index);
            let fresh = round.replay(moduli, &coefficients, &mut alive, watch)?;
            coefficients.extend(fresh);
            if index == 0 {
                coefficients.drain(..self.generators.len());
            }
        }
        let tails = self.tails(moduli, &coefficients, &mut alive, watch)?;
        let lane = |l: usize| {
            let list = |tail: &Vec<[u32; N]>| std::iter::once(1).chain(tail.iter().map(|c| c[l])).collect();
            alive[l].then(|| tails.iter().map(list).collect())
        };
        Ok(std::array::from_fn(lane))
    }

    fn nonzero_generators<const N: usize>(&self, generators: &[Vec<[u32; N]>]) -> Result<Vec<Vec<[u32; N]>>> {
        let fits = |&(index, terms): &(usize, usize)| generators.get(index).is_some_and(|f| f.len() == terms);
        if !self.generators.iter().all(fits) {
            let text = "the generators must have the same terms as the generators of the learned run";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(self.generators.iter().map(|&(index, _)| generators[index].clone()).collect())
    }

    /// The tails of the basis, reduced.
    fn tails<const N: usize>(
        &self,
        moduli: [u32; N],
        coefficients: &[Vec<[u32; N]>],
        alive: &mut [bool; N],
        watch: &Watch,
    ) -> Result<Vec<Vec<[u32; N]>>> {
        let mut sweep = Sweep::new(moduli, Instructions::detect(), &self.last, coefficients);
        let mut tails = Vec::with_capacity(self.supports.len());
        for (row, support) in self.last.lower.iter().zip(&self.supports) {
            let form = reduced(&mut sweep, row, watch)?;
            tails.push(on_support(&form, support, alive));
        }
        Ok(tails)
    }
}

/// The matrix without the reducers that no lower row needs. Their rows are empty.
pub(super) fn pruned(shape: &Shape) -> Shape {
    let mut touched = vec![false; shape.columns];
    let mut entries = Vec::new();
    let mut keep = |row: &Row, touched: &mut [bool]| {
        let columns = shape.columns_of(row);
        columns.iter().for_each(|&column| touched[column as usize] = true);
        entries.extend_from_slice(columns);
        Row { element: row.element, from: entries.len() - columns.len(), to: entries.len() }
    };
    let lower = shape.lower.iter().map(|row| keep(row, &mut touched)).collect();
    let empty = |row: &Row| Row { element: row.element, from: 0, to: 0 };
    let mut upper = Vec::with_capacity(shape.upper.len());
    for (column, row) in shape.upper.iter().enumerate() {
        upper.push(if touched[column] { keep(row, &mut touched) } else { empty(row) });
    }
    entries.shrink_to_fit();
    Shape { columns: shape.columns, upper, lower, entries }
}

impl Round {
    /// The coefficients of the round's new elements. Lanes that differ from the learned run are removed from `alive`.
    fn replay<const N: usize>(
        &self,
        moduli: [u32; N],
        coefficients: &[Vec<[u32; N]>],
        alive: &mut [bool; N],
        watch: &Watch,
    ) -> Result<Vec<Vec<[u32; N]>>> {
        let mut sweep = Sweep::new(moduli, Instructions::detect(), &self.shape, coefficients);
        for (row, &lead) in self.shape.lower.iter().zip(&self.leads) {
            let mut form = reduced(&mut sweep, row, watch)?;
            start_at(&mut form, lead, alive);
            make_monic(&sweep, &mut form, alive);
            sweep.adopt(form);
        }
        let mut order: Vec<usize> = (0..sweep.rows.len()).collect();
        order.sort_unstable_by_key(|&row| std::cmp::Reverse(sweep.rows[row].columns[0]));
        for &row in order.iter().filter(|_| order.len() > 1) {
            watch.check()?;
            let lead = sweep.rows[row].columns[0];
            let form = sweep.rows[row].clone();
            sweep.load(&form, &moduli.map(|p| p - 1));
            sweep.clear(lead as usize, &[lead; N], watch)?;
            sweep.rows[row] = sweep.take();
        }
        // In the order of insertion: the smallest leading monomial first.
        let rows = order.iter().map(|&row| &sweep.rows[row]);
        Ok(rows.zip(self.supports.iter().rev()).map(|(row, support)| on_support(row, support, alive)).collect())
    }
}

/// A row of the matrix, reduced by all rows with a leading column so far.
fn reduced<const N: usize>(sweep: &mut Sweep<'_, [u32; N], N>, row: &Row, watch: &Watch) -> Result<Sparse<[u32; N]>> {
    watch.check()?;
    sweep.accumulate(row, &sweep.moduli.p.map(|p| p - 1));
    sweep.clear(0, &[u32::MAX; N], watch)?;
    Ok(sweep.take())
}

/// Makes `row` begin in the column `lead`. Lanes with an entry further left are removed from `alive`.
fn start_at<const N: usize>(row: &mut Sparse<[u32; N]>, lead: u32, alive: &mut [bool; N]) {
    let left = row.columns.partition_point(|&column| column < lead);
    for coefficients in row.coefficients.drain(..left) {
        strike(alive, |l| coefficients[l] != 0);
    }
    row.columns.drain(..left);
    if row.columns.first() != Some(&lead) {
        row.columns.insert(0, lead);
        row.coefficients.insert(0, [0; N]);
    }
}

/// Divides each lane by its leading coefficient. Lanes where it is zero are removed from `alive`; their leading
/// coefficient is set to one.
fn make_monic<const N: usize>(sweep: &Sweep<'_, [u32; N], N>, row: &mut Sparse<[u32; N]>, alive: &mut [bool; N]) {
    let lead = row.coefficients[0];
    strike(alive, |l| lead[l] == 0);
    let inverse: [u32; N] = std::array::from_fn(|l| if lead[l] == 0 { 1 } else { sweep.moduli.inverse(l, lead[l]) });
    for coefficients in &mut row.coefficients {
        *coefficients = std::array::from_fn(|l| sweep.moduli.product(l, coefficients[l], inverse[l]));
    }
    row.coefficients[0] = [1; N];
}

/// The coefficients of `row` in the columns of `support`. Lanes with an entry elsewhere are removed from `alive`.
fn on_support<const N: usize>(row: &Sparse<[u32; N]>, support: &[u32], alive: &mut [bool; N]) -> Vec<[u32; N]> {
    let mut coefficients = vec![[0; N]; support.len()];
    let mut place = 0;
    for (&column, value) in row.columns.iter().zip(&row.coefficients) {
        while place < support.len() && support[place] < column {
            place += 1;
        }
        if support.get(place) == Some(&column) {
            coefficients[place] = *value;
        } else {
            strike(alive, |l| value[l] != 0);
        }
    }
    coefficients
}

fn strike<const N: usize>(alive: &mut [bool; N], dead: impl Fn(usize) -> bool) {
    for (l, lane) in alive.iter_mut().enumerate() {
        *lane &= !dead(l);
    }
}
