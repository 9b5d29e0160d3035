//! Division of polynomials as linear algebra: the monomials that occur, each with the multiple of a divisor that
//! cancels it (the symbolic preprocessing of F4).

use std::collections::HashMap;

use super::divisors::{Batch, Divisors, LANES};
use super::system::{Integral, refuse};
use crate::poly::{Layout, Monomial};
use crate::{Error, ErrorKind, Result, Watch};

/// Columns are monomials, greatest first.
pub(super) struct Matrix {
    columns: HashMap<Monomial, u32>,
    reducers: Vec<Option<Reducer>>,
}

/// A multiple of a divisor by a monomial.
struct Reducer {
    element: usize,
    /// The columns of its terms.
    columns: Vec<u32>,
}

impl Matrix {
    /// Builds the matrix for the division of `targets`.
    pub(super) fn new(divisors: &Divisors<'_>, targets: &[Integral], watch: &Watch) -> Result<Self> {
        let layout = divisors.ring.layout();
        let mut rows: HashMap<Monomial, Option<(usize, Monomial)>> = HashMap::new();
        let mut open: Vec<Monomial> = targets.iter().flat_map(|f| &f.terms).map(|(m, _)| m.clone()).collect();
        while let Some(monomial) = open.pop() {
            if rows.contains_key(&monomial) {
                continue;
            }
            watch.check()?;
            let row = reducer(layout, &divisors.elements, &monomial);
            if let Some((element, shift)) = &row {
                for (m, _) in &divisors.elements[*element].terms {
                    open.push(layout.checked_mul(m, shift).ok_or_else(overflow)?);
                }
            }
            rows.insert(monomial, row);
        }
        let mut sorted: Vec<&Monomial> = rows.keys().collect();
        sorted.sort_unstable_by(|a, b| layout.compare(b, a));
        let columns: HashMap<Monomial, u32> =
            sorted.iter().zip(0..).map(|(m, column)| ((*m).clone(), column)).collect();
        let place =
            |m: &Monomial, shift: &Monomial| columns[&layout.checked_mul(m, shift).expect("was multiplied before")];
        let numbered = |(element, shift): &(usize, Monomial)| Reducer {
            element: *element,
            columns: divisors.elements[*element].terms.iter().map(|(m, _)| place(m, shift)).collect(),
        };
        let reducers = sorted.iter().map(|m| rows[*m].as_ref().map(numbered)).collect();
        Ok(Matrix { columns, reducers })
    }

    /// The divisor for each quotient of [`Matrix::divide`].
    pub(super) fn divisors(&self) -> impl Iterator<Item = usize> {
        self.reducers.iter().flatten().map(|reducer| reducer.element)
    }

    /// The quotients by the integer multiples of the divisors, one vector for each prime.
    ///
    /// # Errors
    /// [`ErrorKind::Certificate`] when the remainder is not zero.
    pub(super) fn divide(&self, target: &Integral, batch: &Batch) -> Result<Vec<Vec<u32>>> {
        let primes = batch.primes.map(u64::from);
        let squares = primes.map(|p| p * p);
        let mut sums = vec![[0u64; LANES]; self.reducers.len()];
        for (monomial, c) in &target.terms {
            sums[self.columns[monomial] as usize] = batch.primes.map(|p| u64::from(crate::number::residue(c, p)));
        }
        let mut quotients = vec![Vec::new(); LANES];
        for (column, reducer) in self.reducers.iter().enumerate() {
            let value: [u64; LANES] = std::array::from_fn(|l| sums[column][l] % primes[l]);
            let Some(Reducer { element, columns }) = reducer else {
                if value != [0; LANES] {
                    return Err(refuse("does not reduce to zero"));
                }
                continue;
            };
            for l in 0..LANES {
                quotients[l].push((value[l] * u64::from(batch.inverses[*element][l]) % primes[l]) as u32);
            }
            if value != [0; LANES] {
                let factor: [u64; LANES] = std::array::from_fn(|l| (primes[l] - value[l]) % primes[l]);
                subtract(&mut sums, columns, &batch.images[*element], &factor, &squares);
            }
        }
        Ok(quotients)
    }
}

/// Adds `factor` times a row. The sums stay below the squares of the primes.
fn subtract(
    sums: &mut [[u64; LANES]],
    columns: &[u32],
    row: &[[u32; LANES]],
    factor: &[u64; LANES],
    squares: &[u64; LANES],
) {
    for (&column, coefficient) in columns.iter().zip(row) {
        let sum = &mut sums[column as usize];
        for l in 0..LANES {
            let next = sum[l] + factor[l] * u64::from(coefficient[l]);
            sum[l] = next.min(next.wrapping_sub(squares[l]));
        }
    }
}

/// The first divisor whose leading monomial divides `monomial`, and its monomial factor.
fn reducer(layout: &Layout, elements: &[Integral], monomial: &Monomial) -> Option<(usize, Monomial)> {
    elements.iter().enumerate().find_map(|(index, f)| Some((index, layout.checked_div(monomial, f.lead())?)))
}

fn overflow() -> Error {
    Error::new(ErrorKind::Overflow, "a monomial's degree exceeds the limit of the ring of the basis")
}
