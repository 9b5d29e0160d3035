//! Path following: moves an arm along poses on a continuous branch of the solutions, within limits. Main function:
//! [`follow`].

use std::cmp::Ordering;

use super::members::add_members;
use super::path_request::PathRequest;
use super::{JointTrack, Trajectory};
use crate::kinematics::{Chain, InverseKinematics, Joint, JointKind, Solution, Target, Task};
use crate::spatial::angle;
use crate::{Error, ErrorKind, Result, Watch};

/// Maximum step of a joint from pose to pose without a jump \[rad\], if there are no times.
const NEAR: f64 = 0.5;
/// Tolerance of limits for rounding \[rad or m\].
const ROUNDING: f64 = 1e-9;
/// Maximum number of combinations of a solution's values that differ by whole turns. Those furthest from zero are
/// omitted.
const MOST_STATES: usize = groebot_algebra::limits::POSE_STATES;

/// A jump from one branch to another, with the reason.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// The index of the pose after the jump, from 0.
    pub sample: usize,
    /// The index of the joint with the largest step.
    pub joint: usize,
    /// The step \[rad or the chain's unit\].
    pub step: f64,
    /// The reason, as text.
    pub why: String,
}

/// A path with its jumps.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Followed {
    /// The path.
    pub trajectory: Trajectory,
    /// Its jumps, in order.
    pub jumps: Vec<Jump>,
}

impl Jump {
    /// The jump to the pose `sample`, in which `joint` moves by `step`.
    pub fn new(sample: usize, joint: usize, step: f64, why: String) -> Self {
        Jump { sample, joint, step, why }
    }
}

impl Followed {
    /// A path with its jumps.
    pub fn new(trajectory: Trajectory, jumps: Vec<Jump>) -> Self {
        Followed { trajectory, jumps }
    }
}

/// A state of the arm at a pose, with the best path to it.
struct State {
    q: Vec<f64>,
    branch: usize,
    /// The number of jumps and the sum of squared joint steps up to this state.
    cost: (usize, f64),
    /// The state at the previous pose.
    from: usize,
}

/// Computes joint values that move the tip of `chain` through the requested poses, with `solver`. The path has the fewest jumps
/// between branches and, among those, the least sum of squared joint steps. Revolute joints are shifted by whole turns
/// where their limits permit. A step is a jump if a joint moves further than its maximum velocity permits in the time.
/// Without a maximum velocity the bound is half a radian or a tenth of the reach. At singular poses the path continues along self-motions if `solver` has a
/// search for their members ([`InverseKinematics::nearest_to`]).
///
/// # Errors
/// [`ErrorKind::BadValue`] for an empty list and for a wrong number of times; with the number of the pose, for one that
/// is out of reach or whose solutions all exceed limits; [`ErrorKind::Unsupported`] for a task other than a pose, and
/// for given joints; [`ErrorKind::BadValue`] unless the start has one finite value per joint; [`ErrorKind::Cancelled`] and
/// [`ErrorKind::Budget`].
pub fn follow<'w>(
    chain: &Chain,
    solver: &dyn InverseKinematics,
    request: &PathRequest<'_>,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Followed> {
    let watch = Watch::or_none(watch);
    let PathRequest { poses, pace, speeds, start } = *request;
    start.map(|start| chain.forward(start)).transpose()?;
    if chain.task() != Task::Pose || !chain.given().is_empty() {
        let text =
            format!("the task is `{}`; a path of poses is followed by `pose` without given joints", chain.task_text());
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let times = pace.times(poses.len())?;
    let path = Path { chain, speeds, times: &times, start };
    let mut layers: Vec<Vec<State>> = Vec::with_capacity(poses.len());
    let mut found = vec![Vec::new(); poses.len()];
    let named = |sample: usize| move |error: Error| error.with_context(format_args!("pose {}", sample + 1));
    for (sample, (pose, found)) in poses.iter().zip(&mut found).enumerate() {
        watch.check()?;
        watch.report("poses of the path", sample, poses.len() - sample);
        solver.solve(&Target::Pose(*pose), &[], found).map_err(named(sample))?;
    }
    add_members(chain, solver, request, &mut found, watch)?;
    for (sample, found) in found.iter().enumerate() {
        watch.check()?;
        let choices = path.choices(found).map_err(named(sample))?;
        layers.push(path.reached(sample, &choices, layers.last()));
    }
    let best = path.best_path(&layers);
    let later = (1..best.len()).filter_map(|sample| path.jump(sample, &layers, &best));
    let jumps = path.first_jump(&layers[0][best[0]]).into_iter().chain(later).collect();
    let trajectory = path.trajectory(&layers, &best);
    trajectory.check()?;
    Ok(Followed { trajectory, jumps })
}

/// Compares costs: fewer jumps first, then the smaller sum of squares.
fn cheaper(a: (usize, f64), b: (usize, f64)) -> Ordering {
    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
}

/// The values of a solution's joints within the limits, which differ by whole turns.
struct Choices {
    branch: usize,
    values: Vec<Vec<f64>>,
}

impl Choices {
    /// The number of combinations.
    fn count(&self) -> usize {
        self.values.iter().fold(1, |count, values| count.saturating_mul(values.len()))
    }

    /// Reduces the choices to at most [`MOST_STATES`] combinations. The joint with the most values loses the one
    /// furthest from zero.
    fn fewer(mut self) -> Self {
        while self.count() > MOST_STATES {
            let Some(most) = self.values.iter_mut().max_by_key(|values| values.len()) else { break };
            most.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
            most.pop();
            most.sort_by(f64::total_cmp);
        }
        self
    }

    /// All combinations. The last joint's value varies fastest.
    fn states(&self) -> Vec<State> {
        let mut all = vec![Vec::new()];
        for values in &self.values {
            all = all.iter().flat_map(|q| values.iter().map(|value| [&q[..], &[*value]].concat())).collect();
        }
        let state = |q| State { q, branch: self.branch, cost: (usize::MAX, f64::INFINITY), from: 0 };
        all.into_iter().map(state).collect()
    }

    /// The index of the combination nearest to `q`.
    fn nearest(&self, q: &[f64]) -> usize {
        self.values.iter().zip(q).fold(0, |place, (values, before)| {
            let off = |at: &usize| (values[*at] - before).abs();
            let next = (0..values.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
            place * values.len() + next
        })
    }
}

/// Data common to all steps of a path.
struct Path<'p> {
    chain: &'p Chain,
    speeds: &'p [Option<f64>],
    times: &'p [f64],
    /// The state of the arm before the first pose, if known.
    start: Option<&'p [f64]>,
}

impl Path<'_> {
    /// The values of each solution within the limits, joint by joint.
    fn choices(&self, found: &[Solution]) -> Result<Vec<Choices>> {
        let of = |solution: &Solution| {
            let joints = self.chain.joints().iter().zip(&solution.q);
            let values = joints.map(|(joint, value)| within(joint.limits, *value, joint.kind == JointKind::Revolute));
            Choices { branch: solution.branch, values: values.collect() }
        };
        let choices: Vec<Choices> =
            found.iter().map(of).filter(|choices| choices.count() > 0).map(Choices::fewer).collect();
        match (choices.is_empty(), found.first()) {
            (false, _) => Ok(choices),
            (true, None) => Err(Error::new(ErrorKind::BadValue, "it is out of reach")),
            (true, Some(_)) => {
                let text = format!("all {} solutions are beyond the limits of a joint", found.len());
                Err(Error::new(ErrorKind::BadValue, text))
            }
        }
    }

    /// The states at a pose, each with the best path to it: from a previous state to the nearest values of a solution,
    /// or by a jump from the best of all.
    fn reached(&self, sample: usize, choices: &[Choices], before: Option<&Vec<State>>) -> Vec<State> {
        let mut states: Vec<State> = choices.iter().flat_map(Choices::states).collect();
        let Some(before) = before else {
            for state in &mut states {
                let step = self.start.map_or((false, 0.0), |start| self.step(0, start, &state.q));
                state.cost = (usize::from(step.0), step.1);
            }
            return states;
        };
        let best = (0..before.len()).min_by(|a, b| cheaper(before[*a].cost, before[*b].cost)).unwrap_or(0);
        let starts: Vec<usize> =
            choices.iter().scan(0, |start, own| Some(std::mem::replace(start, *start + own.count()))).collect();
        let mut relax = |to: usize, from: usize| {
            let (jumps, squares) = self.step(sample, &before[from].q, &states[to].q);
            let cost = (before[from].cost.0 + usize::from(jumps), before[from].cost.1 + squares);
            if cheaper(cost, states[to].cost).is_lt() {
                (states[to].cost, states[to].from) = (cost, from);
            }
        };
        for (own, start) in choices.iter().zip(starts) {
            (start..start + own.count()).for_each(|to| relax(to, best));
            (0..before.len()).for_each(|from| relax(start + own.nearest(&before[from].q), from));
        }
        states
    }

    /// Whether a step is a jump, and the sum of squared joint steps.
    fn step(&self, sample: usize, before: &[f64], q: &[f64]) -> (bool, f64) {
        let steps = (0..q.len()).map(|joint| self.distance(joint, before[joint], q[joint]));
        let far = steps.clone().enumerate().any(|(joint, step)| step.abs() > self.most(sample, joint));
        (far, steps.map(|step| step * step).sum())
    }

    /// The step of a joint between two values; for a joint without limits the shorter rotation.
    fn distance(&self, joint: usize, from: f64, to: f64) -> f64 {
        let Joint { kind, limits, .. } = &self.chain.joints()[joint];
        if *kind == JointKind::Revolute && limits.is_none() { angle::difference(to, from) } else { to - from }
    }

    /// The maximum step of a joint to a pose without a jump.
    fn most(&self, sample: usize, joint: usize) -> f64 {
        // The time of the step to the first pose is not given.
        let time = sample.checked_sub(1).map(|before| self.times[sample] - self.times[before]);
        match self.speeds.get(joint).copied().flatten().zip(time) {
            Some((speed, time)) => speed * time,
            None if self.chain.joints()[joint].kind == JointKind::Revolute => NEAR,
            None => 0.1 * self.chain.reach(),
        }
    }

    /// The joint with the largest relative step, and its step divided by the maximum without a jump.
    fn furthest(&self, sample: usize, before: &[f64], q: &[f64]) -> Option<(usize, f64)> {
        let share = |joint: usize| self.distance(joint, before[joint], q[joint]).abs() / self.most(sample, joint);
        (0..q.len()).map(|joint| (joint, share(joint))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The index of the best path's state at each pose.
    fn best_path(&self, layers: &[Vec<State>]) -> Vec<usize> {
        let last = layers.last().map_or(&[][..], |layer| layer);
        let end = (0..last.len()).min_by(|a, b| cheaper(last[*a].cost, last[*b].cost)).unwrap_or(0);
        let mut best = vec![end];
        for layer in layers[1..].iter().rev() {
            best.push(layer[best[best.len() - 1]].from);
        }
        best.reverse();
        best
    }

    /// The jump from the start to the first state, if it is one.
    fn first_jump(&self, first: &State) -> Option<Jump> {
        let start = self.start?;
        let (joint, _) = self.furthest(0, start, &first.q).filter(|(_, share)| *share > 1.0)?;
        let step = self.distance(joint, start[joint], first.q[joint]);
        Some(Jump { sample: 0, joint, step, why: "the path does not begin at the current joint values".to_owned() })
    }

    /// The jump to a pose, if it is one, with the reason: how the branch before it ends.
    fn jump(&self, sample: usize, layers: &[Vec<State>], best: &[usize]) -> Option<Jump> {
        let [before, now] = [sample - 1, sample].map(|at| &layers[at][best[at]]);
        let (joint, _) = self.furthest(sample, &before.q, &now.q).filter(|(_, share)| *share > 1.0)?;
        let step = self.distance(joint, before.q[joint], now.q[joint]);
        let name = |joint: usize| &self.chain.joints()[joint].name;
        let goes_on = layers[sample].iter().any(|state| !self.step(sample, &before.q, &state.q).0);
        let same = layers[sample].iter().find(|state| state.branch == before.branch);
        let why = if goes_on {
            let blocked = self.end_of_branch(sample, layers, best);
            format!("the branch continues, but ends {blocked}")
        } else if let Some(same) = same {
            let (fast, _) = self.furthest(sample, &before.q, &same.q)?;
            let turns = self.chain.joints()[fast].kind == JointKind::Revolute;
            if turns && self.distance(fast, before.q[fast], same.q[fast]).abs() > std::f64::consts::PI {
                format!("`{}` would leave its limits; it is moved back by a whole turn", name(fast))
            } else {
                format!("the branch continues, but `{}` would exceed its maximum velocity", name(fast))
            }
        } else if let Some(limited) = self.at_limit(&before.q) {
            format!("`{}` is at its limit", name(limited))
        } else {
            "the branch ends: its solutions no longer exist, or are beyond limits".to_owned()
        };
        Some(Jump { sample, joint, step, why })
    }

    /// The pose at which all paths from the state before a jump end.
    fn end_of_branch(&self, sample: usize, layers: &[Vec<State>], best: &[usize]) -> String {
        let mut alive = vec![best[sample - 1]];
        for at in sample..layers.len() {
            let next: Vec<usize> = (0..layers[at].len())
                .filter(|to| alive.iter().any(|from| !self.step(at, &layers[at - 1][*from].q, &layers[at][*to].q).0))
                .collect();
            if next.is_empty() {
                return format!("at pose {}", at + 1);
            }
            alive = next;
        }
        "after the path".to_owned()
    }

    /// A joint that is near a limit, if there is one.
    fn at_limit(&self, q: &[f64]) -> Option<usize> {
        let near = |(joint, value): (&Joint, &f64)| {
            joint.limits.is_some_and(|(low, high)| (value - low).min(high - value) < 0.1 * NEAR)
        };
        self.chain.joints().iter().zip(q).position(near)
    }

    fn trajectory(&self, layers: &[Vec<State>], best: &[usize]) -> Trajectory {
        let joint = |(place, joint): (usize, &Joint)| JointTrack {
            name: joint.name.clone(),
            slides: joint.kind == JointKind::Prismatic,
            limits: joint.limits,
            speed: self.speeds.get(place).copied().flatten(),
        };
        Trajectory {
            robot: self.chain.name().to_owned(),
            joints: self.chain.joints().iter().enumerate().map(joint).collect(),
            times: self.times.to_vec(),
            q: self.unwound(layers.iter().zip(best).map(|(layer, state)| &layer[*state].q)),
            ..Trajectory::default()
        }
    }

    /// The values with joints without limits unwound to be continuous.
    fn unwound<'q>(&self, values: impl Iterator<Item = &'q Vec<f64>>) -> Vec<Vec<f64>> {
        let mut unwound: Vec<Vec<f64>> = Vec::new();
        for q in values {
            let next = match unwound.last().map(Vec::as_slice).or(self.start) {
                Some(last) => {
                    (0..q.len()).map(|joint| last[joint] + self.distance(joint, last[joint], q[joint])).collect()
                }
                None => q.clone(),
            };
            unwound.push(next);
        }
        unwound
    }
}

/// The values that differ from `value` by whole turns, within limits; without limits `value` itself.
fn within(limits: Option<(f64, f64)>, value: f64, turns: bool) -> Vec<f64> {
    let turn = std::f64::consts::TAU;
    let Some((low, high)) = limits else { return vec![value] };
    let inside = |value: &f64| *value >= low - ROUNDING && *value <= high + ROUNDING;
    if !turns {
        return Some(value).filter(inside).into_iter().collect();
    }
    let first = ((low - ROUNDING - value) / turn).ceil() as i64;
    let shifts = (first..first + 8).map(|count| value + count as f64 * turn);
    shifts.filter(inside).map(|value| value.clamp(low, high)).collect()
}
