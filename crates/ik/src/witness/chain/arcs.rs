//! The check of a redundant arm's arcs, at joint values within limits. Main function: [`check_arcs`].

use std::f64::consts::{PI, TAU};

use super::model::{Configuration, Joints, Model};
use super::targets::Targets;
use crate::solver::Program;
use crate::solver::redundant::{Arcs, ArmTarget, Criterion, RedundantSolver};
use crate::tolerances::WITNESS;
use crate::witness::{Draws, Fault, Kind, Row, Verdict};
use crate::{ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;

/// The number of joint vectors. In every fourth, angles are multiples of [`ROUND`].
const VECTORS: usize = 40;
/// Round angles: 15 degrees.
const ROUND: f64 = PI / 12.0;
/// The random seed.
const SEED: u64 = 3;

/// Checks the arcs of a redundant program at targets of joint values within limits: the joint values are on an arc, and the ends of arcs reach the target and
/// are within limits. Unsure arcs may lack the joint values. A row has the number of arcs instead of that of solutions. Rows with unsure arcs count as singular.
/// No rows without redundancy.
///
/// # Errors
/// Those of the solver, except for gaps and bounded work. The error of `watch` if it stops the check. Failed checks are in the rows.
pub fn check_arcs<'w>(chain: &Chain, program: &Program, watch: impl Into<Option<&'w Watch>>) -> Result<Vec<Row>> {
    let watch = Watch::or_none(watch);
    let Some(solver) = program.redundant_solver() else { return Ok(Vec::new()) };
    let model = Model::new(chain);
    let mut targets = Targets::new(&model, Draws::All, SEED);
    let mut rows = Vec::with_capacity(VECTORS);
    for number in 0..VECTORS {
        watch.check()?;
        let mut q = targets.joints();
        for (joint, value) in q.iter_mut().enumerate().filter(|(joint, _)| model.turns(*joint)) {
            *value = within(*value, solver.limits().pairs()[joint], number % 4 == 3);
        }
        rows.push(row(&model, &solver, number, q)?);
    }
    Ok(rows)
}

/// An angle in (-pi, pi] moved between limits of at most a turn, and to a round value if there is one.
fn within(angle: f64, [low, high]: [f64; 2], is_round: bool) -> f64 {
    let (low, high) = if high - low < TAU { (low, high) } else { (-PI, PI) };
    let angle = low + (angle + PI) / TAU * (high - low);
    let round = (angle / ROUND).round() * ROUND;
    if is_round && (low..=high).contains(&round) { round } else { angle }
}

fn row(model: &Model<'_>, solver: &RedundantSolver, number: usize, q: Vec<f64>) -> Result<Row> {
    let numbers = model.target(&q);
    let own = numbers.len() - model.given.len();
    let target = solver.target_of_numbers(&numbers[..own])?;
    let mut row = Row::open(number, Kind::Arcs, numbers, Some(q.clone()), None);
    let arcs = match solver.arcs(&target, &solver.limits()) {
        Ok(arcs) => arcs,
        Err(error) if [ErrorKind::Unsupported, ErrorKind::Budget].contains(&error.kind()) => return Ok(row),
        Err(error) => return Err(error.with_context(format!("arcs at {q:?}"))),
    };
    row.solutions = arcs.arcs.len();
    row.is_singular = arcs.is_unsure || arcs.is_surface || model.sigma(&q) <= WITNESS.ordinary;
    let faults = faults(model, solver, (&target, &arcs), &q, &mut row)?;
    row.verdict = if faults.is_empty() { Verdict::Pass } else { Verdict::Fail(faults) };
    Ok(row)
}

fn faults(
    model: &Model<'_>,
    solver: &RedundantSolver,
    (target, arcs): (&ArmTarget, &Arcs),
    q: &[f64],
    row: &mut Row,
) -> Result<Vec<Fault>> {
    let limits = solver.limits();
    let nearest = solver.best_on(target, &limits, &arcs.arcs, &Criterion::nearest(q.to_vec()))?;
    let distance = nearest.map_or(f64::INFINITY, |best| best.value);
    row.nearest = Some(distance);
    let ends = || arcs.arcs.iter().flat_map(|arc| [&arc.start.q, &arc.end.q]);
    let worst = ends().map(|end| model.residual(&row.target, end)).fold(0.0, f64::max);
    row.worst_residual = Some(worst);
    let is_beyond = |end: &Vec<f64>| {
        let mut pairs = end.iter().zip(limits.pairs());
        pairs.any(|(value, [low, high])| !(low - WITNESS.duplicate..=high + WITNESS.duplicate).contains(value))
    };
    let found = [
        (distance > WITNESS.near && !arcs.is_surface && !arcs.is_unsure, Fault::Missing),
        (worst > WITNESS.equal, Fault::Residual),
        (ends().any(is_beyond), Fault::Limits),
    ];
    Ok(found.into_iter().filter_map(|(is_wrong, fault)| is_wrong.then_some(fault)).collect())
}
