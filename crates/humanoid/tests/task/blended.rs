//! The footsteps of a plan without rests between them, by preview control.

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Footprint, GaitDefaults};
use groebot_humanoid::nav::Map;
use groebot_humanoid::task::{Floor, Method, Obstacle, Pilot, Plan, Reason};
use groebot_robot::model::Robot;

use super::{APART, ROOM, arrives, goal, is_walked, keeps_away, pilot, plan, room};

fn preview(pilot: &Pilot) -> GaitDefaults {
    pilot.walker().gaits.iter().find(|(name, _)| *name == "preview").unwrap().1.clone()
}

/// A pilot with steps for preview control, its gait, a room, and a plan around the wall in it.
fn planned(name: &str, text: &str) -> (Robot, Pilot, GaitDefaults, Map, Plan) {
    let (robot, pilot) = pilot(name);
    let gait = preview(&pilot);
    let (pilot, map) = (pilot.for_gait(&gait), room(text));
    assert!(pilot.reach().ahead <= gait.length && pilot.reach().turn <= gait.most_turn);
    let start = Footprint { x: 0.75, y: 0.8, yaw: 0.0 };
    let plan = plan(&pilot, &map, start, goal(2.6, 0.8, Some(0.0)), Method::Exact);
    (robot, pilot, gait, map, plan)
}

#[test]
fn steps_follow_one_another_without_rests() {
    for name in ["nao", "rh0", "teo"] {
        let (robot, pilot, gait, map, plan) = planned(name, ROOM);
        let floor = Floor::new(&map, APART).unwrap();
        let walk = plan.blended(&pilot, &floor, &gait, &Watch::none()).unwrap().unwrap();
        assert_eq!(walk.schedule.route.steps, plan.walk.schedule.route.steps);
        arrives(&pilot, &walk, &plan.course.goal);
        is_walked(&pilot, &walk);
        keeps_away(&robot, &pilot, &walk, &map, 0..walk.references.len());
        let seconds = |walk: &groebot_humanoid::gait::Walk| walk.time(walk.references.len() - 1);
        assert!(seconds(&walk) < 0.6 * seconds(&plan.walk), "{name}: {} {}", seconds(&walk), seconds(&plan.walk));
    }
}

/// The same checks as step by step: where they fail, the reason is returned.
#[test]
fn the_reason_against_a_walk_without_rests_is_returned() {
    let (_, pilot, gait, map, plan) = planned("rh0", ROOM);
    let floor = Floor::new(&map, APART).unwrap();
    let high = GaitDefaults { lift: 0.6, ..gait.clone() };
    let reason = plan.blended(&pilot, &floor, &high, &Watch::none()).unwrap().unwrap_err();
    assert!(matches!(&reason, Reason::Gait(text) if !text.is_empty()) && !reason.to_string().is_empty(), "{reason:?}");
    // A wall moved onto the path.
    let blocked = room(&ROOM.replace("at = [1.6, 0.8]", "at = [1.6, 1.6]"));
    let floor = Floor::new(&blocked, APART).unwrap();
    let reason = plan.blended(&pilot, &floor, &gait, &Watch::none()).unwrap().unwrap_err();
    assert!(matches!(reason, Reason::Obstacle(Obstacle::Body | Obstacle::Sole(_), _)), "{reason:?}");
}
