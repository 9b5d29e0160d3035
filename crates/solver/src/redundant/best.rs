//! The best solution within limits by a criterion: [`Criterion`], [`Best`].

use std::f64::consts::TAU;

use groebot_runtime::redundant as runtime;
use serde::Serialize;

use super::{Arc, ArmTarget, JointLimits, RedundantSolver};
use crate::Unit;
use crate::{Error, ErrorKind, Result};

/// The maximum number of local optima. Of more, the run time leaves out the worst ones.
const ROOM: usize = 128;

/// A criterion that selects one solution.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Criterion {
    /// The greatest least distance of a joint to its limits, in rad. Lengths are relative to the scale of the program. Joints without limits, or with a range of
    /// at least one turn, do not count.
    Margin,
    /// Same as the margin, but each distance is divided by half of the joint's range: 1 is the middle of all ranges. The distance of a joint with only one
    /// limit is not divided.
    RelativeMargin,
    /// The least distance to joint values: the square root of the sum of weighted squares of differences, in rad or the length unit. Along arcs, differences of
    /// angles whose range is at least one turn are compared modulo 2 pi. Each local optimum is then turned to the values within limits that are nearest to `q0`,
    /// and its distance is that of these values. Other values of `q0` should be within limits.
    Nearest {
        /// The joint values, in rad or the length unit of the program.
        q0: Vec<f64>,
        /// The weight of each joint's square; not negative.
        weights: Vec<f64>,
    },
    /// The greatest manipulability, sqrt(det(J J^T)) of the task's Jacobian, with lengths relative to the scale of the program (T. Yoshikawa, Int. J. Robotics
    /// Research 4 (1985) 3-9).
    Manipulability,
    /// The least difference of one joint from a value. An angle whose range is at least one turn is compared modulo 2 pi and turned as for
    /// [`Criterion::Nearest`].
    Change {
        /// The index of the joint.
        joint: usize,
        /// The value, in rad or the length unit.
        value: f64,
    },
}

impl Criterion {
    /// The least distance to `q0` with equal weights.
    pub fn nearest(q0: Vec<f64>) -> Self {
        let weights = vec![1.0; q0.len()];
        Criterion::Nearest { q0, weights }
    }

    /// Its name, such as `margin`.
    pub fn name(&self) -> &'static str {
        match self {
            Criterion::Margin => "margin",
            Criterion::RelativeMargin => "relative margin",
            Criterion::Nearest { .. } => "nearest",
            Criterion::Manipulability => "manipulability",
            Criterion::Change { .. } => "change",
        }
    }

    /// Whether the least value is the best, as of distances.
    pub fn is_least_best(&self) -> bool {
        matches!(self, Criterion::Nearest { .. } | Criterion::Change { .. })
    }
}

/// A solution that is optimal by a criterion.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Best {
    /// Joint values within limits.
    pub q: Vec<f64>,
    /// The value of the criterion: a margin, a distance, a difference or the manipulability. A margin is infinite if no joint is limited.
    pub value: f64,
    /// The index of its arc among those of [`RedundantSolver::arcs`].
    pub arc: usize,
    /// Its distance from the start of the arc, in the unit of [`super::Arc::length`].
    pub s: f64,
}

impl RedundantSolver {
    /// The best of all local optima of `target` within `limits` ([`RedundantSolver::optima`]). `None` without a solution within limits.
    ///
    /// # Errors
    /// As [`RedundantSolver::arcs`]. [`ErrorKind::BadValue`] for a criterion with values that do not fit the joints.
    pub fn best(&self, target: &ArmTarget, limits: &JointLimits, criterion: &Criterion) -> Result<Option<Best>> {
        self.best_on(target, limits, &self.arcs(target, limits)?.arcs, criterion)
    }

    /// Same as [`RedundantSolver::best`], on arcs of this target and these limits that are computed already.
    ///
    /// # Errors
    /// As [`RedundantSolver::optima_on`].
    pub fn best_on(
        &self,
        target: &ArmTarget,
        limits: &JointLimits,
        arcs: &[Arc],
        criterion: &Criterion,
    ) -> Result<Option<Best>> {
        Ok(self.optima_on(target, limits, arcs, criterion)?.into_iter().next())
    }

    /// The solution of `target` within `limits` that is nearest to `q0`: one value for each joint, in rad or the length unit ([`Criterion::nearest`]).
    ///
    /// # Errors
    /// As [`RedundantSolver::best`].
    pub fn nearest(&self, target: &ArmTarget, limits: &JointLimits, q0: &[f64]) -> Result<Option<Best>> {
        self.best(target, limits, &Criterion::nearest(q0.to_vec()))
    }

    /// The local optima on all arcs, ends included, the best ones first. There are at most 128: of more, the worst ones are left out without notice. Each arc is
    /// sampled at six points for each step of the tracer. Two optima between neighbouring samples are found as one.
    ///
    /// # Errors
    /// As [`RedundantSolver::best`].
    pub fn optima(&self, target: &ArmTarget, limits: &JointLimits, criterion: &Criterion) -> Result<Vec<Best>> {
        self.optima_on(target, limits, &self.arcs(target, limits)?.arcs, criterion)
    }

    /// Same as [`RedundantSolver::optima`], on arcs of this target and these limits that are computed already. [`Best::arc`] is an index of `arcs`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a criterion with values that do not fit the joints.
    pub fn optima_on(
        &self,
        target: &ArmTarget,
        limits: &JointLimits,
        arcs: &[Arc],
        criterion: &Criterion,
    ) -> Result<Vec<Best>> {
        let own = self.run_time_criterion(criterion)?;
        let traced: Vec<runtime::Arc> = arcs.iter().map(|arc| arc.traced).collect();
        let mut room = vec![runtime::Best::NONE; ROOM];
        let count = runtime::optima(&self.arm, &target.row, &limits.rows, (&traced, &own), &mut room)
            .map_err(|error| self.refused(target, error))?;
        let mut optima: Vec<Best> = room[..count].iter().map(|best| self.found(limits, criterion, best)).collect();
        if criterion.is_least_best() {
            optima.sort_by(|a, b| a.value.total_cmp(&b.value));
        }
        Ok(optima)
    }

    /// An optimum with its angles turned to the reference of the criterion. A distance is that of these joint values.
    fn found(&self, limits: &JointLimits, criterion: &Criterion, best: &runtime::Best) -> Best {
        let q = self.values(&best.q);
        let (q, value) = match criterion {
            Criterion::Nearest { q0, weights } => {
                let q = self.turned(limits, &q, q0);
                let squares = q.iter().zip(q0).zip(weights).map(|((q, q0), weight)| weight * (q - q0).powi(2));
                let value = squares.sum::<f64>().sqrt();
                (q, value)
            }
            Criterion::Change { joint, value } => {
                let mut near = q.clone();
                near[*joint] = *value;
                let q = self.turned(limits, &q, &near);
                let change = (q[*joint] - value).abs();
                (q, change)
            }
            _ => (q, best.value),
        };
        Best { q, value, arc: best.arc, s: best.s }
    }

    /// The criterion in the run time's type.
    pub(super) fn run_time_criterion(&self, criterion: &Criterion) -> Result<runtime::Criterion> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        let row = |values: &[f64]| {
            let mut row = [0.0; runtime::MOST_JOINTS];
            row[..values.len()].copy_from_slice(values);
            row
        };
        Ok(match criterion {
            Criterion::Margin => runtime::Criterion::Margin { is_relative: false },
            Criterion::RelativeMargin => runtime::Criterion::Margin { is_relative: true },
            Criterion::Nearest { q0, weights } => {
                self.joint_values(q0)?;
                if weights.len() != q0.len() || !weights.iter().all(|weight| weight.is_finite() && *weight >= 0.0) {
                    return bad(format!("give {} weights that are finite and not negative", q0.len()));
                }
                runtime::Criterion::Nearest { q0: row(q0), weights: row(weights) }
            }
            Criterion::Manipulability => runtime::Criterion::Manipulability,
            Criterion::Change { joint, value } if *joint >= self.joints.len() || !value.is_finite() => {
                let count = self.joints.len();
                return bad(format!(
                    "the criterion is joint {joint} at {value}; give one of {count} joints and a finite value"
                ));
            }
            Criterion::Change { joint, value } => runtime::Criterion::Change { joint: *joint, value: *value },
        })
    }

    /// The same angles, moved by whole turns to the nearest values to `near` within limits.
    pub(super) fn turned(&self, limits: &JointLimits, q: &[f64], near: &[f64]) -> Vec<f64> {
        let value = |joint: usize| {
            let ([low, high], own) = (limits.rows[joint], q[joint]);
            if self.joints[joint].unit != Unit::Radian {
                return own;
            }
            let nearest = own + TAU * ((near[joint] - own) / TAU).round();
            let least = if low.is_finite() { own + TAU * ((low - own) / TAU).ceil() } else { nearest };
            let most = if high.is_finite() { own + TAU * ((high - own) / TAU).floor() } else { nearest };
            if least <= most { nearest.max(least).min(most) } else { own }
        };
        (0..q.len()).map(value).collect()
    }
}
