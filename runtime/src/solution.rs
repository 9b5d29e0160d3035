//! What solving gives: [`Solution`], [`Pairs`], [`Error`].

use core::fmt;

use crate::mechanism::{Joints, Mechanism};
use crate::storage::{Array, Storage};

/// One answer.
pub struct Solution<M: Mechanism> {
    /// Joint values, in the order of the joints: rad in (-pi, pi], or the unit of lengths.
    pub q: Joints<M>,
    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    pub residual: f64,
    /// The largest share of an equation's value in its size.
    pub relative: f64,
    /// Which cases and which roots gave it.
    pub branch: usize,
    /// Whether the source of the mechanism would choose this one.
    pub chosen: bool,
    /// Bit `j` is set where joint `j` may take any value here: this is one member of a self-motion.
    pub free: u32,
    /// False where the [steps](crate::tolerances::MOST_STEPS) of the target were spent before all work was done. All of its answers say so: others may be
    /// missing, and [`Solution::relative`] tells how well each holds, at most [`crate::tolerances::UNSETTLED`].
    pub settled: bool,
}

/// One answer by cosines and sines.
pub struct Pairs<M: Mechanism> {
    /// By joint: the cosine and the sine of an angle; a length's value and zero.
    pub joints: Joints<M, [f64; 2]>,
    /// As in [`Solution`].
    pub residual: f64,
    /// As in [`Solution`].
    pub branch: usize,
    /// As in [`Solution`].
    pub free: u32,
    /// As in [`Solution`].
    pub settled: bool,
}

impl<M: Mechanism> Solution<M> {
    /// No answer yet: what a buffer is filled with.
    pub fn empty(mechanism: &M) -> Self {
        let q = Array::by(mechanism.facts().joints.len(), |_| 0.0);
        Solution { q, residual: 0.0, relative: 0.0, branch: 0, chosen: false, free: 0, settled: true }
    }

    /// Whether a joint may take any value here.
    pub fn is_free(&self, joint: usize) -> bool {
        crate::joints::is_in(self.free, joint)
    }

    /// Whether no joint is free.
    #[inline(always)]
    pub fn is_isolated(&self) -> bool {
        self.free == 0
    }
}

impl<M: Mechanism> Pairs<M> {
    /// No answer yet: what a buffer is filled with.
    pub fn empty(mechanism: &M) -> Self {
        let joints = Array::by(mechanism.facts().joints.len(), |_| [0.0; 2]);
        Pairs { joints, residual: 0.0, branch: 0, free: 0, settled: true }
    }
}

impl<M: Mechanism> Clone for Solution<M> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Solution { q: self.q.clone(), ..*self }
    }
}

impl<M: Mechanism> Copy for Solution<M> where <M::Storage as Storage>::Joints<f64>: Copy {}

impl<M: Mechanism> fmt::Debug for Solution<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solution")
            .field("q", &self.q.as_ref())
            .field("residual", &self.residual)
            .field("relative", &self.relative)
            .field("branch", &self.branch)
            .field("chosen", &self.chosen)
            .field("free", &self.free)
            .field("settled", &self.settled)
            .finish()
    }
}

impl<M: Mechanism> PartialEq for Solution<M> {
    fn eq(&self, other: &Self) -> bool {
        let rest = |s: &Self| (s.branch, s.chosen, s.free, s.settled);
        self.q.as_ref() == other.q.as_ref()
            && [self.residual, self.relative] == [other.residual, other.relative]
            && rest(self) == rest(other)
    }
}

impl<M: Mechanism> Clone for Pairs<M> {
    #[inline(always)]
    fn clone(&self) -> Self {
        Pairs { joints: self.joints.clone(), ..*self }
    }
}

impl<M: Mechanism> Copy for Pairs<M> where <M::Storage as Storage>::Joints<[f64; 2]>: Copy {}

impl<M: Mechanism> fmt::Debug for Pairs<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pairs")
            .field("joints", &self.joints.as_ref())
            .field("residual", &self.residual)
            .field("branch", &self.branch)
            .field("free", &self.free)
            .field("settled", &self.settled)
            .finish()
    }
}

impl<M: Mechanism> PartialEq for Pairs<M> {
    fn eq(&self, other: &Self) -> bool {
        self.joints.as_ref() == other.joints.as_ref()
            && (self.residual, self.branch, self.free, self.settled)
                == (other.residual, other.branch, other.free, other.settled)
    }
}

/// Why a target has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A number of the target is infinite or not a number.
    NotFinite,
    /// The rotation of the target is off by more than [`crate::tolerances::CONSISTENT`].
    NotRotation,
    /// The direction of the target is not of length one within [`crate::tolerances::CONSISTENT`].
    NotUnit,
    /// The target lies on the stratum with this number, which could not be derived.
    OpenStratum(usize),
    /// The [steps](crate::tolerances::MOST_STEPS) of the target were spent before an answer was found: there may be some.
    Unsettled,
    /// The task is not the pose of one tip: base and tool cannot be taken off the target.
    NotPose,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NotFinite => f.write_str("a number of the target is infinite or not a number; give finite ones"),
            Error::NotRotation => {
                f.write_str("the rotation of the target is off by more than 1e-9; give a right-handed rotation matrix")
            }
            Error::NotUnit => {
                f.write_str("the direction of the target is not of length one within 1e-9; give a unit vector")
            }
            Error::Unsettled => {
                f.write_str("the steps of the target were spent before an answer was found; allow more of them")
            }
            Error::NotPose => {
                f.write_str("the task is not the pose of one tip; give the target in the frame of the base")
            }
            Error::OpenStratum(number) => write!(f, "the target lies on stratum {number}, which could not be derived"),
        }
    }
}

impl core::error::Error for Error {}
