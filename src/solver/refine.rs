//! Measuring an answer by the original equations, and polishing it by Newton steps in the joints.

use super::frame::Frame;
use super::instruction::Operand;
use super::program::{Checks, JointValue, Program};
use super::{ACCEPT, DAMPINGS, MAX_JOINTS, POLISH_STEPS, POLISHED};

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

/// Up to [`POLISH_STEPS`] Gauss-Newton steps from `q`, whose `fit` was measured last, damped where that is needed (Levenberg 1944,
/// Marquardt 1963); each is taken only if the relative residual falls. Joints that are `held` stay.
pub(super) fn polish(
    program: &Program,
    q: &mut Joints,
    fit: &mut Fit,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) {
    for _ in 0..POLISH_STEPS {
        if fit.relative <= POLISHED {
            return;
        }
        let Some(better) = improved(program, q, fit, held, frame) else { return };
        (*q, *fit) = better;
    }
}

/// The least damped step that lowers the relative residual.
fn improved(
    program: &Program,
    q: &Joints,
    fit: &Fit,
    held: &[bool; MAX_JOINTS],
    frame: &mut Frame<'_>,
) -> Option<(Joints, Fit)> {
    for (index, damping) in DAMPINGS.iter().enumerate() {
        if index > 0 {
            measure(program, q, frame);
        }
        let Some(step) = newton_step(program, *damping, held, frame) else { continue };
        let candidate = moved(program, q, &step);
        let next = measure(program, &candidate, frame);
        if next.relative < fit.relative {
            return Some((candidate, next));
        }
    }
    None
}

/// `q - step`, angles in (-pi, pi].
fn moved(program: &Program, q: &Joints, step: &Joints) -> Joints {
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

/// The angle in (-pi, pi]: -pi, which atan2 gives for a negative zero sine, becomes pi.
pub(super) fn half_open(angle: f64) -> f64 {
    if angle <= -std::f64::consts::PI { angle + std::f64::consts::TAU } else { angle }
}

/// The angle moved by at most one turn into (-pi, pi].
pub(super) fn wrap(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    if angle > std::f64::consts::PI { angle - turn } else { half_open(angle) }
}

type Square = [[f64; MAX_JOINTS + 1]; MAX_JOINTS];

/// The least-squares step `(J^T J + d |J^T J|)^-1 J^T f`, or `J^-1 f` for a square Jacobian, `d = 0` and no joint held, at the
/// joints that were measured last; `None` when it is singular.
fn newton_step(program: &Program, damping: f64, held: &[bool; MAX_JOINTS], frame: &mut Frame<'_>) -> Option<Joints> {
    let (checks, joints) = (&program.checks, program.joints.len());
    frame.run(&checks.code[measured(checks)..]);
    let mut system: Square = [[0.0; MAX_JOINTS + 1]; MAX_JOINTS];
    if damping == 0.0 && checks.residuals.len() == joints && *held == NONE_FREE {
        for (line, (row, residual)) in system.iter_mut().zip(checks.jacobian.iter().zip(&checks.residuals)) {
            for (entry, derivative) in line.iter_mut().zip(row) {
                *entry = frame.value(*derivative);
            }
            line[joints] = frame.value(*residual);
        }
    } else {
        normal_equations(program, held, frame, &mut system);
    }
    let size = (0..joints).fold(0.0, |size: f64, i| size.max(system[i][i].abs()));
    for i in 0..joints {
        system[i][i] += if held[i] { 1.0 } else { damping * size };
    }
    solve_linear(&mut system, joints)
}

/// Adds `J^T J` and `J^T f`; rows and columns of held joints stay zero.
fn normal_equations(program: &Program, held: &[bool; MAX_JOINTS], frame: &Frame<'_>, system: &mut Square) {
    let joints = program.joints.len();
    for (row, residual) in program.checks.jacobian.iter().zip(&program.checks.residuals) {
        let mut line = [0.0; MAX_JOINTS + 1];
        for (joint, derivative) in row.iter().enumerate() {
            line[joint] = if held[joint] { 0.0 } else { frame.value(*derivative) };
        }
        line[joints] = frame.value(*residual);
        for (i, sums) in system.iter_mut().enumerate().take(joints) {
            for (sum, entry) in sums.iter_mut().zip(&line).take(joints + 1) {
                *sum += line[i] * entry;
            }
        }
    }
}

/// Gaussian elimination with partial pivoting on an augmented matrix; `None` for a zero or non-finite pivot.
fn solve_linear(system: &mut Square, size: usize) -> Option<[f64; MAX_JOINTS]> {
    for column in 0..size {
        let mut best = column;
        for row in column + 1..size {
            if system[row][column].abs() > system[best][column].abs() {
                best = row;
            }
        }
        system.swap(column, best);
        let pivot = system[column][column];
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        for row in column + 1..size {
            let factor = system[row][column] / pivot;
            let top = system[column];
            for (entry, above) in system[row][column..=size].iter_mut().zip(&top[column..=size]) {
                *entry -= factor * above;
            }
        }
    }
    let mut solution = [0.0; MAX_JOINTS];
    for row in (0..size).rev() {
        let mut sum = system[row][size];
        for k in row + 1..size {
            sum -= system[row][k] * solution[k];
        }
        solution[row] = sum / system[row][row];
    }
    Some(solution)
}
