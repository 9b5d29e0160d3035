//! The generalised eigenvalue problem ([`Pencil`]): `(A - x B) v = 0` with sixteen rows and columns.
//!
//! Each equation is multiplied by the cosine and by the sine of half of one near joint's angle. There are then as many equations as products. The reason is
//! that there are four homogeneous monomials of degree three in half that angle, and three of degree two. Half a turn is then an ordinary point.

use core::array::from_fn;

use super::linear::clear;
use super::profile::{PRODUCTS, STILL};
use super::reduce::Reduced;
use super::rows::{FAR, MOVING, Row};
use super::vector::product;

/// Rows and columns of the pencil, the number of complex solutions of a general chain.
pub const SIZE: usize = 2 * MOVING;
/// Monomials of the doubled joint times products of the other near one.
pub(super) const NEAR: usize = PRODUCTS + 3;
/// Columns before elimination: the near ones, then the far ones with the cosine and with the sine of the half angle.
pub(super) const ALL: usize = NEAR + 2 * FAR;

pub(super) type Wide = [f64; ALL];
/// A square matrix of [`SIZE`] rows.
pub type Matrix = [[f64; SIZE]; SIZE];

/// The near joint by whose half angle or displacement the equations are multiplied.
#[derive(Clone, Copy)]
pub(super) struct Doubled {
    /// Whether it is the second one.
    pub second: bool,
    pub slides: bool,
}

impl Doubled {
    /// A row times the cosine (`power` 0) or the sine (`power` 1) of the half angle: `1 = C^2 + S^2`, `c = C^2 - S^2`, `s = 2 C S`. For a prismatic joint, `1 =
    /// C^2`, `d = C S`, `d^2 = S^2`.
    #[inline(always)]
    fn row<const W: usize>(self, row: &Row, reduced: &Reduced, power: usize) -> [f64; W] {
        let (step, other) = if self.second { (1, 3) } else { (3, 1) };
        let left = reduced.left();
        let mut wide = [0.0; W];
        for k in 0..3 {
            let [one, even, odd] = [0, 1, 2].map(|index| row[k * other + index * step]);
            let values = if self.slides { [one, odd, even] } else { [one + even, odd + odd, one - even] };
            for (degree, value) in values.into_iter().enumerate() {
                wide[3 * (degree + power) + k] = value;
            }
        }
        for k in 0..left {
            wide[NEAR + power * left + k] = row[reduced.order[reduced.solved + k]];
        }
        wide
    }

    /// All rows, first times the cosine, then times the sine. The first result is without the tangent of half the hidden angle, the second one with it.
    #[inline(always)]
    fn all<const W: usize>(self, reduced: &Reduced) -> ([[f64; W]; SIZE], [[f64; W]; SIZE]) {
        let (mut constant, mut linear) = ([[0.0; W]; SIZE], [[0.0; W]; SIZE]);
        for k in 0..SIZE {
            constant[k] = self.row(&reduced.rows.constant[k % MOVING], reduced, k / MOVING);
            linear[k] = self.row(&reduced.rows.linear[k % MOVING], reduced, k / MOVING);
        }
        (constant, linear)
    }
}

/// The pencil, and how its unknowns are computed from an eigenvector.
pub(super) struct Pencil {
    /// `A`.
    pub constant: Matrix,
    /// `B`.
    pub linear: Matrix,
    /// The remaining columns, as indices among all columns.
    kept: [usize; SIZE],
    /// The eliminated unknowns: each with its column and its equation.
    solved: [(usize, Wide); 2 * STILL],
    count: usize,
}

impl Pencil {
    /// The pencil of reduced equations. `None` when no equation determines one of the remaining columns.
    #[inline(always)]
    pub fn new(reduced: &Reduced, doubled: Doubled) -> Option<Self> {
        if reduced.solved < STILL {
            return Pencil::narrowed(reduced, doubled);
        }
        let solved = [(ALL, [0.0; ALL]); 2 * STILL];
        let (constant, linear) = doubled.all(reduced);
        Some(Pencil { constant, linear, kept: from_fn(|k| k), solved, count: 0 })
    }

    /// Same as [`Pencil::new`], where some still equations did not determine far products.
    #[cold]
    fn narrowed(reduced: &Reduced, doubled: Doubled) -> Option<Self> {
        let (mut constant, mut linear) = doubled.all(reduced);
        let mut solved = [(ALL, [0.0; ALL]); 2 * STILL];
        let count = 2 * (STILL - reduced.solved);
        for (k, (_, row)) in solved[..count].iter_mut().enumerate() {
            *row = doubled.row(&reduced.rows.still[reduced.solved + k / 2], reduced, k % 2);
        }
        eliminate(&mut solved[..count], &mut constant, &mut linear)?;
        let mut kept = [0; SIZE];
        let columns = (0..SIZE + count).filter(|column| solved.iter().all(|(pivot, _)| pivot != column));
        kept.iter_mut().zip(columns).for_each(|(slot, column)| *slot = column);
        Some(Pencil { constant: narrow(&constant, &kept), linear: narrow(&linear, &kept), kept, solved, count })
    }

    /// The values of all columns.
    #[inline(always)]
    pub fn widened(&self, vector: &[f64; SIZE]) -> Wide {
        let mut wide = [0.0; ALL];
        self.kept.iter().zip(vector).for_each(|(column, value)| wide[*column] = *value);
        let known = wide;
        for (column, row) in &self.solved[..self.count] {
            wide[*column] = -product(row, &known);
        }
        wide
    }
}

/// The kept columns.
#[inline(always)]
fn narrow(rows: &[Wide; SIZE], kept: &[usize; SIZE]) -> Matrix {
    let mut matrix = [[0.0; SIZE]; SIZE];
    for (narrow, wide) in matrix.iter_mut().zip(rows) {
        narrow.iter_mut().zip(kept).for_each(|(entry, column)| *entry = wide[*column]);
    }
    matrix
}

/// Solves each remaining still equation for its largest column, and eliminates these columns from all others.
fn eliminate(solved: &mut [(usize, Wide)], constant: &mut [Wide; SIZE], linear: &mut [Wide; SIZE]) -> Option<()> {
    for index in 0..solved.len() {
        let (row, column) = largest(&solved[index..])?;
        solved.swap(index, index + row);
        solved[index].0 = column;
        let inverse = 1.0 / solved[index].1[column];
        solved[index].1.iter_mut().for_each(|entry| *entry *= inverse);
        let pivot = solved[index].1;
        let others = solved.iter_mut().enumerate().filter(|(other, _)| *other != index).map(|(_, (_, row))| row);
        others.chain(&mut *constant).chain(&mut *linear).for_each(|row| clear(row, &pivot, column));
    }
    Some(())
}

/// The indices of the largest entry. `None` when all are zero or one is not finite.
fn largest(rows: &[(usize, Wide)]) -> Option<(usize, usize)> {
    let (mut most, mut place) = (0.0, None);
    for (index, (_, row)) in rows.iter().enumerate() {
        for (column, entry) in row.iter().enumerate() {
            if entry.abs() > most {
                (most, place) = (entry.abs(), Some((index, column)));
            }
        }
    }
    place.filter(|_| most.is_finite())
}
