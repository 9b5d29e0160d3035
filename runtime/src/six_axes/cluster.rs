//! Coincident eigenvalues ([`Cluster`]): solutions with equal values of the hidden joint, separated by the doubled joint.
//!
//! Inverse iteration finds one vector of the space that their eigenvectors span. Simultaneous iteration finds a basis of this space. Multiplying the monomials
//! by the tangent of half the doubled angle is a matrix in this basis, with as many rows as solutions. Its eigenvectors are the solutions' coordinates (R. M.
//! Corless, P. M. Gianni and B. M. Trager, ISSAC 1997, 133-140).

use core::array::from_fn;

use super::hessenberg::Hessenberg;
use super::linear::solve;
use super::pencil::{ALL, Matrix, NEAR, Pencil, SIZE, Wide};
use super::shifted_qr::Eigenvalue;
use super::vector::product;
use crate::arithmetic::Arithmetic;
use crate::tolerances::{EIGENVALUES, MERGING, PIVOTS};
use crate::trigonometry::{cosine, sine};

/// Number of simultaneous iterations.
const ROUNDS: usize = 2;
/// Origin of half the doubled angle.
const ORIGIN: f64 = 0.7;

/// The solutions of coincident eigenvalues.
pub(super) struct Cluster {
    /// Their eigenvectors, in the first rows.
    pub vectors: Matrix,
    /// [`Eigenvalue::depth`] of their tangents.
    pub depths: [f64; SIZE],
}

impl Cluster {
    /// The solutions of `count` eigenvalues at `x`. `None` where the doubled joint does not separate them.
    #[cold]
    pub fn new(form: &Hessenberg, pencil: &Pencil, x: f64, count: usize) -> Option<Self> {
        let basis = basis(form, x, count)?;
        let mut wide = [[0.0; ALL]; SIZE];
        wide.iter_mut().zip(&basis[..count]).for_each(|(wide, vector)| *wide = pencil.widened(vector));
        let small = Hessenberg::reduce(tangents(&wide[..count])?);
        let values = small.eigenvalues()?;
        if !are_separate(&values[..count]) {
            return None;
        }
        let shares = small.eigenvectors(&values.map(|value| value.re)[..count]);
        let mixed = |shares: [f64; SIZE], k: usize| (0..count).fold(0.0, |sum, j| sum + shares[j] * basis[j][k]);
        let vectors = shares.map(|shares| from_fn(|k| mixed(shares, k)));
        Some(Cluster { vectors, depths: values.map(|value| value.depth()) })
    }
}

/// An orthonormal basis of the space of `count` eigenvectors for eigenvalues at `x`.
fn basis(form: &Hessenberg, x: f64, count: usize) -> Option<Matrix> {
    let shifted = x + EIGENVALUES.shift * (1.0 + x.abs());
    // Walsh functions: orthogonal, and no entry is zero.
    let mut basis: Matrix = from_fn(|j| from_fn(|k| if (j & k).count_ones().is_multiple_of(2) { 1.0 } else { -1.0 }));
    for _ in 0..ROUNDS {
        let mut rows = [[0.0; 2 * SIZE]; SIZE];
        for (k, row) in rows.iter_mut().enumerate() {
            row[..SIZE].copy_from_slice(&form.matrix[k]);
            row[k] -= shifted;
            (0..count).for_each(|j| row[SIZE + j] = basis[j][k]);
        }
        if solve(&mut rows) <= 0.0 {
            return None;
        }
        basis = from_fn(|j| from_fn(|k| rows[k][SIZE + j]));
        orthonormalise(&mut basis[..count])?;
    }
    basis[..count].iter_mut().for_each(|vector| form.turn_back(vector));
    Some(basis)
}

/// Gram-Schmidt orthonormalisation, applied twice. `None` where vectors are linearly dependent.
fn orthonormalise(basis: &mut [[f64; SIZE]]) -> Option<()> {
    for j in 0..basis.len() {
        let (known, rest) = basis.split_at_mut(j);
        for _ in 0..2 {
            for other in &*known {
                let share = product(other, &rest[0]);
                rest[0].iter_mut().zip(other).for_each(|(entry, over)| *entry -= share * over);
            }
        }
        let inverse = 1.0 / Arithmetic::sqrt(product(&rest[0], &rest[0]));
        rest[0].iter_mut().for_each(|entry| *entry *= inverse);
        if !inverse.is_finite() {
            return None;
        }
    }
    Some(())
}

/// The matrix, in a basis, of multiplication by the tangent, by least squares. Rows and columns beyond those of the basis are zero.
fn tangents(basis: &[Wide]) -> Option<Matrix> {
    let (c, s) = (cosine(ORIGIN), sine(ORIGIN));
    let cosines = |vector: &Wide, k: usize| c * vector[k] + s * vector[k + 3];
    let sines = |vector: &Wide, k: usize| c * vector[k + 3] - s * vector[k];
    let mut rows = [[0.0; 2 * SIZE]; SIZE];
    (basis.len()..SIZE).for_each(|i| rows[i][i] = 1.0);
    for (row, own) in rows.iter_mut().zip(basis) {
        for (j, other) in basis.iter().enumerate() {
            for k in 0..NEAR - 3 {
                let across = cosines(own, k);
                row[j] += across * cosines(other, k);
                row[SIZE + j] += across * sines(other, k);
            }
        }
    }
    let is_determined = solve(&mut rows) >= PIVOTS.singular;
    is_determined.then(|| rows.map(|row| from_fn(|k| row[SIZE + k])))
}

/// Whether all tangents are distinct within the tolerance.
fn are_separate(values: &[Eigenvalue]) -> bool {
    let is_close = |a: &Eigenvalue, b: &Eigenvalue| {
        (a.re - b.re).abs() + (a.im - b.im).abs() <= MERGING.apart * (1.0 + a.re * a.re + b.re * b.re)
    };
    !values.iter().enumerate().any(|(k, value)| values[..k].iter().any(|other| is_close(value, other)))
}
