//! The still equations, solved for products of the joints behind the target ([`Reduced`]).

use super::profile::{PRODUCTS, STILL};
use super::rows::{FAR, MOVING, Row, Rows};

/// A pivot of a still equation below this share of its largest coefficient is not taken while the far products alone are solved for.
pub(super) const WEAK: f64 = 1e-3;

/// The equations after elimination: `a - x b = 0` with `x` the tangent of half the hidden angle, in the near products and the far ones
/// that are left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reduced {
    /// The still equations, reduced: the first [`Reduced::solved`] each give one far product, the others are left as they are.
    pub still: [Row<f64>; STILL],
    /// How many far products are solved for.
    pub solved: usize,
    /// The far columns: those that are solved for come first, in the order of their equations.
    pub order: [usize; FAR],
    /// `a`.
    pub constant: [Row<f64>; MOVING],
    /// `b`.
    pub linear: [Row<f64>; MOVING],
}

impl Reduced {
    /// Solves the still equations for as many far products as they determine well, by complete pivoting.
    pub fn new(rows: &Rows<f64>) -> Self {
        let Rows { still, constant, linear } = *rows;
        let order = std::array::from_fn(|k| PRODUCTS + k);
        let mut reduced = Reduced { still, solved: 0, order, constant, linear };
        while reduced.solved < STILL {
            let Some((row, place)) = reduced.pivot() else { break };
            reduced.eliminate(row, place);
        }
        reduced
    }

    /// The equation and the place in the order of the columns with the largest share of its equation's size.
    fn pivot(&self) -> Option<(usize, usize)> {
        let (mut best, mut found) = (WEAK, None);
        for row in self.solved..STILL {
            let size = self.still[row].iter().fold(f64::MIN_POSITIVE, |most: f64, entry| most.max(entry.abs()));
            for place in self.solved..FAR {
                let share = self.still[row][self.order[place]].abs() / size;
                if share > best {
                    (best, found) = (share, Some((row, place)));
                }
            }
        }
        found
    }

    /// Solves equation `row` for the column at `place`, and takes it out of all others.
    fn eliminate(&mut self, row: usize, place: usize) {
        let index = self.solved;
        self.still.swap(index, row);
        self.order.swap(index, place);
        let column = self.order[index];
        let inverse = 1.0 / self.still[index][column];
        self.still[index].iter_mut().for_each(|entry| *entry *= inverse);
        let pivot = self.still[index];
        let others = self.still.iter_mut().enumerate().filter(|(other, _)| *other != index).map(|(_, row)| row);
        for row in others.chain(&mut self.constant).chain(&mut self.linear) {
            let factor = row[column];
            row.iter_mut().zip(&pivot).for_each(|(entry, over)| *entry -= factor * over);
            row[column] = 0.0;
        }
        self.solved += 1;
    }
}
