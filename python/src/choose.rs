//! Selection among the solutions of a target: those within limits, or the one nearest to a reference. Main type:
//! [`Choice`].

use std::f64::consts::TAU;

use groebot::solver::MAX_JOINTS;

use crate::kernel::{Answer, Kernel};
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
    if let Some(nearest) = nearest
        && let Some(rows) = sink.more(1)
    {
        let Answer { q, residual, branch, free, .. } = (&nearest).into();
        rows.q.copy_from_slice(q);
        (rows.residual[0], rows.branch[0], rows.free[0]) = (residual, branch as i32, free);
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
            for answer in &found {
                let Some(rows) = sink.more(1) else { return };
                let Answer { q, residual, branch, free, .. } = answer.into();
                rows.q.copy_from_slice(q);
                (rows.residual[0], rows.branch[0], rows.free[0]) = (residual, branch as i32, free);
            }
        }
    }
}

/// Keeps the solution that is nearest to a reference after whole turns within limits, with its nearest turns. Among equal ones it is the first.
fn keep_nearest(turns: &[bool], sink: &mut Sink<'_>, begun: usize, reference: &[f64], limits: Option<&[[f64; 2]]>) {
    let (mut best, mut least) = ([0.0; MAX_JOINTS], f64::INFINITY);
    let (mut q, mut nearest) = ([0.0; MAX_JOINTS], None);
    let joints = turns.len();
    for answer in begun..sink.taken {
        if !moved(turns, sink.row(answer), reference, limits, &mut q[..joints]) {
            continue;
        }
        let distance: f64 = q.iter().zip(reference).map(|(a, b)| (a - b) * (a - b)).sum();
        if distance < least {
            (least, best, nearest) = (distance, q, Some(answer));
        }
    }
    if let Some(answer) = nearest {
        sink.put(answer, begun);
        sink.row_mut(begun).copy_from_slice(&best[..joints]);
    }
    sink.taken = begun + usize::from(nearest.is_some());
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
fn moved(turns: &[bool], q: &[f64], reference: &[f64], limits: Option<&[[f64; 2]]>, out: &mut [f64]) -> bool {
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
