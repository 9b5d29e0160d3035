//! Measuring an answer by the original equations, and polishing it by Newton steps in the joints.

use std::f64::consts::{PI, TAU};

use super::angle::wrap;
use super::frame::Frame;
use super::instruction::Operand;
use super::joint::JointValue;
use super::program::{Checks, Program};
use super::{
    ACCEPT, DAMPINGS, INVERSIONS, LEAPS, MAX_JOINTS, NEAR, OVERSHOT, PATIENCE, POLISH_STEPS, POLISHED, RETURNS,
    ROUNDING, SHORT, STIFF,
};

/// Joint values; places behind the program's joints are zero.
pub(super) type Joints = [f64; MAX_JOINTS];

/// No joint is held.
pub(super) const NONE_FREE: [bool; MAX_JOINTS] = [false; MAX_JOINTS];

/// How well a joint vector solves the equations.
pub(super) struct Fit {
    /// The largest magnitude of an equation's value.
    pub residual: f64,
    /// The largest share of an equation's value in its scale.
    pub relative: f64,
    /// Whether every equation holds within [`ACCEPT`].
    pub accepted: bool,
}

/// The unknowns at joint values `q`: cosines and sines of angles, other joints as they are.
pub(super) fn unknowns_of(program: &Program, q: &[f64], unknowns: &mut [f64]) {
    for (joint, &value) in program.joints.iter().zip(q) {
        match joint.value {
            JointValue::Angle { cosine, sine } => {
                unknowns[cosine] = value.cos();
                unknowns[sine] = value.sin();
            }
            JointValue::Plain(unknown) => unknowns[unknown] = value,
        }
    }
}

/// How many instructions of the checks the equations' values and sizes need; the others are for the derivatives.
pub(super) fn measured(checks: &Checks) -> usize {
    let end = |operand: &Operand| if let Operand::Register(index) = operand { index + 1 } else { 0 };
    checks.residuals.iter().chain(&checks.scales).map(end).max().unwrap_or(0)
}

/// Evaluates the equations at `q`; the frame then holds their registers.
pub(super) fn measure(program: &Program, q: &Joints, frame: &mut Frame<'_>) -> Fit {
    unknowns_of(program, q, &mut frame.unknowns);
    measure_unknowns(program, q, frame)
}

/// Evaluates the equations at the frame's unknowns, which are those of `q` but for rounding.
pub(super) fn measure_unknowns(program: &Program, q: &Joints, frame: &mut Frame<'_>) -> Fit {
    frame.run(&program.checks.code[..measured(&program.checks)]);
    let mut fit = Fit { residual: 0.0, relative: 0.0, accepted: true };
    for (residual, scale) in program.checks.residuals.iter().zip(&program.checks.scales) {
        let (value, scale) = (frame.value(*residual).abs(), frame.value(*scale));
        fit.residual = fit.residual.max(value);
        fit.relative = fit.relative.max(value / scale.max(f64::MIN_POSITIVE));
        fit.accepted &= value <= ACCEPT * scale;
    }
    fit.accepted &= fit.residual.is_finite() && q.iter().all(|value| value.is_finite());
    fit
}

/// Measures `q` and polishes it: how well it then solves the equations.
pub(super) fn polished(program: &Program, q: &mut Joints, held: &[bool; MAX_JOINTS], frame: &mut Frame<'_>) -> Fit {
    let mut fit = measure(program, q, frame);
    polish(program, q, &mut fit, held, frame);
    fit
}

/// Up to [`POLISH_STEPS`] Gauss-Newton steps from `q`, whose `fit` was measured last, damped where that is needed (Levenberg 1944,
/// Marquardt 1963); each is taken only if the relative residual falls, at once or after a leap. Joints that are `held` stay.
pub(super) fn polish(
    program: &Program,
    q: &mut Joints,
    fit: &mut Fit,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) {
    let mut slow = 0;
    for _ in 0..POLISH_STEPS {
        if fit.relative <= POLISHED || slow == PATIENCE {
            return;
        }
        let Some(better) = improved(program, q, fit, held, frame) else { return };
        slow = if better.1.relative <= f64::max(0.5 * fit.relative, ROUNDING) { 0 } else { slow + 1 };
        let step = std::array::from_fn(|joint| better.0[joint] - q[joint]);
        (*q, *fit) = better;
        if fit.relative < ROUNDING && length(program, &step) <= SHORT {
            return;
        }
    }
}

/// The least damped step that lowers the relative residual: where it is more than rounding, to half of it, else a leap, else at all. Where
/// it is rounding and a plain step is short, that is the last.
fn improved(
    program: &Program,
    q: &Joints,
    fit: &Fit,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) -> Option<(Joints, Fit)> {
    let leaps = (ROUNDING..=NEAR).contains(&fit.relative);
    let enough = if leaps { 0.5 * fit.relative } else { fit.relative };
    let mut fallen = None;
    for (index, damping) in DAMPINGS.iter().enumerate() {
        if index > 0 {
            measure(program, q, frame);
        }
        let Some(step) = newton_step(program, *damping, held, frame) else { continue };
        let candidate = moved(program, q, &step);
        let next = measure(program, &candidate, frame);
        if next.relative < enough {
            return Some((candidate, next));
        }
        if index == 0 && fit.relative < ROUNDING && length(program, &step) <= SHORT {
            return None;
        }
        if leaps
            && index == 0
            && *held == NONE_FREE
            && next.relative <= OVERSHOT * fit.relative
            && let Some(end) = returned(program, candidate, fit.relative, held, frame)
        {
            return Some(end);
        }
        if next.relative < fit.relative && fallen.is_none() {
            fallen = Some(candidate);
        }
    }
    if leaps && let Some(end) = leap(program, q, enough, held, frame) {
        return Some(end);
    }
    let candidate = fallen?;
    // The frame must hold what is returned.
    let next = measure(program, &candidate, frame);
    Some((candidate, next))
}

/// Newton steps from the joints that were measured last, on until they miss by less than `relative`: from between two roots next to each
/// other the first step leads beyond one of them, and from there on each quarters the miss.
fn returned(
    program: &Program,
    mut q: Joints,
    relative: f64,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) -> Option<(Joints, Fit)> {
    for _ in 0..RETURNS {
        let step = newton_step(program, 0.0, held, frame)?;
        q = moved(program, &q, &step);
        let fit = measure(program, &q, frame);
        if fit.relative < relative {
            return Some((q, fit));
        }
    }
    None
}

/// A Newton step, or a part of it, and behind it damped steps back to where the equations nearly hold, until they hold within `enough`.
/// Next to a self-motion the miss hardly changes along a bent way, and rises on each straight one: the watchdog technique (Chamberlain,
/// Powell, Lemarechal, Pedersen 1982).
fn leap(
    program: &Program,
    q: &Joints,
    enough: f64,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) -> Option<(Joints, Fit)> {
    measure(program, q, frame);
    let step = newton_step(program, 0.0, held, frame)?;
    let longest = length(program, &step);
    if !longest.is_finite() {
        return None;
    }
    for most in LEAPS {
        let share = (most / longest).min(1.0);
        let mut candidate = moved(program, q, &step.map(|way| share * way));
        measure(program, &candidate, frame);
        for _ in 0..RETURNS {
            let Some(back) = newton_step(program, STIFF, held, frame) else { break };
            candidate = moved(program, &candidate, &back);
            let next = measure(program, &candidate, frame);
            if next.relative < enough {
                return Some((candidate, next));
            }
        }
    }
    None
}

/// Whether the equations hold within `bound` at `q`, or where a few damped steps lead from there, which leave alone in what direction the
/// equations hardly change.
pub(super) fn nearly_holds(
    program: &Program,
    q: &Joints,
    bound: f64,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) -> bool {
    let mut at = *q;
    let mut fit = measure(program, &at, frame);
    for _ in 0..RETURNS {
        if fit.relative <= bound {
            return true;
        }
        let Some(back) = newton_step(program, STIFF, held, frame) else { return false };
        at = moved(program, &at, &back);
        fit = measure(program, &at, frame);
    }
    fit.relative <= bound
}

/// The longest way of a joint in a step: an angle, or a share of the program's scale.
fn length(program: &Program, step: &Joints) -> f64 {
    let mut longest = 0.0_f64;
    for (joint, way) in program.joints.iter().zip(step) {
        let size = if matches!(joint.value, JointValue::Plain(_)) { program.scale } else { 1.0 };
        longest = longest.max(way.abs() / size);
    }
    longest
}

/// How much each joint matters to the equations at `q`: the greatest derivative as a share of its equation's scale, at most one; one
/// for a length.
pub(super) fn weights(program: &Program, q: &Joints, frame: &mut Frame<'_>) -> Joints {
    let checks = &program.checks;
    unknowns_of(program, q, &mut frame.unknowns);
    frame.run(&checks.code);
    let mut weights: Joints = [0.0; MAX_JOINTS];
    for (row, scale) in checks.jacobian.iter().zip(&checks.scales) {
        let scale = frame.value(*scale).max(f64::MIN_POSITIVE);
        for (weight, derivative) in weights.iter_mut().zip(row) {
            *weight = weight.max(frame.value(*derivative).abs() / scale);
        }
    }
    for (weight, joint) in weights.iter_mut().zip(&program.joints) {
        *weight = if matches!(joint.value, JointValue::Plain(_)) { 1.0 } else { weight.min(1.0) };
    }
    weights
}

/// `q - step`, angles in (-pi, pi].
pub(super) fn moved(program: &Program, q: &Joints, step: &Joints) -> Joints {
    let mut moved = *q;
    for (index, joint) in program.joints.iter().enumerate() {
        let value = q[index] - step[index];
        moved[index] = match joint.value {
            JointValue::Angle { .. } => wrap(value),
            JointValue::Plain(_) => value,
        };
    }
    moved
}

/// `a - b` for one joint, for an angle by the shorter way round.
pub(super) fn difference(program: &Program, joint: usize, a: &[f64], b: &[f64]) -> f64 {
    let difference = a[joint] - b[joint];
    match program.joints[joint].value {
        JointValue::Angle { .. } if difference > PI => difference - TAU,
        JointValue::Angle { .. } if difference < -PI => difference + TAU,
        _ => difference,
    }
}

/// The least-squares step `(J^T J + d |J^T J|)^-1 J^T f` at the joints that were measured last; `None` when it is singular. The rows
/// of the Jacobian and of the damping are turned into a triangle (Householder 1958): a direction in which the equations hardly change is
/// not lost, as it would be in `J^T J`.
fn newton_step(program: &Program, damping: f64, held: &[bool; MAX_JOINTS], frame: &mut Frame<'_>) -> Option<Joints> {
    substituted(&triangle(program, damping, held, frame))
}

/// The least pivot of the Jacobian's triangle at `q` as a share of the largest: rounding where the joints can move while the equations
/// hold, or a root is double. No pivot is less than the least singular value.
pub(super) fn regularity(program: &Program, q: &Joints, frame: &mut Frame<'_>) -> f64 {
    measure(program, q, frame);
    let columns = triangle(program, 0.0, &NONE_FREE, frame);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (row, column) in columns.iter().enumerate().take(program.joints.len()) {
        (least, most) = (least.min(column[row].abs()), most.max(column[row].abs()));
    }
    least / most
}

/// The direction in which the equations change least at `q`, its longest way one, and by what share of the largest pivot they do. By
/// inverse iteration; `None` where a pivot is zero.
pub(super) fn stillest(program: &Program, q: &Joints, frame: &mut Frame<'_>) -> Option<(Joints, f64)> {
    measure(program, q, frame);
    let mut columns = triangle(program, 0.0, &NONE_FREE, frame);
    let joints = program.joints.len();
    let most = (0..joints).map(|joint| columns[joint][joint].abs()).fold(0.0, f64::max);
    let mut way: Joints = [1.0; MAX_JOINTS];
    let mut share = 1.0;
    for _ in 0..INVERSIONS {
        for row in 0..joints {
            let above = columns[row][..row].iter().zip(&columns[joints]);
            let sum = above.fold(way[row], |sum, (entry, solved)| sum - entry * solved);
            columns[joints][row] = sum / columns[row][row];
        }
        let before = size(&columns[joints][..joints]);
        way = substituted(&columns)?;
        share = before / (size(&way[..joints]) * most);
    }
    let longest = length(program, &way);
    (longest.is_finite() && longest > 0.0).then(|| (way.map(|way| way / longest), share))
}

fn size(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |sum, x| sum + x * x).sqrt()
}

/// The triangle of a step's equations, the right side in the last column.
fn triangle(program: &Program, damping: f64, held: &[bool; MAX_JOINTS], frame: &mut Frame<'_>) -> Vec<Vec<f64>> {
    let (checks, joints) = (&program.checks, program.joints.len());
    frame.run(&checks.code[measured(checks)..]);
    let equations = checks.residuals.len();
    let mut columns = vec![vec![0.0; equations + joints]; joints + 1];
    let mut size = 0.0_f64;
    for joint in 0..joints {
        let mut square = 0.0;
        for (row, derivatives) in checks.jacobian.iter().enumerate() {
            let entry = if held[joint] { 0.0 } else { frame.value(derivatives[joint]) };
            columns[joint][row] = entry;
            square += entry * entry;
        }
        size = size.max(square);
    }
    for (entry, residual) in columns[joints].iter_mut().zip(&checks.residuals) {
        *entry = frame.value(*residual);
    }
    for joint in 0..joints {
        columns[joint][equations + joint] = if held[joint] { 1.0 } else { (damping * size).sqrt() };
    }
    reflect(&mut columns);
    columns
}

/// Turns all columns but the last into a triangle by reflections.
fn reflect(columns: &mut [Vec<f64>]) {
    for pivot in 0..columns.len() - 1 {
        let mut mirror = columns[pivot][pivot..].to_vec();
        let square = mirror.iter().fold(0.0, |sum, x| sum + x * x);
        if square == 0.0 {
            continue;
        }
        let length = square.sqrt().copysign(mirror[0]);
        mirror[0] += length;
        let half = length * mirror[0];
        columns[pivot][pivot] = -length;
        for column in &mut columns[pivot + 1..] {
            let along = mirror.iter().zip(&column[pivot..]).fold(0.0, |sum, (x, y)| sum + x * y) / half;
            for (x, y) in column[pivot..].iter_mut().zip(&mirror) {
                *x -= along * y;
            }
        }
    }
}

/// The solution of a triangular system whose right side is the last column; `None` for a zero or non-finite pivot.
fn substituted(columns: &[Vec<f64>]) -> Option<Joints> {
    let joints = columns.len() - 1;
    let mut solution = [0.0; MAX_JOINTS];
    for row in (0..joints).rev() {
        let pivot = columns[row][row];
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        let mut sum = columns[joints][row];
        for k in row + 1..joints {
            sum -= columns[k][row] * solution[k];
        }
        solution[row] = sum / pivot;
    }
    Some(solution)
}
