//! Polishing, the last step of the subproblems of several joints: Gauss-Newton on `e^(S1 q1) ... e^(Sn qn) p = k`, and
//! the check that `k` is reached.

use nalgebra::{Cholesky, Point3, SMatrix, SVector, Vector3};

use super::MERGE;
use super::values::{Answers, Reach};
use crate::spatial::{Screw, angle};

/// Maximum number of steps.
const STEPS: usize = 24;

/// Residual, relative to the size, below which a candidate is not refined.
const ENOUGH: f64 = 64.0 * f64::EPSILON;

/// Residual, relative to the size, above which the refinement ends.
const NEAR: f64 = 1e-3;

/// The longest step of a joint \[rad, or units of the size\].
const MAX_STEP: f64 = 0.02;

/// Two solutions that differ by more than this are different.
const NEARBY: f64 = 1e-2;

/// Refines the candidates and returns those that reach `k`, each once. With [`Reach::Closest`], when none reaches it,
/// returns those that come nearest, or the result of a search from many starting values.
pub(super) fn polish<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    reach: Reach,
    candidates: impl Iterator<Item = [Option<f64>; N]>,
) -> Answers<N> {
    let mut found = Answers::default();
    let within = match reach {
        Reach::Within(share) => share * size,
        Reach::Closest => Reach::EXACT.slack(size),
    };
    for candidate in candidates {
        let (answer, miss) = refine(screws, p, k, size, candidate);
        if miss <= within && !contains(screws, p, k, size, &found, &answer) {
            found.push(answer);
        }
    }
    if found.is_empty() && reach == Reach::Closest {
        return closest(screws, p, k, size);
    }
    found
}

/// Whether `found` contains `answer`: equal values, or values near them with only solutions between. Rounding separates
/// values like this near a double solution, or where an axis passes near its point.
fn contains<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    found: &Answers<N>,
    answer: &[Option<f64>; N],
) -> bool {
    let within = |share: f64, other: &[Option<f64>; N]| {
        (0..N).all(|i| match (answer[i], other[i], screws[i].axis()) {
            (Some(a), Some(b), Some(_)) => angle::difference(a, b).abs() <= share,
            (Some(a), Some(b), None) => (a - b).abs() <= share * size,
            (a, b, _) => a.is_none() && b.is_none(),
        })
    };
    let miss = |q: &[Option<f64>; N]| (k - carried(screws, q, p)).norm();
    let joined = |other: &[Option<f64>; N]| {
        let between = std::array::from_fn(|i| {
            let (a, b) = (answer[i]?, other[i]?);
            Some(if screws[i].axis().is_some() { a + angle::difference(b, a) / 2.0 } else { (a + b) / 2.0 })
        });
        miss(&between) <= miss(answer).max(miss(other)).max(2.0 * ENOUGH * size)
    };
    found.iter().any(|other| within(MERGE, other) || (within(NEARBY, other) && joined(other)))
}

/// The best solution of a Gauss-Newton refinement from `answer`, and its distance from `k`. Near a double solution the
/// residual increases before it decreases.
fn refine<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    mut answer: [Option<f64>; N],
) -> ([Option<f64>; N], f64) {
    let mut miss = k - carried(screws, &answer, p);
    let mut best = (answer, miss.norm());
    for _ in 0..STEPS {
        if best.1 <= ENOUGH * size {
            break;
        }
        let Some(step) = step(screws, p, &answer, &miss, size) else { break };
        // Candidates are near a solution. Without this limit, a joint whose axis passes near its point would make a
        // large step.
        for i in 0..N {
            let most = MAX_STEP * if screws[i].axis().is_some() { 1.0 } else { size };
            answer[i] = answer[i].map(|q| q + step[i].clamp(-most, most));
        }
        miss = k - carried(screws, &answer, p);
        if miss.norm() < best.1 {
            best = (answer, miss.norm());
        } else if miss.norm() > NEAR * size || best.1 <= 10.0 * ENOUGH * size {
            break;
        }
    }
    for (q, screw) in best.0.iter_mut().zip(screws) {
        if screw.axis().is_some() {
            *q = q.map(angle::wrap);
        }
    }
    best
}

/// `e^(S1 q1) ... e^(Sn qn) p`, with free joints at zero.
fn carried<const N: usize>(screws: &[Screw; N], answer: &[Option<f64>; N], p: &Point3<f64>) -> Point3<f64> {
    screws.iter().zip(answer).rev().fold(*p, |x, (screw, q)| screw.carry(q.unwrap_or(0.0), &x))
}

/// The Jacobian columns of the moved point; zero for a free joint. Also returns the directions of the axes in this
/// configuration, zero for prismatic joints.
fn columns<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    answer: &[Option<f64>; N],
) -> [(Vector3<f64>, Vector3<f64>); N] {
    // From the last joint on: the velocity at the joint, rotated by the joints before it.
    let mut columns = [(Vector3::zeros(), Vector3::zeros()); N];
    let mut x = *p;
    for i in (0..N).rev() {
        let q = answer[i].unwrap_or(0.0);
        x = screws[i].carry(q, &x);
        for (later, axis) in columns.iter_mut().skip(i + 1) {
            (*later, *axis) = (turn(&screws[i], q, later), turn(&screws[i], q, axis));
        }
        if answer[i].is_some() {
            columns[i] = match &screws[i] {
                Screw::Revolute(axis) => (axis.direction().cross(&(x - axis.point())), axis.direction().into_inner()),
                Screw::Prismatic(direction) => (direction.into_inner(), Vector3::zeros()),
            };
        }
    }
    columns
}

/// The Gauss-Newton step, with a small damping that keeps it finite at singular configurations.
fn step<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    answer: &[Option<f64>; N],
    miss: &Vector3<f64>,
    size: f64,
) -> Option<[f64; N]> {
    let columns = columns(screws, p, answer).map(|(column, _)| column);
    // Each joint in its own unit, since an axis may pass near its point.
    let units = columns.map(|column| column.norm().max(1e-12 * size));
    let square = SMatrix::<f64, N, N>::from_fn(|i, j| columns[i].dot(&columns[j]) / units[i] / units[j]);
    let damping = 1e-15 * square.trace().max(f64::MIN_POSITIVE);
    let projected = SVector::<f64, N>::from_fn(|i, _| columns[i].dot(miss) / units[i]);
    let solved = Cholesky::new(square + SMatrix::<f64, N, N>::identity() * damping)?.solve(&projected);
    Some(std::array::from_fn(|i| solved[i] / units[i]))
}

/// Newton's step to a minimum distance, damped; none when the distance has no positive curvature.
fn downhill<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    answer: &[Option<f64>; N],
    miss: &Vector3<f64>,
    size: f64,
    damping: f64,
) -> Option<[f64; N]> {
    let columns = columns(screws, p, answer);
    let units = screws.each_ref().map(|screw| if screw.axis().is_some() { 1.0 } else { size });
    let hessian = SMatrix::<f64, N, N>::from_fn(|i, j| {
        // A joint rotates the velocities of the later joints.
        let (before, after) = (i.min(j), i.max(j));
        let curvature = columns[before].1.cross(&columns[after].0).dot(miss);
        (columns[i].0.dot(&columns[j].0) - curvature) * units[i] * units[j]
    });
    let projected = SVector::<f64, N>::from_fn(|i, _| columns[i].0.dot(miss) * units[i]);
    let damped = hessian + SMatrix::<f64, N, N>::identity() * (damping * size * size);
    let solved = Cholesky::new(damped)?.solve(&projected);
    Some(std::array::from_fn(|i| solved[i] * units[i]))
}

fn turn(screw: &Screw, q: f64, x: &Vector3<f64>) -> Vector3<f64> {
    match screw {
        Screw::Revolute(axis) => x + crate::spatial::rotation::displacement(&axis.direction(), q, x),
        Screw::Prismatic(_) => *x,
    }
}

/// The values whose point is nearest to `k`, by Gauss-Newton from a grid of starting values.
fn closest<const N: usize>(screws: &[Screw; N], p: &Point3<f64>, k: &Point3<f64>, size: f64) -> Answers<N> {
    const GRID: usize = 7;
    let mut best: Vec<([Option<f64>; N], f64)> = Vec::new();
    for number in 0..GRID.pow(N as u32) {
        let start: [Option<f64>; N] = std::array::from_fn(|i| {
            let share = (number / GRID.pow(i as u32) % GRID) as f64 / GRID as f64;
            Some(match screws[i].axis() {
                Some(_) => std::f64::consts::TAU * share,
                None => size * (2.0 * share - 1.0),
            })
        });
        best.push(descend(screws, p, k, size, start));
    }
    let least = best.iter().map(|(_, miss)| *miss).fold(f64::INFINITY, f64::min);
    let mut found = Answers::default();
    for (answer, miss) in &best {
        let near = *miss <= least + 1e-9 * size;
        let similar = |other: &[Option<f64>; N]| {
            (0..N).all(|i| match (answer[i], other[i], screws[i].axis()) {
                (Some(a), Some(b), Some(_)) => angle::difference(a, b).abs() <= 1e-4,
                (Some(a), Some(b), None) => (a - b).abs() <= 1e-4 * size,
                _ => false,
            })
        };
        if near && found.len() < 4 && !found.iter().any(similar) {
            found.push(*answer);
        }
    }
    found
}

/// Damped Newton (Levenberg 1944) to a minimum distance from `k`.
fn descend<const N: usize>(
    screws: &[Screw; N],
    p: &Point3<f64>,
    k: &Point3<f64>,
    size: f64,
    start: [Option<f64>; N],
) -> ([Option<f64>; N], f64) {
    let (mut answer, mut damping) = (start, 1e-3);
    let mut miss = k - carried(screws, &answer, p);
    for _ in 0..100 {
        let next = downhill(screws, p, &answer, &miss, size, damping)
            .map(|step| std::array::from_fn(|i| answer[i].map(|q| q + step[i])));
        let better = next.map(|next| (next, k - carried(screws, &next, p)));
        match better.filter(|(_, better)| better.norm() < miss.norm()) {
            Some((next, better)) => (answer, miss, damping) = (next, better, damping / 10.0),
            None if damping > 1e6 => break,
            None => damping *= 10.0,
        }
    }
    refine(screws, p, k, size, answer)
}
