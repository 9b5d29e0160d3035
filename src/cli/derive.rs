//! `groebot derive`: from a description to a proved solver and its files.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use nalgebra::Point3;

use super::Outcome;
use super::answers::exact;
use super::console::{self, Paint};
use super::ends::{EndArguments, SnapArgument};
use super::files::{assemble_files, destination};
use super::info::near_words;
use super::progress::{Limits, Session, seconds};
use super::report::{Report, report};
use crate::derive::{Proved, Source};
use crate::files::write_folder_atomically;
use crate::kinematics::Chain;
use crate::spatial::Screw;
use crate::witness::chain::{self, limbs};
use crate::witness::{self, Check, Options};
use crate::{Error, ErrorKind, Result, Watch};

/// How much is checked of a chain.
const CHAIN: Options = Options { targets: 240, oracle: 2, exact: 20, seed: 1 };
/// How much is checked of limbs that share motors.
const LIMBS: Options = Options { targets: 120, oracle: 1, exact: 6, seed: 1 };

/// A robot that is farther from the base frame, in its reaches, is called far.
const FAR: f64 = 5.0;

const EXAMPLES: &str = "Examples:
  groebot derive derivations/nao_leg_sagittal          files beside its 0_chain.toml
  groebot derive arm.toml                              files in the folder arm
  groebot derive arm.toml --out /tmp/arm --time 60     files in /tmp/arm, or an error after a minute";

/// Derives, proves and writes the closed-form inverse kinematics of a chain, of limbs or of a system of equations
///
/// Writes one numbered file for each stage. Ctrl-C stops the work and leaves the folder as it was.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A mechanism's folder with its 0_chain.toml, 0_system.toml, 0_robot.urdf or 0_limbs.toml, or an input file
    #[arg(value_name = "DIR-or-FILE")]
    input: PathBuf,
    #[command(flatten)]
    ends: EndArguments,
    #[command(flatten)]
    snap: SnapArgument,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The time budget
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time: Option<Duration>,
    /// The memory budget: polynomial terms alive
    #[arg(long, value_name = "N")]
    terms: Option<usize>,
    /// Neither progress nor report
    #[arg(long)]
    quiet: bool,
}

/// Derives, writes the files, then tells about it.
pub fn run(arguments: &Arguments) -> Outcome {
    let session =
        Session::start(Limits { time: arguments.time, terms: arguments.terms, memory: None, quiet: arguments.quiet })?;
    let mut clock = Clock::start();
    let mut source = Source::read_between(&arguments.input, &arguments.snap.ends(&arguments.ends))?;
    let folder = destination(&source, &arguments.input, arguments.out.as_deref())?;
    clock.lap("read");
    let chosen = source.choose_given(&session.watch)?;
    let derivation = derive(&source, &session.watch)?;
    clock.lap("derive and prove");
    let checked = check(&source, &derivation, &session.watch)?;
    refuse_failures(&derivation, &checked)?;
    clock.lap("check numerically");
    let files = assemble_files(&source, &derivation, &checked, &folder)?;
    clock.lap("print the stages");
    write_folder_atomically(&folder, &files, &session.watch)?;
    clock.lap("write");
    drop(session);
    if arguments.quiet {
        return Ok(());
    }
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    let told =
        Report { derivation: &derivation, checked: &checked, folder: &folder, files: &names, timings: &clock.laps };
    let told = report(&told, Paint::of(&std::io::stdout()))?;
    let chosen = chosen.map(|joint| {
        format!("The value of `{joint}` is given with each target: the planner chose it, and `--free JOINT` chooses another.\n\n")
    });
    console::print(&(chosen.unwrap_or_default() + &told))
}

/// The numeric checks of a derivation.
///
/// # Errors
/// As [`Check::run`], [`chain::Check::run`] and [`limbs::check`].
pub fn check(source: &Source, proved: &Proved, watch: &Watch) -> Result<witness::Report> {
    match proved {
        Proved::Equations(derivation) => Check::run(source, &derivation.program, &Options::default(), watch),
        Proved::Chain(derived) => {
            chain::Check::run(derived.measured(), &derived.program, derived.program.isolated, &CHAIN, watch)
        }
        Proved::SixAxes(derived) => {
            chain::Check::run(&derived.chain, &derived.program, Some(derived.dimension()), &CHAIN, watch)
        }
        Proved::Limbs(derived) => limbs::check(derived, &LIMBS, watch),
    }
}

fn derive(source: &Source, watch: &Watch) -> Result<Proved> {
    Proved::of(source, watch).map(|proved| proved.about(source)).map_err(|error| match error.kind() {
        ErrorKind::Cancelled => error,
        _ => error.in_file(&source.path),
    })
}

/// Fails at the first target whose answers are wrong. An eigenvalue problem may lose answers at special targets, and so may the formulas of
/// an ideal robot, where that one is singular and the described one is not quite: the table tells where.
///
/// # Errors
/// [`ErrorKind::Certificate`] with the row, its target and what is wrong.
pub fn refuse_failures(derivation: &Proved, checked: &witness::Report) -> Result<()> {
    let may_lose = match derivation {
        Proved::SixAxes(_) => true,
        Proved::Chain(derived) => derived.truth.is_some(),
        Proved::Equations(_) | Proved::Limbs(_) => false,
    };
    let Some(row) = checked.failures().find(|row| !(may_lose && row.is_special_loss())) else { return Ok(()) };
    let target: Vec<String> = row.target.iter().map(|value| exact(*value)).collect();
    let text = format!(
        "numeric check, row {} ({}): the answers at the target {} are wrong: {}{}",
        row.number,
        row.kind,
        target.join(","),
        row.verdict.faults().iter().map(|fault| fault.sentence()).collect::<Vec<_>>().join("; "),
        nearly_ideal(derivation)
    );
    Err(Error::new(ErrorKind::Certificate, text))
}

/// What almost holds of a chain's axes, and what to do then: closed forms of such a chain are at the mercy of rounding.
fn nearly_ideal(derivation: &Proved) -> String {
    let Proved::Chain(derived) = derivation else { return String::new() };
    let far = farness(derived.measured());
    if far > FAR {
        return format!(
            "; the robot stands {far:.0} of its reaches from the base frame, where targets are rounded too much: derive it between nearer \
             links (--base), and give the base's place at run time"
        );
    }
    let near = near_words(derived.measured());
    if near.is_empty() || derived.truth.is_some() {
        return String::new();
    }
    format!("; {}: `--snap TOLERANCE` takes the robot of which this does hold", near.join(", "))
}

/// How many reaches the first axis that turns is from the base frame's origin.
fn farness(chain: &Chain) -> f64 {
    let place = chain.screws().iter().find_map(Screw::axis).map(|axis| axis.distance_to(&Point3::origin()));
    place.map_or(0.0, |distance| distance / chain.reach().max(f64::MIN_POSITIVE))
}

/// How long each stage took.
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
