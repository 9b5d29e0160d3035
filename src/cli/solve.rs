//! `groebot solve`: all solutions of targets, as text, JSON or CSV.

use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};

use super::answers::{Angles, Answer, csv_header, csv_rows, json, text, turned};
use super::arcs::{ArcOptions, ArcQuestion};
use super::closest::Search;
use super::files::is_derived;
use super::forms::Forms;
use super::named::CacheArguments;
use super::scanned::ScanQuestion;
use super::targets::{self, Row};
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits::PROGRAM_BYTES;
use groebot_ik::derive::Source;
use groebot_ik::derive::problem::input::COUPLED_NAME;
use groebot_ik::folder::{self, PROGRAM, is_thin};
use groebot_ik::solver::{ClosestOptions, ErrorWeights, Program, Solver};
use groebot_robot::document::read_text;

const EXAMPLES: &str = "Examples:
  groebot solve derivations/nao_leg_sagittal --target 60,150
  groebot solve derivations/nao_leg_sagittal --target -60,-150 --json
  groebot solve derivations/planar_2r --target 3,4 --closest
  groebot solve derivations/nao_leg_sagittal < targets.csv > answers.csv
  groebot fk derivations/ur5 < joints.csv | groebot solve derivations/ur5 | groebot fk derivations/ur5

A redundant arm, from a clone of the repository:
  groebot derive tests/corpus/redundant/arms/panda.urdf --out panda
  groebot solve panda --target 0.306891,0,0.486882,1,0,0,0

Targets are numbers in the order and units of the derivation's inputs. A rotation may be a
quaternion x, y, z, w (of length one, within 1e-6) instead of its nine elements by rows: a pose is
12 numbers or 7.

A redundant solver was derived for a chain with one joint more than its task determines. The output
for a --target without the value of its given joint is all arcs of solutions within limits: the joint
values at both ends of each arc with the joint that is at its limit, and the solution with the largest
margin to the limits. Lengths of arcs, margins and distances are in rad; lengths of prismatic joints are
relative to the characteristic length, in distances in their unit. Without a solution within limits, the
reason is printed, and the exit status is 0. Targets in CSV need the value of the given joint;
--closest-to finds the solution nearest to joint values. \"unsure\" marks results that may be wrong or
incomplete (docs/redundant.md).

A CSV may start with a line of names, which gives the order of its columns. x_m or x_mm is px in
that unit, and so are phi_deg and A1_deg. Other columns that `fk`, `ik` and `solve` write are
ignored; unknown names are errors.

Angles of solutions are moved into their joint's limits by whole turns where possible. A target
without a solution is not an error. The output is \"unreachable: no solution\", an empty list of
solutions (JSON), or a row with 0 solutions (CSV). With --closest it has the joint values with the
least error, too: distance^2 + (2 LENGTH sin(angle / 2))^2. They do not respect joint limits, except
those of a redundant arm without the value of its given joint. The exit status is 0 as well. For
chains that share actuators, text and JSON of a --target name the chain that fails, and the reason.";

/// Computes all solutions of targets with a derived solver
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A folder that `groebot derive` wrote, or its 5_program.json; `-` for that file from standard input; or a robot's
    /// name (`groebot robots`)
    derivation: PathBuf,
    #[command(flatten)]
    cache: CacheArguments,
    /// A target, numbers separated by commas (repeatable); `-`, or no target: CSV from standard input
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    target: Vec<String>,
    /// Print JSON: one object per target
    #[arg(long)]
    json: bool,
    /// Use degrees instead of radians in targets, in JSON and CSV output and in tables of arcs (other text has both)
    #[arg(long)]
    degrees: bool,
    /// For a target out of reach, also compute the joint values whose target has the least error; of a redundant arm,
    /// within limits
    #[arg(long)]
    closest: bool,
    /// The distance that counts as an angle of 1 rad in this error [unit of the inputs; default: the reach]
    #[arg(long, value_name = "LENGTH", requires = "closest")]
    length: Option<f64>,
    /// Of a redundant solver: narrower limits of a joint, in rad, in degrees with --degrees, or in the length unit
    /// (repeatable)
    #[arg(long, value_name = "JOINT=LOW,HIGH", allow_hyphen_values = true)]
    limits: Vec<String>,
    /// Of a redundant solver: compute the solution nearest to these joint values, not the one with the largest margin
    /// (in rad, in degrees with --degrees, or in the length unit)
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true, conflicts_with = "closest")]
    closest_to: Option<String>,
}

/// Solves the targets.
pub fn run(arguments: &Arguments) -> Outcome {
    if let Some(length) = arguments.length.filter(|length| !(*length > 0.0 && length.is_finite())) {
        return Err(Error::new(ErrorKind::BadValue, format!("--length is {length}; give a positive number")).into());
    }
    let derivation = arguments.cache.derivation(&arguments.derivation)?;
    let program = read_program(derivation.path())?;
    let angles = if arguments.degrees { Angles::Degrees } else { Angles::Radians };
    match arguments.target.as_slice() {
        [] if io::stdin().is_terminal() => {
            let text = "no target; give one by --target, or CSV on standard input";
            Err(Error::new(ErrorKind::MissingKey, text).into())
        }
        [] => arguments.stream(&program, angles),
        [dash] if dash == "-" => arguments.stream(&program, angles),
        given => listed(&program, given, angles, arguments),
    }
}

impl Arguments {
    fn stream(&self, program: &Program, angles: Angles) -> Outcome {
        targets::is_free(&self.derivation, "--target")?;
        self.refuse_arc_options()?;
        stream(&Question::new(program, angles, self), self.json)
    }

    /// The options for redundant solvers.
    fn arc_options(&self) -> ArcOptions<'_> {
        let weights = ErrorWeights::default();
        let closest = self.closest.then(|| self.length.map_or(weights, |length| weights.length(length)));
        ArcOptions { limits: &self.limits, closest_to: self.closest_to.as_deref(), closest }
    }

    /// Checks that no option is set that only a target without the value of a given joint has.
    fn refuse_arc_options(&self) -> Result<()> {
        if !self.arc_options().are_set() {
            return Ok(());
        }
        let text =
            "--limits and --closest-to are for a --target of a redundant solver without the value of its given joint";
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The options of the closest joint values, if they are requested.
    fn closest(&self) -> Option<ClosestOptions> {
        let options = ClosestOptions::default();
        self.closest.then(|| self.length.map_or(options.clone(), |length| options.length(length)))
    }
}

/// The program in a derivation's folder, or in a file. Of a thin folder it is the program that the certificate proves.
///
/// # Errors
/// As [`folder::program`], and as [`Program::from_json`] with the file.
pub(super) fn read_program(path: &Path) -> Result<Program> {
    if let Some(folder) = program_folder(path) {
        return folder::program(folder);
    }
    let file = path.to_owned();
    let text = read_text(&file, PROGRAM_BYTES)?;
    if !text.trim_start().starts_with('{') {
        let text = "this is not a derived solver; `groebot derive FILE --out DIR` derives one from a description: give that folder";
        return Err(Error::new(ErrorKind::Syntax, text).in_file(&file));
    }
    Program::from_json(&text).map_err(|error| error.in_file(&file))
}

/// The folder whose program is meant: `path` itself, or the folder of a `5_program.json` that a thin folder does not have.
fn program_folder(path: &Path) -> Option<&Path> {
    let parent = || path.parent().filter(|folder| path.ends_with(PROGRAM) && !path.exists() && is_thin(folder));
    if path.is_dir() { Some(path) } else { parent() }
}

/// A prepared program with the forms of its targets and the options of the command.
struct Question<'a> {
    program: &'a Program,
    solver: Solver,
    forms: Forms,
    angles: Angles,
    closest: Option<ClosestOptions>,
}

impl<'a> Question<'a> {
    fn new(program: &'a Program, angles: Angles, arguments: &Arguments) -> Self {
        Question { program, solver: program.solver(), forms: Forms::new(program), angles, closest: arguments.closest() }
    }

    fn answer(&self, numbers: Vec<f64>) -> Result<Answer<'a>> {
        let (program, angles) = (self.program, self.angles);
        let target = self.forms.inputs(numbers)?;
        let own = angles.to_radians(program, &target);
        let solutions = turned(program, self.solver.solve_numbers(&own)?);
        let closest = match &self.closest {
            None => Search::Off,
            Some(_) if !solutions.is_empty() => Search::Needless,
            Some(options) => Search::run(&self.solver, &own, options)?
                .moved(|found| turned(program, vec![found]).pop().unwrap_or_default()),
        };
        Ok(Answer { program, target, solutions, reason: None, closest, angles })
    }
}

/// The reason why `target`, in radians, has no solution, for chains that share actuators.
///
/// # Errors
/// As [`Source::read`] and [`folder::reprove`].
fn reason(folder: &Path, target: &[f64]) -> Result<Option<String>> {
    if !folder.is_dir() || !is_derived(folder) || !folder.join(COUPLED_NAME).is_file() {
        return Ok(None);
    }
    let derivation = folder::reprove(folder, &Source::read(folder)?)?;
    let explained = derivation.coupled().map(|coupled| coupled.explain(target, &Watch::none())).transpose()?;
    Ok(explained.flatten().map(|explanation| explanation.to_string()))
}

/// Solves the targets of the command line; prints text, or JSON.
fn listed(program: &Program, given: &[String], angles: Angles, arguments: &Arguments) -> Outcome {
    let mut page = String::new();
    let question = Question::new(program, angles, arguments);
    let scanned = ScanQuestion::new(program, angles, &arguments.arc_options())?;
    let redundant = if scanned.is_some() { None } else { ArcQuestion::new(program, angles, &arguments.arc_options())? };
    for (index, target) in given.iter().enumerate() {
        let count = target.split(',').count();
        if let Some((scanned, names)) = scanned.as_ref().and_then(|scanned| Some((scanned, scanned.names(count)?))) {
            let answer = targets::parse(&names, target)
                .and_then(|numbers| scanned.answer(numbers))
                .map_err(|error| error.with_context(format!("target `{}`", targets::shown(target))))?;
            page += if index > 0 && !arguments.json { "\n" } else { "" };
            page += &if arguments.json { answer.json(given.len() == 1) } else { answer.text() };
            continue;
        }
        if let Some((arcs, names)) = redundant.as_ref().and_then(|arcs| Some((arcs, arcs.names(count)?))) {
            let answer = targets::parse(&names, target)
                .and_then(|numbers| arcs.answer(numbers))
                .map_err(|error| error.with_context(format!("target `{}`", targets::shown(target))))?;
            page += if index > 0 && !arguments.json { "\n" } else { "" };
            page += &if arguments.json { answer.json(given.len() == 1) } else { answer.text() };
            continue;
        }
        arguments.refuse_arc_options()?;
        let lists = question.forms.names();
        let names = lists.iter().find(|names| names.len() == count).unwrap_or(&lists[0]);
        let mut answer = targets::parse(names, target)
            .and_then(|numbers| question.answer(numbers))
            .map_err(|error| error.with_context(format!("target `{}`", targets::shown(target))))?;
        if answer.solutions.is_empty() {
            answer.reason = reason(&arguments.derivation, &angles.to_radians(program, &answer.target))?;
        }
        if arguments.json {
            page += &json(&answer, given.len() == 1);
        } else {
            page += if index > 0 { "\n" } else { "" };
            page += &text(&answer);
        }
    }
    console::print(&page)
}

/// Solves the targets from standard input, one per row; writes CSV, or one JSON object per line.
fn stream(question: &Question<'_>, as_json: bool) -> Outcome {
    let (program, angles) = (question.program, question.angles);
    let mut out = BufWriter::new(io::stdout().lock());
    let mut write = |text: &str| out.write_all(text.as_bytes()).map_err(|error| console::unwritten(&error));
    let columns = question.forms.columns(program, angles == Angles::Degrees);
    let mut rows = targets::Reader::new(columns, io::stdin().lock(), Path::new(targets::STDIN));
    if !as_json {
        write(&csv_header(program, angles, question.closest.is_some()))?;
    }
    let mut index = 0;
    let outcome = loop {
        let solved = match rows.next() {
            None => break Ok(()),
            Some(row) => row.and_then(|Row { line, target }| {
                question.answer(target).map_err(|error| error.at_line(line).in_file(Path::new(targets::STDIN)))
            }),
        };
        match solved {
            Ok(answer) if as_json => write(&json(&answer, false))?,
            Ok(answer) => {
                index += 1;
                write(&csv_rows(&answer, index))?;
            }
            Err(error) => break Err(error),
        }
    };
    out.flush().map_err(|error| console::unwritten(&error))?;
    Ok(outcome?)
}
