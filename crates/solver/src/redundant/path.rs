//! A path of joint values along a sequence of targets, by dynamic programming over arcs. Main types: [`PathOptions`], [`ArmPath`].
//!
//! The states at a target are samples of its arcs, and for each state at the target before the nearest point of each arc. So a continuous path does not depend on
//! the distance of the samples. Of the states in one interval of an arc, the one with the best path is kept.

use serde::Serialize;

use super::sampled::{SampledArc, nearest};
use super::{ArmTarget, JointLimits, RedundantSolver};
use crate::Unit;
use crate::{Error, ErrorKind, Result, Watch};

/// The maximum step of an angle without a maximum velocity, in rad.
const NEAR: f64 = 0.5;
/// The maximum step of a length without a maximum velocity, as a fraction of the scale of the program.
const NEAR_SHARE: f64 = 0.1;
/// A joint this close to its limit, in rad or the length unit, explains a jump.
const AT_LIMIT: f64 = 0.05;

/// Options of a path.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct PathOptions<'a> {
    /// The limits; by default the described ones.
    pub limits: Option<JointLimits>,
    /// The time of each target in s, ascending. Without times, a step of more than 0.5 rad or a tenth of the scale is a jump. The same holds for joints without
    /// a maximum velocity, and for the step from the start.
    pub times: Option<&'a [f64]>,
    /// By joint, its maximum velocity in rad/s or the length unit per second, positive; may be shorter than the list of joints. Not used without times.
    pub speeds: &'a [Option<f64>],
    /// The joint values before the first target, in rad or the length unit.
    pub start: Option<&'a [f64]>,
}

impl<'a> PathOptions<'a> {
    /// The defaults.
    pub fn new() -> Self {
        PathOptions::default()
    }

    /// Sets the limits.
    #[must_use]
    pub fn limits(mut self, limits: JointLimits) -> Self {
        self.limits = Some(limits);
        self
    }

    /// Sets the time of each target, and the maximum velocity of each joint.
    #[must_use]
    pub fn speeds(mut self, times: &'a [f64], speeds: &'a [Option<f64>]) -> Self {
        (self.times, self.speeds) = (Some(times), speeds);
        self
    }

    /// Sets the joint values before the first target.
    #[must_use]
    pub fn start(mut self, q: &'a [f64]) -> Self {
        self.start = Some(q);
        self
    }
}

/// A path of joint values.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ArmPath {
    /// By target, the joint values in rad or the length unit, one for each joint.
    pub q: Vec<Vec<f64>>,
    /// By target, the index of the arc among those of [`RedundantSolver::arcs`].
    pub arcs: Vec<usize>,
    /// The jumps, in order.
    pub jumps: Vec<ArmJump>,
    /// Whether the arcs of some target are unsure.
    pub is_unsure: bool,
}

/// A step that is larger than the joints can move.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ArmJump {
    /// The index of the target after the step.
    pub sample: usize,
    /// The index of the joint that exceeds its maximum step most.
    pub joint: usize,
    /// Its step, in rad or the length unit.
    pub step: f64,
    /// The probable reason, as text.
    pub why: String,
}

/// A state of the arm at a target, with the best path to it.
struct State {
    q: Vec<f64>,
    arc: usize,
    /// The interval of the arc.
    bin: usize,
    /// The number of jumps and the sum of squared joint steps.
    cost: (usize, f64),
    from: usize,
}

/// Data common to all steps.
#[derive(Clone, Copy)]
struct Steps<'a> {
    solver: &'a RedundantSolver,
    limits: JointLimits,
    options: &'a PathOptions<'a>,
}

/// The solver for each target.
pub(super) type SolverAt<'a> = &'a dyn Fn(usize) -> RedundantSolver;

impl RedundantSolver {
    /// Joint values along `targets` within limits. A step is a jump if a joint moves further than its maximum velocity permits in the time. The path has the
    /// fewest jumps and, of those, the least sum of squared joint steps, among the sampled states that the search keeps. A joint with a bounded range of at
    /// least one turn does not pass its limit: it jumps by a whole turn.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no targets, a wrong number of times or start values, times that do not ascend, and with its number for a target without a
    /// solution within limits. As [`RedundantSolver::arcs`]. The error of `watch` if it stops the search.
    pub fn path<'w>(
        &self,
        targets: &[ArmTarget],
        options: &PathOptions<'_>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<ArmPath> {
        self.path_by(targets, options, None, Watch::or_none(watch))
    }

    /// Checks the options of a path along so many targets.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] as [`RedundantSolver::path`].
    pub(super) fn check_path(&self, count: usize, options: &PathOptions<'_>) -> Result<()> {
        Steps { solver: self, limits: self.limits(), options }.check(count)
    }

    /// Same as [`RedundantSolver::path`], with another solver of the same joints for each target.
    pub(super) fn path_by(
        &self,
        targets: &[ArmTarget],
        options: &PathOptions<'_>,
        solver_at: Option<SolverAt<'_>>,
        watch: &Watch,
    ) -> Result<ArmPath> {
        let steps = Steps { solver: self, limits: options.limits.unwrap_or(self.limits()), options };
        steps.check(targets.len())?;
        let (mut layers, mut is_unsure): (Vec<Vec<State>>, bool) = (Vec::new(), false);
        for (sample, target) in targets.iter().enumerate() {
            watch.check()?;
            watch.report("targets of the path", sample, targets.len() - sample);
            let own = solver_at.map(|solver_at| solver_at(sample));
            let steps = Steps { solver: own.as_ref().unwrap_or(self), ..steps };
            let (arcs, doubt) =
                steps.arcs(target).map_err(|error| error.with_context(format!("target {}", sample + 1)))?;
            is_unsure |= doubt;
            let states = steps.reached(sample, target, &arcs, layers.last().map(Vec::as_slice))?;
            layers.push(states);
        }
        Ok(steps.best(layers, is_unsure))
    }
}

impl Steps<'_> {
    fn check(&self, count: usize) -> Result<()> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if count == 0 {
            return bad("there is no target; give at least one".to_owned());
        }
        if let Some(times) = self.options.times {
            if times.len() != count {
                return bad(format!("{} times for {count} targets; give one each", times.len()));
            }
            if !times.iter().all(|time| time.is_finite()) || times.windows(2).any(|pair| pair[1] <= pair[0]) {
                return bad("the times of the targets must be finite and ascend".to_owned());
            }
        }
        self.options.start.map_or(Ok(()), |start| self.solver.joint_values(start).map(drop))
    }

    /// The sampled arcs of a target, and whether they are unsure.
    fn arcs(&self, target: &ArmTarget) -> Result<(Vec<SampledArc>, bool)> {
        let arcs = self.solver.arcs(target, &self.limits)?;
        if let Some(absence) = &arcs.absence {
            let text = format!("no solution within limits: {}", absence.text(&self.solver.names()));
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let sampled = arcs.arcs.iter().map(|arc| self.solver.sampled(target, &self.limits, arc));
        Ok((sampled.collect::<Result<_>>()?, arcs.is_unsure))
    }

    /// The states at a target, each with the best path to it.
    fn reached(
        &self,
        sample: usize,
        target: &ArmTarget,
        arcs: &[SampledArc],
        before: Option<&[State]>,
    ) -> Result<Vec<State>> {
        let mut states: Vec<State> = Vec::new();
        for (arc, sampled) in arcs.iter().enumerate() {
            for (bin, q) in sampled.points.iter().enumerate() {
                let state = |q, cost, from| State { q, arc, bin, cost, from };
                let Some(before) = before else {
                    let q = self.options.start.map_or_else(|| q.clone(), |start| self.near(q, start));
                    let cost = self.options.start.map_or((0, 0.0), |start| self.cost(sample, start, &q));
                    states.push(state(q, cost, 0));
                    continue;
                };
                let by = |(from, state): (usize, &State)| {
                    let q = self.near(q, &state.q);
                    let own = self.cost(sample, &state.q, &q);
                    (from, (state.cost.0 + own.0, state.cost.1 + own.1), q)
                };
                let best = before.iter().enumerate().map(by).min_by(|a, b| cheaper(a.1, b.1));
                states.extend(best.map(|(from, cost, q)| state(q, cost, from)));
            }
            let starts = before.map_or_else(
                || self.options.start.map(|start| vec![(0, start, (0, 0.0))]).unwrap_or_default(),
                |before| before.iter().enumerate().map(|(from, state)| (from, &state.q[..], state.cost)).collect(),
            );
            for (from, own, cost) in starts {
                let Some((bin, q)) = nearest(self.solver, target, sampled, own, |a, b| self.near(a, b))? else {
                    continue;
                };
                if !self.is_within(&q) {
                    continue;
                }
                let step = self.cost(sample, own, &q);
                states.push(State { q, arc, bin, cost: (cost.0 + step.0, cost.1 + step.1), from });
            }
        }
        Ok(thinned(states))
    }

    /// Whether joint values are within limits.
    fn is_within(&self, q: &[f64]) -> bool {
        q.iter().zip(&self.limits.rows).all(|(value, [low, high])| low <= value && value <= high)
    }

    /// The same angles by whole turns nearest to `before`, within limits.
    fn near(&self, q: &[f64], before: &[f64]) -> Vec<f64> {
        self.solver.turned(&self.limits, q, before)
    }

    /// The maximum step of a joint without a jump.
    fn most(&self, sample: usize, joint: usize) -> f64 {
        let before = sample.checked_sub(1);
        let time = self.options.times.zip(before).map(|(times, before)| times[sample] - times[before]);
        match self.options.speeds.get(joint).copied().flatten().zip(time) {
            Some((speed, time)) => speed * time,
            None if self.solver.joints[joint].unit == Unit::Radian => NEAR,
            None => NEAR_SHARE * self.solver.arm.length,
        }
    }

    /// Whether a step is a jump, as 1 or 0, and the sum of squared joint steps.
    fn cost(&self, sample: usize, before: &[f64], q: &[f64]) -> (usize, f64) {
        let steps = q.iter().zip(before).map(|(to, from)| to - from);
        let is_jump = steps.clone().enumerate().any(|(joint, step)| step.abs() > self.most(sample, joint));
        (usize::from(is_jump), steps.map(|step| step * step).sum())
    }

    /// The best path through the layers.
    fn best(&self, mut layers: Vec<Vec<State>>, is_unsure: bool) -> ArmPath {
        let mut path: Vec<State> = Vec::with_capacity(layers.len());
        let last = layers.last().map_or(&[][..], Vec::as_slice);
        let mut place = (0..last.len()).min_by(|a, b| cheaper(last[*a].cost, last[*b].cost)).unwrap_or(0);
        while let Some(mut layer) = layers.pop() {
            let state = layer.swap_remove(place);
            place = state.from;
            path.push(state);
        }
        path.reverse();
        let first = self.options.start.and_then(|start| self.jump(0, start, &path[0].q));
        let later = (1..path.len()).filter_map(|sample| self.jump(sample, &path[sample - 1].q, &path[sample].q));
        let jumps = first.into_iter().chain(later).collect();
        let arcs = path.iter().map(|state| state.arc).collect();
        ArmPath { q: path.into_iter().map(|state| state.q).collect(), arcs, jumps, is_unsure }
    }

    /// The jump of a step, if it is one, with the reason.
    fn jump(&self, sample: usize, before: &[f64], q: &[f64]) -> Option<ArmJump> {
        let share = |joint: usize| (q[joint] - before[joint]).abs() / self.most(sample, joint);
        let joint = (0..q.len()).max_by(|a, b| share(*a).total_cmp(&share(*b))).filter(|joint| share(*joint) > 1.0)?;
        let name = |joint: usize| &self.solver.joints[joint].name;
        let at_limit = (0..q.len()).find(|joint| {
            let [low, high] = self.limits.rows[*joint];
            (before[*joint] - low).min(high - before[*joint]) < AT_LIMIT
        });
        let why = match at_limit {
            _ if sample == 0 => "the path does not begin at the current joint values".to_owned(),
            Some(limited) => format!("the arc ends: `{}` is at its limit", name(limited)),
            None => format!("no arc continues: `{}` would exceed its maximum step", name(joint)),
        };
        Some(ArmJump { sample, joint, step: q[joint] - before[joint], why })
    }
}

/// The cheapest state of each interval of each arc, in order.
fn thinned(mut states: Vec<State>) -> Vec<State> {
    states.sort_by(|a, b| (a.arc, a.bin).cmp(&(b.arc, b.bin)).then(cheaper(a.cost, b.cost)));
    states.dedup_by_key(|state| (state.arc, state.bin));
    states
}

/// Compares costs: fewer jumps first, then the smaller sum of squares.
fn cheaper(a: (usize, f64), b: (usize, f64)) -> std::cmp::Ordering {
    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
}
