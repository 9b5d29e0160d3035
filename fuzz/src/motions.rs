//! Motions: trajectories, walks, tasks, footsteps, tables of states, logs, scenes.

use groebot::cli::readers;
use groebot::gait::{Measures, Route, step_commands};
use groebot::motion::{StateTable, Trajectory};
use groebot::sim::TaskRecord;
use groebot::sim::export::Scene;
use groebot::view::{Page, WalkRecord};

use super::given::{HINGE, WALKER};
use super::{Target, check_shown, read, text};

pub(super) const TARGETS: [Target; 9] = [
    Target { name: "states", about: "tables of states, `motion::StateTable`", run: states, damaged: 300 },
    Target { name: "log", about: "logs of `identify`, and the identified parameters", run: log, damaged: 100 },
    Target { name: "trajectory_csv", about: "trajectories in CSV", run: trajectory_csv, damaged: 200 },
    Target { name: "trajectory_json", about: "trajectories in JSON", run: trajectory_json, damaged: 200 },
    Target { name: "walk_json", about: "walks in JSON, and their page", run: walk_json, damaged: 100 },
    Target { name: "task_json", about: "tasks in JSON, `sim::TaskRecord`", run: task_json, damaged: 200 },
    Target { name: "footsteps", about: "footsteps in CSV, `gait::Route`", run: footsteps, damaged: 300 },
    Target {
        name: "walk_words",
        about: "text descriptions of walks, `gait::step_commands`",
        run: walk_words,
        damaged: 300,
    },
    Target { name: "vrml", about: "VRML in the form of RH0 Fig. 5-4, written in all formats", run: vrml, damaged: 200 },
];

/// Rows have the number of columns of the table. Errors have a line.
fn states(bytes: &[u8]) {
    match StateTable::from_csv(&text(bytes)) {
        Ok(table) => assert!(table.rows.iter().all(|row| row.q.len() == table.coordinates)),
        Err(error) => {
            assert!(error.place().line.is_some(), "{error}");
            super::check_refusal(&error);
        }
    }
}

/// Identified parameters are finite.
fn log(bytes: &[u8]) {
    let Some(log) = read(readers::log(&HINGE, &text(bytes))) else { return };
    for with_friction in [false, true] {
        if let Some(found) = read(HINGE.identify(&log, with_friction)) {
            assert!(found.base.iter().all(|estimate| estimate.value.is_finite()), "{:?}", found.base);
            assert!(found.consistency.values.iter().all(|value| value.is_finite()));
        }
    }
}

/// Nine decimals are written. Normalisation of a quaternion may change its last decimal.
fn trajectory_csv(bytes: &[u8]) {
    let Some(trajectory) = read(Trajectory::from_csv(&text(bytes))) else { return };
    let again = Trajectory::from_csv(&trajectory.to_csv()).expect("what is written is read");
    assert_eq!((&again.robot, &again.joints), (&trajectory.robot, &trajectory.joints));
    let near = |a: &f64, b: &f64| (a - b).abs() <= 1e-9 * b.abs().max(1.0);
    assert!(again.times.iter().zip(&trajectory.times).all(|(a, b)| near(a, b)));
    assert!(again.q.iter().flatten().zip(trajectory.q.iter().flatten()).all(|(a, b)| near(a, b)));
    let names = |own: &Trajectory| own.contacts.iter().map(|contact| contact.name.clone()).collect::<Vec<_>>();
    assert_eq!(
        (names(&again), again.points.len(), again.figures.len()),
        (names(&trajectory), trajectory.points.len(), trajectory.figures.len())
    );
}

fn trajectory_json(bytes: &[u8]) {
    if let Some(trajectory) = read(Trajectory::from_json(&text(bytes))) {
        assert_eq!(Trajectory::from_json(&trajectory.to_json().to_string()), Ok(trajectory));
    }
}

/// The page of a walk contains no foreign script.
fn walk_json(bytes: &[u8]) {
    let text = text(bytes);
    let (trajectory, walk) = (read(Trajectory::from_json(&text)), read(WalkRecord::from_json(&text)));
    let Some(trajectory) = trajectory else { return };
    let page =
        Page::of_robot(&WALKER, None).and_then(|page| page.with_motion(&trajectory, walk.flatten().as_ref(), &[]));
    if let Some(page) = read(page) {
        let data = page.data();
        assert!(!data.contains("</"), "{data}");
    }
}

/// The text of a task is read as the same task.
fn task_json(bytes: &[u8]) {
    if let Some(task) = read(TaskRecord::from_json(&text(bytes))).flatten() {
        let written = serde_json::json!({ "task": task }).to_string();
        assert_eq!(TaskRecord::from_json(&written), Ok(Some(task)));
    }
}

/// After each step both feet have a pose.
fn footsteps(bytes: &[u8]) {
    if let Some(route) = read(Route::from_csv(&text(bytes), 0.05)) {
        assert_eq!(route.stands().len(), route.steps.len() + 1);
    }
}

fn walk_words(bytes: &[u8]) {
    let measures = Measures { length: 0.04, half_width: 0.05, most_turn: 0.3 };
    if let Some(words) = read(step_commands(&text(bytes))) {
        let _ = read(Route::of_commands(&words, &measures));
    }
}

/// A scene is written in all formats. Numbers may exceed the single precision of glTF.
fn vrml(bytes: &[u8]) {
    let Some(scene) = read(Scene::from_vrml(&text(bytes))) else { return };
    check_shown(&scene.to_x3d().expect("numbers and names"));
    check_shown(&scene.to_wrl().expect("numbers and names"));
    let _ = read(scene.to_glb());
}
