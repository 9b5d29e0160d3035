//! Results of solving: [`Solution`], [`Pairs`], [`Error`].

use core::fmt;

use crate::mechanism::{Joints, Mechanism};
use crate::storage::{Array, Storage};

/// One solution.
pub struct Solution<M: Mechanism> {
    /// Joint values, in the order of the joints: rad in (-pi, pi], or the unit of lengths.
    pub q: Joints<M>,
    /// The largest magnitude among the equations' values at `q`, in the equations' own unit.
    pub residual: f64,
    /// The largest value of an equation relative to its size.
    pub relative: f64,
    /// Number of the combination of cases and roots.
    pub branch: usize,
    /// Whether the source of the mechanism would select this solution.
    pub chosen: bool,
    /// Bit `j` is set where joint `j` is free: this is one member of a self-motion.
    pub free: u32,
    /// False where the [steps](crate::MOST_STEPS) of the target were used up before all work was done. This holds for all of its solutions, and
    /// others may be missing. [`Solution::relative`] is then at most `tolerances::ACCEPTANCE.unsettled`.
    pub settled: bool,
}

/// One solution by cosines and sines.
pub struct Pairs<M: Mechanism> {
    /// By joint: the cosine and the sine of an angle, or a length's value and zero.
    pub joints: Joints<M, [f64; 2]>,
    /// Same as [`Solution::residual`].
    pub residual: f64,
    /// Same as [`Solution::branch`].
    pub branch: usize,
    /// Same as [`Solution::free`].
    pub free: u32,
    /// Same as [`Solution::settled`].
    pub settled: bool,
}

impl<M: Mechanism> Solution<M> {
    /// An empty entry, with which a buffer is filled.
    pub fn empty(mechanism: &M) -> Self {
        let q = Array::by(mechanism.facts().joints.len(), |_| 0.0);
        Solution { q, residual: 0.0, relative: 0.0, branch: 0, chosen: false, free: 0, settled: true }
    }

    /// Whether a joint is free.
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
    /// An empty entry, with which a buffer is filled.
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

/// Reasons why a target has no solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A target number is infinite or NaN.
    NotFinite,
    /// The rotation of the target is not orthogonal within `tolerances::ACCEPTANCE.input`.
    NotRotation,
    /// The direction of the target does not have length one within `tolerances::ACCEPTANCE.input`.
    NotUnit,
    /// The target is on the stratum with this number, for which no derivation exists.
    OpenStratum(usize),
    /// The [steps](crate::MOST_STEPS) of the target were used up before a solution was found. Solutions may exist.
    Unsettled,
    /// The task is not the pose of one tip. The base and the tool cannot be removed from the target.
    NotPose,
    /// The limits of the joint with this number are not in order, or NaN.
    Limits(usize),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NotFinite => f.write_str("a target number is infinite or NaN; all must be finite"),
            Error::NotRotation => f.write_str(
                "the rotation of the target is not orthogonal within 1e-9; give a right-handed rotation matrix",
            ),
            Error::NotUnit => {
                f.write_str("the direction of the target does not have length one within 1e-9; give a unit vector")
            }
            Error::Unsettled => {
                f.write_str("the steps of the target were used up before a solution was found; allow more steps")
            }
            Error::OpenStratum(number) => {
                write!(f, "the target is on stratum {number}, for which no derivation exists")
            }
            Error::Limits(joint) => {
                write!(f, "the limits of joint {joint} are not in order; the lower limit must be at most the upper one")
            }
            Error::NotPose => {
                f.write_str("the task is not the pose of one tip; give the target in the frame of the base")
            }
        }
    }
}

impl core::error::Error for Error {}
