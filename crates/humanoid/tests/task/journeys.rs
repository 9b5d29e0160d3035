//! Walks around obstacles, by known robots with all methods, and through a passage in which they cannot turn.

use groebot_humanoid::Watch;
use groebot_humanoid::gait::Footprint;
use groebot_humanoid::nav::Path;
use groebot_humanoid::task::{Course, Floor, Journey, Method};
use nalgebra::Point2;

use super::{APART, ROOM, arrives, goal, is_walked, keeps_away, pilot, plan, room};

#[test]
fn rh0_walks_around_a_wall() {
    let (robot, pilot) = pilot("rh0");
    let map = room(ROOM);
    let goal = goal(2.9, 0.7, Some(std::f64::consts::FRAC_PI_2));
    let mut lengths = Vec::new();
    for method in [Method::Exact, Method::FastMarching, Method::M3r] {
        let found = plan(&pilot, &map, Footprint { x: 0.6, y: 0.7, yaw: 0.3 }, goal, method);
        assert!(found.course.is_wide);
        arrives(&pilot, &found.walk, &goal);
        is_walked(&pilot, &found.walk);
        keeps_away(&robot, &pilot, &found.walk, &map, 0..found.walk.references.len());
        lengths.push(found.course.path.length());
        // At least the path length divided by the step length; turns on the spot need some more.
        let least = (lengths[lengths.len() - 1] / pilot.reach().ahead) as usize;
        let steps = found.walk.schedule.route.steps.len();
        assert!(steps >= least && steps < 2 * least + 30, "{steps} {least}");
        let sides: Vec<_> = found.walk.schedule.route.steps.iter().map(|step| step.side).collect();
        assert!(sides.windows(2).filter(|pair| pair[0] == pair[1]).count() <= 1);
    }
    assert!(lengths[1..].iter().all(|length| *length >= lengths[0] - 1e-9), "{lengths:?}");
}

#[test]
fn other_robots_walk_there_too() {
    for (name, start, end) in [("nao", (0.9, 0.5), (0.9, 1.0)), ("teo", (0.7, 0.6), (1.1, 2.0))] {
        let (robot, pilot) = pilot(name);
        let map = room(ROOM);
        let goal = goal(end.0, end.1, None);
        let found = plan(&pilot, &map, Footprint { x: start.0, y: start.1, yaw: 1.2 }, goal, Method::Exact);
        arrives(&pilot, &found.walk, &goal);
        is_walked(&pilot, &found.walk);
        keeps_away(&robot, &pilot, &found.walk, &map, 0..found.walk.references.len());
    }
}

/// The passage is wide enough to walk through, but not to turn in it.
#[test]
fn rh0_walks_through_a_passage_in_which_it_cannot_turn() {
    let (robot, pilot) = pilot("rh0");
    let text = r#"
size = [2.6, 1.6]
wall = 0.05
[[furniture]]
name = "right"
box = [0.5, 0.7]
at = [1.35, 0.2]
[[furniture]]
name = "left"
box = [0.5, 0.7]
at = [1.35, 1.4]
"#;
    let map = room(text);
    let goal = goal(2.15, 0.8, None);
    let found = plan(&pilot, &map, Footprint { x: 0.5, y: 0.8, yaw: 0.2 }, goal, Method::Exact);
    assert!(!found.course.is_wide);
    arrives(&pilot, &found.walk, &goal);
    is_walked(&pilot, &found.walk);
    keeps_away(&robot, &pilot, &found.walk, &map, 0..found.walk.references.len());
}

/// A course made by hand leads along a box, with room for soles but not for the body. The robot keeps its distance from the box. Where it cannot continue, the
/// error has the reason.
#[test]
fn a_body_keeps_away_where_its_course_does_not() {
    let (robot, pilot) = pilot("rh0");
    let map =
        room("size = [3.0, 2.2]\nwall = 0.05\n[[furniture]]\nname = \"box\"\nbox = [1.2, 0.6]\nat = [1.5, 0.5]\n");
    let (floor, watch) = (Floor::new(&map, APART).unwrap(), Watch::none());
    let goal = goal(2.5, 1.0, None);
    let start = Footprint { x: 0.5, y: 1.0, yaw: 0.0 };
    let soles = |y: f64| map.is_free(map.cell_at(&Point2::new(1.5, y - pilot.half_width() - 0.06)).unwrap());
    assert!(soles(1.0));
    let course = Course { goal, path: Path { points: vec![start.point(), goal.place] }, is_wide: true };
    let mut journey = Journey::new(&pilot, &floor, start.feet(pilot.half_width()), &watch).unwrap();
    let end = loop {
        match journey.step(&floor, &course, &watch) {
            Ok(true) => {}
            end => break end,
        }
    };
    if let Err(error) = end {
        assert!(
            error.message().contains("was found from (") || error.message().contains("is feasible from ("),
            "{error}"
        );
    }
    let walk = journey.walk();
    is_walked(&pilot, walk);
    keeps_away(&robot, &pilot, walk, &map, 0..walk.references.len());
    // It passed the near side of the box.
    assert!(walk.schedule.route.rests.iter().any(|rest| rest.x > 1.2 && rest.y > 1.02));
}
