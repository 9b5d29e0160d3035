//! The numeric checks of a derivation of any kind: [`check`].

use super::chain::{self, coupled};
use super::{Check, Options, Report};
use crate::derive::{Proved, Source};
use crate::kinematics::Chain;
use crate::solver::Program;
use crate::{Result, Watch};

/// How much is checked of a chain.
const CHAIN: Options = Options { targets: 240, oracle: 2, exact: 20, seed: 1 };
/// How much is checked of a described robot on which the answers of the ideal one are polished, and how much of that ideal one.
const POLISHED: Options = Options { targets: 120, oracle: 2, exact: 0, seed: 1 };
const IDEAL: Options = Options { targets: 40, oracle: 0, exact: 20, seed: 2 };
/// How many times the tolerance of a target an answer may miss it by: so far is the target from what the ideal robot reaches, and this from the described one.
const MISSES: f64 = 2.0;
/// How much is checked of chains that share actuators.
const COUPLED: Options = Options { targets: 60, oracle: 1, exact: 6, seed: 1 };

/// The numeric checks of a derivation. The joint values that made a target are shown within the limits of the source's chain, where whole turns of
/// angles do that.
///
/// # Errors
/// As [`Check::run`], [`chain::Check::run`] and [`coupled::check`].
pub fn check(source: &Source, proved: &Proved, watch: &Watch) -> Result<Report> {
    let report = checked(source, proved, watch)?;
    match &source.chain {
        Some(chain) => Ok(report.turned(chain)),
        None => Ok(report),
    }
}

fn checked(source: &Source, proved: &Proved, watch: &Watch) -> Result<Report> {
    match proved {
        Proved::Equations(derivation) => Check::run(source, &derivation.program, &Options::default(), watch),
        Proved::Chain(derived) => match &derived.unpolished {
            None => chain::Check::run(&derived.chain, &derived.program, derived.program.isolated, &CHAIN, watch),
            Some(ideal) => {
                check_both(derived.measured(), &derived.program, (&derived.chain, ideal, ideal.isolated), watch)
            }
        },
        Proved::SixAxes(derived) => match &derived.unpolished {
            None => chain::Check::run(&derived.chain, &derived.program, Some(derived.dimension()), &CHAIN, watch),
            Some(ideal) => {
                let bound = Some(derived.dimension());
                check_both(derived.measured(), &derived.program, (&derived.chain, ideal, bound), watch)
            }
        },
        Proved::Coupled(derived) => coupled::check(derived, &COUPLED, watch),
    }
}

/// The checks of a solver that polishes the answers of an ideal robot on the one described: on this one, and those of the ideal robot's own
/// solver, whose solutions are counted exactly.
fn check_both(
    described: &Chain,
    polished: &Program,
    (ideal, own, bound): (&Chain, &Program, Option<usize>),
    watch: &Watch,
) -> Result<Report> {
    let report = match &polished.described {
        // What a search finds reaches the target, and answers need only come near.
        Some(told) => {
            let options = Options { oracle: 0, ..POLISHED };
            chain::Check::run_within(described, polished, None, (&options, MISSES * told.within), watch)?
        }
        None => chain::Check::run(described, polished, None, &POLISHED, watch)?,
    };
    Ok(report.with_ideal(chain::Check::run(ideal, own, bound, &IDEAL, watch)?))
}
