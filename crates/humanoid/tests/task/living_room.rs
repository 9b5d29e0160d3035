//! The furnished room of RH0 5.4: global (Fig. 5-25, 5-26), nearly enclosed (5-27), local (5-29), and completely enclosed.

use std::fs::read_to_string;
use std::path::Path;

use groebot_humanoid::Watch;
use groebot_humanoid::gait::Footprint;
use groebot_humanoid::nav::{Field, Forces, Method, Potential, Room, Window};
use groebot_humanoid::task::{self, Floor, Plan};
use nalgebra::Point2;

use super::{APART, arrives, goal, is_walked, keeps_away, pilot};

fn living_room() -> Room {
    let file = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("examples/living_room.toml");
    Room::from_toml(&read_to_string(file).unwrap()).unwrap()
}

/// Fig. 5-27: the furniture is around the robot with one gap, on the side away from the goal.
fn encirclement() -> Room {
    let places = [
        ("sofa", 3.0, 1.6),
        ("billiard table", 3.0, 4.25),
        ("piano", 4.8, 2.85),
        ("armchair", 1.45, 2.3),
        ("chair", 1.6, 3.75),
        ("lamp", 7.0, 5.3),
        ("planetary ball", 6.6, 1.2),
    ];
    places.iter().fold(living_room(), |room, (name, x, y)| room.with_moved(name, Point2::new(*x, *y), 0.0).unwrap())
}

const INSIDE: Footprint = Footprint { x: 3.0, y: 3.0, yaw: 0.0 };

#[test]
fn rh0_crosses_the_living_room() {
    let (robot, pilot) = pilot("rh0");
    let map = living_room().map().unwrap();
    let goal = goal(7.2, 3.4, Some(0.0));
    let start = Footprint { x: 1.0, y: 2.6, yaw: 0.0 };
    let found = super::plan(&pilot, &map, start, goal, task::Method::M3r);
    arrives(&pilot, &found.walk, &goal);
    is_walked(&pilot, &found.walk);
    keeps_away(&robot, &pilot, &found.walk, &map, 0..found.walk.references.len());
}

#[test]
fn rh0_leaves_what_nearly_encloses_it() {
    let (robot, pilot) = pilot("rh0");
    let map = encirclement().map().unwrap();
    let goal = goal(7.0, 3.0, None);
    // The descent of a potential field ends inside: its force points to the piano.
    let grown = map.grown(pilot.radius()).unwrap();
    let potential = Potential::new(&grown, &goal.place, &Forces::default()).unwrap();
    let stuck = potential.descend(&grown, &INSIDE.point()).unwrap().unwrap_err();
    assert!((stuck.place - INSIDE.point()).norm() < 1.2, "{stuck}");
    let found = super::plan(&pilot, &map, INSIDE, goal, task::Method::Exact);
    // The path leaves on the left and goes around.
    let leftmost = found.course.path.points.iter().map(|point| point.x).fold(f64::INFINITY, f64::min);
    assert!(found.course.is_wide && leftmost < 1.35 && found.course.path.length() > 8.0);
    arrives(&pilot, &found.walk, &goal);
    is_walked(&pilot, &found.walk);
    keeps_away(&robot, &pilot, &found.walk, &map, 0..found.walk.references.len());
}

#[test]
fn an_enclosure_of_rh0_by_furniture_is_reported() {
    let (_, pilot) = pilot("rh0");
    let room = encirclement().with_moved("chair", Point2::new(1.6, 3.0), 0.0).unwrap();
    let map = room.with_moved("planetary ball", Point2::new(1.6, 3.5), 0.0).unwrap().map().unwrap();
    let floor = Floor::new(&map, APART).unwrap();
    let feet = INSIDE.feet(pilot.half_width());
    let goal = goal(7.0, 3.0, None);
    let blocked = Plan::find(&pilot, &floor, feet, goal, &Watch::none()).unwrap().unwrap_err();
    let [inside, outside] = [INSIDE.point(), goal.place].map(|at| blocked.map.cell_at(&at).unwrap());
    assert!(blocked.enclosure.parts(&blocked.map, inside, outside));
}

/// Fig. 5-29: nearby obstacles change, and the field is updated incrementally, or only in a window.
#[test]
fn a_field_follows_a_chair_that_is_moved() {
    let (_, pilot) = pilot("rh0");
    let watch = Watch::none();
    let grown = |room: Room| room.map().unwrap().grown(pilot.radius()).unwrap();
    let (before, after) =
        (grown(living_room()), grown(living_room().with_moved("chair", Point2::new(2.2, 3.0), 0.0).unwrap()));
    let goals = [Point2::new(7.2, 3.4)];
    for method in [Method::M3r, Method::FastMarching(1)] {
        let field = Field::new(&before, &goals, method, &watch).unwrap();
        let again = field.clone().after(&after, &watch).unwrap();
        let anew = Field::new(&after, &goals, method, &watch).unwrap();
        let off = |(a, b): (&f64, &f64)| if a == b { 0.0 } else { (a - b).abs() };
        assert!(again.field.times().iter().zip(anew.times()).map(off).all(|off| off < 1e-9));
        assert!(again.marched < anew.times().iter().filter(|time| time.is_finite()).count());
        // In a window around the robot the descent leads around the chair.
        let window = Window { columns: 20..75, rows: 30..85 };
        let local = field.within(&after, &window, &watch).unwrap();
        let path = local.descend(&after, &Point2::new(1.3, 2.8)).unwrap().unwrap();
        assert!(path.points.iter().all(|point| after.is_free(after.cell_at(point).unwrap())));
        assert!((path.points[path.points.len() - 1] - goals[0]).norm() < 0.06);
    }
}
