//! A run of the simulator: goal, furniture and parameters change between two steps, and the next step takes them into account.

mod answer;
#[cfg(feature = "clearance")]
mod clearance;
mod export;
mod faults;
#[cfg(feature = "clearance")]
mod full_task;
#[cfg(feature = "clearance")]
mod random_rooms;

use std::f64::consts::TAU;

use groebot_humanoid::gait::{Footprint, Walk};
use groebot_humanoid::nav::Room;
use groebot_humanoid::sim::{Destination, FIGURES, Figures, Next, PRESETS, Run, Start, with_fields};
use groebot_humanoid::task::{Body, Goal, Method};
use groebot_humanoid::walkers::{self, Outline, RH0_SIMULATION};
use groebot_humanoid::{ErrorKind, Result, Watch};
use groebot_robot::model::Meshes;
use groebot_robot::robots::{self};
use nalgebra::Point2;

const ROOM: &str = r#"
size = [4.0, 2.6]
wall = 0.05
[[furniture]]
name = "box"
box = [0.3, 0.3]
at = [3.6, 0.4]
"#;

/// The least distance of bodies from obstacles \[m\].
const APART: f64 = 0.02;

fn goal(x: f64, y: f64) -> Goal {
    Goal { place: Point2::new(x, y), heading: None }
}

fn run(robot: &str, from: (f64, f64), to: (f64, f64)) -> Run {
    let middle = Footprint { x: from.0, y: from.1, yaw: 0.0 };
    run_in(&Room::from_toml(ROOM).unwrap(), robot, middle, goal(to.0, to.1).into()).unwrap()
}

fn run_in(room: &Room, robot: &str, middle: Footprint, goal: Destination) -> Result<Run> {
    let walker = walkers::walker(robot, Outline::Measured).unwrap().unwrap();
    let described = robots::robot(robot).unwrap();
    let body = Body::new(&described, &walker.biped, &Meshes::default()).unwrap();
    let start = Start { walker, body, room: room.clone(), apart: APART, middle, goal, method: Method::Exact };
    Run::new(start, &Watch::none())
}

fn arrive(run: &mut Run) -> usize {
    let mut steps = 0;
    while run.step(&Watch::none()).unwrap() != Next::Arrived {
        steps += 1;
    }
    steps
}

fn middle(walk: &Walk) -> Footprint {
    let [left, right] = walk.schedule.route.end();
    left.middle(&right)
}

/// The longest distance from one rest of the feet to the next.
fn longest(walk: &Walk, from: usize) -> f64 {
    let rests = walk.schedule.route.rests[from..].windows(2);
    rests.map(|pair| (pair[1].point() - pair[0].point()).norm()).fold(0.0, f64::max)
}

/// Joints do not jump, and stay within their limits.
fn is_one_motion(run: &Run) {
    let (walk, biped) = (run.walk(), &run.pilot().walker().biped);
    for pair in walk.motion.postures.windows(2) {
        for ((from, to), range) in pair[0].q.iter().zip(&pair[1].q).zip(&biped.joints) {
            assert!((to - from).abs() <= range.speed * walk.schedule.tick * (1.0 + 1e-9), "{}", range.name);
            assert!(*to >= range.limits.0 - 1e-9 && *to <= range.limits.1 + 1e-9, "{}", range.name);
        }
    }
    assert!(walk.balances.iter().all(|balance| balance.margin >= walk.request.margin));
}

#[test]
fn the_next_step_obeys_goal_furniture_and_figures() {
    let watch = Watch::none();
    let mut run = run("rh0", (0.6, 1.2), (3.0, 1.2));
    for _ in 0..3 {
        assert!(matches!(run.step(&watch).unwrap(), Next::Step(samples) if !samples.is_empty()));
    }
    assert!((middle(run.walk()).y - 1.2).abs() < 1e-9 && longest(run.walk(), 0) > 0.1);
    // A box on the path.
    let room = run.room().clone().with_moved("box", Point2::new(2.0, 1.2), 0.3).unwrap();
    run.refurnish(room, &watch).unwrap();
    assert!(run.course().as_ref().unwrap().path.length() > 3.0 - middle(run.walk()).x + 0.02);
    // Steps of half the length.
    let (samples, steps) = (run.set("Lp", 0.07, &watch).unwrap(), run.walk().schedule.route.steps.len());
    assert!(samples.end == run.walk().references.len() && run.pilot().reach().ahead <= 0.07);
    for _ in 0..4 {
        run.step(&watch).unwrap();
    }
    assert!(longest(run.walk(), steps + 1) < 0.08);
    // A lower trunk and a lower foot lift, then another goal.
    let height = |run: &Run| run.walk().motion.postures.last().unwrap().world_from_torso.translation.z;
    let (before, own) = (height(&run), run.figures().values[4]);
    run.set("Hcm", own - 0.015, &watch).unwrap();
    assert!((before - height(&run) - 0.015).abs() < 1e-9);
    run.set("Hp", 0.05, &watch).unwrap();
    run.go_to(goal(0.7, 2.0).into(), &watch).unwrap();
    assert!(arrive(&mut run) > 10);
    let end = middle(run.walk());
    assert!((end.point() - Point2::new(0.7, 2.0)).norm() < 2e-3, "{end:?}");
    is_one_motion(&run);
}

#[test]
fn what_cannot_be_is_refused_and_changes_nothing() {
    let watch = Watch::none();
    let mut run = run("rh0", (0.6, 1.2), (3.0, 1.2));
    run.step(&watch).unwrap();
    let (figures, samples) = (*run.figures(), run.walk().references.len());
    for (name, value, words) in [
        ("Lp", 0.9, "out of reach"),
        ("Hcm", 0.9, "out of reach"),
        ("Gcm", 170.0, ""),
        ("Ca", 8.0, "outside the border"),
        ("RAas", -0.1, "give a positive number"),
        ("Hp", f64::NAN, "give a positive number"),
        ("hp", 0.1, "did you mean"),
    ] {
        let error = run.set(name, value, &watch).unwrap_err();
        assert!(error.message().contains(words), "{name} {value}: {error}");
        // A page has no options.
        let shown = with_fields(error.message());
        assert!(
            !shown.contains("--") && (name != "Lp" || shown.contains("(Hcm) or shorten the steps (Lp)")),
            "{shown}"
        );
        assert!(*run.figures() == figures && run.walk().references.len() == samples);
    }
    let on_it = run.room().clone().with_moved("box", middle(run.walk()).point(), 0.0).unwrap();
    assert!(run.refurnish(on_it, &watch).unwrap_err().message().contains("would overlap the robot"));
    let error = run.go_to(goal(3.6, 0.4).into(), &watch).unwrap_err();
    assert!(error.kind() == ErrorKind::BadValue && error.message().contains("the nearest free place is"), "{error}");
    assert!(run.room().pieces[0].place == Point2::new(3.6, 0.4) && arrive(&mut run) > 10);
}

/// If it is enclosed, the robot stops and reports the reason; when the wall is removed, it continues.
#[test]
fn a_run_that_is_walled_in_waits_until_it_is_not() {
    let watch = Watch::none();
    let mut run = run("rh0", (0.6, 1.2), (2.8, 1.2));
    let mut room = run.room().clone();
    room.pieces[0].outline = groebot_humanoid::nav::Shape::rectangle(Point2::origin(), 0.2, 2.6, 0.0);
    let walled = room.clone().with_moved("box", Point2::new(1.9, 1.3), 0.0).unwrap();
    run.refurnish(walled, &watch).unwrap();
    assert!(run.course().is_err());
    assert!(run.step(&watch).unwrap_err().message().contains("there is no path"));
    run.refurnish(room.without("box").unwrap(), &watch).unwrap();
    assert!(arrive(&mut run) > 10);
}

/// The parameters in the thesis' sections are those of RH0's gait of the simulations. Setting NAO's and TEO's own parameters changes nothing.
#[test]
fn figures_have_their_units() {
    let rh0 = walkers::walker("rh0", Outline::Measured).unwrap().unwrap();
    let thesis = Figures::of(&rh0.biped, &RH0_SIMULATION, RH0_SIMULATION.hip_heights[0]);
    let (own, thesis) = (thesis.values, PRESETS[0].figures.values);
    for ((figure, own), thesis) in FIGURES.iter().zip(own).zip(thesis) {
        // The height is the first feasible one; the cadence is 1 / (81 * 0.036 s).
        let most = if figure.name == "Hcm" { 0.0031 } else { 1e-4 };
        assert!(own.is_nan() || (own - thesis).abs() <= most, "{figure:?}: {own} {thesis}");
    }
    for robot in ["nao", "teo"] {
        let mut run = run(robot, (0.8, 1.2), (1.4, 1.3));
        let defaults =
            run.pilot().walker().gaits.iter().find(|(_, defaults)| defaults.gait.is_one_step()).unwrap().1.clone();
        let put = run.figures().put(&run.pilot().walker().biped, &defaults);
        assert!((put.period - defaults.period).abs() < 1e-12 && (put.amplitude - defaults.amplitude).abs() < 1e-12);
        assert!((put.most_turn - defaults.most_turn).abs() < TAU * 1e-12);
        assert!(defaults.hip_heights.iter().any(|height| (put.hip_heights[0] - height).abs() < 1e-12));
        assert!(arrive(&mut run) > 3);
        is_one_motion(&run);
    }
}
