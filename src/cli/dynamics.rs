//! `groebot dynamics`: the equations of motion of a robot at states of a table.

use std::fs::File;
use std::path::{Path, PathBuf};

use nalgebra::{DMatrix, DVector, Vector3};
use serde::Serialize;

use super::export::described;
use super::{Outcome, console};
use crate::dynamics::{Base, Equations, State, Workspace};
use crate::files::write_atomically;
use crate::model::{JointType, Robot};
use crate::{Error, ErrorKind, Result};

const EXAMPLES: &str = "Examples:
  groebot dynamics ur5.urdf --states states.csv -o out.csv
  groebot dynamics nao_v5 --states flight.csv --gravity 0,0,-1.62 --json

states.csv begins with a row of names: q0, q1, ... (the independent joints, in the order of the description; before them, where the root moves freely, its
position x, y, z and its quaternion x, y, z, w), v0, v1, ... (the root's linear and angular velocity in its own frame first), a0, a1, ... and, if they are known,
tau0, tau1, ... Without velocities and accelerations they are zero. The count of q tells whether the root moves freely, and whether joints that
follow others are told too: then each is on its own.

Written are tau0.. (inverse dynamics), M0_0, M1_0, M1_1.. (the inertia matrix's lower triangle), C0_0, C0_1.. (the Coriolis matrix of Christoffel's symbols),
g0.. (gravity) and qdd0.. (forward dynamics of the given torques, else of the computed ones). Metres, kilograms, seconds, radians.";

/// Tells torques, inertia, Coriolis and gravity terms of a robot at states
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot of groebot, or a description in URDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The states, CSV
    #[arg(long, value_name = "FILE")]
    states: PathBuf,
    /// The link from which joints move: those that do not lie between it and the tip stand still at zero
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link up to which joints move
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Gravity in the frame of the root, or of `--base` [m/s^2]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true, default_value = "0,0,-9.81")]
    gravity: Vector3<f64>,
    /// Leave the friction of joints out
    #[arg(long)]
    no_friction: bool,
    /// Take inertias that no body has as they are told
    #[arg(long)]
    as_told: bool,
    /// Where the table goes; standard output without it
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// JSON in place of the table
    #[arg(long)]
    json: bool,
}

/// Three numbers between commas.
fn vector(text: &str) -> std::result::Result<Vector3<f64>, String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|word| word.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(Vector3::new(x, y, z)),
        _ => Err("give three finite numbers between commas, such as 0,0,-9.81".to_owned()),
    }
}

/// What is told of all states.
#[derive(Serialize)]
struct Report {
    format: u32,
    /// The independent joints, in order.
    joints: Vec<String>,
    floating: bool,
    states: Vec<Answer>,
}

/// What is told of one state.
#[derive(Serialize)]
struct Answer {
    tau: Vec<f64>,
    #[serde(rename = "M")]
    inertia: Vec<Vec<f64>>,
    #[serde(rename = "C")]
    coriolis: Vec<Vec<f64>>,
    g: Vec<f64>,
    qdd: Vec<f64>,
}

/// Reads the states and writes what is asked of them.
pub fn run(arguments: &Arguments) -> Outcome {
    let (robot, _) = described(&arguments.robot)?;
    let (robot, gravity) = between(&robot, arguments)?;
    let table = Table::read(&arguments.states)?;
    let report = report(&robot, gravity, arguments, &table)?;
    let text = if arguments.json { json(&report) } else { csv(&report)? };
    match &arguments.out {
        Some(file) => Ok(write_atomically(file, text.as_bytes())?),
        None => console::print(&text),
    }
}

/// The robot whose other joints stand still, and gravity in its root's frame.
fn between(robot: &Robot, arguments: &Arguments) -> Result<(Robot, Vector3<f64>)> {
    let place = |name: &Option<String>| name.as_ref().map(|name| robot.link(name)).transpose();
    let (base, tip) = (place(&arguments.base)?, place(&arguments.tip)?);
    let above = |link: Option<usize>| link.map_or_else(Vec::new, |link| robot.ancestry(link));
    let (carrying, path) = (above(base), above(tip));
    if tip.is_some() && !carrying.iter().all(|joint| path.contains(joint)) {
        let text = format!(
            "link `{}` is not above link `{}`",
            arguments.base.as_deref().unwrap_or_default(),
            arguments.tip.as_deref().unwrap_or_default()
        );
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    let mut parts = robot.parts().clone();
    let below = |joint: usize| {
        base.is_none_or(|base| robot.ancestry(robot.ends(joint).1).iter().any(|&up| robot.ends(up).0 == base))
    };
    for (joint, told) in parts.joints.iter_mut().enumerate() {
        let moves = if tip.is_some() { path.contains(&joint) && !carrying.contains(&joint) } else { below(joint) };
        if told.kind.is_single() && !moves {
            (told.kind, told.limits, told.mimic) = (JointType::Fixed, None, None);
        }
    }
    let still: Vec<String> =
        parts.joints.iter().filter(|joint| !joint.kind.is_single()).map(|joint| joint.name.clone()).collect();
    for actuator in &mut parts.actuators {
        actuator.joints.retain(|(joint, _)| !still.contains(joint));
    }
    parts.actuators.retain(|actuator| !actuator.joints.is_empty());
    let robot = Robot::new(parts)?;
    let model = crate::dynamics::Model::new(&robot)?;
    let turn = base.map_or_else(nalgebra::UnitQuaternion::identity, |base| model.link(base).1.rotation);
    Ok((robot, turn * arguments.gravity))
}

fn report(robot: &Robot, gravity: Vector3<f64>, arguments: &Arguments, table: &Table) -> Result<Report> {
    let (count, moving) = (table.q, robot.moving().len());
    let new = |robot: &Robot, base| {
        let new = if arguments.as_told { Equations::as_told } else { Equations::new };
        new(robot, base).map_err(|error| error.in_file(&arguments.robot))
    };
    let leading = new(robot, Base::Fixed)?.joints().len();
    // A table may tell of joints that follow others, too: then each is on its own.
    let all =
        if [moving, moving + 7].contains(&count) && moving > leading { Some(without_followers(robot)?) } else { None };
    let robot = all.as_ref().unwrap_or(robot);
    let joints = new(robot, Base::Fixed)?.joints().to_vec();
    let base = if count == joints.len() + 7 { Base::Floating } else { Base::Fixed };
    let mut equations = new(robot, base)?.with_gravity(gravity);
    if arguments.no_friction {
        equations = equations.without_friction();
    }
    if count != equations.coordinates() {
        let names = joints.join(", ");
        let text = format!(
            "{count} columns q0.. are given; the robot has {} independent joints ({names}), and 7 more where its root moves freely",
            joints.len()
        );
        return Err(Error::new(ErrorKind::BadValue, text).in_file(&arguments.states));
    }
    let mut room = equations.workspace();
    let answer = |(index, row): (usize, &Row)| {
        answer(&equations, &mut room, row)
            .map_err(|error| error.with_context(format!("row {}", index + 1)).in_file(&arguments.states))
    };
    let states = table.rows.iter().enumerate().map(answer).collect::<Result<_>>()?;
    Ok(Report { format: 1, joints, floating: base == Base::Floating, states })
}

/// The robot of which each joint is on its own.
fn without_followers(robot: &Robot) -> Result<Robot> {
    let mut parts = robot.parts().clone();
    parts.joints.iter_mut().for_each(|joint| joint.mimic = None);
    Robot::new(parts)
}

fn answer(equations: &Equations, room: &mut Workspace, row: &Row) -> Result<Answer> {
    let still = vec![0.0; equations.freedoms()];
    let or_still = |list: &Option<Vec<f64>>| list.clone().unwrap_or_else(|| still.clone());
    let (velocity, acceleration) = (or_still(&row.velocity), or_still(&row.acceleration));
    let state = State { q: &row.q, velocity: &velocity };
    let torques = equations.inverse(room, state, &acceleration)?;
    let [inertia, coriolis] = equations.matrices(room, state)?;
    let gravity = equations.gravity(room, &row.q)?;
    let given = row.torques.as_deref().unwrap_or(torques.as_slice());
    let changes = equations.forward(room, state, given)?;
    let rows = |matrix: &DMatrix<f64>| matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
    Ok(Answer {
        tau: list(&torques),
        inertia: rows(&inertia),
        coriolis: rows(&coriolis),
        g: list(&gravity),
        qdd: list(&changes),
    })
}

fn json(report: &Report) -> String {
    serde_json::to_string_pretty(report).expect("numbers and names") + "\n"
}

/// The table that is written.
fn csv(report: &Report) -> Result<String> {
    let count = report.states.first().map_or(0, |state| state.tau.len());
    let list = |name: &'static str| (0..count).map(move |i| format!("{name}{i}"));
    let lower = (0..count).flat_map(|i| (0..=i).map(move |j| format!("M{i}_{j}")));
    let all = (0..count).flat_map(|i| (0..count).map(move |j| format!("C{i}_{j}")));
    let names: Vec<String> = list("tau").chain(lower).chain(all).chain(list("g")).chain(list("qdd")).collect();
    let mut text = names.join(",") + "\n";
    for state in &report.states {
        let lower = state.inertia.iter().enumerate().flat_map(|(i, row)| &row[..=i]);
        let numbers =
            state.tau.iter().chain(lower).chain(state.coriolis.iter().flatten()).chain(&state.g).chain(&state.qdd);
        let words: Vec<String> = numbers.map(|number| format!("{number:?}")).collect();
        text += &(words.join(",") + "\n");
    }
    Ok(text)
}

/// The states that are read.
struct Table {
    /// How many columns begin with q.
    q: usize,
    rows: Vec<Row>,
}

/// A state, and what else the table tells of it.
struct Row {
    q: Vec<f64>,
    velocity: Option<Vec<f64>>,
    acceleration: Option<Vec<f64>>,
    torques: Option<Vec<f64>>,
}

impl Table {
    fn read(file: &Path) -> Result<Self> {
        let fault = |error: csv::Error| Error::new(ErrorKind::Syntax, error.to_string()).in_file(file);
        let opened = File::open(file).map_err(|error| Error::io(file, &error))?;
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(opened);
        let names: Vec<String> = reader.headers().map_err(fault)?.iter().map(str::to_owned).collect();
        let columns = ["q", "v", "a", "tau"].map(|head| columns(&names, head));
        let known: usize = columns.iter().map(Vec::len).sum();
        if known != names.len() || columns[0].is_empty() {
            let text = format!(
                "the first row is `{}`; give the names q0, q1, ..., v0, ..., a0, ... and tau0, ..., each list whole",
                names.join(",")
            );
            return Err(Error::new(ErrorKind::Syntax, text).in_file(file).at_line(1));
        }
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(fault)?;
            let line = record.position().map_or(0, |position| position.line() as usize);
            let number = |&column: &usize| {
                let word = &record[column];
                let text = || format!("column `{}`: `{word}` is no number", names[column]);
                word.parse::<f64>().map_err(|_| Error::new(ErrorKind::Syntax, text()).in_file(file).at_line(line))
            };
            let list = |columns: &Vec<usize>| columns.iter().map(number).collect::<Result<Vec<f64>>>();
            let optional = |columns: &Vec<usize>| (!columns.is_empty()).then(|| list(columns)).transpose();
            rows.push(Row {
                q: list(&columns[0])?,
                velocity: optional(&columns[1])?,
                acceleration: optional(&columns[2])?,
                torques: optional(&columns[3])?,
            });
        }
        Ok(Table { q: columns[0].len(), rows })
    }
}

/// The columns of the names that begin so and count from zero.
fn columns(names: &[String], head: &str) -> Vec<usize> {
    let column = |index: usize| names.iter().position(|name| *name == format!("{head}{index}"));
    (0..).map_while(column).collect()
}
