//! The numeric checks of a derivation of any kind: [`check`], and at round targets alone: [`check_round`].

use super::chain::{self, coupled};
use super::{Check, Draws, Options, Report};
use crate::derive::{Proved, Source};
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
pub fn check(source: &Source, proved: &Proved, watch: &Watch) -> Result<Report> {
    let of = |targets, oracle, exact, seed| Options { targets, oracle, exact, seed, draws: Draws::All };
    let amounts = Amounts {
        equations: Options::default(),
        chain: of(240, 2, 20, 1),
        polished: of(120, 2, 0, 1),
        ideal: of(40, 0, 20, 2),
        coupled: of(60, 1, 6, 1),
    };
    let report = checked(source, proved, &amounts, watch)?;
    match &source.chain {
        Some(chain) => Ok(report.turned(chain)),
        None => Ok(report),
    }
}

/// The same at so many round targets, each of which is searched by the numeric oracle; so many again for an ideal robot.
///
/// # Errors
/// As [`check`].
pub fn check_round(source: &Source, proved: &Proved, targets: usize, watch: &Watch) -> Result<Report> {
    let options = Options { targets, oracle: 1, exact: 0, seed: 1, draws: Draws::Round };
    let amounts = Amounts { equations: options, chain: options, polished: options, ideal: options, coupled: options };
    checked(source, proved, &amounts, watch)
}

fn checked(source: &Source, proved: &Proved, amounts: &Amounts, watch: &Watch) -> Result<Report> {
    match proved {
        Proved::Equations(derivation) => Check::run(source, &derivation.program, &amounts.equations, watch),
        Proved::Chain(derived) => match &derived.unpolished {
            None => {
                chain::Check::run(&derived.chain, &derived.program, derived.program.isolated, &amounts.chain, watch)
            }
            Some(ideal) => check_both(
                derived.measured(),
                &derived.program,
                (&derived.chain, ideal, ideal.isolated),
                amounts,
                watch,
            ),
        },
        Proved::SixAxes(derived) => match &derived.unpolished {
            None => {
                chain::Check::run(&derived.chain, &derived.program, Some(derived.dimension()), &amounts.chain, watch)
            }
            Some(ideal) => {
                let bound = Some(derived.dimension());
                check_both(derived.measured(), &derived.program, (&derived.chain, ideal, bound), amounts, watch)
            }
        },
        Proved::Coupled(derived) => coupled::check(derived, &amounts.coupled, watch),
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
