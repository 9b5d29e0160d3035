//! `groebot derive`: derives a proved solver from a description and writes its files.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::cells::exact;
use super::console::{self, Paint};
use super::ends::{IdealEndArguments, TipLink};
use super::files::{assemble_files, destination, write_derivation};
use super::info::near_words;
use super::json::{self, Derived};
use super::output::Force;
use super::progress::{Limits, Session, seconds};
use super::report::{Report, report};
use super::{Halt, Outcome};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_ik::derive::planner::{Choice, fitting_task};
use groebot_ik::derive::problem::ends::solver_name;
use groebot_ik::derive::{Derivation, Ends, Source};
use groebot_ik::folder::is_thin;
use groebot_ik::witness;
use groebot_robot::document::shown;

/// A robot farther from the base frame than this multiple of its reach is reported as far.
const FAR: f64 = 5.0;

const EXAMPLES: &str = "Examples:
  groebot derive derivations/nao_leg_sagittal          writes into that folder
  groebot derive arm.toml                              writes into the folder arm
  groebot derive ur10e                                 a robot by name; writes into the folder ur10e
  groebot derive arm.toml --out /tmp/arm --time 60     writes into /tmp/arm; fails after 60 s
  groebot derive derivations/ur5_calibrated --thin     writes the certificate, and hashes of the outputs

A thin folder contains the input, README.md, certificate.json and outputs.sha256. solve, codegen, view, reach and
explain check the certificate again and use the solver that it proves. A thin folder stays thin when it is derived
again; --full writes all files.";

/// Derives, proves and writes the closed-form inverse kinematics of a chain, of coupled chains or of a system of
/// equations
///
/// Writes one numbered file for each stage. Ctrl-C stops the work and leaves the folder unchanged.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A mechanism's folder with its 0_chain.toml, 0_system.toml, 0_robot.urdf or 0_coupled.toml, or an input file; `-`
    /// for standard input, with --out; or a robot's name (`groebot robots`)
    #[arg(value_name = "DIR-or-FILE")]
    input: PathBuf,
    #[command(flatten)]
    ends: IdealEndArguments,
    /// The output folder (default: the mechanism's folder, or the folder `foo` for `foo.toml` and for a robot
    /// `foo`)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The time budget [s] (default: none)
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,
    /// The memory budget as the number of polynomial terms in use (default: none)
    #[arg(long, value_name = "N")]
    terms: Option<usize>,
    /// Print neither progress nor report
    #[arg(long)]
    quiet: bool,
    /// The name of the solver (default: the mechanism's): its files are NAME.c, NAME.h, NAME.rs and NAME_ikfast.cpp
    #[arg(long, value_name = "NAME", value_parser = name)]
    name: Option<String>,
    /// Print JSON instead of the report
    #[arg(long)]
    json: bool,
    /// Refuse a solver with wrong or missing solutions at any target of the numeric check, including singular ones
    #[arg(long)]
    strict: bool,
    /// Write a thin folder: input, README.md, certificate.json, and in outputs.sha256 a hash of each other file
    #[arg(long, conflicts_with = "full")]
    thin: bool,
    /// Write all files, also into a thin folder
    #[arg(long)]
    full: bool,
    #[command(flatten)]
    force: Force,
}

impl Arguments {
    /// Whether the files in `folder` are those of a thin folder.
    fn is_thin(&self, folder: &Path) -> bool {
        self.thin || !self.full && is_thin(folder)
    }
}

fn name(text: &str) -> std::result::Result<String, String> {
    solver_name(text).map_err(|error| error.message().to_owned())
}

/// Derives, writes the files, then prints the report.
pub fn run(arguments: &Arguments) -> Outcome {
    let session =
        Session::start(Limits { time: arguments.time, terms: arguments.terms, memory: None, quiet: arguments.quiet })?;
    let mut clock = Clock::start();
    let ends = Ends { name: arguments.name.clone(), ..arguments.ends.ends()? };
    let mut source = Source::read_with(&arguments.input, &ends, &arguments.ends.options())?;
    let folder = destination(&source, &arguments.input, arguments.out.as_deref())?;
    clock.lap("read");
    let chosen = source.choose_given(&session.watch)?;
    let derivation = derive(&source, &session.watch)?;
    clock.lap("derive and prove");
    let checked = witness::check(&source, &derivation, &session.watch)?;
    refuse_failures(&source, &derivation, &checked, arguments.strict)?;
    clock.lap("check numerically");
    let files = assemble_files(&source, &derivation, &checked, &folder, arguments.is_thin(&folder))?;
    clock.lap("print the stages");
    write_derivation(&source, &folder, &files, arguments.force, &session.watch)?;
    clock.lap("write");
    drop(session);
    if arguments.quiet && !arguments.json {
        return weak(&checked);
    }
    let names = files.names();
    if arguments.json {
        let (choice, laps) = (chosen.as_ref(), clock.laps.as_slice());
        let derived = Derived {
            source: &source,
            derivation: &derivation,
            checked: &checked,
            choice,
            folder: &folder,
            files: &names,
            laps,
        };
        console::print(&json::text(&derived.json()))?;
        return weak(&checked);
    }
    let content = Report {
        source: &source,
        derivation: &derivation,
        checked: &checked,
        folder: &folder,
        files: &names,
        timings: &clock.laps,
    };
    let text = report(&content, Paint::of(&std::io::stdout()))?;
    let tip = TipLink::line(TipLink::of_source(&source).as_ref());
    let choice = match derivation.redundancy() {
        Some(_) => redundancy_text(&derivation),
        None => chosen.as_ref().map(choice_text).unwrap_or_default(),
    };
    console::print(&(choice + &tip + &text))?;
    weak(&checked)
}

/// The given joints, and other possible choices, as text.
pub fn choice_text(choice: &Choice) -> String {
    let joints = choice.given.iter().map(|joint| format!("`{joint}`")).collect::<Vec<_>>().join(", ");
    if choice.candidates.is_empty() {
        return format!("Given with each target: the value of {joints}, which other joints of the chain follow.\n\n");
    }
    let candidates: String = choice.candidates.iter().map(|candidate| format!("  {candidate}\n")).collect();
    format!(
        "Given with each target: the value of {joints}. The planner chose; `--given JOINT` chooses another of\n{candidates}\n"
    )
}

/// The solvers of a redundant chain as text, one line for each given joint.
fn redundancy_text(derivation: &Derivation) -> String {
    let lines: String = derivation.redundancy_lines().iter().map(|line| format!("  {line}\n")).collect();
    format!(
        "The chain has one joint more than its task determines. `groebot solve` computes all solutions within limits, \
         from the solvers with each joint given\n(`--given JOINT` derives only one of them):\n{lines}\n"
    )
}

/// The outcome of the command: the exit status reports a solver with weak spots.
fn weak(checked: &witness::Report) -> Outcome {
    if checked.weak_spots().next().is_some() { Err(Halt::WeakSpots) } else { Ok(()) }
}

fn derive(source: &Source, watch: &Watch) -> Result<Derivation> {
    Derivation::of(source, watch).map(|proved| proved.about(source)).map_err(|error| match error.kind() {
        ErrorKind::Cancelled => error,
        ErrorKind::Unsupported | ErrorKind::Inconsistent => advised(source, error).in_file(&source.path),
        _ => error.in_file(&source.path),
    })
}

/// Adds advice to `error`: a task that fits a chain with too few joints for the requested one, and a tolerance that
/// would help.
fn advised(source: &Source, error: Error) -> Error {
    let Some((ideal, report)) = &source.ideal else { return error };
    if let Some(task) = fitting_task(ideal) {
        let free = ideal.independent().len();
        let text = format!(
            "{free} joints reach no generic target of the task `{}`; `{task}` is a task that they can perform: {}",
            ideal.task().name(),
            error.message()
        );
        return Error::new(error.kind(), text);
    }
    let near = near_words(ideal);
    let without = if report.tolerance == 0.0 { "without --exact: " } else { "" };
    let advice = if near.is_empty() { String::new() } else { format!("; {without}{}", near.join(", ")) };
    Error::new(error.kind(), format!("{}{advice}", error.message()))
}

/// Fails at the first ordinary target with wrong or missing solutions; with `strict`, at the first target of any kind.
/// Errors at singular targets are otherwise reported as [weak spots](witness::Report::weak_spots), because the algebra
/// is proved.
///
/// # Errors
/// [`ErrorKind::Certificate`] with the row, its target and the error.
pub fn refuse_failures(
    source: &Source,
    derivation: &Derivation,
    checked: &witness::Report,
    strict: bool,
) -> Result<()> {
    let Some(row) = checked.failures().find(|row| strict || !row.is_weak_spot()) else { return Ok(()) };
    let target: Vec<String> = row.target.iter().map(|value| exact(*value)).collect();
    let text = format!(
        "{}{}; numeric check, row {} ({}), target {}",
        row.verdict.faults().iter().map(|fault| fault.sentence()).collect::<Vec<_>>().join("; "),
        nearly_ideal(source, derivation),
        row.number,
        row.kind,
        target.join(",")
    );
    let text = if row.is_weak_spot() {
        format!(
            "at a singular target an answer is wrong or missing (without --strict it is reported and is not an error): {text}"
        )
    } else {
        format!("at an ordinary target an answer is wrong or missing: {text}")
    };
    Err(Error::new(ErrorKind::Certificate, text))
}

/// The relations that a chain's axes almost satisfy, and advice. Closed forms of such a chain are ill-conditioned.
fn nearly_ideal(source: &Source, derivation: &Derivation) -> String {
    let Some(derived) = derivation.sequential() else { return String::new() };
    let far = derived.problem.measured().remoteness();
    if far > FAR {
        let nearer = source.carrier.as_ref().map(|link| format!(", `{}`", shown(link))).unwrap_or_default();
        return format!(
            "; the robot is {far:.0} times its reach away from the base frame, where targets have too large rounding errors: choose a base link nearer to \
             the arm{nearer} (--base), and add the place of that link at run time"
        );
    }
    let near = near_words(derived.problem.measured());
    if near.is_empty() || derived.problem.truth.is_some() {
        return String::new();
    }
    format!("; {}: `--snap TOLERANCE` derives the robot for which this holds exactly", near.join(", "))
}

/// The duration of each stage.
struct Clock {
    last: Instant,
    laps: Vec<(&'static str, Duration)>,
}

impl Clock {
    fn start() -> Self {
        Clock { last: Instant::now(), laps: Vec::new() }
    }

    fn lap(&mut self, stage: &'static str) {
        let now = Instant::now();
        self.laps.push((stage, now - self.last));
        self.last = now;
    }
}
