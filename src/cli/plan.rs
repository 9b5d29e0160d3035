//! `groebot plan`: the order of subproblems by which screw theory solves a chain, in words.

use std::path::{Path, PathBuf};

use super::ends::IdealEndArguments;
use super::{Outcome, console, json};
use crate::derive::InputFile;
use crate::kinematics::Chain;
use crate::kinematics::screw::ScrewSolver;
use crate::{Error, ErrorKind, Result, robots};

const EXAMPLES: &str = "Examples:
  groebot plan puma                              a robot that comes with groebot
  groebot plan robot.urdf --base base_link --tip tool0
  groebot plan derivations/nao_leg_sagittal

Names: PK1-PK3 Paden-Kahan, PG1-PG8 and Pardos-One Pardos-Gotor, SP5 and SP6 IK-Geo; docs/subproblems.md tells each.";

/// Prints how screw theory solves a chain: which joints cancel, which subproblem is left
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    mechanism: Mechanism,
    /// JSON instead of text
    #[arg(long)]
    json: bool,
}

/// Which chain.
#[derive(clap::Args)]
pub struct Mechanism {
    /// A mechanism's folder, a file (chain.toml, DH table, URDF), or a robot that comes with groebot
    #[arg(value_name = "DIR-FILE-or-ROBOT")]
    input: PathBuf,
    #[command(flatten)]
    ends: IdealEndArguments,
}

impl Mechanism {
    /// The screw solver of `chain`, which this names.
    ///
    /// # Errors
    /// As [`ScrewSolver::within`].
    pub fn solver(&self, chain: &Chain) -> Result<ScrewSolver> {
        let tolerance = self.ends.ends()?.tolerance();
        ScrewSolver::within(chain, tolerance).map_err(|error| match error.kind() {
            ErrorKind::Unsupported => Error::new(
                ErrorKind::Unsupported,
                format!("{}; `groebot info` shows how its axes lie", error.message()),
            ),
            _ => error,
        })
    }

    /// The chain; what of a robot is passed over is told on standard error.
    ///
    /// # Errors
    /// As [`InputFile::read`] and [`InputFile::chain`]; [`ErrorKind::UnknownName`] for what is neither a file nor a robot.
    pub fn chain(&self) -> Result<Chain> {
        if let Some(chain) = self.known_robot()? {
            return self.ends.ask(chain);
        }
        let (input, ends) = (InputFile::read(&self.input)?, self.ends.ends()?);
        let chain = input.chain(&ends)?.ok_or_else(|| {
            let text = "this is a system of equations, or coupled chains; screw theory needs a chain (of coupled chains, give the file of one)";
            Error::new(ErrorKind::BadValue, text).in_file(&input.path)
        })?;
        console::tell(&input.passed_over(&ends)?);
        Ok(chain)
    }

    /// A robot of [`robots`], where no file has its name.
    fn known_robot(&self) -> Result<Option<Chain>> {
        let name = self.input.to_string_lossy();
        if self.input.exists() || self.input.components().count() != 1 || self.input.extension().is_some() {
            return Ok(None);
        }
        let known = robots::by_name(&name);
        if known.is_none() && !Path::new(&self.input).exists() {
            let names: Vec<&str> = robots::ALL.iter().map(|robot| robot.name()).collect();
            let text =
                format!("`{name}` is neither a file nor a robot of groebot; the robots are {}", names.join(", "));
            return Err(Error::new(ErrorKind::UnknownName, text));
        }
        Ok(known)
    }
}

/// Prints the plan.
pub fn run(arguments: &Arguments) -> Outcome {
    let chain = arguments.mechanism.chain()?;
    let solver = arguments.mechanism.solver(&chain)?;
    if arguments.json {
        return console::print(&json::text(&json::plan(&chain, solver.plan())));
    }
    let about = chain.parts().description.as_deref().map(|text| format!("{text}\n")).unwrap_or_default();
    console::print(&format!("{}, task {}\n{about}\n{}\n", chain.name(), chain.task().name(), solver.plan()))
}
