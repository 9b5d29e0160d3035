//! The trait of all inverse-kinematics solvers, [`InverseKinematics`], and their result, [`Solution`].

use std::fmt;

use serde::Serialize;

use super::Target;
use crate::Result;

/// One inverse-kinematics solution: joint values that move the tip to its target.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solution {
    /// The joint values, base to tip: radians in (-pi, pi], lengths in the solver's unit; zero for a free joint.
    pub q: Vec<f64>,
    /// The largest residual at `q`. For a derived solver it is that of its equations, in their own unit. For other
    /// solvers it is the tip's distance from its target in the chain's unit, or its angle \[rad\]. [`Target::missed`]
    /// returns both.
    pub residual: f64,
    /// Branch number: which roots of which equations were used. A branch keeps its number from target to target.
    pub branch: usize,
    /// Free joints (indices from 0) of a singular pose: every value of them has a solution, with other values of the
    /// other joints.
    pub free: Vec<usize>,
    /// Whether the source of the mechanism would select this solution.
    pub chosen: bool,
    /// False if the polishing steps permitted for a target were used up before the end
    /// (`MOST_STEPS` of groebot-runtime). All solutions of this target are marked. Others may
    /// be missing, and the residual shows the accuracy of each.
    pub settled: bool,
}

impl Default for Solution {
    fn default() -> Self {
        Solution { q: Vec::new(), residual: 0.0, branch: 0, free: Vec::new(), chosen: false, settled: true }
    }
}

/// An inverse-kinematics solver: derived, generated, by screw theory or by numeric search.
pub trait InverseKinematics: fmt::Debug + Send + Sync {
    /// Writes all solutions for `target` to `out`, which is cleared first. There are none when the target is out of
    /// reach. `given` are the values of the given joints. Joint limits are not checked.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) for a target of another task than the solver's, with a
    /// number that is not finite or a matrix that is not a rotation, and unless each given joint has a finite value.
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()>;

    /// The solution nearest to the joint values `q0` after whole turns within `limits`, where members of self-motions are moved along them. Its angles are not
    /// wrapped. `None` when no solution is within `limits`, and from solvers that do not move along self-motions (the default).
    ///
    /// # Errors
    /// As [`InverseKinematics::solve`]; [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) unless `q0` has one finite value and `limits` one ordered pair for
    /// each joint.
    fn nearest_to(
        &self,
        _target: &Target,
        _given: &[f64],
        _q0: &[f64],
        _limits: &[[f64; 2]],
    ) -> Result<Option<Solution>> {
        Ok(None)
    }

    /// Whether the solutions are found together as eigenvalues of a matrix, as those of six joints in general position. Newton's method from joint values near
    /// a solution then takes less time.
    fn uses_eigenvalues(&self) -> bool {
        false
    }
}
