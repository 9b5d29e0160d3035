//! Joint limits of a request: [`JointLimits`].

use groebot_runtime::redundant::Limits as Rows;
use serde::{Serialize, Serializer};

use super::RedundantSolver;
use crate::{Error, ErrorKind, Result};

/// The least and the greatest value of each joint of a redundant arm, in rad or the length unit of the program: the described ones, or narrower ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    pub(super) rows: Rows,
    /// The number of joints.
    count: usize,
}

impl JointLimits {
    /// By joint, the least and the greatest value in rad or the length unit of the program; infinite without a limit.
    pub fn pairs(&self) -> &[[f64; 2]] {
        &self.rows[..self.count]
    }
}

/// The list of pairs.
impl Serialize for JointLimits {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        self.pairs().serialize(serializer)
    }
}

impl RedundantSolver {
    /// The described limits.
    pub fn limits(&self) -> JointLimits {
        JointLimits { rows: self.arm.limits, count: self.joints.len() }
    }

    /// The described limits, narrowed to `limits`: one pair per joint, in the order of the joints. Infinite values change nothing.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of pairs, for NaN, for a least value above the greatest, and for limits without a value within the described
    /// ones. All name the joint.
    pub fn limits_within(&self, limits: &[[f64; 2]]) -> Result<JointLimits> {
        let count = self.joints.len();
        if limits.len() != count {
            let text = format!("{} pairs of limits given; give one for each of {count} joints", limits.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        limits.iter().enumerate().try_fold(self.limits(), |all, (joint, pair)| self.narrowed(all, joint, *pair))
    }

    /// `limits` with those of one joint narrowed to `[low, high]`.
    ///
    /// # Errors
    /// As [`RedundantSolver::limits_within`]; [`ErrorKind::BadValue`] for a joint that does not exist.
    pub fn narrowed(&self, mut limits: JointLimits, joint: usize, [low, high]: [f64; 2]) -> Result<JointLimits> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        let Some(name) = self.joints.get(joint).map(|joint| joint.name.as_str()) else {
            return bad(format!("there is no joint {joint}; the solver has {}", self.joints.len()));
        };
        if low.is_nan() || high.is_nan() {
            return bad(format!("the limits of `{name}` are {low} and {high}; give numbers"));
        }
        if low > high {
            return bad(format!("the limits of `{name}` are {low} and {high}; give the lower one first"));
        }
        let [least, greatest] = limits.rows[joint];
        let narrow = [low.max(least), high.min(greatest)];
        if narrow[0] > narrow[1] {
            return bad(format!(
                "the limits of `{name}` are {low} and {high}, but only {least} to {greatest} is allowed by those before"
            ));
        }
        limits.rows[joint] = narrow;
        Ok(limits)
    }
}
