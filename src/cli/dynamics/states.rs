//! The equations of motion of a robot at states of a table.

use std::path::Path;

use nalgebra::{DMatrix, DVector, Vector3};
use serde::Serialize;

use super::Arguments;
use crate::cli::moving::described;
use crate::cli::output::Kind;
use crate::cli::{Outcome, console};
use crate::dynamics::{Base, Equations, State, Workspace};
use crate::model::Robot;
use crate::motion::{StateRow, StateTable};
use crate::{Error, ErrorKind, Result};

/// What is told of all states.
#[derive(Serialize)]
struct Report {
    format: u32,
    /// The independent joints, in order.
    joints: Vec<String>,
    floating: bool,
    states: Vec<Answer>,
    /// What of the robot's file was ignored.
    notes: Vec<String>,
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
pub fn run(arguments: &Arguments, states: &Path) -> Outcome {
    let output = arguments.output(Some(states)).expects([arguments.out.as_ref()])?;
    let (robot, _) = described(&arguments.robot)?;
    let (robot, gravity) = arguments.part.of(&robot)?;
    let table = StateTable::read_csv(states)?;
    let report = report(&robot, gravity, arguments, (states, &table))?;
    let text = if arguments.json { json(&report) } else { csv(&report)? };
    if !arguments.json {
        console::tell(&report.notes);
    }
    match &arguments.out {
        Some(file) => output.write(file, if arguments.json { Kind::Json } else { Kind::Plain }, text),
        None => console::print(&text),
    }
}

fn report(
    robot: &Robot,
    gravity: Vector3<f64>,
    arguments: &Arguments,
    (file, table): (&Path, &StateTable),
) -> Result<Report> {
    let (count, moving) = (table.coordinates, robot.moving().len());
    let new = |robot: &Robot| {
        let new = if arguments.as_told { Equations::as_told } else { Equations::new };
        new(robot, Base::Fixed).map_err(|error| error.in_file(&arguments.robot))
    };
    let mut equations = new(robot)?;
    // A table may tell of joints that follow others, too: then each is on its own.
    if [moving, moving + 7].contains(&count) && moving > equations.joints().len() {
        equations = new(&without_followers(robot)?)?;
    }
    let joints = equations.joints().to_vec();
    let base = if count == joints.len() + 7 { Base::Floating } else { Base::Fixed };
    equations = equations.with_base(base).with_gravity(gravity);
    if arguments.no_friction {
        equations = equations.without_friction();
    }
    if count != equations.coordinates() {
        let names = joints.join(", ");
        let text = format!(
            "{count} columns q0.. are given; the robot has {} independent joints ({names}), and 7 more where its root moves freely",
            joints.len()
        );
        return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
    }
    let mut room = equations.workspace();
    let answer = |(index, row): (usize, &StateRow)| {
        answer(&equations, &mut room, row)
            .map_err(|error| error.with_context(format!("row {}", index + 1)).in_file(file))
    };
    let states = table.rows.iter().enumerate().map(answer).collect::<Result<_>>()?;
    Ok(Report { format: 1, joints, floating: base == Base::Floating, states, notes: robot.parts().notes.clone() })
}

/// The robot of which each joint is on its own.
fn without_followers(robot: &Robot) -> Result<Robot> {
    let mut parts = robot.parts().clone();
    parts.joints.iter_mut().for_each(|joint| joint.mimic = None);
    Robot::new(parts)
}

fn answer(equations: &Equations, room: &mut Workspace, row: &StateRow) -> Result<Answer> {
    let still = vec![0.0; equations.freedoms()];
    let or_still = |list: &Option<Vec<f64>>| list.clone().unwrap_or_else(|| still.clone());
    let (velocity, acceleration) = (or_still(&row.velocity), or_still(&row.acceleration));
    let state = State::new(&row.q, &velocity);
    let rows = |matrix: &DMatrix<f64>| matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
    let tau = list(equations.inverse(room, state, &acceleration)?);
    let [inertia, coriolis] = equations.matrices(room, state)?.map(rows);
    let g = list(equations.gravity(room, &row.q)?);
    let qdd = list(equations.forward(room, state, row.torques.as_deref().unwrap_or(&tau))?);
    Ok(Answer { tau, inertia, coriolis, g, qdd })
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
