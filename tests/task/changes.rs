//! Goal and obstacles that change on the way, RH0 5.4.3.

use groebot::Watch;
use groebot::gait::Footprint;
use groebot::nav::Shape;
use groebot::task::{Course, Floor, Journey, Method};
use nalgebra::Point2;

use super::{APART, arrives, goal, is_walked, keeps_away, pilot, room};

#[test]
fn the_next_step_obeys_a_new_obstacle_and_a_new_goal() {
    let (robot, pilot) = pilot("rh0");
    let watch = Watch::none();
    let before = room("size = [3.2, 2.4]\nwall = 0.05\n");
    let ahead = Shape::rectangle(Point2::new(1.8, 1.0), 0.3, 0.9, 0.0);
    let after = before.with(&[ahead]).unwrap();
    let floors = [&before, &after].map(|map| Floor::new(map, APART).unwrap());
    let (first, last) = (goal(2.6, 1.0, None), goal(2.6, 1.8, None));
    let start = Footprint { x: 0.5, y: 1.0, yaw: 0.0 };
    let mut journey = Journey::new(&pilot, &floors[0], start.feet(pilot.half_width()), &watch).unwrap();
    let course = Course::find(&pilot, &floors[0], &journey.middle(), first, Method::Exact, &watch).unwrap().unwrap();
    for _ in 0..3 {
        assert!(journey.step(&floors[0], &course, &watch).unwrap());
    }
    let changed = journey.walk().references.len();
    // Straight ahead until then.
    assert!((journey.middle().y - 1.0).abs() < 1e-9 && journey.middle().x > start.x + 1.5 * pilot.reach().ahead);
    journey.turn_to_new_course();
    let course = Course::find(&pilot, &floors[1], &journey.middle(), first, Method::M3r, &watch).unwrap().unwrap();
    for _ in 0..6 {
        let before = journey.middle();
        assert!(journey.step(&floors[1], &course, &watch).unwrap());
        // It never turns back to where the course begins.
        assert!(journey.middle().x > before.x - 0.02);
    }
    journey.turn_to_new_course();
    let course = Course::find(&pilot, &floors[1], &journey.middle(), last, Method::Exact, &watch).unwrap().unwrap();
    while journey.step(&floors[1], &course, &watch).unwrap() {}
    let walk = journey.finish(&watch).unwrap();
    arrives(&pilot, &walk, &last);
    is_walked(&pilot, &walk);
    keeps_away(&robot, &pilot, &walk, &before, 0..changed);
    keeps_away(&robot, &pilot, &walk, &after, changed - 1..walk.references.len());
}
