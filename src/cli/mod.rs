//! The command-line tool: one file per subcommand.
//!
//! Results go to standard output, errors to standard error as `error: FILE: line N: message`. The exit status is 0 for
//! success, 1 for a failure and 2 for wrong usage. It is 3 for a derived solver with weak spots and for a log that
//! `identify` reports as bad. It is 4 if there is no path, 5 if a robot falls, and 130 for an interruption. A closed
//! reader (`| head`) ends the work without a message and with status 0.

mod algebra;
mod answers;
mod arcs;
mod basis;
mod basis_answer;
mod basis_certificate;
mod basis_cover;
mod basis_question;
mod cells;
mod chain_report;
mod check;
mod closest;
mod codegen;
mod columns;
mod console;
mod derive;
mod description;
mod dynamics;
mod ends;
mod explain;
mod export;
mod feedback;
mod files;
mod fk;
mod floor;
mod follow;
mod following;
mod forms;
mod identify;
mod ik;
mod info;
mod json;
mod moving;
mod named;
mod navigate;
mod output;
mod overview;
mod page;
mod part;
mod path;
mod physics;
mod plan;
mod progress;
mod reach;
pub mod readers;
mod report;
mod scanned;
mod simulate;
mod solve;
mod strata;
mod targets;
mod task;
mod track;
mod verify;
mod view;
mod walk;
mod walk_json;
mod walk_request;
mod walker;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::{FromArgMatches, Parser, Subcommand};

use crate::{Error, ErrorKind};
use console::Paint;
use groebot_algebra::escape;

const EXAMPLES: &str = "Examples:
  groebot robots
  groebot derive derivations/nao_leg_sagittal
  groebot solve derivations/nao_leg_sagittal --target 60,150
  groebot check derivations/nao_leg_sagittal
  groebot explain derivations/nao_leg_sagittal
  groebot codegen derivations/puma --lang c -o puma.c
  groebot reach derivations/ur5 -o reach.json --plot reach.svg
  groebot info derivations/nao_arm_planar
  groebot info robot.urdf --tip tool0
  groebot fk robot.urdf --tip tool0 --q 0,-90,90,0,0,0 --degrees
  groebot plan nao_left_leg
  groebot ik ur5 --target 0.4,0.1,0.5,0,180,0 --degrees
  groebot basis cyclic5.txt --order lex
  groebot walk nao --steps 8 -o walk.csv --plot walk.svg
  groebot path map.pgm --start 1,1 --goal 8,5
  groebot navigate rh0 --map room.yaml --goal 3.2,1.5 -o walk.csv --plot plan.svg
  groebot task rh0 --room living-room --goal sofa -o task.json --view task.html
  groebot view walk.csv -o walk.html
  groebot simulate walk.csv --plot joints.svg
  groebot dynamics robot.urdf --states states.csv
  groebot track robot.urdf --law computed-torque --trajectory t.csv

Exit status: 0 success, 1 failure, 2 wrong usage, 3 derived and written but with weak spots at
singular targets, or a bad log (identify), 4 no path exists, 5 the robot falls, 130 interrupted.
--json of each command: docs/json.md and docs/cli_schema.json describe its keys.";

/// Derives closed-form inverse kinematics of robots, with all solutions and a proof; plans walks and paths
#[derive(Parser)]
#[command(name = "groebot", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Derive(derive::Arguments),
    Solve(solve::Arguments),
    Check(check::Arguments),
    Explain(explain::Arguments),
    Codegen(codegen::Arguments),
    Robots(named::Arguments),
    Info(info::Arguments),
    Plan(plan::Arguments),
    Ik(ik::Arguments),
    Fk(fk::Arguments),
    Basis(basis::Arguments),
    Walk(walk::Arguments),
    Navigate(navigate::Arguments),
    Task(task::Arguments),
    Path(path::Arguments),
    Reach(reach::Arguments),
    Dynamics(dynamics::Arguments),
    Track(track::Arguments),
    Identify(identify::Arguments),
    Export(export::Arguments),
    Follow(follow::Arguments),
    Simulate(simulate::Arguments),
    View(view::Arguments),
    Completions(overview::Arguments),
}

/// The reason why a subcommand ends early.
enum Halt {
    /// An error that is not reported yet.
    Error(Error),
    /// Standard output has been closed by its reader.
    PipeClosed,
    /// There is no path. The command has already reported this.
    NoPath,
    /// A robot fell. The command has already reported this.
    Fell,
    /// A solver was derived and written, but misses solutions at some singular targets. The command has already
    /// reported this.
    WeakSpots,
    /// A log does not fit rigid bodies with independent noise. The command has already reported this.
    BadData,
}

/// The exit status of [`Halt::WeakSpots`] and [`Halt::BadData`].
const WEAK: u8 = 3;
/// The exit status of [`Halt::NoPath`].
const NO_PATH: u8 = 4;
/// The exit status of [`Halt::Fell`].
const FELL: u8 = 5;

impl From<Error> for Halt {
    fn from(error: Error) -> Self {
        Halt::Error(error)
    }
}

type Outcome = std::result::Result<(), Halt>;

/// Runs the tool on the arguments of this process.
pub fn run() -> ExitCode {
    ExitCode::from(run_on(std::env::args_os()))
}

/// Runs the tool on `arguments`, of which the first is the program's name, inside another process; returns the exit
/// status.
pub fn run_on(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let cli = match parsed(arguments) {
        Ok(cli) => cli,
        Err(usage) => {
            return report_usage(&usage);
        }
    };
    // If signals cannot be caught, they end the process as usual.
    let _ = progress::interrupted();
    let outcome = match &cli.command {
        Command::Derive(arguments) => derive::run(arguments),
        Command::Solve(arguments) => solve::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Codegen(arguments) => codegen::run(arguments),
        Command::Robots(arguments) => named::run(arguments),
        Command::Info(arguments) => info::run(arguments),
        Command::Plan(arguments) => plan::run(arguments),
        Command::Ik(arguments) => ik::run(arguments),
        Command::Fk(arguments) => fk::run(arguments),
        Command::Basis(arguments) => basis::run(arguments),
        Command::Walk(arguments) => walk::run(arguments),
        Command::Navigate(arguments) => navigate::run(arguments),
        Command::Task(arguments) => task::run(arguments),
        Command::Path(arguments) => path::run(arguments),
        Command::Reach(arguments) => reach::run(arguments),
        Command::Dynamics(arguments) => dynamics::run(arguments),
        Command::Track(arguments) => track::run(arguments),
        Command::Identify(arguments) => identify::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Follow(arguments) => follow::run(arguments),
        Command::Simulate(arguments) => simulate::run(arguments),
        Command::View(arguments) => view::run(arguments),
        Command::Completions(arguments) => overview::run(arguments),
    };
    status(&outcome)
}

/// Parses a command line.
fn parsed(arguments: impl IntoIterator<Item = OsString>) -> std::result::Result<Cli, clap::Error> {
    overview::command().try_get_matches_from(arguments).and_then(|matches| Cli::from_arg_matches(&matches))
}

/// Prints help, the version or an error in the arguments; returns the exit status.
fn report_usage(usage: &clap::Error) -> u8 {
    let code = u8::try_from(usage.exit_code()).unwrap_or(2);
    if usage.use_stderr() {
        // A closed standard error cannot be reported.
        let _ = std::io::stderr().write_all(escape::message(&usage.render().to_string()).as_bytes());
        return code;
    }
    let printed = usage.print().and_then(|()| std::io::stdout().flush());
    printed.map_or_else(|error| status(&Err(console::unwritten(&error))), |()| code)
}

/// Reports an error and returns the exit status of a command.
fn status(outcome: &Outcome) -> u8 {
    match outcome {
        Ok(()) | Err(Halt::PipeClosed) => 0,
        Err(Halt::WeakSpots | Halt::BadData) => WEAK,
        Err(Halt::NoPath) => NO_PATH,
        Err(Halt::Fell) => FELL,
        Err(Halt::Error(error)) => {
            report_error(error);
            if error.kind() == ErrorKind::Cancelled { 130 } else { 1 }
        }
    }
}

fn report_error(error: &Error) {
    let mut stderr = std::io::stderr().lock();
    let paint = Paint::of(&stderr);
    let text = match error.kind() {
        ErrorKind::Cancelled => "interrupted; nothing was written".to_owned(),
        _ => error.to_string(),
    };
    // A closed standard error cannot be reported.
    let _ = writeln!(stderr, "{} {text}", paint.red("error:"));
}
