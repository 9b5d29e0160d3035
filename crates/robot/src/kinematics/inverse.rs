//! What every inverse-kinematics solver is: [`InverseKinematics`], and what it answers: [`Solution`].

use std::fmt;

use serde::Serialize;

use super::Target;
use crate::Result;

/// One answer: joint values that bring the tip to its target.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solution {
    /// The joint values, base to tip: radians in (-pi, pi], lengths in the solver's unit; zero for a free joint.
    pub q: Vec<f64>,
    /// The largest miss, measured at `q`: of the equations of a derived solver, in their own unit; of other solvers the distance of the tip
    /// from its target in the chain's unit, or its angle \[rad\]. [`Target::missed`] gives both.
    pub residual: f64,
    /// Which roots of which equations it comes from: a branch keeps its number from target to target.
    pub branch: usize,
    /// The joints, from 0, for which every value does it (the others changing along with it) at this singular pose.
    pub free: Vec<usize>,
    /// Whether the source of the mechanism would choose this one.
    pub chosen: bool,
    /// False where the steps of polishing that the target may take were spent before all work was done
    /// ([`MOST_STEPS`](groebot_runtime::tolerances::MOST_STEPS)). All its answers say so: others may be missing, and the residual tells how well each holds.
    pub settled: bool,
}

impl Default for Solution {
    fn default() -> Self {
        Solution { q: Vec::new(), residual: 0.0, branch: 0, free: Vec::new(), chosen: false, settled: true }
    }
}

/// A solver of inverse kinematics: derived, printed, by screw theory or by search.
pub trait InverseKinematics: fmt::Debug + Send + Sync {
    /// Puts all joint values that bring the tip to `target` into `out`, in place of what is there; none when it is out of reach. `given` are the
    /// values of the joints whose values the user gives. Joint limits are not looked at.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) for a target of another task than the solver's, with a number that is not finite or a
    /// rotation that is none, and unless each given joint has a finite value.
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()>;
}
