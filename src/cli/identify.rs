//! `groebot identify`: what a robot's bodies weigh, from a log.

use std::path::PathBuf;

use serde::Serialize;

use super::moving::described;
use super::output::{Force, Kind};
use super::part::PartArguments;
use super::{Outcome, console};
use crate::dynamics::{Base, CONFIDENT, Consistency, Equations, Estimate, Identification, Logged};
use crate::motion::StateTable;
use crate::{Error, ErrorKind, Result, limits};

const EXAMPLES: &str = "Examples:
  groebot identify ur5.urdf log.csv
  groebot identify ur5.urdf log.csv --friction --json -o identified.csv

log.csv begins with a row of names: q0, q1, ... (the independent joints, in the order of the description), v0.., a0.. and tau0.., of motions that were measured.

Reported are the base parameters, sums of the inertial parameters of bodies (m, mx, my, mz: mass, and mass times centre; Ixx to Izz: inertia about the origin; each in the frame of its
link, with the links fixed to it) which alone matter for motion, with 95 % confidence, and whether bodies can have them.";

/// Identifies inertial parameters by least squares on base parameters, from a log of motions and torques
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot of groebot, or a description in URDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The log, CSV
    #[arg(value_name = "LOG")]
    log: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// Find viscous and Coulomb friction of each joint, too; without it the description's is taken
    #[arg(long)]
    friction: bool,
    /// Where a table of what was found goes, CSV
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    rows: usize,
    condition: f64,
    /// By joint.
    root_mean_square_misses: Vec<(&'a str, f64)>,
    parameters: Vec<Row<'a>>,
    consistent: bool,
    /// In words, and, where bodies can weigh it, what they do.
    consistency: String,
    bodies: Vec<(String, f64)>,
    /// What of the robot's file was ignored.
    notes: &'a [String],
}

#[derive(Serialize)]
struct Row<'a> {
    name: &'a str,
    value: f64,
    /// Half of what 95 % lie within.
    confidence: f64,
    described: f64,
}

/// Reads the log and tells.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.robot.as_path(), arguments.log.as_path()]);
    let output = output.expects([arguments.out.as_ref()])?;
    let (robot, _) = described(&arguments.robot)?;
    let (robot, gravity) = arguments.part.of(&robot)?;
    let equations =
        Equations::as_told(&robot, Base::Fixed).map_err(|error| error.in_file(&arguments.robot))?.with_gravity(gravity);
    let log = read(arguments)?;
    let found = equations.identify(&log, arguments.friction).map_err(|error| error.in_file(&arguments.log))?;
    let names = equations.parameter_names();
    let report = Report { notes: &robot.parts().notes, ..report(&found, log.len(), equations.joints(), &names) };
    if let Some(file) = &arguments.out {
        output.write(file, Kind::Plain, table(&report))?;
    }
    if arguments.json {
        return console::print(&(serde_json::to_string_pretty(&report).expect("numbers and names") + "\n"));
    }
    console::tell(report.notes);
    console::print(&text(&report))
}

fn read(arguments: &Arguments) -> Result<Vec<Logged>> {
    let table = StateTable::read_csv(&arguments.log)?;
    let entries = table.rows.len().saturating_mul(10 * table.coordinates * table.coordinates);
    limits::check_count("entries of the regressor (rows times joints times parameters)", entries, limits::LOG_ENTRIES)
        .map_err(|error| error.in_file(&arguments.log))?;
    let whole = table.rows.into_iter().map(|row| {
        Some(Logged { q: row.q, velocity: row.velocity?, acceleration: row.acceleration?, torques: row.torques? })
    });
    let text = "a log has columns q0.., v0.., a0.. and tau0..; some are missing";
    whole.collect::<Option<Vec<_>>>().ok_or_else(|| Error::new(ErrorKind::MissingKey, text).in_file(&arguments.log))
}

fn report<'a>(found: &'a Identification, rows: usize, joints: &'a [String], names: &[String]) -> Report<'a> {
    let row = |estimate: &'a Estimate| Row {
        name: &estimate.name,
        value: estimate.value,
        confidence: CONFIDENT * estimate.deviation,
        described: estimate.told,
    };
    let (consistent, consistency, bodies) = match &found.consistency {
        Consistency::Consistent(numbers) => {
            let text =
                "bodies can weigh that: none of them has a negative mass or principal moment of its mass".to_owned();
            (true, text, names.iter().cloned().zip(numbers.iter().copied()).collect())
        }
        Consistency::Off { deviations, name } => {
            let text = format!(
                "no bodies were found that weigh that: of those that come nearest `{name}` is {deviations:.1} deviations off"
            );
            (false, text, Vec::new())
        }
    };
    Report {
        format: 1,
        rows,
        condition: found.condition,
        root_mean_square_misses: joints.iter().map(String::as_str).zip(found.misses.iter().copied()).collect(),
        parameters: found.base.iter().chain(found.friction.iter().flatten()).map(row).collect(),
        consistent,
        consistency,
        bodies,
        notes: &[],
    }
}

fn text(report: &Report<'_>) -> String {
    let mut text = format!(
        "{} rows, {} numbers; condition number {:.3e} (columns of one length)\n{:>14}  {:>11}  {:>14}  what\n",
        report.rows,
        report.parameters.len(),
        report.condition,
        "found",
        "+- (95 %)",
        "described"
    );
    for row in &report.parameters {
        text += &format!("{:>14.6e}  {:>11.2e}  {:>14.6e}  {}\n", row.value, row.confidence, row.described, row.name);
    }
    for (joint, miss) in &report.root_mean_square_misses {
        text += &format!("{joint}: torques miss by {miss:.3e} in the root of the mean square\n");
    }
    text + &report.consistency + "\n"
}

fn table(report: &Report<'_>) -> String {
    let mut text = "name,value,confidence_95,described\n".to_owned();
    for row in &report.parameters {
        text += &format!("\"{}\",{:?},{:?},{:?}\n", row.name, row.value, row.confidence, row.described);
    }
    text
}
