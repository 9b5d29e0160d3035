//! Whether answers are members of a self-motion, and of which: free joints are moved, and the others follow.

use crate::joints::{beyond, differences, is_in, moved};
use crate::mechanism::{Joints, Mechanism};
use crate::problem::{End, Problem};
use crate::tolerances::{ARRIVED, ASIDE, DOUBLINGS, NARROWS, REGULAR, ROUNDING, SINGULAR, STAGES};

impl<M: Mechanism> Problem<'_, M> {
    /// Whether the equations hold too, within `bound` or rounding, where the joints `free` are elsewhere and the others follow, to one side at
    /// least: to the other there may be a branching. Where `q` is not singular that is not tried. A self-motion may go round a small part of the
    /// circle only: where `q` is singular within rounding, shorter ways are tried as well, each an eighth of the one before.
    pub fn lies_on_self_motion(&self, q: &Joints<M>, free: u32, bound: f64) -> bool {
        self.leads_to_self_motion(q, free, bound, self.regularity(q))
    }

    /// The same within rounding, but for self-motions that go round a small part of the circle only.
    pub fn lies_on_long_self_motion(&self, q: &Joints<M>, free: u32) -> bool {
        let leads = |way: f64| self.leads_aside(q, free, way, ROUNDING);
        self.regularity(q) <= REGULAR && (leads(ASIDE) || leads(-ASIDE))
    }

    /// A joint that lies alone on a self-motion, the first of those that some case frees; as a set.
    pub fn joint_on_self_motion(&self, q: &Joints<M>, bound: f64) -> Option<u32> {
        if self.facts().freed.is_empty() {
            return None;
        }
        let regularity = self.regularity(q);
        let mut alone = self.facts().freed.iter().map(|joint| 1 << joint);
        alone.find(|free| self.leads_to_self_motion(q, *free, bound, regularity))
    }

    fn leads_to_self_motion(&self, q: &Joints<M>, free: u32, bound: f64, regularity: f64) -> bool {
        let (mut way, bound) = (ASIDE, f64::max(bound, ROUNDING));
        if regularity > REGULAR {
            return false;
        }
        for narrow in 0..NARROWS {
            if narrow == 1 && (bound > ROUNDING || regularity > SINGULAR) {
                return false;
            }
            if self.leads_aside(q, free, way, bound) || self.leads_aside(q, free, -way, bound) {
                return true;
            }
            way /= 8.0;
        }
        false
    }

    /// The same for one way, which is doubled until it is that long, and from where it is short the joints must come back: an isolated answer
    /// may be led to a self-motion next to it, but not back.
    fn leads_aside(&self, q: &Joints<M>, free: u32, way: f64, bound: f64) -> bool {
        let (mut before, mut at) = (q.clone(), q.clone());
        let mut share = 1.0;
        for _ in 1..DOUBLINGS {
            share *= 0.5;
        }
        for stage in 0..DOUBLINGS {
            let mut next = beyond::<M>(&self.facts(), &before, &at, if stage == 1 { 1.0 } else { 2.0 });
            for i in (0..self.joints()).filter(|&i| is_in(free, i)) {
                next.as_mut()[i] = moved::<M>(&self.facts(), q, i, share * way).as_ref()[i];
            }
            let (next, fit) = self.polished(next, free);
            if fit.relative > bound || (stage == 1 && !self.leads_back(q, free, &at, &next, bound)) {
                return false;
            }
            (before, at) = (at, next);
            share *= 2.0;
        }
        true
    }

    /// Whether the joints come back to `q` on along the line from `far` through `near`.
    fn leads_back(&self, q: &Joints<M>, free: u32, near: &Joints<M>, far: &Joints<M>, bound: f64) -> bool {
        let mut back = beyond::<M>(&self.facts(), far, near, 1.0);
        for i in (0..self.joints()).filter(|&i| is_in(free, i)) {
            back.as_mut()[i] = q.as_ref()[i];
        }
        let (back, fit) = self.polished(back, free);
        fit.accepted && self.are_joined(&back, q, bound, free)
    }

    /// Whether the self-motion of `a` has the member `b`, with the same free joints: as these move there in stages, the other joints follow. Two
    /// self-motions may be next to each other: half-way from where that ends to `b` the equations hold too.
    pub fn leads_to(&self, a: &Joints<M>, b: &Joints<M>, free: u32) -> bool {
        let mut q = a.clone();
        let mut accepted = false;
        for stages in (1..=STAGES).rev() {
            let way = differences::<M>(&self.facts(), b, &q);
            for i in (0..self.joints()).filter(|&i| is_in(free, i)) {
                q.as_mut()[i] += way.as_ref()[i] / stages as f64;
            }
            let end: End<M> = self.polished(q, free);
            (q, accepted) = (end.0, end.1.accepted);
        }
        accepted && self.facts().is_within(q.as_ref(), b.as_ref(), ARRIVED) && self.are_joined(&q, b, ROUNDING, free)
    }
}
