//! The triangular factor of Newton steps, and how singular it is.

use crate::arithmetic::Arithmetic;
use crate::counters::Event;
use crate::effort::{INVERSIONS, STEEP};
use crate::joints::is_in;
use crate::mechanism::{Equations, Joints, Mechanism};
use crate::problem::Problem;
use crate::storage::{Array, Storage};

/// A QR factorisation, stored by columns; the right side is the last one.
pub(crate) struct Triangle<M: Mechanism> {
    numbers: <M::Storage as Storage>::Triangle,
    /// The length of a column: one entry for each equation, then one for each joint.
    rows: usize,
    joints: usize,
    /// Number of damped joints: in all columns the entries of the other joints are zero. Before the reflection of a pivot, the entries after that of its joint
    /// are zero.
    damped: usize,
}

impl<M: Mechanism> Problem<'_, M> {
    /// The least pivot of the triangular factor of the Jacobian at `q`, relative to the largest. It is within rounding at a double root, and where the joints
    /// can move while the equations hold.
    pub fn regularity(&mut self, q: &Joints<M>) -> f64 {
        self.regularity_of(q, 0)
    }

    /// Same as [`Problem::regularity`], with the joints in `held` left out.
    pub fn regularity_of(&mut self, q: &Joints<M>, held: u32) -> f64 {
        self.triangle(q, 0.0, held).regularity()
    }

    /// The direction in which the equations change least, with its largest component equal to one, and that change relative to the largest pivot. Computed by
    /// inverse iteration from the triangular factor. `None` where a pivot is zero, or no steps are left.
    pub fn stillest(&self, mut triangle: Triangle<M>) -> Option<(Joints<M>, f64)> {
        if self.steps.are_spent() {
            return None;
        }
        let joints = self.joints();
        let most = (0..joints).fold(0.0, |most, i| f64::max(most, triangle.entry(i, i).abs()));
        let mut direction: Joints<M> = Array::by(joints, |_| 1.0);
        let mut share = 1.0;
        for _ in 0..INVERSIONS {
            for row in 0..joints {
                let above = (0..row)
                    .fold(direction.as_ref()[row], |sum, k| sum - triangle.entry(row, k) * triangle.entry(joints, k));
                let solved = above / triangle.entry(row, row);
                triangle.column_mut(joints)[row] = solved;
            }
            let before = norm(&triangle.column(joints)[..joints]);
            direction = triangle.substituted()?;
            share = before / (norm(direction.as_ref()) * most);
        }
        let longest = self.facts().longest(direction.as_ref());
        let unit = Array::by(joints, |i| direction.as_ref()[i] / longest);
        (longest.is_finite() && longest > 0.0).then_some((unit, share))
    }

    /// The triangular factor of a step's equations.
    pub fn triangle(&mut self, q: &Joints<M>, damping: f64, held: u32) -> Triangle<M> {
        let (derivatives, right) = self.slopes(q);
        self.triangle_of(&derivatives, &right, damping, held)
    }

    /// The Jacobian of the equations and their values.
    pub fn slopes(&self, q: &Joints<M>) -> (Equations<M, Joints<M>>, Equations<M>) {
        self.linearised(&self.place(q))
    }

    /// The triangular factor of the relative equations (each divided by its size).
    pub fn shares(&mut self, q: &Joints<M>, damping: f64, held: u32) -> Triangle<M> {
        let (derivatives, right) = self.shared(q);
        self.triangle_of(&derivatives, &right, damping, held)
    }

    /// The Jacobian of the relative equations and their values.
    pub fn shared(&self, q: &Joints<M>) -> (Equations<M, Joints<M>>, Equations<M>) {
        let at = self.place(q);
        let (mut derivatives, mut right) = self.linearised(&at);
        let sizes = self.mechanism.sizes(self.parameters, &at);
        for (i, &size) in self.facts().size_of.iter().enumerate() {
            let size = f64::max(sizes.as_ref()[size], f64::MIN_POSITIVE);
            right.as_mut()[i] /= size;
            derivatives.as_mut()[i].as_mut().iter_mut().for_each(|entry| *entry /= size);
        }
        (derivatives, right)
    }

    /// A triangle of zeros.
    pub fn no_triangle(&self) -> Triangle<M> {
        let joints = self.joints();
        let rows = self.facts().size_of.len() + joints;
        Triangle { numbers: Array::by((joints + 1) * rows, |_| 0.0), rows, joints, damped: joints }
    }

    /// The triangular factor for a given Jacobian and values.
    pub fn triangle_of(
        &mut self,
        derivatives: &Equations<M, Joints<M>>,
        right: &Equations<M>,
        damping: f64,
        held: u32,
    ) -> Triangle<M> {
        self.steps.take(Event::Step);
        let (joints, equations) = (self.joints(), self.facts().size_of.len());
        let mut triangle = self.no_triangle();
        let mut size = 0.0;
        for i in (0..joints).filter(|i| !is_in(held, *i)) {
            let mut square = 0.0;
            for (entry, row) in triangle.column_mut(i).iter_mut().zip(derivatives.as_ref()) {
                *entry = row.as_ref()[i];
                square += *entry * *entry;
            }
            size = f64::max(size, square);
        }
        triangle.column_mut(joints)[..equations].copy_from_slice(right.as_ref());
        triangle.damped = if damping > 0.0 { joints } else { (u32::BITS - held.leading_zeros()) as usize };
        for i in 0..joints {
            let damped = if is_in(held, i) { 1.0 } else { Arithmetic::sqrt(damping * size) };
            triangle.column_mut(i)[equations + i] = damped;
        }
        triangle.reflect();
        triangle
    }
}

impl<M: Mechanism> Triangle<M> {
    fn column(&self, column: usize) -> &[f64] {
        &self.numbers.as_ref()[column * self.rows..][..self.rows]
    }

    pub fn column_mut(&mut self, column: usize) -> &mut [f64] {
        &mut self.numbers.as_mut()[column * self.rows..][..self.rows]
    }

    pub fn entry(&self, column: usize, row: usize) -> f64 {
        self.numbers.as_ref()[column * self.rows + row]
    }

    /// Reduces the columns to a triangle by Householder reflections.
    pub fn reflect(&mut self) {
        for pivot in 0..self.joints {
            let end = self.rows - self.joints + usize::min(pivot + 1, self.damped);
            let (before, behind) = self.numbers.as_mut().split_at_mut((pivot + 1) * self.rows);
            let mirror = &mut before[pivot * self.rows..][pivot..end];
            let square = mirror.iter().fold(0.0, |sum, x| sum + x * x);
            if square == 0.0 {
                continue;
            }
            let length = Arithmetic::sqrt(square).copysign(mirror[0]);
            mirror[0] += length;
            let half = length * mirror[0];
            for column in behind.chunks_exact_mut(self.rows) {
                let column = &mut column[pivot..end];
                let along = mirror.iter().zip(&*column).fold(0.0, |sum, (x, y)| sum + x * y) / half;
                column.iter_mut().zip(&*mirror).for_each(|(x, y)| *x -= along * y);
            }
            mirror[0] = -length;
        }
    }

    /// The least pivot, relative to the largest.
    pub fn regularity(&self) -> f64 {
        let pivots = (0..self.joints).map(|i| self.entry(i, i).abs());
        let (least, most) =
            pivots.fold((f64::INFINITY, 0.0), |(least, most), pivot| (f64::min(least, pivot), f64::max(most, pivot)));
        least / most
    }

    /// Whether the least pivot exceeds the equations' values: then no configuration nearby has smaller residuals than the end of the plain step.
    pub fn is_regular(&self) -> bool {
        let pivots = (0..self.joints).map(|i| self.entry(i, i).abs());
        let (least, most) =
            pivots.fold((f64::INFINITY, 0.0), |(least, most), pivot| (f64::min(least, pivot), f64::max(most, pivot)));
        least * least > STEEP * most * norm(self.column(self.joints))
    }

    /// The solution of the triangular system by back substitution. `None` for a zero or non-finite pivot.
    pub fn substituted(&self) -> Option<Joints<M>> {
        let mut solution: Joints<M> = Array::by(self.joints, |_| 0.0);
        for row in (0..self.joints).rev() {
            let pivot = self.entry(row, row);
            if pivot == 0.0 || !pivot.is_finite() {
                return None;
            }
            let mut sum = self.entry(self.joints, row);
            for k in row + 1..self.joints {
                sum -= self.entry(k, row) * solution.as_ref()[k];
            }
            solution.as_mut()[row] = sum / pivot;
        }
        Some(solution)
    }
}

fn norm(vector: &[f64]) -> f64 {
    Arithmetic::sqrt(vector.iter().fold(0.0, |sum, x| sum + x * x))
}
