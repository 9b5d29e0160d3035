//! The best solution within limits by a criterion: [`Criterion`], [`Best`].

use std::f64::consts::TAU;

use serde::Serialize;

use super::{Arc, ArmTarget, JointLimits, RedundantSolver};
use crate::solver::Unit;
use crate::{Error, ErrorKind, Result};

/// The distance of the samples among which optima are searched, in rad.
const SPACING: f64 = 0.05;
/// The maximum number of samples of an arc.
const MOST: usize = 256;
/// The number of steps of each golden-section search. They shorten an interval of [`SPACING`] to 1e-9 rad.
const STEPS: usize = 38;
/// (sqrt(5) - 1) / 2
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A criterion that selects one solution.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Criterion {
    /// The greatest least distance of a joint to its limits, in rad or the length unit. Joints without limits, or with a range of at least one turn, do not count.
    Margin,
    /// The least distance to joint values: the square root of the sum of weighted squares.
    Nearest {
        /// The joint values.
        q0: Vec<f64>,
        /// The weight of each joint's square; not negative.
        weights: Vec<f64>,
    },
    /// The least difference of one joint from a value.
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

    /// Its name: `margin`, `nearest` or `change`.
    pub fn name(&self) -> &'static str {
        match self {
            Criterion::Margin => "margin",
            Criterion::Nearest { .. } => "nearest",
            Criterion::Change { .. } => "change",
        }
    }
}

/// A solution that is optimal by a criterion.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Best {
    /// Joint values within limits.
    pub q: Vec<f64>,
    /// The value of the criterion.
    pub value: f64,
    /// The index of its arc among those of [`RedundantSolver::arcs`].
    pub arc: usize,
    /// Its distance from the start of the arc.
    pub s: f64,
}

impl RedundantSolver {
    /// The best solution of `target` within `limits`, over all arcs. `None` without a solution within limits.
    ///
    /// # Errors
    /// As [`RedundantSolver::arcs`]. [`ErrorKind::BadValue`] for a criterion with values that do not fit the joints.
    pub fn best(&self, target: &ArmTarget, limits: &JointLimits, criterion: &Criterion) -> Result<Option<Best>> {
        let cost = |best: &Best| if *criterion == Criterion::Margin { -best.value } else { best.value };
        let optima = self.optima(target, limits, criterion)?;
        Ok(optima.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b))))
    }

    /// The solution of `target` within `limits` that is nearest to `q0`.
    ///
    /// # Errors
    /// As [`RedundantSolver::best`].
    pub fn nearest(&self, target: &ArmTarget, limits: &JointLimits, q0: &[f64]) -> Result<Option<Best>> {
        self.best(target, limits, &Criterion::nearest(q0.to_vec()))
    }

    /// All local optima on all arcs, by arc and by distance from its start. The ends of an arc are optima if the criterion is not better next to them.
    ///
    /// # Errors
    /// As [`RedundantSolver::best`].
    pub fn optima(&self, target: &ArmTarget, limits: &JointLimits, criterion: &Criterion) -> Result<Vec<Best>> {
        self.check_criterion(criterion)?;
        let cost = |q: &[f64]| {
            let (value, q) = self.measured(limits, criterion, q);
            (if *criterion == Criterion::Margin { -value } else { value }, value, q)
        };
        let mut optima = Vec::new();
        for (number, arc) in self.arcs(target, limits)?.arcs.iter().enumerate() {
            let count = ((arc.length / SPACING).ceil() as usize + 1).clamp(2, MOST);
            let points = self.samples(target, limits, arc, count)?;
            let costs: Vec<f64> = points.iter().map(|q| cost(q).0).collect();
            let spacing = arc.length / (count - 1) as f64;
            let last = count - 1;
            for place in 0..count {
                let (before, after) = match arc.is_closed {
                    // The first and the last point are one.
                    true => (
                        if place == 0 { last - 1 } else { place - 1 },
                        if place == last { continue } else { place + 1 },
                    ),
                    false => (place.saturating_sub(1), usize::min(place + 1, last)),
                };
                // Of equal neighbours, the first is the optimum.
                let is_least = costs[place] <= costs[after]
                    && (costs[place] < costs[before]
                        || before == place
                        || arc.is_closed && costs[place] <= costs[before]);
                if !is_least {
                    continue;
                }
                let at = |s: f64| self.at(target, limits, arc, s).map(|q| (cost(&q).0, q));
                let mut found = (spacing * place as f64, costs[place], points[place].clone());
                let next = usize::min(place + 1, last);
                // A closed curve continues before its first point at its last one.
                let before = if arc.is_closed && place == 0 { last - 1 } else { place.saturating_sub(1) };
                let intervals = [[before, before + 1], [place, next]];
                for [low, high] in intervals.into_iter().filter(|[low, high]| low < high) {
                    found = golden(spacing * low as f64, spacing * high as f64, found, &at)?;
                }
                let (s, _, q) = found;
                let (_, value, q) = cost(&q);
                optima.push(Best { q, value, arc: number, s });
            }
        }
        Ok(optima)
    }

    /// Joint values at a distance `s` from the start of an arc of this target and these limits. `s` is limited to the arc.
    ///
    /// # Errors
    /// As [`RedundantSolver::arcs`].
    pub fn at(&self, target: &ArmTarget, limits: &JointLimits, arc: &Arc, s: f64) -> Result<Vec<f64>> {
        let q = groebot_runtime::redundant::at(&self.arm, &target.row, &limits.rows, &arc.traced, s);
        Ok(self.values(&q.map_err(|error| self.refused(target, error))?))
    }

    /// Joint values at `count` equal distances along an arc of this target and these limits, the ends included.
    ///
    /// # Errors
    /// As [`RedundantSolver::arcs`].
    pub fn samples(&self, target: &ArmTarget, limits: &JointLimits, arc: &Arc, count: usize) -> Result<Vec<Vec<f64>>> {
        let mut out = vec![[0.0; groebot_runtime::redundant::MOST_JOINTS]; count];
        groebot_runtime::redundant::sample(&self.arm, &target.row, &limits.rows, &arc.traced, &mut out)
            .map_err(|error| self.refused(target, error))?;
        Ok(out.iter().map(|q| self.values(q)).collect())
    }

    fn check_criterion(&self, criterion: &Criterion) -> Result<()> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        match criterion {
            Criterion::Margin => Ok(()),
            Criterion::Nearest { q0, weights } => {
                self.joint_values(q0)?;
                if weights.len() != q0.len() || !weights.iter().all(|weight| weight.is_finite() && *weight >= 0.0) {
                    return bad(format!("give {} weights that are finite and not negative", q0.len()));
                }
                Ok(())
            }
            Criterion::Change { joint, value } if *joint >= self.joints.len() || !value.is_finite() => bad(format!(
                "the criterion is joint {joint} at {value}; give one of {} joints and a finite value",
                self.joints.len()
            )),
            Criterion::Change { .. } => Ok(()),
        }
    }

    /// The value of the criterion, and the joint values with the whole turns at which it is best.
    fn measured(&self, limits: &JointLimits, criterion: &Criterion, q: &[f64]) -> (f64, Vec<f64>) {
        match criterion {
            Criterion::Margin => (self.margin(limits, q), q.to_vec()),
            Criterion::Nearest { q0, weights } => {
                let q = self.turned(limits, q, q0);
                let squares = q.iter().zip(q0).zip(weights).map(|((a, b), weight)| weight * (a - b).powi(2));
                (squares.sum::<f64>().sqrt(), q)
            }
            Criterion::Change { joint, value } => {
                let mut near = q.to_vec();
                near[*joint] = *value;
                let q = self.turned(limits, q, &near);
                ((q[*joint] - value).abs(), q)
            }
        }
    }

    /// The least distance of a joint to its limits.
    fn margin(&self, limits: &JointLimits, q: &[f64]) -> f64 {
        let ends = |(joint, value): (usize, &f64)| {
            let [low, high] = limits.rows[joint];
            let counts = self.joints[joint].unit != Unit::Radian || high - low < TAU;
            counts.then(|| (value - low).min(high - value))
        };
        q.iter().enumerate().filter_map(ends).fold(f64::INFINITY, f64::min)
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

/// Golden-section search for the least cost between `low` and `high`. Returns the best of `best` and all places tried: place, cost, joint values.
fn golden(
    mut low: f64,
    mut high: f64,
    mut best: (f64, f64, Vec<f64>),
    at: impl Fn(f64) -> Result<(f64, Vec<f64>)>,
) -> Result<(f64, f64, Vec<f64>)> {
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut found = [at(inner[0])?, at(inner[1])?];
    for _ in 0..STEPS {
        let side = usize::from(found[1].0 < found[0].0);
        if found[side].0 < best.1 {
            best = (inner[side], found[side].0, found[side].1.clone());
        }
        found.swap(0, 1);
        if side == 0 {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            found[0] = at(inner[0])?;
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            found[1] = at(inner[1])?;
        }
    }
    Ok(best)
}
