//! The short way from a candidate of a nearby mechanism's formulas to the answer next to it: [`approached`].

use super::angle::wrap;
use super::frame::Frame;
use super::instruction::Operand;
use super::joint::JointValue;
use super::program::{Program, Short};
use super::refine::{Fit, Joints, measure_unknowns, measured};
use super::{APPROACHES, MAX_JOINTS, PLAIN, ROUNDING, TURN};

/// Where the short way has led.
pub(super) struct Approach {
    /// The joints there.
    pub end: Joints,
    /// How well they solve the equations: within [`ROUNDING`].
    pub fit: Fit,
    /// What the candidate missed, as a share of the equations' sizes.
    pub missed: f64,
    /// The least pivot of the normal equations at the candidate, as a share of their size.
    pub pivot: f64,
}

/// Where plain Newton steps by the normal equations lead from `q`, whose unknowns the frame holds, if the equations hold there within
/// [`ROUNDING`] and are regular on the way. Where no angle turns by more than [`TURN`] in a step, pairs of cosines and sines are turned.
pub(super) fn approached(program: &Program, q: &Joints, frame: &mut Frame<'_>) -> Option<Approach> {
    let checks = &program.checks;
    let code = &checks.code[..needed(&checks.short)];
    let mut end = *q;
    stepped(program, &mut end, &[0.0; MAX_JOINTS], &mut frame.unknowns)?;
    frame.run(code);
    let missed = missed(&checks.short, frame);
    let mut first = None;
    for _ in 0..APPROACHES {
        let (step, pivot) = normal_step(program, frame)?;
        let pivot = *first.get_or_insert(pivot);
        stepped(program, &mut end, &step, &mut frame.unknowns)?;
        let fit = measure_unknowns(program, &end, frame);
        if fit.relative < ROUNDING {
            return fit.accepted.then_some(Approach { end, fit, missed, pivot });
        }
        frame.run(code.get(measured(checks)..).unwrap_or_default());
    }
    None
}

/// The largest share of a value in its scale.
fn missed(short: &[Short], frame: &Frame<'_>) -> f64 {
    let share = |one: &Short| frame.value(one.residual).abs() / frame.value(one.scale).max(f64::MIN_POSITIVE);
    short.iter().map(share).fold(0.0, f64::max)
}

/// How many instructions of the checks the short way needs.
fn needed(short: &[Short]) -> usize {
    let end = |operand: &Operand| if let Operand::Register(index) = operand { index + 1 } else { 0 };
    short.iter().flat_map(Short::operands).map(end).max().unwrap_or(0)
}

/// The step `(J^T J)^-1 J^T f` of the short way at the joints that were measured last, by elimination without pivoting, and the least pivot as a
/// share of the size; none where it is small.
fn normal_step(program: &Program, frame: &Frame<'_>) -> Option<(Joints, f64)> {
    let (short, joints) = (&program.checks.short, program.joints.len());
    let mut square = [[0.0; MAX_JOINTS]; MAX_JOINTS];
    let mut step: Joints = [0.0; MAX_JOINTS];
    let (mut size, mut least) = (0.0_f64, f64::INFINITY);
    for i in 0..joints {
        for Short { residual, derivatives, .. } in short {
            let entry = frame.value(derivatives[i]);
            (0..=i).for_each(|j| square[i][j] += entry * frame.value(derivatives[j]));
            step[i] += entry * frame.value(*residual);
        }
        size = size.max(square[i][i]);
    }
    for k in 0..joints {
        let pivot = square[k][k];
        if pivot.is_nan() || pivot <= PLAIN * size {
            return None;
        }
        least = least.min(pivot);
        for i in k + 1..joints {
            let factor = square[i][k] / pivot;
            (k + 1..=i).for_each(|j| square[i][j] -= factor * square[j][k]);
            step[i] -= factor * step[k];
        }
    }
    for k in (0..joints).rev() {
        let above = (k + 1..joints).fold(step[k], |sum, j| sum - square[j][k] * step[j]);
        step[k] = above / square[k][k];
    }
    Some((step, least / size))
}

/// Takes `step` from `q`, and turns the pairs among `unknowns` back by it, nearer to the circle; none where a pair is far from the circle.
fn stepped(program: &Program, q: &mut Joints, step: &Joints, unknowns: &mut [f64]) -> Option<()> {
    for (index, joint) in program.joints.iter().enumerate() {
        let way = step[index];
        match joint.value {
            JointValue::Angle { cosine, sine } => {
                let (c, s) = (unknowns[cosine], unknowns[sine]);
                let norm = 1.5 - 0.5 * (c * c + s * s);
                let is_round = (norm - 1.0).abs() <= TURN;
                if !is_round {
                    return None;
                }
                q[index] = wrap(q[index] - way);
                (unknowns[cosine], unknowns[sine]) = if way.abs() <= TURN {
                    let square = way * way;
                    let across = norm * way * (1.0 - square * (1.0 - square / 20.0) / 6.0);
                    let along = norm * (1.0 - 0.5 * square * (1.0 - square / 12.0));
                    (along * c + across * s, along * s - across * c)
                } else {
                    (q[index].cos(), q[index].sin())
                };
            }
            JointValue::Plain(unknown) => {
                q[index] -= way;
                unknowns[unknown] = q[index];
            }
        }
    }
    Some(())
}
