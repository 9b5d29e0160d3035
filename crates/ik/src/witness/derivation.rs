//! The numeric checks of any derivation: [`check`], and only at round targets: [`check_round`].

use super::chain::{check_arcs, check_chain, check_within, coupled};
use super::{Draws, Options, Report, Row, check_equations};
use crate::derive::{AnyView, ChainProblem, Derivation, Source};
use crate::solver::Program;
use crate::{Result, Watch};
use groebot_robot::kinematics::Chain;

/// The extent of the checks by type of derivation.
struct Amounts {
    equations: Options,
    chain: Options,
    /// The extent for a described robot on which the solutions of the ideal one are polished.
    polished: Options,
    /// The extent for that ideal robot.
    ideal: Options,
    /// The extent for coupled chains.
    coupled: Options,
}

/// The factor from the tolerance of a target to the maximum error of a solution. The target differs from the ideal robot's workspace by the tolerance, and so
/// does the ideal robot from the described one.
const MISSES: f64 = 2.0;
/// The numeric checks of a derivation. The joint values that made a target are shown within the limits of the source's chain, if whole turns of angles permit
/// it.
///
/// # Errors
/// As [`check_equations`] and [`check_chain`].
pub fn check<'w>(source: &Source, derivation: &Derivation, watch: impl Into<Option<&'w Watch>>) -> Result<Report> {
    let watch = Watch::or_none(watch);
    let of = |targets, oracle, exact, seed| Options { targets, oracle, exact, seed, draws: Draws::All };
    let amounts = Amounts {
        equations: Options::default(),
        chain: of(240, 2, 20, 1),
        polished: of(120, 2, 0, 1),
        ideal: of(40, 0, 20, 2),
        coupled: of(60, 1, 6, 1),
    };
    let report = checked(source, derivation, &amounts, watch)?.with_rows(arcs(derivation, watch)?);
    match &source.chain {
        Some(chain) => Ok(report.turned(chain)),
        None => Ok(report),
    }
}

/// The checks of the arcs of a redundant chain as described.
fn arcs(derivation: &Derivation, watch: &Watch) -> Result<Vec<Row>> {
    match derivation.view() {
        AnyView::Sequential(view) => check_arcs(view.problem.measured(), view.program, watch),
        AnyView::Eigenvalue(view) => check_arcs(view.problem.measured(), view.program, watch),
        AnyView::Equations(_) | AnyView::Coupled(_) => Ok(Vec::new()),
    }
}

/// Same as [`check`], but at `targets` round targets, each of which the numeric oracle searches. An ideal robot gets as many again.
///
/// # Errors
/// As [`check`].
pub fn check_round<'w>(
    source: &Source,
    derivation: &Derivation,
    targets: usize,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Report> {
    let watch = Watch::or_none(watch);
    let options = Options { targets, oracle: 1, exact: 0, seed: 1, draws: Draws::Round };
    let amounts = Amounts { equations: options, chain: options, polished: options, ideal: options, coupled: options };
    checked(source, derivation, &amounts, watch)
}

fn checked(source: &Source, derivation: &Derivation, amounts: &Amounts, watch: &Watch) -> Result<Report> {
    match derivation.view() {
        AnyView::Equations(view) => check_equations(source, view.program, &amounts.equations, watch),
        AnyView::Sequential(view) => {
            let of_ideal = |ideal: &Program| ideal.isolated;
            check_problem(view.problem, view.program, (view.unpolished()?, of_ideal), amounts, watch)
        }
        AnyView::Eigenvalue(view) => {
            let of_ideal = |_: &Program| Some(view.method.dimension());
            check_problem(view.problem, view.program, (view.unpolished()?, of_ideal), amounts, watch)
        }
        AnyView::Coupled(view) => coupled::check(view, &amounts.coupled, watch),
    }
}

/// The checks of a chain's solver. If it polishes the solutions of an ideal chain's solver, the checks of that solver too. `bound` is the maximum number of
/// solutions of the ideal chain's solver.
fn check_problem(
    problem: &ChainProblem,
    program: &Program,
    (unpolished, bound): (Option<Program>, impl Fn(&Program) -> Option<usize>),
    amounts: &Amounts,
    watch: &Watch,
) -> Result<Report> {
    match unpolished {
        None => check_chain(&problem.chain, program, bound(program), &amounts.chain, watch),
        Some(ideal) => {
            let bound = bound(&ideal);
            check_both(problem.measured(), program, (&problem.chain, &ideal, bound), amounts, watch)
        }
    }
}

/// The checks of a solver that polishes the solutions of an ideal robot on the described one: on the described robot, and those of the ideal robot's own
/// solver, whose solutions are counted exactly.
fn check_both(
    described: &Chain,
    polished: &Program,
    (ideal, own, bound): (&Chain, &Program, Option<usize>),
    amounts: &Amounts,
    watch: &Watch,
) -> Result<Report> {
    let report = match &polished.described {
        // The search requires that the target is reached exactly, but solutions only need to come near it.
        Some(inexact) => {
            let options = Options { oracle: 0, ..amounts.polished };
            check_within(described, polished, None, (&options, MISSES * inexact.within), watch)?
        }
        None => check_chain(described, polished, None, &amounts.polished, watch)?,
    };
    Ok(report.with_ideal(check_chain(ideal, own, bound, &amounts.ideal, watch)?))
}
