//! Selection among the solutions of a target: those within limits, or the one nearest to a reference. Main type:
//! [`Choice`].

use std::f64::consts::TAU;

use groebot::solver::MAX_JOINTS;

use crate::kernel::{Kernel, add};
use crate::sink::{Sink, Status};
use crate::solution::Solution;
use crate::targets::Targets;

/// Tolerance of a limit for the rounding of a joint value.
const SLACK: f64 = 1e-9;

/// The selection.
#[derive(Clone, Copy, Default)]
pub struct Choice<'a> {
    /// Lower and upper limit of each joint.
    pub limits: Option<&'a [[f64; 2]]>,
    /// Reference joint values: one row for all targets, or one row for each.
    pub near: Option<&'a [f64]>,
}

impl Choice<'_> {
    /// Ends a target whose solutions begin at row `begun`, and keeps the selected ones.
    pub fn end(
        &self,
        kernel: &dyn Kernel,
        targets: &Targets<'_>,
        sink: &mut Sink<'_>,
        target: usize,
        begun: usize,
        why: Status,
    ) {
        let found = sink.taken - begun;
        let on_self_motion = (begun..sink.taken).any(|answer| sink.rows.free[answer] != 0);
        if let Some(near) = self.near.filter(|_| on_self_motion) {
            let near = reference(near, sink.joints, target);
            keep_member(kernel, targets, sink, (target, begun), (near, self.limits));
            sink.end(begun, if why == Status::Unsettled { why } else { Status::BeyondLimits });
            return;
        }
        if let Some(limits) = self.limits {
            keep_within(kernel, targets, sink, target, begun, limits);
        }
        if let Some(near) = self.near {
            let near = reference(near, sink.joints, target);
            keep_nearest(&kernel.shape().turns, sink, begun, near, self.limits);
        }
        sink.end(begun, if found > 0 && why != Status::Unsettled { Status::BeyondLimits } else { why });
    }
}

/// The reference of a target.
fn reference(near: &[f64], joints: usize, target: usize) -> &[f64] {
    let start = if near.len() == joints { 0 } else { target * joints };
    &near[start..start + joints]
}

/// Keeps the solution that is nearest to a reference within limits, on the self-motions of a singular target too.
fn keep_member(
    kernel: &dyn Kernel,
    targets: &Targets<'_>,
    sink: &mut Sink<'_>,
    (target, begun): (usize, usize),
    (near, limits): (&[f64], Option<&[[f64; 2]]>),
) {
    let endless = vec![[f64::NEG_INFINITY, f64::INFINITY]; sink.joints];
    let mut numbers = vec![0.0; targets.inputs];
    targets.row(target, &mut numbers);
    let nearest = kernel.nearest_to(&numbers, near, limits.unwrap_or(&endless)).ok().flatten();
    sink.taken = begun;
    if let Some(nearest) = nearest {
        add(sink, (&nearest).into());
    }
}

/// Keeps the solutions that are within limits after whole turns. Each angle is moved by as few turns as possible. Members of self-motions are moved along them
/// where necessary.
fn keep_within(
    kernel: &dyn Kernel,
    targets: &Targets<'_>,
    sink: &mut Sink<'_>,
    target: usize,
    begun: usize,
    limits: &[[f64; 2]],
) {
    let turns = &kernel.shape().turns;
    let (mut kept, mut strides) = (begun, false);
    let mut q = [0.0; MAX_JOINTS];
    let q = &mut q[..turns.len()];
    for answer in begun..sink.taken {
        if moved(turns, sink.row(answer), sink.row(answer), Some(limits), q) {
            sink.put(answer, kept);
            sink.row_mut(kept).copy_from_slice(q);
            kept += 1;
        } else {
            strides |= sink.rows.free[answer] != 0;
        }
    }
    sink.taken = kept;
    if strides {
        let mut numbers = vec![0.0; targets.inputs];
        targets.row(target, &mut numbers);
        if let Ok(found) = kernel.solve_within(&numbers, limits) {
            sink.taken = begun;
            found.iter().for_each(|solution| add(sink, solution.into()));
        }
    }
}

/// Keeps the solution that is nearest to a reference after whole turns within limits, with its nearest turns. Among equal ones it is the first.
fn keep_nearest(turns: &[bool], sink: &mut Sink<'_>, begun: usize, reference: &[f64], limits: Option<&[[f64; 2]]>) {
    let mut nearest = Nearest::to(turns, reference, limits);
    (begun..sink.taken).for_each(|answer| nearest.consider(answer, sink.row(answer)));
    let found = nearest.found();
    if let Some((answer, q)) = found {
        sink.put(answer, begun);
        sink.row_mut(begun).copy_from_slice(q);
    }
    sink.taken = begun + usize::from(found.is_some());
}

/// Search of the solution that is nearest to a reference after whole turns within limits. Among equal ones it is the first.
pub struct Nearest<'a> {
    turns: &'a [bool],
    reference: &'a [f64],
    limits: Option<&'a [[f64; 2]]>,
    /// The squared distance, the index and the joint values of the nearest so far.
    least: f64,
    index: Option<usize>,
    best: [f64; MAX_JOINTS],
}

impl<'a> Nearest<'a> {
    pub fn to(turns: &'a [bool], reference: &'a [f64], limits: Option<&'a [[f64; 2]]>) -> Self {
        Nearest { turns, reference, limits, least: f64::INFINITY, index: None, best: [0.0; MAX_JOINTS] }
    }

    /// Considers the solution with this index.
    pub fn consider(&mut self, index: usize, q: &[f64]) {
        let mut near = [0.0; MAX_JOINTS];
        if !moved(self.turns, q, self.reference, self.limits, &mut near[..self.turns.len()]) {
            return;
        }
        let distance: f64 = near.iter().zip(self.reference).map(|(a, b)| (a - b) * (a - b)).sum();
        if distance < self.least {
            (self.least, self.best, self.index) = (distance, near, Some(index));
        }
    }

    /// The index of the nearest solution, and its joint values after whole turns.
    pub fn found(&self) -> Option<(usize, &[f64])> {
        self.index.map(|index| (index, &self.best[..self.turns.len()]))
    }
}

/// Moves each solution by whole turns to its nearest values to `q0` within limits, and sorts the solutions by their distance to `q0`.
pub fn nearest_first(turns: &[bool], q0: &[f64], limits: Option<&[[f64; 2]]>, solutions: &mut [Solution]) {
    let mut q = vec![0.0; turns.len()];
    for solution in solutions.iter_mut() {
        if moved(turns, &solution.q, q0, limits, &mut q) {
            solution.q.copy_from_slice(&q);
        }
    }
    let distance = |solution: &Solution| solution.q.iter().zip(q0).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    solutions.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
}

/// Writes `q` with each angle moved by whole turns into its limits, as near to `reference` as possible. Returns false when a joint cannot be within its limits.
pub fn moved(turns: &[bool], q: &[f64], reference: &[f64], limits: Option<&[[f64; 2]]>, out: &mut [f64]) -> bool {
    out.iter_mut().enumerate().all(|(joint, out)| {
        let [low, high] = limits.map_or([f64::NEG_INFINITY, f64::INFINITY], |limits| limits[joint]);
        let (low, high, value) = (low - SLACK, high + SLACK, q[joint]);
        *out = value;
        if !turns[joint] {
            return (low..=high).contains(&value);
        }
        let (first, last) = (((low - value) / TAU).ceil(), ((high - value) / TAU).floor());
        if first <= last {
            *out += TAU * ((reference[joint] - value) / TAU).round().clamp(first, last);
        }
        first <= last
    })
}
