//! Joint values next to a target at which a joint can move while the tip does not: [`Problem::freed`].

use crate::effort::LEAPS;
use crate::joints::{is_in, shifted, stepped};
use crate::mechanism::{Equations, Joints, Mechanism};
use crate::problem::Problem;
use crate::storage::Array;
use crate::tolerances::{PIVOTS, POLISHING};
use crate::triangle::Triangle;

impl<M: Mechanism> Problem<'_, M> {
    /// Joint values next to `q` at which the first of the joints `free` can move, to first order, while the others keep the equations' values. Among these,
    /// those with the least residual. The joints `free` keep their values. `None` where no such joint values are near.
    ///
    /// The component of the free joint's derivative orthogonal to the derivatives by the other joints must vanish. Gauss-Newton steps achieve this (variable
    /// projection: G. Golub, V. Pereyra 1973). The weight of the equations themselves decreases to zero over the steps.
    pub fn freed(&mut self, mut q: Joints<M>, free: u32) -> Option<Joints<M>> {
        for share in POLISHING.freeing {
            let step = self.freeing_step(&q, free, share)?;
            let is_near = self.facts().longest(step.as_ref()) <= LEAPS[0];
            if !is_near {
                return None;
            }
            q = stepped::<M>(&self.facts(), &q, &step);
        }
        Some(q)
    }

    fn freeing_step(&mut self, q: &Joints<M>, free: u32, share: f64) -> Option<Joints<M>> {
        let (rows, joints) = (self.shared(q).0, self.joints());
        let (missed, direction) = self.across(&rows, &rows, free.trailing_zeros() as usize, free)?;
        let bends = self.bends(q, &direction);
        let nearer = self.shares(q, PIVOTS.regular, free);
        let mut triangle = self.no_triangle();
        for i in 0..=joints {
            if i == joints {
                fill(triangle.column_mut(i), &missed);
            } else if !is_in(free, i) {
                fill(triangle.column_mut(i), &self.across(&rows, &bends, i, free)?.0);
            }
            let below = &mut triangle.column_mut(i)[self.facts().size_of.len()..];
            below.iter_mut().enumerate().take(i + 1).for_each(|(k, entry)| *entry = share * nearer.entry(i, k));
        }
        triangle.reflect();
        triangle.substituted()
    }

    /// The component of a column orthogonal to the derivatives by the joints that are not `free`, and the joint velocities that cancel the rest. The velocity
    /// of the column's joint is one.
    fn across(
        &mut self,
        rows: &Equations<M, Joints<M>>,
        columns: &Equations<M, Joints<M>>,
        column: usize,
        free: u32,
    ) -> Option<(Equations<M>, Joints<M>)> {
        let count = self.facts().size_of.len();
        let whole: Equations<M> = Array::by(count, |i| columns.as_ref()[i].as_ref()[column]);
        let triangle: Triangle<M> = self.triangle_of(rows, &whole, POLISHING.dampings[1], free);
        let along = triangle.substituted()?;
        let rest = |i: usize| {
            let of_joints = rows.as_ref()[i].as_ref().iter().zip(along.as_ref()).enumerate();
            of_joints.fold(whole.as_ref()[i], |sum, (k, (x, y))| if is_in(free, k) { sum } else { sum - x * y })
        };
        let direction = Array::by(self.joints(), |k| match k {
            k if k == column => 1.0,
            k if is_in(free, k) => 0.0,
            k => -along.as_ref()[k],
        });
        Some((Array::by(count, rest), direction))
    }

    /// The change of the Jacobian along a displacement of the joints.
    fn bends(&self, q: &Joints<M>, direction: &Joints<M>) -> Equations<M, Joints<M>> {
        let width = POLISHING.difference / f64::max(self.facts().longest(direction.as_ref()), 1.0);
        let moved = |by: f64| {
            let part: Joints<M> = Array::by(self.joints(), |i| by * direction.as_ref()[i]);
            self.shared(&shifted::<M>(&self.facts(), q, &part)).0
        };
        let (ahead, behind) = (moved(width), moved(-width));
        Array::by(self.facts().size_of.len(), |i| {
            let change = |k: usize| ahead.as_ref()[i].as_ref()[k] - behind.as_ref()[i].as_ref()[k];
            Array::by(self.joints(), |k| change(k) / (2.0 * width))
        })
    }
}

/// Writes a column's upper part.
fn fill(column: &mut [f64], values: &impl AsRef<[f64]>) {
    column.iter_mut().zip(values.as_ref()).for_each(|(entry, value)| *entry = *value);
}
