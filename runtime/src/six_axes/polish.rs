//! Forward kinematics of the chain, and its solution by Newton's method ([`Chain::polish`]).

use core::array::from_fn;

use super::chain::Chain;
use super::linear::solve;
use super::rigid::Rigid;
use super::vector::{Vector, add, cosines_and_sines, cross, dot, norm, product, scale, size, sub, turn};
use crate::arithmetic::Arithmetic;
use crate::tolerances::{PIVOTS, POLISHING, SELF_MOTIONS};

/// Maximal number of Newton steps: at a singular pose each one only halves the residual.
const STEPS: usize = 40;
/// A residual below which no further step is tried: a pose has more rounding than an equation.
pub(super) const EXACT: f64 = 2.0 * POLISHING.done;
/// Maximal number of times that steps are shortened, over all steps.
const SHORTENED: usize = 12;
/// A step that moves a joint by more than this is shortened.
pub(super) const LONGEST: f64 = 0.5;

/// Forward kinematics of a joint vector.
pub(super) struct Reach {
    axes: [Vector; 6],
    origins: [Vector; 6],
    pub end: Rigid,
}

impl Reach {
    /// The pose error to a target: translation relative to the length scale, and rotation (rad).
    #[inline(always)]
    pub fn miss(&self, target: &Rigid) -> [f64; 6] {
        let position = sub(&target.translation, &self.end.translation);
        let turn = |index: usize| cross(&self.end.column(index), &target.column(index));
        let turn = scale(&add(&add(&turn(0), &turn(1)), &turn(2)), 0.5);
        let cosine = |index: usize| dot(&self.end.column(index), &target.column(index));
        let turn = if cosine(0) + cosine(1) + cosine(2) < 1.0 { obtuse(&turn) } else { turn };
        [position[0], position[1], position[2], turn[0], turn[1], turn[2]]
    }
}

/// The error for a rotation by more than a right angle, given its sine along its axis. Its length is two minus the sine, which is not zero at half a turn
/// either.
#[cold]
fn obtuse(turn: &Vector) -> Vector {
    let sine = Arithmetic::sqrt(dot(turn, turn));
    if sine > PIVOTS.regular { scale(turn, (2.0 - sine) / sine) } else { [2.0, 0.0, 0.0] }
}

/// A joint vector and its pose error.
struct Trial {
    q: [f64; 6],
    reach: Reach,
    miss: [f64; 6],
    /// The largest component of the error.
    residual: f64,
}

impl Chain {
    #[inline(always)]
    pub(super) fn reach(&self, q: &[f64; 6]) -> Reach {
        let (mut axes, mut origins) = ([[0.0; 3]; 6], [[0.0; 3]; 6]);
        let (mut frame, moves) = (self.steps[0], cosines_and_sines(q));
        for joint in 0..6 {
            frame = if joint == 0 { frame } else { frame.after(&self.steps[joint]) };
            (axes[joint], origins[joint]) = (frame.column(2), frame.translation);
            frame = self.moved(&frame, joint, q, &moves);
        }
        Reach { axes, origins, end: frame }
    }

    /// A frame that a joint moves, given all cosines and sines.
    #[inline(always)]
    fn moved(&self, frame: &Rigid, joint: usize, q: &[f64; 6], [c, s]: &[[f64; 6]; 2]) -> Rigid {
        if self.slides[joint] { frame.then_slid(q[joint]) } else { frame.then_turned([c[joint], s[joint]]) }
    }

    /// The value of `joint` that brings the last joint's frame nearest to a target, given the other joints.
    pub(super) fn closing(&self, q: &[f64; 6], joint: usize, target: &Rigid) -> f64 {
        let (mut before, moves) = (self.steps[0], cosines_and_sines(q));
        for k in 0..joint {
            before = self.moved(&before, k, q, &moves).after(&self.steps[k + 1]);
        }
        let mut behind = Rigid::NONE;
        for k in joint + 1..6 {
            behind = self.moved(&behind.after(&self.steps[k]), k, q, &moves);
        }
        let motion = before.inverse().after(target).after(&behind.inverse());
        let r = motion.rotation;
        if self.slides[joint] { motion.translation[2] } else { turn(r[0][0] + r[1][1], r[1][0] - r[0][1]) }
    }

    /// Takes Newton steps from `q` to a target, shortened where the residual increases. Returns the residual before and after them.
    pub(super) fn polish(&self, q: &mut [f64; 6], target: &Rigid) -> (f64, f64) {
        let mut at = self.trial(*q, target);
        let start = at.residual;
        let mut shortened = 0;
        for _ in 0..STEPS {
            let known = at.residual;
            if known <= EXACT || !known.is_finite() {
                break;
            }
            let Some(step) = self.newton(&at) else { break };
            let next = self.stepped(&at, &step, target, &mut shortened);
            if next.residual >= known {
                break;
            }
            at = next;
            if at.residual > 0.5 * known && at.residual <= SELF_MOTIONS.member {
                break;
            }
        }
        *q = at.q;
        (start, at.residual)
    }

    #[inline(always)]
    fn trial(&self, q: [f64; 6], target: &Rigid) -> Trial {
        let reach = self.reach(&q);
        let miss = reach.miss(target);
        Trial { q, reach, miss, residual: size(&miss) }
    }

    /// The end of a step, shortened until its residual is smaller.
    #[inline(always)]
    fn stepped(&self, at: &Trial, step: &[f64; 6], target: &Rigid, shortened: &mut usize) -> Trial {
        let mut share = 1.0;
        loop {
            let next = self.trial(from_fn(|joint| at.q[joint] + share * step[joint]), target);
            if next.residual < at.residual || at.residual <= SELF_MOTIONS.member || *shortened >= SHORTENED {
                return next;
            }
            (share, *shortened) = (0.25 * share, *shortened + 1);
        }
    }

    /// The Jacobian: derivatives of the last frame's position and rotation by the joints, in columns.
    #[inline(always)]
    pub(super) fn jacobian(&self, reach: &Reach) -> [[f64; 6]; 6] {
        let mut matrix = [[0.0; 6]; 6];
        for (joint, (axis, origin)) in reach.axes.iter().zip(&reach.origins).enumerate() {
            let arm = sub(&reach.end.translation, origin);
            let (position, turn) = if self.slides[joint] { (*axis, [0.0; 3]) } else { (cross(axis, &arm), *axis) };
            for k in 0..3 {
                (matrix[k][joint], matrix[3 + k][joint]) = (position[k], turn[k]);
            }
        }
        matrix
    }

    /// A Newton step, at most [`LONGEST`] long.
    #[inline(always)]
    fn newton(&self, at: &Trial) -> Option<[f64; 6]> {
        let (matrix, mut rows) = (self.jacobian(&at.reach), [[0.0; 8]; 6]);
        for (row, (entries, miss)) in rows.iter_mut().zip(matrix.iter().zip(at.miss)) {
            row[..6].copy_from_slice(entries);
            row[6] = miss;
        }
        if solve(&mut rows) <= 0.0 {
            return None;
        }
        let step = rows.map(|row| row[6]);
        let longest = size(&step);
        let share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
        longest.is_finite().then(|| step.map(|entry| share * entry))
    }

    /// Joints whose motion the joints after them compensate, to first order: their columns of the Jacobian depend on the later columns.
    pub(super) fn free(&self, q: &[f64; 6]) -> [bool; 6] {
        let matrix = self.jacobian(&self.reach(q));
        let (mut kept, mut count, mut free) = ([[0.0; 6]; 6], 0, [false; 6]);
        for joint in (0..6).rev() {
            let mut column = matrix.map(|row| row[joint]);
            let whole = norm(&column);
            for _ in 0..2 {
                for direction in &kept[..count] {
                    let share = product(direction, &column);
                    column.iter_mut().zip(direction).for_each(|(entry, over)| *entry -= share * over);
                }
            }
            let left = norm(&column);
            free[joint] = left <= PIVOTS.regular * whole;
            if !free[joint] {
                kept[count] = column.map(|entry| entry / left);
                count += 1;
            }
        }
        free
    }
}
