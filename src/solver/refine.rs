//! Measuring an answer by the original equations, and polishing it by Newton steps in the joints.

use super::evaluate::{Frame, half_open};
use super::program::{JointValue, Program};
use super::{ACCEPT, DAMPINGS, MAX_JOINTS, POLISH_STEPS};

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

/// Evaluates the equations at `q`; the frame then holds the code's registers.
pub(super) fn measure(program: &Program, q: &[f64], frame: &mut Frame<'_>) -> Fit {
    unknowns_of(program, q, &mut frame.unknowns);
    let kept = std::mem::take(&mut frame.registers);
    frame.run(&program.checks.code);
    let mut fit = Fit { residual: 0.0, relative: 0.0, accepted: true };
    for (residual, scale) in program.checks.residuals.iter().zip(&program.checks.scales) {
        let (value, scale) = (frame.value(*residual).abs(), frame.value(*scale));
        fit.residual = fit.residual.max(value);
        fit.relative = fit.relative.max(value / scale.max(f64::MIN_POSITIVE));
        fit.accepted &= value <= ACCEPT * scale;
    }
    fit.accepted &= fit.residual.is_finite() && q.iter().all(|value| value.is_finite());
    drop(std::mem::replace(&mut frame.registers, kept));
    fit
}

/// Up to [`POLISH_STEPS`] Gauss-Newton steps, damped where that is needed (Levenberg 1944, Marquardt 1963); each is taken only
/// if the relative residual falls.
pub(super) fn polish(program: &Program, q: &mut Vec<f64>, frame: &mut Frame<'_>) {
    let mut fit = measure(program, q, frame);
    for _ in 0..POLISH_STEPS {
        let better = DAMPINGS.iter().find_map(|damping| {
            let step = newton_step(program, q, *damping, frame)?;
            let candidate = moved(program, q, &step);
            let next = measure(program, &candidate, frame);
            (next.relative < fit.relative).then_some((candidate, next))
        });
        let Some(better) = better else { return };
        (*q, fit) = better;
    }
}

/// `q - step`, angles in (-pi, pi].
fn moved(program: &Program, q: &[f64], step: &[f64; MAX_JOINTS]) -> Vec<f64> {
    let values = program.joints.iter().zip(q.iter().zip(step));
    let one = |(joint, (value, change)): (&super::Joint, (&f64, &f64))| match joint.value {
        JointValue::Angle { .. } => wrap(value - change),
        JointValue::Plain(_) => value - change,
    };
    values.map(one).collect()
}

/// The angle moved by at most one turn into (-pi, pi].
pub(super) fn wrap(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    if angle > std::f64::consts::PI { angle - turn } else { half_open(angle) }
}

type Square = [[f64; MAX_JOINTS + 1]; MAX_JOINTS];

/// The least-squares step `(J^T J + d |J^T J|)^-1 J^T f`, or `J^-1 f` for a square Jacobian and `d = 0`; `None` when it is singular.
fn newton_step(program: &Program, q: &[f64], damping: f64, frame: &mut Frame<'_>) -> Option<[f64; MAX_JOINTS]> {
    unknowns_of(program, q, &mut frame.unknowns);
    let kept = std::mem::take(&mut frame.registers);
    frame.run(&program.checks.code);
    let (checks, joints) = (&program.checks, q.len());
    let mut system: Square = [[0.0; MAX_JOINTS + 1]; MAX_JOINTS];
    for (index, (row, residual)) in checks.jacobian.iter().zip(&checks.residuals).enumerate() {
        let residual = frame.value(*residual);
        if damping == 0.0 && checks.residuals.len() == joints {
            for column in 0..joints {
                system[index][column] = frame.value(row[column]);
            }
            system[index][joints] = residual;
        } else {
            for i in 0..joints {
                let left = frame.value(row[i]);
                for j in 0..joints {
                    system[i][j] += left * frame.value(row[j]);
                }
                system[i][joints] += left * residual;
            }
        }
    }
    drop(std::mem::replace(&mut frame.registers, kept));
    let size = (0..joints).fold(0.0, |size: f64, i| size.max(system[i][i].abs()));
    (0..joints).for_each(|i| system[i][i] += damping * size);
    solve_linear(&mut system, joints)
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
