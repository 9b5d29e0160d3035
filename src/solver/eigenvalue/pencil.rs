//! The eigenvalue problem ([`Pencil`]): `(A - x B) v = 0` with sixteen rows and columns.
//!
//! Each equation is multiplied by the cosine and by the sine of half of one near joint's angle. In the homogeneous monomials of half that
//! angle (four of degree three instead of three of degree two) there are then as many equations as products, and half a turn is a point
//! like any other.

use super::profile::{PRODUCTS, STILL};
use super::reduce::Reduced;
use super::rows::{Doubled, FAR, MOVING, Row};

/// Rows and columns of the pencil, the number of complex solutions of a general chain.
pub const SIZE: usize = 16;
/// Monomials of the doubled joint times products of the other near one.
pub(super) const NEAR: usize = 12;
/// Columns before elimination: the near ones, then the far ones with the cosine and with the sine of the half angle.
pub(super) const ALL: usize = NEAR + 2 * FAR;

pub(super) type Wide = [f64; ALL];
pub(super) type Matrix = [[f64; SIZE]; SIZE];

/// The pencil, and how its unknowns are found in it.
#[derive(Clone, Debug)]
pub(super) struct Pencil {
    /// `A`.
    pub constant: Matrix,
    /// `B`.
    pub linear: Matrix,
    /// The columns that are left, as places in all columns.
    kept: [usize; SIZE],
    /// What was solved for: a column, and its equation.
    solved: [(usize, Wide); 2 * STILL],
    count: usize,
}

/// Where a row's coefficients go when it is multiplied by the cosine or the sine of the half angle.
struct Doubling {
    /// The near joint whose angle is halved.
    doubled: Doubled<f64>,
    /// Far columns that are left.
    left: usize,
}

impl Doubling {
    /// The row times the cosine (`power` 0) or the sine (`power` 1) of the half angle.
    fn row(&self, row: &Row<f64>, order: &[usize; FAR], power: usize) -> Wide {
        let mut wide = [0.0; ALL];
        for (degree, values) in self.doubled.monomials(row).into_iter().enumerate() {
            wide[3 * (degree + power)..][..3].copy_from_slice(&values);
        }
        for k in 0..self.left {
            wide[NEAR + power * self.left + k] = row[order[FAR - self.left + k]];
        }
        wide
    }
}

impl Pencil {
    /// The pencil of reduced equations; `None` when a column is left that no equation determines.
    pub fn new(reduced: &Reduced, doubled: Doubled<f64>) -> Option<Self> {
        let doubling = Doubling { doubled, left: FAR - reduced.solved };
        let double = |rows: &[Row<f64>; MOVING]| -> [Wide; SIZE] {
            std::array::from_fn(|k| doubling.row(&rows[k % MOVING], &reduced.order, k / MOVING))
        };
        let (mut constant, mut linear) = (double(&reduced.constant), double(&reduced.linear));
        let mut still = [[0.0; ALL]; 2 * STILL];
        let count = 2 * (STILL - reduced.solved);
        for (k, wide) in still[..count].iter_mut().enumerate() {
            *wide = doubling.row(&reduced.still[reduced.solved + k / 2], &reduced.order, k % 2);
        }
        let solved = eliminate(&mut still[..count], &mut constant, &mut linear)?;
        let mut kept = [0; SIZE];
        let columns = (0..SIZE + count).filter(|column| solved[..count].iter().all(|(pivot, _)| pivot != column));
        kept.iter_mut().zip(columns).for_each(|(slot, column)| *slot = column);
        let narrow = |rows: &[Wide; SIZE]| rows.each_ref().map(|row| kept.map(|column| row[column]));
        Some(Pencil { constant: narrow(&constant), linear: narrow(&linear), kept, solved, count })
    }

    /// The values of all columns, from those that are left.
    pub fn widened(&self, vector: &[f64; SIZE]) -> Wide {
        let mut wide = [0.0; ALL];
        self.kept.iter().zip(vector).for_each(|(column, value)| wide[*column] = *value);
        let known = wide;
        for (column, row) in &self.solved[..self.count] {
            wide[*column] = -row.iter().zip(&known).map(|(a, b)| a * b).sum::<f64>();
        }
        wide
    }
}

/// Solves the still equations that are left, each for its largest column, and takes these columns out of all others.
fn eliminate(
    still: &mut [Wide],
    constant: &mut [Wide; SIZE],
    linear: &mut [Wide; SIZE],
) -> Option<[(usize, Wide); 2 * STILL]> {
    let mut solved = [(0, [0.0; ALL]); 2 * STILL];
    for index in 0..still.len() {
        let (row, column) = largest(&still[index..])?;
        still.swap(index, index + row);
        let inverse = 1.0 / still[index][column];
        still[index].iter_mut().for_each(|entry| *entry *= inverse);
        let pivot = still[index];
        let others = still.iter_mut().enumerate().filter(|(other, _)| *other != index).map(|(_, row)| row);
        for row in others.chain(constant.iter_mut()).chain(linear.iter_mut()) {
            let factor = row[column];
            row.iter_mut().zip(&pivot).for_each(|(entry, over)| *entry -= factor * over);
            row[column] = 0.0;
        }
        solved[index].0 = column;
    }
    for (slot, row) in solved.iter_mut().zip(still.iter()) {
        slot.1 = *row;
    }
    Some(solved)
}

/// The place of the largest entry; `None` when all are zero or one is not finite.
fn largest(rows: &[Wide]) -> Option<(usize, usize)> {
    let (mut most, mut place) = (0.0, None);
    for (index, row) in rows.iter().enumerate() {
        for (column, entry) in row.iter().enumerate() {
            if entry.abs() > most {
                (most, place) = (entry.abs(), Some((index, column)));
            }
        }
    }
    place.filter(|_| most.is_finite())
}

/// The tangent's place in the monomials of the doubled joint: products of the other near joint at one power of the half angle's sine.
pub(super) fn monomials(wide: &Wide, power: usize) -> [f64; 3] {
    [0, 1, 2].map(|k| wide[3 * power + k])
}

const _: () = assert!(SIZE == 2 * MOVING && NEAR == PRODUCTS + 3);
