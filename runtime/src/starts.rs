//! Start points of continuation along curves: [`Starts`].

use crate::joints::{beyond, differences};
use crate::mechanism::{Facts, Found, Joints, Mechanism};
use crate::tolerances::MERGING;

/// Maximal number of stored starts.
const ROOM: usize = 32;

/// Starts of walks: the candidates, and joint values on the curves next to them.
pub(crate) struct Starts<M: Mechanism> {
    pub list: [Option<(Found, Joints<M>)>; ROOM],
    pub count: usize,
}

impl<M: Mechanism> Starts<M> {
    pub const NONE: Self = Starts { list: [const { None }; ROOM], count: 0 };

    pub fn is_full(&self) -> bool {
        self.count == ROOM
    }

    /// Adds a start if there is [room](Starts::is_full).
    pub fn add(&mut self, found: Found, q: Joints<M>) {
        self.list[self.count] = Some((found, q));
        self.count += 1;
    }

    /// Removes the starts that a step passes.
    pub fn pass(&mut self, facts: &Facts<'_>, from: &Joints<M>, to: &Joints<M>) {
        let delta = differences::<M>(facts, to, from);
        for start in &mut self.list[..self.count] {
            let is_passed = |(_, q): &(Found, Joints<M>)| {
                let aside = differences::<M>(facts, q, from);
                let share = product(aside.as_ref(), delta.as_ref()) / product(delta.as_ref(), delta.as_ref());
                let share = share.clamp(0.0, 1.0);
                let nearest = beyond::<M>(facts, to, from, -share);
                facts.farthest(q.as_ref(), nearest.as_ref()) <= MERGING.known
            };
            if start.as_ref().is_some_and(is_passed) {
                *start = None;
            }
        }
    }
}

/// The scalar product.
pub(crate) fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}
