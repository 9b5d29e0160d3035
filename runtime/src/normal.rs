//! Normal equations of Newton steps, for one candidate or several at once. Main type: [`Normal`].

use crate::mechanism::{Joints, Mechanism, Shorts};
use crate::number::Number;
use crate::storage::Array;
use crate::tolerances::PIVOTS;

#[inline(always)]
fn dot<M: Mechanism, N: Number>(a: &Shorts<M, N>, b: &Shorts<M, N>) -> N {
    a.as_ref().iter().zip(b.as_ref()).fold(N::of(0.0), |sum, (a, b)| sum + *a * *b)
}

/// Normal equations `J^T J`, eliminated without pivoting.
pub(crate) struct Normal<M: Mechanism, N: Number> {
    columns: Joints<M, Shorts<M, N>>,
    /// The factors of the elimination are below the diagonal.
    square: Joints<M, Joints<M, N>>,
    inverse: Joints<M, N>,
    /// The least pivot, relative to the size of the equations.
    pub pivot: N,
    /// The largest pivot.
    pub most: N,
}

impl<M: Mechanism, N: Number> Normal<M, N> {
    /// The normal equations of these derivatives by each joint. `sound` becomes zero where a pivot is small.
    #[inline(always)]
    pub fn new(columns: Joints<M, Shorts<M, N>>, joints: usize, sound: &mut N) -> Self {
        let none = N::of(0.0);
        let mut square: Joints<M, Joints<M, N>> = Array::by(joints, |_| Array::by(joints, |_| none));
        let mut inverse: Joints<M, N> = Array::by(joints, |_| none);
        let (mut size, mut least, mut most) = (none, N::of(f64::INFINITY), none);
        for i in 0..joints {
            for j in 0..=i {
                square.as_mut()[i].as_mut()[j] = dot::<M, N>(&columns.as_ref()[i], &columns.as_ref()[j]);
            }
            size = size.greater(square.as_ref()[i].as_ref()[i]);
        }
        let rows = square.as_mut();
        for k in 0..joints {
            let pivot = rows[k].as_ref()[k];
            *sound = sound.where_below(size * PIVOTS.regular - pivot, 0.0);
            (least, most) = (least.lesser(pivot), most.greater(pivot));
            inverse.as_mut()[k] = N::of(1.0) / pivot;
            for i in k + 1..joints {
                let factor = rows[i].as_ref()[k] * inverse.as_ref()[k];
                for j in k + 1..=i {
                    let taken = factor * rows[j].as_ref()[k];
                    rows[i].as_mut()[j] = rows[i].as_ref()[j] - taken;
                }
            }
        }
        Normal { columns, square, inverse, pivot: least / size, most }
    }

    /// The step `(J^T J)^-1 J^T f`.
    #[inline(always)]
    pub fn step(&self, value: &Shorts<M, N>) -> Joints<M, N> {
        self.solved(Array::by(self.inverse.as_ref().len(), |i| dot::<M, N>(&self.columns.as_ref()[i], value)))
    }

    /// `(J^T J)^-1` times a vector.
    #[inline(always)]
    pub fn solved(&self, mut step: Joints<M, N>) -> Joints<M, N> {
        let (square, inverse) = (self.square.as_ref(), self.inverse.as_ref());
        let joints = inverse.len();
        let delta = step.as_mut();
        for k in 0..joints {
            for i in k + 1..joints {
                delta[i] = delta[i] - square[i].as_ref()[k] * inverse[k] * delta[k];
            }
        }
        for k in (0..joints).rev() {
            let above = (k + 1..joints).fold(delta[k], |sum, j| sum - square[j].as_ref()[k] * delta[j]);
            delta[k] = above * inverse[k];
        }
        step
    }
}
