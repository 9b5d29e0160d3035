//! The still equations, solved for products of the joints after the target ([`Reduced`]).

use core::array::from_fn;

use super::linear::clear;
use super::profile::{PRODUCTS, STILL};
use super::rows::{FAR, Rows};
use super::vector::largest;
use crate::tolerances::PIVOTS;

/// The equations after elimination, in the near products and the remaining far ones.
pub(super) struct Reduced {
    /// The first [`Reduced::solved`] still equations each determine one far product; the others are unchanged.
    pub rows: Rows,
    /// Number of far products that are solved for.
    pub solved: usize,
    /// Order of the far columns: solved ones first, in the order of their equations.
    pub order: [usize; FAR],
}

impl Reduced {
    /// Solves the still equations for as many far products as are well determined, by complete pivoting.
    #[inline(always)]
    pub fn new(rows: Rows) -> Self {
        let mut reduced = Reduced { rows, solved: 0, order: from_fn(|k| PRODUCTS + k) };
        while reduced.solved < STILL {
            let Some((row, place)) = reduced.pivot() else { break };
            reduced.eliminate(row, place);
        }
        reduced
    }

    /// Number of remaining far products.
    pub fn left(&self) -> usize {
        FAR - self.solved
    }

    /// The equation, and the index in the order of the columns, of the largest coefficient relative to its equation's size.
    fn pivot(&self) -> Option<(usize, usize)> {
        let (mut best, mut found) = (PIVOTS.weak, None);
        for row in self.solved..STILL {
            let still = &self.rows.still[row];
            let inverse = 1.0 / largest(f64::MIN_POSITIVE, &[*still]);
            for place in self.solved..FAR {
                let share = still[self.order[place]].abs() * inverse;
                if share > best {
                    (best, found) = (share, Some((row, place)));
                }
            }
        }
        found
    }

    /// Solves equation `row` for the column at `place`, and eliminates it from all others.
    fn eliminate(&mut self, row: usize, place: usize) {
        let (index, rows) = (self.solved, &mut self.rows);
        rows.still.swap(index, row);
        self.order.swap(index, place);
        let column = self.order[index];
        let inverse = 1.0 / rows.still[index][column];
        rows.still[index].iter_mut().for_each(|entry| *entry *= inverse);
        let pivot = rows.still[index];
        let others = rows.still.iter_mut().enumerate().filter(|(other, _)| *other != index).map(|(_, row)| row);
        others.chain(&mut rows.constant).chain(&mut rows.linear).for_each(|row| clear(row, &pivot, column));
        self.solved += 1;
    }
}
