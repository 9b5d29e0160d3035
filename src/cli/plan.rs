//! `groebot plan`: the order of subproblems by which screw theory solves a chain, as text.

use std::path::{Path, PathBuf};

use super::derive::choice_text;
use super::ends::{IdealEndArguments, TipLink};
use super::{Outcome, console, json};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_ik::derive::Source;
use groebot_ik::derive::planner::Choice;
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::screw::ScrewSolver;

const EXAMPLES: &str = "Examples:
  groebot plan puma                              a robot of groebot by name
  groebot plan robot.urdf --base base_link --tip tool0
  groebot plan derivations/nao_leg_sagittal

Names: PK1-PK3 Paden-Kahan, PG1-PG8 and Pardos-One Pardos-Gotor, SP5 and SP6 IK-Geo;
docs/subproblems.md describes each.";

/// Prints how screw theory solves a chain: for each step the joints that cancel, and the Paden-Kahan subproblem
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    mechanism: Mechanism,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

/// The chain.
#[derive(clap::Args)]
pub struct Mechanism {
    /// A mechanism's folder, a file (chain.toml, DH table, URDF, xacro, MJCF, SDF; `-` for standard input), or a robot of groebot by name
    #[arg(value_name = "DIR-FILE-or-ROBOT")]
    input: PathBuf,
    #[command(flatten)]
    ends: IdealEndArguments,
}

/// A requested chain.
pub struct RequestedChain {
    /// Its source, with the joints whose values are given.
    source: Source,
    /// The choice of these joints by the planner.
    pub choice: Option<Choice>,
}

impl RequestedChain {
    /// The chain.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a source without one.
    pub fn chain(&self) -> Result<&Chain> {
        self.source.chain.as_ref().ok_or_else(|| {
            let text = "this is a system of equations, or coupled chains; screw theory needs a chain (of coupled chains, give the file of one)";
            Error::new(ErrorKind::BadValue, text).in_file(&self.source.path)
        })
    }

    /// The last link, for a robot.
    pub fn tip(&self) -> Option<TipLink> {
        TipLink::of_source(&self.source)
    }

    /// The ignored parts of a robot.
    pub fn notes(&self) -> &[String] {
        &self.source.notes
    }

    /// Its screw solver.
    ///
    /// # Errors
    /// As [`ScrewSolver::within`].
    pub fn solver(&self) -> Result<ScrewSolver> {
        ScrewSolver::within(self.chain()?, self.source.ends.tolerance()).map_err(|error| match error.kind() {
            ErrorKind::Unsupported => {
                let text = format!("{}; `groebot info` prints the relations of its axes", error.message());
                self.source.advised(Error::new(error.kind(), text))
            }
            _ => error,
        })
    }
}

impl Mechanism {
    /// The input.
    pub fn input(&self) -> &Path {
        &self.input
    }

    /// The chain. If its task has redundant joints, the named ones are given, else those chosen by the planner.
    ///
    /// # Errors
    /// As [`InputFile::read`], [`Source::of`] and [`Source::choose_given`]; [`ErrorKind::UnknownName`] for a name that
    /// is neither a file nor a robot.
    pub fn requested(&self) -> Result<RequestedChain> {
        let mut source = self.source()?;
        let choice = source.choose_given(&Watch::none())?;
        Ok(RequestedChain { source, choice })
    }

    /// Same as [`Mechanism::requested`], but for a numeric search, which needs no closed form. A redundant joint that the
    /// planner cannot choose stays free.
    ///
    /// # Errors
    /// As [`Mechanism::requested`].
    pub fn searched(&self) -> Result<RequestedChain> {
        let mut source = self.source()?;
        let choice = match source.choose_given(&Watch::none()) {
            Err(error) if error.kind() == ErrorKind::Unsupported => None,
            choice => choice?,
        };
        Ok(RequestedChain { source, choice })
    }

    fn source(&self) -> Result<Source> {
        let ends = self.ends.ends()?;
        Source::read_with(&self.input, &ends, &self.ends.options())
    }
}

/// Prints the plan.
pub fn run(arguments: &Arguments) -> Outcome {
    let requested = arguments.mechanism.requested()?;
    let (chain, solver, tip) = (requested.chain()?, requested.solver()?, requested.tip());
    if arguments.json {
        return console::print(&json::text(&json::plan(chain, solver.plan(), requested.notes(), tip.as_ref())));
    }
    console::print_notes(requested.notes());
    let about = chain.parts().description.as_deref().map(|text| format!("{text}\n")).unwrap_or_default();
    let heading = TipLink::line(tip.as_ref()) + &requested.choice.as_ref().map(choice_text).unwrap_or_default();
    console::print(&format!("{heading}{}, task {}\n{about}\n{}\n", chain.name(), chain.task_text(), solver.plan()))
}
