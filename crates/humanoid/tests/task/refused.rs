//! Goals without a path, and invalid input.

use groebot_humanoid::gait::Footprint;
use groebot_humanoid::nav::Map;
use groebot_humanoid::task::{Body, Floor, Method, Pilot, Plan};
use groebot_humanoid::{ErrorKind, Watch};
use nalgebra::Point2;

use super::{APART, ROOM, goal, pilot, room};

#[test]
fn the_enclosure_of_a_robot_is_reported() {
    let (_, pilot) = pilot("rh0");
    // The gap beside the wall is narrower than the robot's core.
    let map = room(&ROOM.replace("box = [0.1, 1.5]", "box = [0.1, 2.4]").replace("at = [1.6, 0.8]", "at = [1.6, 1.2]"));
    assert!(map.is_free(map.cell_at(&Point2::new(1.6, 2.5)).unwrap()));
    let floor = Floor::new(&map, APART).unwrap();
    let start = Footprint { x: 0.6, y: 0.7, yaw: 0.0 };
    for method in [Method::Exact, Method::FastMarching, Method::M3r] {
        let goal = goal(2.9, 0.7, None);
        let found =
            Plan::find(&pilot, &floor, start.feet(pilot.half_width()), goal.by(method), &Watch::none()).unwrap();
        let blocked = found.unwrap_err();
        let ends = [start.point(), goal.place].map(|place| blocked.map.cell_at(&place).unwrap());
        let [inside, outside] = if blocked.enclosure.cells.contains(&ends[0]) { ends } else { [ends[1], ends[0]] };
        assert!(blocked.enclosure.parts(&blocked.map, inside, outside));
        assert!(blocked.to_string().starts_with("there is no path: "), "{blocked}");
        // Its cells are the possible positions of the core's middle: all others are nearer to an obstacle.
        let clearances = map.clearances();
        let half_cell = map.resolution() * std::f64::consts::FRAC_1_SQRT_2;
        let holds = |cell: usize| clearances[cell] >= pilot.core() + APART - half_cell;
        assert!((0..map.cells().len()).all(|cell| !blocked.map.is_free(cell) || holds(cell)));
    }
}

#[test]
fn bad_input_is_refused() {
    let (_, pilot) = pilot("rh0");
    let map = room(ROOM);
    let floor = Floor::new(&map, APART).unwrap();
    let find = |start: Footprint, x: f64, y: f64, method| {
        let feet = start.feet(pilot.half_width());
        Plan::find(&pilot, &floor, feet, goal(x, y, None).by(method), &Watch::none()).unwrap_err()
    };
    let start = Footprint { x: 0.6, y: 0.7, yaw: 0.0 };
    for (error, words) in [
        (find(start, 1.6, 0.7, Method::Exact), "the nearest free place is ("),
        (find(start, 9.0, 0.7, Method::Exact), "not on the map"),
        (find(Footprint { x: 1.6, ..start }, 2.9, 0.7, Method::Exact), "the nearest free place is ("),
        (find(start, 2.9, 0.7, Method::Potential), "the potential field has a local minimum at ("),
    ] {
        assert!(error.kind() == ErrorKind::BadValue && error.message().contains(words), "{error}");
    }
    let nowhere =
        Plan::find(&pilot, &floor, start.feet(pilot.half_width()), goal(2.9, 0.7, Some(f64::NAN)), &Watch::none());
    assert!(nowhere.unwrap_err().message().contains("the heading at the goal is not finite"));
    assert!(Floor::new(&map, -1.0).is_err() && Floor::new(&map, f64::NAN).is_err());
    for (length, width) in [(0.0, 1.0), (1.0, f64::NAN)] {
        assert!(Body::of_size(length, width).is_err());
    }
    let walker =
        groebot_humanoid::walkers::walker("nao", groebot_humanoid::walkers::Outline::Measured).unwrap().unwrap();
    let preview = walker.gaits.iter().find(|(name, _)| *name == "preview").unwrap().1.clone();
    let body = Body::of_size(0.2, 0.3).unwrap();
    let error = Pilot::new(walker, preview, body, true, &Watch::none()).unwrap_err();
    assert!(error.kind() == ErrorKind::Unsupported && error.message().contains("one step goal"), "{error}");
}

/// For a body wider than every passage no path exists, which is reported. On a floor without walls it does not leave the map.
#[test]
fn a_body_wider_than_every_passage_has_no_path() {
    let walker =
        groebot_humanoid::walkers::walker("rh0", groebot_humanoid::walkers::Outline::Measured).unwrap().unwrap();
    let defaults = walker.gaits[0].1.clone();
    let wide = Body::of_size(1.0, 1.1).unwrap();
    let pilot = Pilot::new(walker, defaults, wide, false, &Watch::none()).unwrap();
    let floor = Floor::new(&room(ROOM), APART).unwrap();
    let start = Footprint { x: 0.75, y: 1.2, yaw: 0.0 };
    let feet = start.feet(pilot.half_width());
    let found = Plan::find(&pilot, &floor, feet, goal(2.7, 1.2, None), &Watch::none()).unwrap();
    assert!(found.is_err());
    let bare = Floor::new(&Map::new(40, 40, 0.05).unwrap(), 0.0).unwrap();
    let feet = Footprint { x: 0.3, y: 1.0, yaw: 0.0 }.feet(pilot.half_width());
    let error = Plan::find(&pilot, &bare, feet, goal(1.0, 1.0, None), &Watch::none()).unwrap_err();
    assert!(error.kind() == ErrorKind::BadValue && error.message().contains("nearest free place"), "{error}");
}
