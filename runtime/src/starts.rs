//! Start points of continuation along curves: [`Starts`].

use crate::joints::{beyond, differences};
use crate::mechanism::{Facts, Found, Joints, Mechanism};
use crate::tolerances::MERGING;

/// Maximal number of stored starts.
const ROOM: usize = 32;
/// Maximal number of crossings at which other curves are searched for.
const CROSSINGS: usize = 16;

/// Starts of walks: the candidates, and joint values on the curves next to them.
pub(crate) struct Starts<M: Mechanism> {
    pub list: [Option<(Found, Joints<M>)>; ROOM],
    pub count: usize,
    /// Crossings of curves that have been searched for other curves.
    crossings: [Option<Joints<M>>; CROSSINGS],
}

impl<M: Mechanism> Starts<M> {
    pub const NONE: Self = Starts { list: [const { None }; ROOM], count: 0, crossings: [const { None }; CROSSINGS] };

    pub fn is_full(&self) -> bool {
        self.count == ROOM
    }

    /// Adds a start if there is [room](Starts::is_full).
    pub fn add(&mut self, found: Found, q: Joints<M>) {
        self.list[self.count] = Some((found, q));
        self.count += 1;
    }

    /// Removes the first start that is left.
    pub fn take(&mut self) -> Option<(Found, Joints<M>)> {
        self.list[..self.count].iter_mut().find_map(Option::take)
    }

    /// Adds a start in the place of one that has been removed, or after the last one.
    pub fn insert(&mut self, found: Found, q: Joints<M>) {
        let place = self.list.iter().position(Option::is_none);
        if let Some(place) = place {
            self.list[place] = Some((found, q));
            self.count = self.count.max(place + 1);
        }
    }

    /// Stores a crossing of curves. Returns whether it is new, farther than `within` from the others, and there is room.
    pub fn is_new_crossing(&mut self, facts: &Facts<'_>, q: &Joints<M>, within: f64) -> bool {
        let is_near = |other: &Joints<M>| facts.farthest(other.as_ref(), q.as_ref()) <= within;
        if self.crossings.iter().flatten().any(is_near) {
            return false;
        }
        let free = self.crossings.iter_mut().find(|crossing| crossing.is_none());
        free.map(|crossing| *crossing = Some(q.clone())).is_some()
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
