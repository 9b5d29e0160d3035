//! `groebot fk`: the pose of the tip, as text, JSON or CSV.

use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::cells::fixed;
use super::columns::{self, Columns};
use super::ends::{EndArguments, TipLink};
use super::json::FORMAT;
use super::targets::{self, Row};
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result};
use groebot_ik::derive::{Description, InputFile};
use groebot_robot::kinematics::{Chain, Joint, JointKind, LengthUnit, Quantity, Target, TargetNumber};
use groebot_robot::spatial::Pose;

const EXAMPLES: &str = "Examples:
  groebot fk derivations/nao_leg_sagittal --q 0.3,0.6
  groebot fk robot.urdf --base base_link --tip tool0 --q 0,-90,90,0,0,0 --degrees
  groebot fk robot.urdf --tip tool0 < joints.csv > poses.csv

Joint values are in the order of the chain, from base to tip; `groebot info` prints it. Angles are
in radians, or in degrees with --degrees. Lengths are in the unit of the description.

A CSV may start with a line of the joints' names, which gives the order of its columns. A1_deg or
A1_rad is A1 in that unit. Other columns that `fk`, `ik` and `solve` write are ignored, and so are
targets without a solution. Unknown names are errors.

A value outside its limits is reported, and is not an error.";

/// Computes the pose of the tip for given joint values (forward kinematics, product of exponentials)
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A mechanism's folder, a file with a chain or a robot, or a robot's name; `-` for standard input
    #[arg(value_name = "DIR-or-FILE")]
    input: PathBuf,
    #[command(flatten)]
    ends: EndArguments,
    /// Joint values separated by commas (repeatable) [rad, or the description's length unit]; `-`, or none: CSV from
    /// standard input
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    q: Vec<String>,
    /// Print JSON: one object per joint vector
    #[arg(long)]
    json: bool,
    /// Use degrees instead of radians in joint values and in JSON and CSV output (text has both)
    #[arg(long)]
    degrees: bool,
}

/// Prints the pose for each given joint vector.
pub fn run(arguments: &Arguments) -> Outcome {
    let input = InputFile::read_with(&arguments.input, &arguments.ends.options())?;
    let ends = arguments.ends.ends()?;
    let chain = input.chain(&ends)?.ok_or_else(|| {
        let text = "this is a system of equations, or coupled chains; forward kinematics needs a chain (of coupled chains, give the file of one)";
        Error::new(ErrorKind::BadValue, text).in_file(&input.path)
    })?;
    let tip = input.path(&ends)?.as_ref().map(TipLink::of_path);
    let others = match &input.description {
        Description::Robot(robot) => robot.joints().iter().map(|joint| joint.name.clone()).collect(),
        _ => Vec::new(),
    };
    let notes = input.ignored(&ends)?;
    if !arguments.json {
        console::print_notes(&notes);
    }
    let edge = Edge { chain: &chain, degrees: arguments.degrees, tip: tip.as_ref(), others, notes };
    match arguments.q.as_slice() {
        [] if io::stdin().is_terminal() => {
            let text = "no joint values; give them by --q, or CSV on standard input";
            Err(Error::new(ErrorKind::MissingKey, text).into())
        }
        [] => arguments.stream(&edge),
        [dash] if dash == "-" => arguments.stream(&edge),
        given => listed(&edge, given, arguments.json),
    }
}

impl Arguments {
    fn stream(&self, edge: &Edge<'_>) -> Outcome {
        targets::is_free(&self.input, "--q")?;
        stream(edge, self.json)
    }
}

/// A chain with the unit of angles in input and output.
struct Edge<'a> {
    chain: &'a Chain,
    degrees: bool,
    /// The ignored parts of the robot.
    notes: Vec<String>,
    /// The last link, for a robot.
    tip: Option<&'a TipLink>,
    /// The other joints of its robot, whose columns are ignored.
    others: Vec<String>,
}

/// Joint values as given, and the pose of the tip.
struct Answer {
    q: Vec<f64>,
    pose: Pose,
    /// Roll, pitch and yaw \[rad\].
    rpy: [f64; 3],
    outside: Vec<String>,
    /// The numbers of the target.
    target: Vec<f64>,
}

/// The columns of a table of the joint values of `chain`; those of the joints in `others` are ignored.
pub fn columns(chain: &Chain, others: Vec<String>, degrees: bool) -> Columns {
    Columns {
        forms: vec![columns::of_joints(chain.joints())],
        joints: others,
        millimetres: chain.length_unit() == LengthUnit::Millimetre,
        degrees,
        skips_unsolved: true,
    }
}

impl Edge<'_> {
    fn names(&self) -> Vec<&str> {
        self.chain.joints().iter().map(|joint| joint.name.as_str()).collect()
    }

    /// The quantities of the chain's task that are not part of a pose, by name: the direction of its aim, or its angle
    /// \[rad\].
    fn task_numbers(&self) -> Vec<(usize, TargetNumber)> {
        let beyond = |(_, number): &(usize, TargetNumber)| {
            matches!(number, TargetNumber::Direction(_) | TargetNumber::PlaneAngle(_))
        };
        self.chain.task().layout().numbers().iter().copied().enumerate().filter(beyond).collect()
    }

    fn turns(&self, joint: &Joint) -> bool {
        self.degrees && joint.kind == JointKind::Revolute
    }

    fn angle_unit(&self) -> &'static str {
        if self.degrees { "deg" } else { "rad" }
    }

    fn unit(&self, joint: &Joint) -> &'static str {
        match joint.kind {
            JointKind::Revolute => self.angle_unit(),
            JointKind::Prismatic => self.chain.length_unit().symbol(),
        }
    }

    /// Converts an angle in radians to the output unit.
    fn angle(&self, radians: f64) -> f64 {
        if self.degrees { radians.to_degrees() } else { radians }
    }

    fn answer(&self, q: Vec<f64>) -> Result<Answer> {
        let joints = self.chain.joints();
        let inside = |(index, value): (usize, &f64)| match joints.get(index) {
            Some(joint) if self.turns(joint) => value.to_radians(),
            _ => *value,
        };
        let values: Vec<f64> = q.iter().enumerate().map(inside).collect();
        let pose = self.chain.forward(&values)?;
        let (roll, pitch, yaw) = pose.rotation.euler_angles();
        let beyond =
            |(joint, value): &(&Joint, &f64)| joint.limits.is_some_and(|(low, high)| **value < low || **value > high);
        let outside = joints.iter().zip(&values).filter(beyond).map(|(joint, _)| joint.name.clone()).collect();
        let target = self.chain.task().layout().values(&Target::of_pose(self.chain, &pose))?;
        Ok(Answer { q, pose, rpy: [roll, pitch, yaw].map(positive_zero), outside, target })
    }
}

/// Replaces minus zero by zero.
fn positive_zero(value: f64) -> f64 {
    value + 0.0
}

impl Answer {
    fn position(&self) -> [f64; 3] {
        <[f64; 3]>::from(self.pose.translation.vector).map(positive_zero)
    }

    /// The quaternion x, y, z, w with w >= 0.
    fn quaternion(&self) -> [f64; 4] {
        let sign = if self.pose.rotation.w < 0.0 { -1.0 } else { 1.0 };
        <[f64; 4]>::from(self.pose.rotation.coords).map(|part| positive_zero(sign * part))
    }

    /// The homogeneous matrix, by rows.
    fn matrix(&self) -> [[f64; 4]; 4] {
        let matrix = self.pose.to_homogeneous();
        std::array::from_fn(|row| std::array::from_fn(|column| positive_zero(matrix[(row, column)])))
    }
}

fn listed(edge: &Edge<'_>, given: &[String], as_json: bool) -> Outcome {
    let mut page = if as_json { String::new() } else { TipLink::line(edge.tip) };
    for (index, text_of_q) in given.iter().enumerate() {
        let answer = targets::parse(&edge.names(), text_of_q)
            .and_then(|q| edge.answer(q))
            .map_err(|error| error.with_context(format!("joint values `{}`", targets::shown(text_of_q))))?;
        if as_json {
            page += &json(edge, &answer, given.len() == 1);
        } else {
            page += if index > 0 { "\n" } else { "" };
            page += &text(edge, &answer);
        }
    }
    console::print(&page)
}

/// Reads joint vectors from standard input, one per row; writes CSV, or one JSON object per line.
fn stream(edge: &Edge<'_>, as_json: bool) -> Outcome {
    let mut out = BufWriter::new(io::stdout().lock());
    let mut write = |text: &str| out.write_all(text.as_bytes()).map_err(|error| console::unwritten(&error));
    let columns = columns(edge.chain, edge.others.clone(), edge.degrees);
    let mut rows = targets::Reader::new(columns, io::stdin().lock(), Path::new(targets::STDIN));
    if !as_json {
        write(&csv_header(edge))?;
    }
    let outcome = loop {
        let answered = match rows.next() {
            None => break Ok(()),
            Some(row) => row.and_then(|Row { line, target }| {
                edge.answer(target).map_err(|error| error.at_line(line).in_file(Path::new(targets::STDIN)))
            }),
        };
        match answered {
            Ok(answer) if as_json => write(&json(edge, &answer, false))?,
            Ok(answer) => write(&csv_row(edge, &answer))?,
            Err(error) => break Err(error),
        }
    };
    out.flush().map_err(|error| console::unwritten(&error))?;
    Ok(outcome?)
}

/// The joint values, then the pose in four forms.
fn text(edge: &Edge<'_>, answer: &Answer) -> String {
    let unit = edge.chain.length_unit().symbol();
    let mut page = format!("{}\n", edge.chain.name());
    let width = edge.names().iter().map(|name| name.chars().count()).max().unwrap_or(0);
    for (joint, value) in edge.chain.joints().iter().zip(&answer.q) {
        let shown = match joint.kind {
            JointKind::Prismatic => format!("{:>14} {unit}", fixed(*value, 9)),
            JointKind::Revolute => {
                let radians = if edge.degrees { value.to_radians() } else { *value };
                format!("{:>14} rad {:>14} deg", fixed(radians, 9), fixed(radians.to_degrees(), 6))
            }
        };
        let outside = if answer.outside.contains(&joint.name) { limits(joint, unit) } else { String::new() };
        page += format!("  {:<width$} {shown}{outside}", joint.name).trim_end();
        page.push('\n');
    }
    let degrees = answer.rpy.map(f64::to_degrees);
    page += "\n  tip in the base frame\n";
    page += &format!("  position       {} {unit}\n", numbers(&answer.position()));
    page += &format!("  quaternion     {}   (x y z w)\n", numbers(&answer.quaternion()));
    page += &format!("  roll pitch yaw {} rad\n", numbers(&answer.rpy));
    page += &format!("                 {} deg\n", numbers(&degrees));
    for (index, row) in answer.matrix().iter().enumerate() {
        let (label, unit) = (if index == 0 { "matrix" } else { "" }, if index < 3 { unit } else { "" });
        page += format!("  {label:<14} {} {unit}", numbers(row)).trim_end();
        page.push('\n');
    }
    page
}

fn limits(joint: &Joint, unit: &str) -> String {
    match (joint.limits, joint.kind) {
        (Some((low, high)), JointKind::Revolute) => {
            format!("   outside {}..{} deg", fixed(low.to_degrees(), 2), fixed(high.to_degrees(), 2))
        }
        (Some((low, high)), JointKind::Prismatic) => format!("   outside {low}..{high} {unit}"),
        (None, _) => String::new(),
    }
}

/// Numbers in columns with a blank before each, nine decimals; values that round to zero have no sign.
fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| format!(" {:>13}", fixed(*value, 9))).collect()
}

#[derive(Serialize)]
struct Page<'a> {
    format: u32,
    name: &'a str,
    /// The last link of a robot's chain.
    #[serde(skip_serializing_if = "Option::is_none")]
    tip_link: Option<&'a TipLink>,
    unit: Units<'a>,
    joints: Vec<&'a str>,
    q: &'a [f64],
    /// The joints whose values are outside their limits.
    outside_limits: &'a [String],
    position: [f64; 3],
    quaternion_xyzw: [f64; 4],
    rpy: [f64; 3],
    /// The homogeneous matrix, by rows.
    matrix: [[f64; 4]; 4],
    /// The ignored parts of the robot.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
}

#[derive(Serialize)]
struct Units<'a> {
    joints: Vec<&'a str>,
    position: &'a str,
    rpy: &'a str,
}

/// One JSON object: on several lines when `pretty`, else on one.
fn json(edge: &Edge<'_>, answer: &Answer, pretty: bool) -> String {
    let page = Page {
        format: FORMAT,
        name: edge.chain.name(),
        tip_link: edge.tip,
        unit: Units {
            joints: edge.chain.joints().iter().map(|joint| edge.unit(joint)).collect(),
            position: edge.chain.length_unit().symbol(),
            rpy: edge.angle_unit(),
        },
        joints: edge.names(),
        q: &answer.q,
        outside_limits: &answer.outside,
        position: answer.position(),
        quaternion_xyzw: answer.quaternion(),
        rpy: answer.rpy.map(|angle| edge.angle(angle)),
        matrix: answer.matrix(),
        notes: &edge.notes,
    };
    let text = if pretty { serde_json::to_string_pretty(&page) } else { serde_json::to_string(&page) };
    text.expect("an answer can be represented in JSON") + "\n"
}

/// The joints' names, then the pose with its units.
fn csv_header(edge: &Edge<'_>) -> String {
    let (length, angle) = (edge.chain.length_unit().symbol(), edge.angle_unit());
    let joint = |joint: &Joint| columns::heading(&joint.name, joint.kind == JointKind::Revolute, edge.degrees);
    let mut cells: Vec<String> = edge.chain.joints().iter().map(joint).collect();
    cells.extend(["x", "y", "z"].map(|name| format!("{name}_{length}")));
    cells.extend(["qx", "qy", "qz", "qw"].map(str::to_owned));
    cells.extend(["roll", "pitch", "yaw"].map(|name| format!("{name}_{angle}")));
    cells.extend(edge.task_numbers().into_iter().map(|(_, number)| match number.quantity() {
        Quantity::Angle => format!("{}_{angle}", number.name()),
        _ => number.name(),
    }));
    cells.push("outside_limits".to_owned());
    super::cells::csv_line(&cells)
}

fn csv_row(edge: &Edge<'_>, answer: &Answer) -> String {
    let mut values = answer.q.clone();
    values.extend(answer.position());
    values.extend(answer.quaternion());
    values.extend(answer.rpy.map(|angle| edge.angle(angle)));
    values.extend(edge.task_numbers().into_iter().map(|(place, number)| match number.quantity() {
        Quantity::Angle => edge.angle(answer.target[place]),
        _ => answer.target[place],
    }));
    let mut cells: Vec<String> = values.iter().map(f64::to_string).collect();
    cells.push(answer.outside.join(" "));
    super::cells::csv_line(&cells)
}
