//! The full task of RH0 5.5: from the start of Fig. 5-25, with furniture that was moved, and out of the near-encirclement of Fig. 5-27.

use groebot_humanoid::Watch;
use groebot_humanoid::gait::Footprint;
use groebot_humanoid::nav::Room;
use groebot_humanoid::sim::{Change, Checks, Destination, Performed, Run, Start, What, perform, room};
use groebot_humanoid::task::Blocked;
use groebot_robot::model::Meshes;
use groebot_robot::robots;
use nalgebra::Point2;

use super::{APART, goal};

pub fn known(name: &str) -> Room {
    Room::from_toml(room(name).unwrap()).unwrap()
}

pub fn start_of(room: &Room) -> Footprint {
    let [x, y, yaw] = room.start.unwrap();
    Footprint { x, y, yaw }
}

/// RH0's run with the parameters of the thesis' simulations.
fn thesis_run(room: &Room, goal: Destination) -> Run {
    let mut start = Start::of_robot("rh0", room.clone(), start_of(room), goal, APART).unwrap();
    start.walker.gaits.sort_by_key(|(name, _)| *name != "rh0-sim");
    Run::new(start, &Watch::none()).unwrap()
}

fn does(room: &Room, goal: Destination, changes: &[Change]) -> Result<(Performed, Checks), Blocked> {
    let watch = Watch::none();
    let run = thesis_run(room, goal);
    let biped = run.pilot().walker().biped.clone();
    let performed = perform(run, changes, &watch).unwrap()?;
    let robot = robots::robot("rh0").unwrap();
    let checks = Checks::of(&robot, &Meshes::default(), &biped, &performed, &watch).unwrap();
    Ok((performed, checks))
}

fn moved(name: &str, x: f64, y: f64, after: usize) -> Change {
    Change { after, what: What::Furniture(name.to_owned(), Some(Footprint { x, y, yaw: 0.0 })) }
}

/// All checks succeed, and the figures are those that the thesis requires.
fn is_done(checks: &Checks) {
    assert!(checks.hold(), "{:?} {:?}", checks.clearances.first(), checks.findings);
    assert!(
        checks.clearances[0].distance > 0.0
            && checks.margin > 0.0
            && checks.fastest.1 < 25.0 * std::f64::consts::TAU / 60.0
    );
    assert!(checks.samples_per_step.0 == 81, "{:?}", checks.samples_per_step);
}

/// In front of the sofa, facing it.
#[test]
fn rh0_gets_to_the_sofa_past_a_piano_that_was_moved() {
    let room = known("living-room").with_moved("piano", Point2::new(2.6, 2.6), 0.4).unwrap();
    let (performed, checks) = does(&room, Destination::Before("sofa".to_owned()), &[]).unwrap();
    is_done(&checks);
    let [left, right] = performed.walk.schedule.route.end();
    let at = left.middle(&right);
    // The sofa, 2 m by 0.9 m about (4, 0.7), is half a metre in front.
    let ahead = at.point() + at.ahead() * 0.5;
    let inside = |at: Point2<f64>| (at.x - 4.0).abs() < 1.0 && (at.y - 0.7).abs() < 0.45;
    assert!(inside(ahead) && !inside(at.point()), "{at:?}");
    assert!(performed.stages.len() == 1 && performed.stages[0].course.path.points.len() > 2);
}

/// Furniture and goal change during the walk. The path is computed anew from the robot's position, and earlier obstacles no longer count.
#[test]
fn changes_during_the_walk_take_effect() {
    let room = known("living-room");
    let changes = [
        moved("chair", 3.1, 2.7, 6),
        Change { after: 12, what: What::Goal(Destination::Before("lamp".to_owned())) },
        Change { after: 12, what: What::Furniture("planetary ball".to_owned(), None) },
    ];
    let (performed, checks) = does(&room, goal(7.2, 3.4).into(), &changes).unwrap();
    is_done(&checks);
    let stages = &performed.stages;
    assert_eq!(stages.iter().map(|stage| stage.steps).collect::<Vec<_>>(), [0, 6, 12]);
    assert!(stages[1].room.piece("chair").unwrap().place == Point2::new(3.1, 2.7));
    assert!(stages[2].room.piece("planetary ball").is_err() && stages[1].room.piece("planetary ball").is_ok());
    // The next path begins where the robot rests.
    for stage in &stages[1..] {
        let rest = performed.walk.schedule.route.rests[stage.steps];
        assert!((stage.course.path.points[0] - rest.point()).norm() < 1e-9);
    }
    let [left, right] = performed.walk.schedule.route.end();
    let lamp = room.piece("lamp").unwrap().place;
    assert!((left.middle(&right).point() - lamp).norm() < 1.0);
    // An object that was removed is checked only while it was present; the chair is checked at both positions.
    let ball = checks.clearances.iter().find(|own| own.thing.to_string() == "planetary ball").unwrap();
    assert!(ball.sample <= stages[2].first && checks.clearances.iter().any(|own| own.thing.to_string() == "chair"));
    let record = performed.record();
    assert!(record.stages[2].pieces.len() + 1 == record.scene.pieces.len() && record.stages[1].from > 0.0);
}

#[test]
fn rh0_leaves_a_near_enclosure_and_a_full_one_is_reported() {
    let room = known("encirclement");
    // After the fourth step the gap is closed.
    let closed = [moved("chair", 1.6, 3.0, 4), moved("planetary ball", 1.6, 3.5, 4)];
    let blocked = does(&room, goal(7.0, 3.0).into(), &closed).unwrap_err();
    let [inside, outside] = [Point2::new(3.0, 3.0), Point2::new(7.0, 3.0)];
    let [inside, outside] = [inside, outside].map(|at| blocked.map.cell_at(&at).unwrap());
    assert!(blocked.enclosure.parts(&blocked.map, inside, outside));
    let (performed, checks) = does(&room, goal(7.0, 3.0).into(), &[]).unwrap();
    is_done(&checks);
    assert!(performed.stages[0].course.path.length() > 8.0);
}
