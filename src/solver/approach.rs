//! The short way from a candidate of a nearby mechanism's formulas to the answer next to it: [`approached`].

use super::frame::Frame;
use super::program::Program;
use super::refine::{Fit, Joints, measure, measured, moved};
use super::{APPROACHES, MAX_JOINTS, PLAIN, ROUNDING, STEEP};

/// Where plain Newton steps by the normal equations lead from `q`, which was measured last and misses by `missed`, if the equations hold there
/// within [`ROUNDING`] and are regular on the way; else none, and `q` is measured again.
pub(super) fn approached(program: &Program, q: &Joints, missed: f64, frame: &mut Frame<'_>) -> Option<(Joints, Fit)> {
    let (mut end, mut relative) = (*q, missed);
    for _ in 0..APPROACHES {
        let Some(step) = normal_step(program, relative, frame) else { break };
        end = moved(program, &end, &step);
        let fit = measure(program, &end, frame);
        if fit.relative < ROUNDING {
            return fit.accepted.then_some((end, fit));
        }
        relative = fit.relative;
    }
    measure(program, q, frame);
    None
}

/// The step `(J^T J)^-1 J^T f` at the joints that were measured last, which miss by `missed`, by elimination without pivoting; none where a
/// pivot is small.
fn normal_step(program: &Program, missed: f64, frame: &mut Frame<'_>) -> Option<Joints> {
    let (checks, joints) = (&program.checks, program.joints.len());
    frame.run(&checks.code[measured(checks)..]);
    let mut square = [[0.0; MAX_JOINTS]; MAX_JOINTS];
    let mut step: Joints = [0.0; MAX_JOINTS];
    let mut size = 0.0_f64;
    for i in 0..joints {
        for (row, residual) in checks.jacobian.iter().zip(&checks.residuals) {
            let entry = frame.value(row[i]);
            (0..=i).for_each(|j| square[i][j] += entry * frame.value(row[j]));
            step[i] += entry * frame.value(*residual);
        }
        size = size.max(square[i][i]);
    }
    let least = PLAIN.max(STEEP * missed) * size;
    for k in 0..joints {
        let pivot = square[k][k];
        if pivot.is_nan() || pivot <= least {
            return None;
        }
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
    Some(step)
}
