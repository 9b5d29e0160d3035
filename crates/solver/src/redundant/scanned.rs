//! Arms with several joints more than their task determines: [`ScanningSolver`].
//!
//! The ranges of some joints, the scanned ones, are sampled. With their values held, the other joints are an arm with one joint more than its task determines.

use serde::Serialize;

use super::scan_samples::{SAMPLES, ScanLimits, between, samples};
use super::{Absence, ArmTarget, Criterion, RedundantSolver, Within};
use crate::{Error, ErrorKind, Result};
use crate::{Joint, Program, Redundancy, Unit};
use groebot_robot::kinematics::Target;

/// The best samples that are refined, and the golden sections of each of their scanned joints.
const REFINED: usize = 3;
const SECTIONS: usize = 16;
/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The solvers of an arm with two to four joints more than its task determines. The planner chooses the scanned joints. Their ranges are sampled (33 values of
/// one joint, 132 of two, 528 of three, more next to solutions), so that narrow ranges of solutions may be missed: completeness is that of the samples.
#[derive(Clone, Debug)]
pub struct ScanningSolver {
    pub(super) program: Program,
    redundancy: Redundancy,
    pub(super) scanned: Vec<usize>,
    /// The solver with the scanned joints held at zero.
    pub(super) zero: RedundantSolver,
}

/// A solution of a [`ScanningSolver`], or the reason why no sample has one.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Scanned {
    /// Joint values within limits, one for each joint of the chain, in rad or the length unit of the program.
    pub q: Option<Vec<f64>>,
    /// The value of the criterion; `None` without a criterion and without a solution.
    pub value: Option<f64>,
    /// The reason why no sample has a solution, with indices of the chain's joints; `None` with a solution.
    pub absence: Option<Absence>,
}

/// A sample with its best solution. A greater score is better.
#[derive(Clone)]
pub(super) struct Sample {
    pub values: Vec<f64>,
    pub q: Vec<f64>,
    score: f64,
}

impl Program {
    /// The prepared solvers of a valid program ([`Program::validate`]) with scanned joints; `None` without scanned joints.
    pub fn scanning_solver(&self) -> Option<ScanningSolver> {
        let redundancy = self.redundancy.as_deref().filter(|redundancy| !redundancy.scanned().is_empty())?;
        let scanned = redundancy.scanned();
        let zero = RedundantSolver::new(self, redundancy, &vec![0.0; scanned.len()]);
        let program = Program { redundancy: None, ..self.clone() };
        Some(ScanningSolver { program, redundancy: redundancy.clone(), scanned, zero })
    }
}

impl ScanningSolver {
    /// The joints of the chain, from base to tip.
    pub fn joints(&self) -> &[Joint] {
        &self.program.joints
    }

    /// The indices of the scanned joints.
    pub fn scanned(&self) -> &[usize] {
        &self.scanned
    }

    /// The described limits of all joints, in rad or the length unit of the program; infinite without a limit.
    pub fn limits(&self) -> Vec<[f64; 2]> {
        self.redundancy.limit_pairs()
    }

    /// The solver of the other joints, with the scanned joints held at `values`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of values, and for NaN and infinity.
    pub fn held(&self, values: &[f64]) -> Result<RedundantSolver> {
        if values.len() != self.scanned.len() || !values.iter().all(|value| value.is_finite()) {
            let text =
                format!("{} values of scanned joints given; give {} finite ones", values.len(), self.scanned.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(self.at(values))
    }

    pub(super) fn at(&self, values: &[f64]) -> RedundantSolver {
        self.zero.held_at(&self.program, &self.redundancy, values)
    }

    /// Checks a target of the task, in the base frame. Lengths are in the unit of the program.
    ///
    /// # Errors
    /// As [`RedundantSolver::target`].
    pub fn target(&self, target: impl Into<Target>) -> Result<ArmTarget> {
        self.zero.target(target)
    }

    /// Checks a target with these numbers, without the values of given joints.
    ///
    /// # Errors
    /// As [`RedundantSolver::target_of_numbers`].
    pub fn target_of_numbers(&self, numbers: &[f64]) -> Result<ArmTarget> {
        self.zero.target_of_numbers(numbers)
    }

    /// The described limits, narrowed to `limits`. A scanned revolute joint without limits has one turn; a prismatic one has twice the scale of the program.
    ///
    /// # Errors
    /// As [`super::RedundantSolver::limits_within`].
    pub(super) fn scan_limits(&self, limits: Option<&[[f64; 2]]>) -> Result<ScanLimits> {
        let described = self.limits();
        let count = described.len();
        let narrow = limits.map_or_else(|| described.clone(), <[[f64; 2]]>::to_vec);
        if narrow.len() != count {
            let text = format!("{} pairs of limits given; give one for each of {count} joints", narrow.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let range = |&joint: &usize| {
            let ([least, greatest], [low, high]) = (described[joint], narrow[joint]);
            let half =
                if self.joints()[joint].unit == Unit::Radian { std::f64::consts::PI } else { self.program.scale };
            let bounds = match [least.max(low), greatest.min(high)] {
                [low, high] if low.is_finite() && high.is_finite() => [low, high],
                [low, _] if low.is_finite() => [low, low + 2.0 * half],
                [_, high] if high.is_finite() => [high - 2.0 * half, high],
                _ => [-half, half],
            };
            let name = &self.joints()[joint].name;
            if low.is_nan() || high.is_nan() || bounds[0] > bounds[1] {
                let text =
                    format!("the limits of `{name}` are {low} and {high}; only {least} to {greatest} is allowed");
                return Err(Error::new(ErrorKind::BadValue, text));
            }
            Ok(bounds)
        };
        let ranges = self.scanned.iter().map(range).collect::<Result<_>>()?;
        let own: Vec<[f64; 2]> = self.zero.own.iter().map(|&joint| narrow[joint]).collect();
        Ok(ScanLimits { ranges, own: self.zero.limits_within(&own)? })
    }

    /// Checks limits of [`ScanningSolver::any_within`].
    ///
    /// # Errors
    /// As [`RedundantSolver::limits_within`].
    #[doc(hidden)]
    pub fn check_limits(&self, limits: &[[f64; 2]]) -> Result<()> {
        self.scan_limits(Some(limits)).map(drop)
    }

    /// One solution of `target` within limits, by no criterion. `limits` has one pair per joint of the chain and narrows the described ones.
    ///
    /// # Errors
    /// As [`RedundantSolver::any_within`] and [`RedundantSolver::limits_within`].
    pub fn any_within(&self, target: &ArmTarget, limits: Option<&[[f64; 2]]>) -> Result<Scanned> {
        let limits = self.scan_limits(limits)?;
        let mut absences = Vec::new();
        for values in samples(&limits.ranges) {
            let found = self.within(target, &limits, &values)?;
            match found.q {
                Some(q) => return Ok(Scanned { q: Some(q), value: None, absence: None }),
                None => absences.push((values, found.absence)),
            }
        }
        for values in between(&absences) {
            if let Some(q) = self.within(target, &limits, &values)?.q {
                return Ok(Scanned { q: Some(q), value: None, absence: None });
            }
        }
        Ok(self.without(absences))
    }

    /// One solution with the scanned joints held, with the values of all joints.
    pub(super) fn within(&self, target: &ArmTarget, limits: &ScanLimits, values: &[f64]) -> Result<Within> {
        let arm = self.at(values);
        let found = arm.any_within(target, &limits.own)?;
        Ok(Within { q: found.q.map(|q| arm.all_joints(&q)), ..found })
    }

    /// The result without a solution: of the samples that are reachable beyond limits, the first one names the joints.
    fn without(&self, absences: Vec<(Vec<f64>, Option<Absence>)>) -> Scanned {
        let beyond = absences.into_iter().find_map(|(_, absence)| match absence {
            Some(Absence::Beyond(joints)) => Some(joints),
            _ => None,
        });
        let absence = beyond.map_or(Absence::Unreachable, |joints| {
            Absence::Beyond(joints.into_iter().map(|joint| self.zero.own[joint]).collect())
        });
        Scanned { q: None, value: None, absence: Some(absence) }
    }

    /// The best solution of `target` within limits by a criterion: the best of the samples, refined by golden sections of the scanned joints. `limits` is that of
    /// [`ScanningSolver::any_within`]. Values of the criterion are those of all joints of the chain, but [`Criterion::Manipulability`] is that of the joints
    /// that are not scanned.
    ///
    /// # Errors
    /// As [`ScanningSolver::any_within`]; [`ErrorKind::BadValue`] for a criterion with values that do not fit the joints.
    pub fn best(&self, target: &ArmTarget, limits: Option<&[[f64; 2]]>, criterion: &Criterion) -> Result<Scanned> {
        let limits = self.scan_limits(limits)?;
        self.check(criterion)?;
        let mut list = samples(&limits.ranges);
        list.extend(self.preferred(criterion, &limits.ranges));
        let (mut found, mut absences) = (Vec::new(), Vec::new());
        for values in list {
            match self.sample(target, &limits, criterion, &values)? {
                Some(sample) => found.push(sample),
                None => absences.push(values),
            }
        }
        found.sort_by(|a: &Sample, b| b.score.total_cmp(&a.score));
        found.truncate(REFINED);
        let mut best: Option<Sample> = None;
        for sample in found {
            let sample = self.refined(target, &limits, criterion, sample)?;
            if best.as_ref().is_none_or(|best| sample.score > best.score) {
                best = Some(sample);
            }
        }
        match best {
            Some(best) => {
                let value = if criterion.is_least_best() { -best.score } else { best.score };
                Ok(Scanned { q: Some(best.q), value: Some(value), absence: None })
            }
            None => {
                let absence = |values: Vec<f64>| {
                    let absence = self.within(target, &limits, &values)?.absence;
                    Ok((values, absence))
                };
                Ok(self.without(absences.into_iter().map(absence).collect::<Result<_>>()?))
            }
        }
    }

    /// The solution of `target` within limits that is nearest to `q0`: one value for each joint of the chain.
    ///
    /// # Errors
    /// As [`ScanningSolver::best`].
    pub fn nearest(&self, target: &ArmTarget, limits: Option<&[[f64; 2]]>, q0: &[f64]) -> Result<Scanned> {
        self.best(target, limits, &Criterion::nearest(q0.to_vec()))
    }

    /// The largest magnitude among the equations' values of `target` at joint values `q` of the chain, as [`RedundantSolver::residual`].
    pub fn residual(&self, target: &ArmTarget, q: &[f64]) -> f64 {
        if q.len() != self.joints().len() {
            return f64::NAN;
        }
        let row = |joints: &[usize]| -> Vec<f64> { joints.iter().map(|&joint| q[joint]).collect() };
        self.at(&row(&self.scanned)).residual(target, &row(&self.zero.own))
    }

    /// The best solution with the scanned joints held.
    fn sample(
        &self,
        target: &ArmTarget,
        limits: &ScanLimits,
        criterion: &Criterion,
        values: &[f64],
    ) -> Result<Option<Sample>> {
        let arm = self.at(values);
        let Some(best) = arm.best(target, &limits.own, &self.own(criterion))? else { return Ok(None) };
        let score = self.score(limits, criterion, values, best.value);
        Ok(Some(Sample { values: values.to_vec(), q: arm.all_joints(&best.q), score }))
    }

    /// The criterion of the joints that are not scanned.
    fn own(&self, criterion: &Criterion) -> Criterion {
        let row = |all: &[f64]| self.zero.own.iter().map(|&joint| all[joint]).collect();
        match criterion {
            Criterion::Nearest { q0, weights } => Criterion::Nearest { q0: row(q0), weights: row(weights) },
            Criterion::Change { joint, value } => match self.zero.own.iter().position(|own| own == joint) {
                Some(joint) => Criterion::Change { joint, value: *value },
                None => Criterion::Margin,
            },
            other => other.clone(),
        }
    }

    /// The criterion of all joints, so that a greater score is better. `own` is its value for the joints that are not scanned.
    fn score(&self, limits: &ScanLimits, criterion: &Criterion, values: &[f64], own: f64) -> f64 {
        let scanned = || self.scanned.iter().zip(values);
        let margin = |is_relative: bool| {
            let of_joint = |((&joint, value), [low, high]): ((&usize, &f64), &[f64; 2])| {
                let unit = if self.joints()[joint].unit == Unit::Radian { 1.0 } else { self.program.scale };
                let half = if is_relative { (high - low) / 2.0 } else { unit };
                (value - low).min(high - value) / half
            };
            scanned().zip(&limits.ranges).map(of_joint).fold(own, f64::min)
        };
        match criterion {
            Criterion::Margin => margin(false),
            Criterion::RelativeMargin => margin(true),
            Criterion::Nearest { q0, weights } => {
                let squares = scanned().map(|(&joint, value)| weights[joint] * (value - q0[joint]).powi(2));
                -(own * own + squares.sum::<f64>()).sqrt()
            }
            Criterion::Manipulability => own,
            Criterion::Change { joint, value } => {
                let held = scanned().find(|(place, _)| *place == joint);
                held.map_or(-own, |(_, held)| -(held - value).abs())
            }
        }
    }

    /// Golden sections of each scanned joint in turn (J. Kiefer, Proc. AMS 4 (1953) 502-506), between the neighbouring samples.
    fn refined(
        &self,
        target: &ArmTarget,
        limits: &ScanLimits,
        criterion: &Criterion,
        mut best: Sample,
    ) -> Result<Sample> {
        for (k, [low, high]) in limits.ranges.iter().enumerate() {
            let width = (high - low) / (SAMPLES - 1) as f64;
            let (mut a, mut b) = ((best.values[k] - width).max(*low), (best.values[k] + width).min(*high));
            for _ in 0..SECTIONS {
                let places = [b - GOLDEN * (b - a), a + GOLDEN * (b - a)];
                let mut scores = [f64::NEG_INFINITY; 2];
                for (score, place) in scores.iter_mut().zip(places) {
                    let mut values = best.values.clone();
                    values[k] = place;
                    let Some(sample) = self.sample(target, limits, criterion, &values)? else { continue };
                    *score = sample.score;
                    if sample.score > best.score {
                        best = sample;
                    }
                }
                if scores[0] >= scores[1] {
                    b = places[1];
                } else {
                    a = places[0];
                }
            }
        }
        Ok(best)
    }

    /// The values of the scanned joints that a criterion prefers, within their ranges.
    fn preferred(&self, criterion: &Criterion, ranges: &[[f64; 2]]) -> Option<Vec<f64>> {
        let value = |(&joint, [low, high]): (&usize, &[f64; 2])| match criterion {
            Criterion::Nearest { q0, .. } => Some(q0[joint].clamp(*low, *high)),
            Criterion::Change { joint: own, value } if *own == joint => Some(value.clamp(*low, *high)),
            Criterion::Change { .. } => Some((low + high) / 2.0),
            _ => None,
        };
        self.scanned.iter().zip(ranges).map(value).collect()
    }

    fn check(&self, criterion: &Criterion) -> Result<()> {
        let count = self.joints().len();
        let fits = match criterion {
            Criterion::Nearest { q0, weights } => {
                q0.len() == count && weights.len() == count && q0.iter().all(|q| q.is_finite())
            }
            Criterion::Change { joint, value } => *joint < count && value.is_finite(),
            _ => true,
        };
        let text = || format!("the criterion needs finite values for {count} joints");
        if fits { Ok(()) } else { Err(Error::new(ErrorKind::BadValue, text())) }
    }
}
