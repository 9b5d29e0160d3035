//! The numeric checks of a derivation of any kind: [`check`], and at round targets alone: [`check_round`].

use super::chain::{self, coupled};
use super::{Check, Draws, Options, Report};
use crate::derive::{AnyView, ChainProblem, Derivation, Source};
use crate::solver::Program;
use crate::{Result, Watch};
use groebot_robot::kinematics::Chain;

/// How much is checked, by the kind of a derivation.
struct Amounts {
    equations: Options,
    chain: Options,
    /// A described robot on which the answers of the ideal one are polished.
    polished: Options,
    /// That ideal one.
    ideal: Options,
    /// Chains that share actuators.
    coupled: Options,
}

/// How many times the tolerance of a target an answer may miss it by: so far is the target from what the ideal robot reaches, and this from the described one.
const MISSES: f64 = 2.0;
/// The numeric checks of a derivation. The joint values that made a target are shown within the limits of the source's chain, where whole turns of
/// angles do that.
///
/// # Errors
/// As [`Check::run`], [`chain::Check::run`] and [`coupled::check`].
pub fn check(source: &Source, derivation: &Derivation, watch: &Watch) -> Result<Report> {
    let of = |targets, oracle, exact, seed| Options { targets, oracle, exact, seed, draws: Draws::All };
    let amounts = Amounts {
        equations: Options::default(),
        chain: of(240, 2, 20, 1),
        polished: of(120, 2, 0, 1),
        ideal: of(40, 0, 20, 2),
        coupled: of(60, 1, 6, 1),
    };
    let report = checked(source, derivation, &amounts, watch)?;
    match &source.chain {
        Some(chain) => Ok(report.turned(chain)),
        None => Ok(report),
    }
}

/// The same at so many round targets, each of which is searched by the numeric oracle; so many again for an ideal robot.
///
/// # Errors
/// As [`check`].
pub fn check_round(source: &Source, derivation: &Derivation, targets: usize, watch: &Watch) -> Result<Report> {
    let options = Options { targets, oracle: 1, exact: 0, seed: 1, draws: Draws::Round };
    let amounts = Amounts { equations: options, chain: options, polished: options, ideal: options, coupled: options };
    checked(source, derivation, &amounts, watch)
}

fn checked(source: &Source, derivation: &Derivation, amounts: &Amounts, watch: &Watch) -> Result<Report> {
    match derivation.view() {
        AnyView::Equations(view) => Check::run(source, view.program, &amounts.equations, watch),
        AnyView::Sequential(view) => {
            let of_ideal = |ideal: &Program| ideal.isolated;
            check_chain(view.problem, view.program, (view.unpolished()?, of_ideal), amounts, watch)
        }
        AnyView::Eigenvalue(view) => {
            let of_ideal = |_: &Program| Some(view.method.dimension());
            check_chain(view.problem, view.program, (view.unpolished()?, of_ideal), amounts, watch)
        }
        AnyView::Coupled(view) => coupled::check(view, &amounts.coupled, watch),
    }
}

/// The checks of a chain's solver, and where that polishes the answers of an ideal chain's solver, those of this one too; `bound` is the most solutions that
/// the solver of the ideal chain may have.
fn check_chain(
    problem: &ChainProblem,
    program: &Program,
    (unpolished, bound): (Option<Program>, impl Fn(&Program) -> Option<usize>),
    amounts: &Amounts,
    watch: &Watch,
) -> Result<Report> {
    match unpolished {
        None => chain::Check::run(&problem.chain, program, bound(program), &amounts.chain, watch),
        Some(ideal) => {
            let bound = bound(&ideal);
            check_both(problem.measured(), program, (&problem.chain, &ideal, bound), amounts, watch)
        }
    }
}

/// The checks of a solver that polishes the answers of an ideal robot on the one described: on this one, and those of the ideal robot's own
/// solver, whose solutions are counted exactly.
fn check_both(
    described: &Chain,
    polished: &Program,
    (ideal, own, bound): (&Chain, &Program, Option<usize>),
    amounts: &Amounts,
    watch: &Watch,
) -> Result<Report> {
    let report = match &polished.described {
        // What a search finds reaches the target, and answers need only come near.
        Some(told) => {
            let options = Options { oracle: 0, ..amounts.polished };
            chain::Check::run_within(described, polished, None, (&options, MISSES * told.within), watch)?
        }
        None => chain::Check::run(described, polished, None, &amounts.polished, watch)?,
    };
    Ok(report.with_ideal(chain::Check::run(ideal, own, bound, &amounts.ideal, watch)?))
}
