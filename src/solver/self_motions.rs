//! Whether answers are members of a self-motion, and of which: free joints are moved, and the others follow.

use super::answers::Answers;
use super::refine::{self, Fit, Joints, NONE_FREE, difference};
use super::{ARRIVED, ASIDE, DOUBLINGS, MAX_JOINTS, NARROWS, REGULAR, ROUNDING, SINGULAR, STAGES};
use crate::kinematics::Solution;

impl Answers<'_> {
    /// Whether the equations hold too, within `bound` or rounding, where the joints `free` are elsewhere and the others follow, to one
    /// side at least: to the other there may be a branching. Where `q` is not singular that is not tried. A self-motion may go round a small
    /// part of the circle only: where `q` is singular within rounding, shorter ways are tried as well, each an eighth of the one before.
    pub(super) fn lies_on_self_motion(&mut self, q: &[f64], free: &[usize], bound: f64) -> bool {
        let regularity = refine::regularity(self.program, &padded(q), &mut self.frame);
        self.leads_to_self_motion(q, free, bound, regularity)
    }

    /// A joint that lies alone on a self-motion, as [`Answers::lies_on_self_motion`] says, the first of those that some case frees.
    pub(super) fn joint_on_self_motion(&mut self, q: &[f64], bound: f64) -> Option<usize> {
        let mut freed = self.program.freed().peekable();
        freed.peek()?;
        let regularity = refine::regularity(self.program, &padded(q), &mut self.frame);
        freed.find(|&joint| self.leads_to_self_motion(q, &[joint], bound, regularity))
    }

    fn leads_to_self_motion(&mut self, q: &[f64], free: &[usize], bound: f64, regularity: f64) -> bool {
        let (mut way, bound) = (ASIDE, bound.max(ROUNDING));
        if regularity > REGULAR {
            return false;
        }
        for narrow in 0..NARROWS {
            if narrow == 1 && (bound > ROUNDING || regularity > SINGULAR) {
                return false;
            }
            if [way, -way].into_iter().any(|way| self.leads_aside(q, free, way, bound)) {
                return true;
            }
            way /= 8.0;
        }
        false
    }

    /// The same for one way, which is doubled until it is that long, and from where it is short the joints must come back: an isolated
    /// answer may be led to a self-motion next to it, but not back.
    fn leads_aside(&mut self, q: &[f64], free: &[usize], way: f64, bound: f64) -> bool {
        let mut at = padded(q);
        let mut before = at;
        for stage in 0..DOUBLINGS {
            let share = 0.5_f64.powi((DOUBLINGS - 1 - stage) as i32);
            let mut next = self.beyond(&before, &at, if stage == 1 { 1.0 } else { 2.0 });
            free.iter().for_each(|&joint| next[joint] = self.displaced(q[joint], joint, share * way));
            if self.follow(&mut next, free).relative > bound
                || (stage == 1 && !self.leads_back(q, free, &at, &next, bound))
            {
                return false;
            }
            (before, at) = (at, next);
        }
        true
    }

    /// Whether the joints come back to `q` on along the line from `far` through `near`.
    fn leads_back(&mut self, q: &[f64], free: &[usize], near: &Joints, far: &Joints, bound: f64) -> bool {
        let mut back = self.beyond(far, near, 1.0);
        free.iter().for_each(|&joint| back[joint] = q[joint]);
        self.follow(&mut back, free).accepted && self.are_joined(&back, q, bound, &held(free))
    }

    /// The joints beyond `b` on the line from `a`, by `ahead` times their distance.
    fn beyond(&self, a: &Joints, b: &Joints, ahead: f64) -> Joints {
        let mut beyond = *b;
        for (joint, slot) in beyond.iter_mut().enumerate().take(self.program.joints.len()) {
            *slot += ahead * difference(self.program, joint, b, a);
        }
        beyond
    }

    /// Whether the self-motion of the answer with this index has `member`, another with the same free joints: as these move there in
    /// stages, the other joints follow. Two self-motions may be next to each other: half-way from where that ends to `member` the equations
    /// hold too.
    pub(super) fn leads_to(&mut self, other: usize, member: &Solution) -> bool {
        let mut q = padded(&self.list[other].solution.q);
        let mut accepted = false;
        for stages in (1..=STAGES).rev() {
            for &joint in &member.free {
                q[joint] += difference(self.program, joint, &member.q, &q) / stages as f64;
            }
            accepted = self.follow(&mut q, &member.free).accepted;
        }
        accepted
            && self.are_near(&q, &member.q, ARRIVED)
            && self.are_joined(&q, &member.q, ROUNDING, &held(&member.free))
    }

    /// Polishes joints of which `free` ones stay where they are.
    fn follow(&mut self, q: &mut Joints, free: &[usize]) -> Fit {
        refine::polished(self.program, q, &held(free), &mut self.frame)
    }
}

/// Joint values with zeros behind them.
fn padded(q: &[f64]) -> Joints {
    let mut padded = [0.0; MAX_JOINTS];
    padded[..q.len()].copy_from_slice(q);
    padded
}

/// By joint whether it is among `joints`.
fn held(joints: &[usize]) -> [bool; MAX_JOINTS] {
    let mut held = NONE_FREE;
    joints.iter().for_each(|&joint| held[joint] = true);
    held
}
