//! The equations of motion of a robot at the states of a table.

use std::path::Path;

use nalgebra::{DMatrix, DVector, Vector3};
use serde::Serialize;

use super::reading::Reading;
use super::{Arguments, massless};
use crate::cli::json::FORMAT;
use crate::cli::moving::described;
use crate::cli::output::Kind;
use crate::cli::{Outcome, console};
use crate::{Error, Result};
use groebot_robot::dynamics::{Base, Equations, State, Workspace};
use groebot_robot::model::{Joint, Robot};
use groebot_robot::motion::{StateRow, StateTable};

/// The output for all states.
#[derive(Serialize)]
struct Report {
    format: u32,
    /// The independent joints, in order.
    joints: Vec<String>,
    floating: bool,
    states: Vec<Answer>,
    /// The ignored parts of the robot's file.
    notes: Vec<String>,
}

/// The output for one state.
#[derive(Serialize)]
struct Answer {
    tau: Vec<f64>,
    #[serde(rename = "M")]
    inertia: Vec<Vec<f64>>,
    #[serde(rename = "C")]
    coriolis: Vec<Vec<f64>>,
    g: Vec<f64>,
    /// Empty where bodies without mass would have to move.
    qdd: Vec<f64>,
}

/// Reads the states and writes the requested quantities.
pub fn run(arguments: &Arguments, states: &Path) -> Outcome {
    let output = arguments.output(Some(states)).expects([arguments.out.as_ref()])?;
    let (robot, _) = described(&arguments.robot, &arguments.part.options())?;
    let (robot, gravity) = arguments.part.of(&robot)?;
    let table = StateTable::read_csv(states)?;
    let report = report(&robot, gravity, arguments, (states, table))?;
    let text = if arguments.json { json(&report) } else { csv(&report)? };
    if !arguments.json {
        console::print_notes(&report.notes);
    }
    match &arguments.out {
        Some(file) => output.write(file, if arguments.json { Kind::Json } else { Kind::Plain }, text),
        None => console::print(&text),
    }
}

/// Whether a link has a mass, or a joint friction or a rotor.
fn has_dynamics(robot: &Robot) -> bool {
    let moves = |joint: &Joint| [joint.damping, joint.friction, joint.armature].iter().any(|number| *number != 0.0);
    robot.links().iter().any(|link| link.mass.is_some()) || robot.joints().iter().any(moves)
}

fn report(
    robot: &Robot,
    gravity: Vector3<f64>,
    arguments: &Arguments,
    (file, table): (&Path, StateTable),
) -> Result<Report> {
    let reading = Reading::choose(robot, &table, arguments.floating).map_err(|error| error.in_file(file))?;
    let table = table.in_order_of(&reading.joints).map_err(|error| error.in_file(file))?;
    let mut notes = robot.parts().notes.clone();
    let robot = if reading.followers.is_empty() { robot } else { &without_followers(robot)? };
    notes.extend(reading.note());
    let mut equations = arguments.equations(robot, reading.base)?.with_gravity(gravity);
    if !has_dynamics(robot) {
        return Err(massless().in_file(&arguments.robot));
    }
    if arguments.no_friction {
        equations = equations.without_friction();
    }
    notes.extend_from_slice(equations.notes());
    let mut room = equations.workspace();
    let mut massless = Vec::new();
    let mut states = Vec::with_capacity(table.rows.len());
    for (number, row) in (1..).zip(&table.rows) {
        let at = |error: Error| error.with_context(format!("row {number}"));
        let (found, free) = answer(&equations, &mut room, row).map_err(|error| at(error).in_file(file))?;
        states.push(found);
        massless.extend(free.map(at));
    }
    if let Some(first) = massless.first() {
        notes.push(format!("qdd is empty in {} of {} rows: {}", massless.len(), states.len(), first.message()));
    }
    let Reading { joints, base, .. } = reading;
    Ok(Report { format: FORMAT, joints, floating: base == Base::Floating, states, notes })
}

/// The robot with all joints independent, without mimic joints.
fn without_followers(robot: &Robot) -> Result<Robot> {
    let mut parts = robot.parts().clone();
    parts.joints.iter_mut().for_each(|joint| joint.mimic = None);
    Robot::new(parts)
}

/// The quantities of a state, and the reason why its accelerations are undefined, if bodies without mass would have to
/// move.
fn answer(equations: &Equations, room: &mut Workspace, row: &StateRow) -> Result<(Answer, Option<Error>)> {
    let still = vec![0.0; equations.freedoms()];
    let or_still = |list: &Option<Vec<f64>>| list.clone().unwrap_or_else(|| still.clone());
    let (velocity, acceleration) = (or_still(&row.velocity), or_still(&row.acceleration));
    let state = State::new(&row.q, &velocity);
    let rows = |matrix: &DMatrix<f64>| matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
    let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
    let tau = list(equations.inverse(room, state, &acceleration)?);
    let [inertia, coriolis] = equations.matrices(room, state)?.map(rows);
    let g = list(equations.gravity(room, &row.q)?);
    let torques = row.torques.as_deref().unwrap_or(&tau);
    let (qdd, massless) = match equations.forward(room, state, torques) {
        Ok(qdd) => (list(qdd), None),
        // All other quantities of the state are valid.
        Err(error) if torques.len() == tau.len() => (Vec::new(), Some(error)),
        Err(error) => return Err(error),
    };
    Ok((Answer { tau, inertia, coriolis, g, qdd }, massless))
}

fn json(report: &Report) -> String {
    serde_json::to_string_pretty(report).expect("numbers and names") + "\n"
}

/// The output table.
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
        let mut words: Vec<String> = numbers.map(|number| format!("{number:?}")).collect();
        words.resize(names.len(), String::new());
        text += &(words.join(",") + "\n");
    }
    Ok(text)
}
