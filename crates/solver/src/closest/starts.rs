//! The starting points of the search.

use groebot_robot::kinematics::Task;

use super::descent::{Descent, End};
use crate::Result;
use crate::Solver;

/// Points of the quasirandom sequence whose error is compared.
const POINTS: usize = 256;
/// The best of these points from which the search starts.
const BEST: usize = 24;
/// The search starts also from each point whose index is a multiple of this.
const EVERY: usize = 16;
/// Fractions of the best position found that are solved with the orientation of the target.
const FRACTIONS: [f64; 3] = [1.0, 0.95, 0.7];

/// All ends of the search, in order of the starting points.
pub(super) fn search(solver: &Solver, target: &[f64], descent: &Descent<'_>) -> Result<Vec<End>> {
    let mut ends: Vec<End> = starts(descent).iter().filter_map(|start| descent.run(start)).collect();
    let best = ends.iter().min_by(|a, b| a.error.total_cmp(&b.error)).map(|end| end.q.clone());
    if let Some(q) = best {
        let nearby = nearby(solver, target, &q)?;
        let unknown = &descent.measure.unknown;
        let start = |q: &Vec<f64>| unknown.iter().map(|&joint| q[joint]).collect::<Vec<f64>>();
        ends.extend(nearby.iter().filter_map(|q| descent.run(&start(q))));
    }
    Ok(ends)
}

/// The best points of the sequence, and some that are evenly spread.
fn starts(descent: &Descent<'_>) -> Vec<Vec<f64>> {
    let ranges: Vec<[f64; 2]> = (0..descent.measure.unknown.len()).map(|unknown| descent.range(unknown)).collect();
    let points: Vec<Vec<f64>> = sequence(&ranges).collect();
    let error = |point: &Vec<f64>| descent.measure.error(&descent.measure.whole(point)).unwrap_or(f64::INFINITY);
    let errors: Vec<f64> = points.iter().map(error).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| errors[a].total_cmp(&errors[b]));
    let spread = (0..points.len()).step_by(EVERY).filter(|index| !order[..BEST].contains(index));
    order[..BEST].iter().copied().chain(spread).map(|index| points[index].clone()).collect()
}

/// Points spread evenly over ranges: the Kronecker sequence whose steps are the powers of 1/x, where x^(n + 1) = x + 1 for n unknowns (Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences").
fn sequence(ranges: &[[f64; 2]]) -> impl Iterator<Item = Vec<f64>> + '_ {
    let root = (0..64).fold(1.5_f64, |x, _| (1.0 + x).powf(1.0 / (ranges.len() as f64 + 1.0)));
    let share = move |point: usize, unknown: usize| (root.powi(-(unknown as i32 + 1)) * (point as f64 + 0.5)).fract();
    let value =
        move |point: usize, (unknown, [low, high]): (usize, &[f64; 2])| low + (high - low) * share(point, unknown);
    (0..POINTS).map(move |point| ranges.iter().enumerate().map(|range| value(point, range)).collect())
}

/// The derived solutions of targets with the orientation of `target`, at fractions of the position that `q` reaches.
fn nearby(solver: &Solver, target: &[f64], q: &[f64]) -> Result<Vec<Vec<f64>>> {
    let lengths = match solver.outline.task {
        Some(task @ (Task::Pose | Task::Ray | Task::PositionYaw { .. })) => task.layout().lengths(),
        _ => return Ok(Vec::new()),
    };
    let Some(reached) = solver.reached(q) else { return Ok(Vec::new()) };
    let mut found = Vec::new();
    let given = solver.outline.joints.iter().zip(q).filter_map(|(joint, value)| Some((joint.given?, *value)));
    for fraction in FRACTIONS {
        let mut near = target.to_vec();
        near[..lengths].iter_mut().zip(&reached).for_each(|(number, own)| *number = fraction * own);
        given.clone().for_each(|(input, value)| near[input] = value);
        found.extend(solver.solve_numbers(&near)?.into_iter().map(|solution| solution.q));
    }
    Ok(found)
}
