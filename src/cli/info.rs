//! `groebot info`: a chain with its geometry, coupled chains with their actuators, a robot with its links, or a system,
//! as text.

mod robot;

use std::path::PathBuf;

use super::cells::fixed;
use super::console::{self, Paint};
use super::ends::{IdealEndArguments, TipLink};
use super::{Halt, Outcome, json};
use crate::{Error, ErrorKind, Result};
use groebot_ik::derive::coupled::{Actuator, CoupledChains};
use groebot_ik::derive::formulate;
use groebot_ik::derive::{Description, Ends, InputFile};
use groebot_robot::kinematics::{Chain, DhTable, ExactVector, Geometry, Joint, JointKind};
use groebot_robot::model::Robot;
use num_traits::ToPrimitive;

const EXAMPLES: &str = "Examples:
  groebot info derivations/nao_leg_sagittal      a chain: joints, geometry, equations
  groebot info robot.urdf                        a robot: its links and the ends of its limbs
  groebot info robot.urdf --tip tool0            the chain from the root to that link";

/// Prints a chain with the relations of its axes, coupled chains with their actuators, a robot's links, or a system of
/// equations
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A mechanism's folder, an input file, or a robot's name (`groebot robots`); `-` for standard input
    #[arg(value_name = "DIR-or-FILE")]
    input: PathBuf,
    #[command(flatten)]
    ends: IdealEndArguments,
    /// Print JSON, for a chain or a robot
    #[arg(long)]
    json: bool,
    /// Joint values of a robot for its centre of mass, in the order of the output [rad or m] (default: all zero)
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    q: Option<Vec<f64>>,
}

/// Prints the input.
pub fn run(arguments: &Arguments) -> Outcome {
    let input = InputFile::read_with(&arguments.input, &arguments.ends.options())?;
    let ends = arguments.ends.ends()?.or(&input.ends);
    let paint = Paint::of(&std::io::stdout());
    match &input.description {
        Description::Robot(robot) if ends == Ends::default() && robot.leaves().len() > 1 => {
            let body = robot::Body::new(robot, arguments.q.as_deref().unwrap_or_default())?;
            console::print(&if arguments.json { json::text(&body.json()) } else { body.page(paint) })
        }
        Description::System(system) if ends == Ends::default() => {
            console::print(&if arguments.json { json::text(&json::system(system)) } else { system.to_string() })
        }
        Description::Coupled(coupled) if ends == Ends::default() => console::print(&if arguments.json {
            json::text(&json::coupled(coupled))
        } else {
            coupled_page(coupled, paint)
        }),
        description => {
            let none = || Error::new(ErrorKind::BadValue, "there is no chain here").in_file(&input.path);
            let chain = input.chain(&ends)?.ok_or_else(none)?;
            let mut notes = match description {
                Description::Robot(tree) => notes(tree, &ends)?,
                _ => Vec::new(),
            };
            let path = input.path(&ends)?;
            let tip = path.as_ref().map(TipLink::of_path);
            notes.extend(
                chain.check_base(input.carrier(path.as_ref()).as_deref()).err().map(|far| far.message().to_owned()),
            );
            notes.extend(tip.as_ref().and_then(TipLink::note));
            notes.extend(DhTable::doubt_of(&input.text));
            let (ideal, report) = ends.ideal(&chain)?;
            if arguments.json {
                return console::print(&json::text(&json::chain(&chain, (&ideal, &report), &notes, tip.as_ref())));
            }
            notes.extend(report.lines());
            notes.extend(near_words(&ideal));
            console::print(&(chain_page(&ideal, &notes, paint) + &equations(&ideal)?))
        }
    }
}

/// Near-relations up to this deviation are reported [rad, fraction of the reach].
const NEAR: f64 = 1e-3;

/// Near-relations of the axes of `chain`, and the option that makes them exact, as text.
pub(super) fn near_words(chain: &Chain) -> Vec<String> {
    let Ok((_, report)) = chain.ideal_within(NEAR) else { return Vec::new() };
    let words = report.relations.iter().map(|relation| relation.words(chain.length_unit()));
    words.map(|words| format!("with --snap {NEAR:e}: {words}")).collect()
}

fn notes(tree: &Robot, ends: &Ends) -> Result<Vec<String>> {
    let path = tree.path(ends.base.as_deref(), ends.tip.as_deref())?;
    Ok(tree.notes(&path))
}

/// The equations of a chain whose task can be derived; empty for others.
fn equations(chain: &Chain) -> std::result::Result<String, Halt> {
    match formulate(chain) {
        Ok(system) => Ok(format!("\n{system}")),
        Err(error) if error.kind() == ErrorKind::Unsupported => Ok(String::new()),
        Err(error) => Err(error.into()),
    }
}

fn chain_page(chain: &Chain, notes: &[String], paint: Paint) -> String {
    let unit = chain.length_unit().symbol();
    let (name, count) = (paint.bold(chain.name()), joints(chain.joints().len()));
    let mut page = format!("{name}: {count}, task {}, lengths in {unit}\n", chain.task_text());
    for text in [&chain.parts().description, &chain.parts().source].into_iter().flatten() {
        page += &format!("{}\n", paint.dim(text));
    }
    page += &format!("\n{}\n", paint.bold("joints, in the base frame with all values at zero"));
    page += &table(
        &chain.joints().iter().enumerate().map(|(index, joint)| joint_row(index, joint, unit)).collect::<Vec<_>>(),
    );
    let pose = chain.base_from_tip();
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let angles = [roll, pitch, yaw].map(|angle| tidy(angle.to_degrees()));
    page += &format!("  tip at {} {unit}, roll pitch yaw ({}) deg\n", vector(&chain.tip().point), angles.join(", "));
    if chain.reach() > 0.0 {
        page += &format!("  at most {} {unit} from the first joint{}\n", tidy(chain.reach()), sliding(chain));
    }
    page += &format!("\n{}", geometry(chain, paint));
    if !notes.is_empty() {
        page += &format!("\n{}\n", paint.bold("notes"));
        page += &notes.iter().map(|note| format!("  {note}\n")).collect::<String>();
    }
    page
}

/// The relations of the axes, with coloured headings.
fn geometry(chain: &Chain, paint: Paint) -> String {
    let text = Geometry::of(chain).to_string();
    let line = |line: &str| if line.starts_with(' ') { format!("{line}\n") } else { format!("{}\n", paint.bold(line)) };
    text.lines().map(line).collect()
}

fn joints(count: usize) -> String {
    format!("{count} joint{}", if count == 1 { "" } else { "s" })
}

fn sliding(chain: &Chain) -> &'static str {
    if chain.joints().iter().any(|joint| joint.kind == JointKind::Prismatic) {
        " (prismatic joints at zero)"
    } else {
        ""
    }
}

fn joint_row(index: usize, joint: &Joint, unit: &str) -> Vec<String> {
    let (axis, point) = (direction(&joint.axis), vector(&joint.point));
    let motion = match joint.kind {
        JointKind::Revolute => format!("turns about {axis}"),
        JointKind::Prismatic => format!("slides along {axis}"),
    };
    let limits = match (joint.kind, joint.limits) {
        (_, None) => "no limits".to_owned(),
        (JointKind::Revolute, Some((low, high))) => {
            format!("{}..{} deg", fixed(low.to_degrees(), 2), fixed(high.to_degrees(), 2))
        }
        (JointKind::Prismatic, Some((low, high))) => format!("{low}..{high} {unit}"),
    };
    let point = format!("through {point} {unit}");
    vec![(index + 1).to_string(), joint.name.clone(), motion, point, limits]
}

/// The greatest integer of a direction that is shown unchanged.
const GREATEST: f64 = 100.0;

/// A direction: small integers unchanged, others as the unit vector.
fn direction(axis: &ExactVector) -> String {
    let entries = axis.each_ref().map(|entry| entry.to_f64().unwrap_or(f64::NAN));
    if axis.iter().all(|entry| entry.is_integer()) && entries.iter().all(|entry| entry.abs() <= GREATEST) {
        return vector(axis);
    }
    let length = entries.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    format!("({})", entries.map(|entry| tidy(entry / length)).join(", "))
}

/// Three numbers: short ones exactly, others to nine decimals.
fn vector(vector: &ExactVector) -> String {
    let numbers = vector.each_ref().map(|x| tidy(x.to_f64().unwrap_or(f64::NAN)));
    format!("({})", numbers.join(", "))
}

/// A number to nine decimals, without trailing zeros.
fn tidy(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Left-aligned columns.
fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| -> String {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("  {cell:<width$}"));
        cells.collect::<String>().trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}

/// The actuators of coupled chains with the joints that they move, then each chain.
fn coupled_page(coupled: &CoupledChains, paint: Paint) -> String {
    let parts = coupled.parts();
    let (count, actuators) = (parts.chains.len(), coupled.actuators().len());
    let mut page = format!("{}: {count} chains on {actuators} actuators\n", paint.bold(&parts.name));
    for text in [&parts.description, &parts.source].into_iter().flatten() {
        page += &format!("{}\n", paint.dim(text));
    }
    page += &format!("\n{}\n", paint.bold("actuators"));
    let row = |actuator: &Actuator| vec![actuator.name.clone(), coupled.moved(actuator).join(", ")];
    page += &table(&coupled.actuators().iter().map(row).collect::<Vec<_>>());
    for member in coupled.chains() {
        page +=
            &format!("\n{}\n{}", paint.bold(&format!("chain {}", member.name)), chain_page(&member.chain, &[], paint));
    }
    page
}
