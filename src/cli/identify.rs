//! `groebot identify`: inertial parameters of a robot's bodies from a log.

use std::path::PathBuf;

use serde::Serialize;

use super::json::FORMAT;
use super::moving::described;
use super::output::{Force, Kind};
use super::part::PartArguments;
use super::{Halt, Outcome, console};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_robot::document::shown;
use groebot_robot::dynamics::{Base, Consistency, Equations, Estimate, Finding, Identification, Logged};
use groebot_robot::motion::StateTable;

const EXAMPLES: &str = "Examples:
  groebot identify ur5.urdf log.csv
  groebot identify ur5.urdf log.csv --friction --json -o identified.csv

log.csv begins with a row of names: q0, q1, ... (the independent joints, in the order of the
description), v0.., a0.. and tau0.. of measured motions; or q:JOINT, v:JOINT and so on in any order.
Rows are in the order of time.

The result is the base parameters with 95 % confidence intervals. Base parameters are the sums of
inertial parameters that determine the motion. m, mx, my, mz are mass, and mass times centre; Ixx to
Izz are the inertia about the origin. Each is in the frame of its link, with the links fixed to it.
The same parameters are also estimated under the condition of physical consistency (positive
semidefinite pseudo-inertia). The confidence intervals assume noise that is independent from row to
row.

The exit status is 3 for a log that does not fit rigid bodies with independent noise: torques that
are unexplained, of opposite sign, in another unit, clipped or outliers, or residuals that are
correlated in time.";

/// Estimates inertial parameters, with confidence intervals, from a log of motions and torques (least squares on base
/// parameters)
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot by name, or a description in URDF, xacro, MJCF, SDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The log, CSV
    #[arg(value_name = "LOG")]
    log: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// Also estimate viscous and Coulomb friction of each joint (default: that of the description)
    #[arg(long)]
    friction: bool,
    /// Write a table of the estimates to this CSV file
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

#[derive(Serialize)]
struct Report<'a> {
    format: u32,
    rows: usize,
    /// The number of torques minus the number of estimates.
    degrees_of_freedom: usize,
    condition_number: f64,
    /// For each joint.
    residual_rms: Vec<(&'a str, f64)>,
    /// For each joint, as a fraction of the torques' standard deviation.
    unexplained_fraction: Vec<(&'a str, f64)>,
    parameters: Vec<Row<'a>>,
    consistent: bool,
    /// As text.
    consistency: String,
    /// The parameters of physically consistent bodies that explain the torques best.
    bodies: Vec<(String, f64)>,
    passed: bool,
    /// Faults of the log.
    findings: Vec<Found<'a>>,
    /// The ignored parts of the robot's file.
    notes: Vec<String>,
}

#[derive(Serialize)]
struct Row<'a> {
    name: &'a str,
    value: f64,
    /// Half of the 95 % interval; `None` without degrees of freedom of the noise.
    confidence_95: Option<f64>,
    described: f64,
    /// The value for physically consistent bodies; `None` for friction.
    consistent: Option<f64>,
}

#[derive(Serialize)]
struct Found<'a> {
    kind: &'static str,
    joint: Option<&'a str>,
    size: f64,
    text: String,
}

/// Reads the log and prints the result.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.robot.as_path(), arguments.log.as_path()]);
    let output = output.expects([arguments.out.as_ref()])?;
    let (robot, _) = described(&arguments.robot, &arguments.part.options())?;
    let (robot, gravity) = arguments.part.of(&robot)?;
    let equations = Equations::unchecked(&robot, Base::Fixed)
        .map_err(|error| error.in_file(&arguments.robot))?
        .with_gravity(gravity);
    let log = read(arguments, &equations)?;
    let found = equations.identify(&log, arguments.friction).map_err(|error| error.in_file(&arguments.log))?;
    let names = equations.parameter_names();
    let notes = [&robot.parts().notes[..], equations.notes()].concat();
    let report = Report { notes, ..report(&found, log.len(), equations.joints(), &names) };
    if let Some(file) = &arguments.out {
        output.write(file, Kind::Plain, table(&report))?;
    }
    if arguments.json {
        console::print(&(serde_json::to_string_pretty(&report).expect("numbers and names") + "\n"))?;
    } else {
        console::print_notes(&report.notes);
        console::print(&text(&report))?;
    }
    if report.passed { Ok(()) } else { Err(Halt::BadData) }
}

fn read(arguments: &Arguments, equations: &Equations) -> Result<Vec<Logged>> {
    log(StateTable::read_csv(&arguments.log)?, equations).map_err(|error| error.in_file(&arguments.log))
}

/// The rows of a log.
///
/// # Errors
/// As [`StateTable::in_order_of`]; [`ErrorKind::BadValue`] for more rows than [`limits::LOG_ENTRIES`] allows; [`ErrorKind::MissingKey`] for a list that is missing.
pub fn log(table: StateTable, equations: &Equations) -> Result<Vec<Logged>> {
    let table = table.in_order_of(equations.joints())?;
    let entries = table.rows.len().saturating_mul(10 * table.coordinates * table.coordinates);
    limits::check_count("entries of the regressor (rows times joints times parameters)", entries, limits::LOG_ENTRIES)?;
    let whole = table.rows.into_iter().map(|row| {
        Some(Logged { q: row.q, velocity: row.velocity?, acceleration: row.acceleration?, torques: row.torques? })
    });
    let text = "a log has columns q0.., v0.., a0.. and tau0..; some are missing";
    whole.collect::<Option<Vec<_>>>().ok_or_else(|| Error::new(ErrorKind::MissingKey, text))
}

fn report<'a>(found: &'a Identification, rows: usize, joints: &'a [String], names: &[String]) -> Report<'a> {
    let row = |estimate: &'a Estimate, of_bodies: Option<f64>| Row {
        name: &estimate.name,
        value: estimate.value,
        confidence_95: estimate.interval,
        described: estimate.described,
        consistent: of_bodies,
    };
    let consistency = &found.consistency;
    let base = found.base.iter().zip(&consistency.values).map(|(estimate, value)| row(estimate, Some(*value)));
    let friction = found.friction.iter().flatten().map(|estimate| row(estimate, None));
    let by_joint = |list: &[f64]| joints.iter().map(String::as_str).zip(list.iter().copied()).collect();
    Report {
        format: FORMAT,
        rows,
        degrees_of_freedom: found.freedom,
        condition_number: found.condition,
        residual_rms: by_joint(&found.misses),
        unexplained_fraction: by_joint(&found.unexplained),
        parameters: base.chain(friction).collect(),
        consistent: consistency.holds(),
        consistency: in_words(consistency),
        bodies: names.iter().cloned().zip(consistency.bodies.iter().copied()).collect(),
        passed: found.findings.is_empty(),
        findings: found.findings.iter().map(finding).collect(),
        notes: Vec::new(),
    }
}

fn finding(finding: &Finding) -> Found<'_> {
    Found { kind: finding.kind.name(), joint: finding.joint.as_deref(), size: finding.size, text: finding.to_string() }
}

fn in_words(consistency: &Consistency) -> String {
    let [reached, least] = [consistency.squares, consistency.least].map(f64::sqrt);
    if consistency.holds() {
        format!(
            "physically possible within the noise: the nearest bodies without a negative mass or principal moment of mass are {reached:.2} standard deviations away"
        )
    } else if consistency.is_refuted() {
        format!("not physically possible: all bodies are at least {least:.1} standard deviations away")
    } else {
        format!(
            "not decided whether it is physically possible: the search for the nearest bodies did not converge; they are between {least:.1} and {reached:.1} standard deviations away"
        )
    }
}

fn text(report: &Report<'_>) -> String {
    let mut text = format!(
        "{} rows, {} numbers, {} degrees of freedom left; condition number {:.3e} (columns of one length)\n{:>14}  {:>11}  {:>14}  {:>14}  what\n",
        report.rows,
        report.parameters.len(),
        report.degrees_of_freedom,
        report.condition_number,
        "found",
        "+- (95 %)",
        "of bodies",
        "described"
    );
    let cell = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.6e}"));
    for row in &report.parameters {
        let interval = row.confidence_95.map_or_else(|| "-".to_owned(), |half| format!("{half:.2e}"));
        let (bodies, name) = (cell(row.consistent), shown(row.name));
        text += &format!("{:>14.6e}  {interval:>11}  {bodies:>14}  {:>14.6e}  {name}\n", row.value, row.described);
    }
    if report.degrees_of_freedom == 0 {
        text +=
            "no interval: the log has as many torques as there are parameters, so that its noise cannot be estimated\n";
    }
    for ((joint, miss), (_, share)) in report.residual_rms.iter().zip(&report.unexplained_fraction) {
        let (joint, percent) = (shown(joint), 100.0 * share);
        text += &format!("{joint}: torque residual {miss:.3e} rms, {percent:.2} % of the standard deviation\n");
    }
    text += &report.consistency;
    text.push('\n');
    report.findings.iter().for_each(|finding| text += &format!("bad data: {}\n", finding.text));
    text
}

fn table(report: &Report<'_>) -> String {
    let mut text = "name,value,confidence_95,described,of_bodies\n".to_owned();
    let cell = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
    for row in &report.parameters {
        let (interval, bodies) = (cell(row.confidence_95), cell(row.consistent));
        text += &format!("\"{}\",{:?},{interval},{:?},{bodies}\n", row.name, row.value, row.described);
    }
    text
}
