//! Goals and obstacles that change during the walk, RH0 5.4.3.

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Footprint, Walk};
use groebot_humanoid::nav::Shape;
use groebot_humanoid::task::{Course, Floor, Journey, Method, Pilot};
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
    let course = Course::find(&pilot, &floors[0], &journey.middle(), first, &watch).unwrap().unwrap();
    for _ in 0..3 {
        assert!(journey.step(&floors[0], &course, &watch).unwrap());
    }
    let changed = journey.walk().references.len();
    // Until then straight forward.
    assert!((journey.middle().y - 1.0).abs() < 1e-9 && journey.middle().x > start.x + 1.5 * pilot.reach().ahead);
    journey.turn_to_new_course();
    let course = Course::find(&pilot, &floors[1], &journey.middle(), first.by(Method::M3r), &watch).unwrap().unwrap();
    for _ in 0..6 {
        let before = journey.middle();
        assert!(journey.step(&floors[1], &course, &watch).unwrap());
        // It never returns to the start of the course.
        assert!(journey.middle().x > before.x - 0.02);
    }
    journey.turn_to_new_course();
    let course = Course::find(&pilot, &floors[1], &journey.middle(), last, &watch).unwrap().unwrap();
    while journey.step(&floors[1], &course, &watch).unwrap() {}
    let walk = journey.finish(&watch).unwrap();
    arrives(&pilot, &walk, &last);
    is_walked(&pilot, &walk);
    keeps_away(&robot, &pilot, &walk, &before, 0..changed);
    keeps_away(&robot, &pilot, &walk, &after, changed - 1..walk.references.len());
}

/// Shorter and lower steps with a lower trunk, from the fourth step on.
#[test]
fn the_next_step_obeys_other_figures_of_the_gait() {
    let (robot, own) = pilot("rh0");
    let watch = Watch::none();
    let map = room("size = [3.0, 2.0]\nwall = 0.05\n");
    let floor = Floor::new(&map, APART).unwrap();
    let end = goal(1.9, 1.0, None);
    let start = Footprint { x: 0.6, y: 1.0, yaw: 0.0 };
    let mut defaults = own.walker().gaits.iter().find(|(_, defaults)| defaults.gait.is_one_step()).unwrap().1.clone();
    let height = own.reach().hip_height - 0.02;
    (defaults.length, defaults.lift, defaults.hip_heights) = (0.06, 0.05, vec![height].into());
    let walker = own.walker().clone();
    let body = own.body().clone();
    let other = Pilot::new(walker, defaults, body, own.is_upright(), &watch).unwrap();
    let mut journey = Journey::new(&own, &floor, start.feet(own.half_width()), &watch).unwrap();
    let course = Course::find(&own, &floor, &journey.middle(), end, &watch).unwrap().unwrap();
    for _ in 0..3 {
        assert!(journey.step(&floor, &course, &watch).unwrap());
    }
    let changed = journey.walk().references.len();
    let torso = |walk: &Walk, sample: usize| walk.motion.postures[sample].world_from_torso.translation.z;
    let before = torso(journey.walk(), changed - 1);
    journey.walk_as(other.clone(), &watch).unwrap();
    let lowered = journey.walk().references.len() - 1;
    assert!((before - torso(journey.walk(), lowered) - 0.02).abs() < 1e-9);
    let course = Course::find(&other, &floor, &journey.middle(), end, &watch).unwrap().unwrap();
    while journey.step(&floor, &course, &watch).unwrap() {}
    let walk = journey.finish(&watch).unwrap();
    arrives(&other, &walk, &end);
    is_walked(&own, &walk);
    keeps_away(&robot, &own, &walk, &map, 0..walk.references.len());
    let highest = |from: usize, to: usize| {
        let soles = walk.references[from..to].iter().flat_map(|reference| reference.world_from_soles);
        soles.map(|pose| pose.translation.z).fold(0.0, f64::max)
    };
    assert!(highest(0, changed) > 0.09 && highest(changed, walk.references.len()) < 0.06);
    let (_, nao) = pilot("nao");
    let mut journey = Journey::new(&own, &floor, start.feet(own.half_width()), &watch).unwrap();
    assert!(journey.walk_as(nao, &watch).unwrap_err().message().contains("cannot continue it"));
}
