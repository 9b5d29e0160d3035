//! Distances of links from furniture, compared with those of points along the axes of their capsules.

use groebot_humanoid::Watch;
use groebot_humanoid::nav::Room;
use groebot_humanoid::sim::{Destination, Links, Next, Thing};
use groebot_robot::model::{Meshes, Solid};
use groebot_robot::robots;
use nalgebra::{Point2, Point3};

use super::full_task::start_of;
use super::{goal, run_in};

/// An L-shaped piece, a rotated box, and a low one.
const ROOM: &str = r#"
size = [4.0, 3.0]
wall = 0.05
start = [0.6, 0.6]
[[furniture]]
name = "corner"
polygon = [[0, 0], [1, 0], [1, 0.2], [0.2, 0.2], [0.2, 1], [0, 1]]
at = [1.2, 1.3]
height = 0.5
[[furniture]]
name = "box"
box = [0.4, 0.3]
at = [2.2, 0.5, 30]
height = 0.3
[[furniture]]
name = "step"
circle = 0.15
at = [3.3, 2.5]
height = 0.02
"#;

/// The distance of a point from a prism over a polygon, computed side by side.
fn from_prism(point: &Point3<f64>, corners: &[Point2<f64>], height: f64) -> f64 {
    let at = point.xy();
    let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
    let crosses = |(a, b): &(&Point2<f64>, &Point2<f64>)| {
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    let to_side = |(a, b): (&Point2<f64>, &Point2<f64>)| {
        let share = ((at - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
        (at - (a + (b - a) * share)).norm()
    };
    let is_over = sides().filter(crosses).count() % 2 == 1;
    let aside = if is_over { 0.0 } else { sides().map(to_side).fold(f64::INFINITY, f64::min) };
    aside.hypot((point.z - height).max(-point.z).max(0.0))
}

#[test]
fn distances_are_those_of_points_along_capsules() {
    let watch = Watch::none();
    let room = Room::from_toml(ROOM).unwrap();
    let mut run = run_in(&room, "rh0", start_of(&room), Destination::Place(goal(2.6, 1.4))).unwrap();
    for _ in 0..4 {
        assert!(matches!(run.step(&watch).unwrap(), Next::Step(_)));
    }
    let robot = robots::robot("rh0").unwrap();
    let biped = &run.pilot().walker().biped;
    let postures: Vec<_> = run.walk().motion.postures.iter().step_by(20).cloned().collect();
    let links = Links::of(&robot, biped, &Meshes::default()).unwrap();
    let found = links.clearances(biped, &postures, 100, &room, &watch).unwrap();
    let mut compared = 0;
    for own in &found {
        let link = robot.link(&own.link).unwrap();
        let shapes = &robot.links()[link].collisions;
        let capsules: Option<Vec<_>> = shapes
            .iter()
            .map(|shape| match shape.solid {
                Solid::Capsule { radius, length } => Some((shape.pose(), length, radius)),
                Solid::Sphere { radius } => Some((shape.pose(), 0.0, radius)),
                _ => None,
            })
            .collect();
        let piece = room.pieces.iter().find(|piece| Thing::Furniture(piece.name.clone()) == own.thing);
        let (Some(capsules), Some(piece)) = (capsules, piece) else { continue };
        let groebot_humanoid::nav::Shape::Polygon(corners) = piece.shape() else { continue };
        let (mut least, mut at) = (f64::INFINITY, 0);
        for (sample, posture) in postures.iter().enumerate() {
            let placed = biped.model.place(&posture.world_from_torso, &posture.q).unwrap();
            for (pose, length, radius) in &capsules {
                for place in 0..=400 {
                    let along = Point3::new(0.0, 0.0, length * (f64::from(place) / 400.0 - 0.5));
                    let point = placed.world_from_link(link) * pose * along;
                    let distance = from_prism(&point, &corners, piece.height) - radius;
                    if distance < least {
                        (least, at) = (distance, 100 + sample);
                    }
                }
            }
        }
        // Each axis point is at most 1 mm from the nearest sample point, so that the sampled distances are too great by at most a few micrometres. The error of
        // parry3d is 1e-7.
        assert!(own.distance <= least + 1e-7 && own.distance >= least - 2e-5, "{own:?} {least}");
        assert!(own.sample == at || (own.distance - least).abs() < 2e-5, "{own:?} {at}");
        compared += 1;
    }
    // Five links are capsules, and two pieces have corners.
    assert!(compared >= 10, "{compared}");
    // The result includes walls, and the floor without the feet.
    assert!(found.iter().any(|own| own.thing == Thing::Wall));
    let floor: Vec<_> = found.iter().filter(|own| own.thing == Thing::Floor).collect();
    assert!(floor.len() >= 5 && floor.iter().all(|own| own.distance > 0.02), "{floor:?}");
}

/// Where a link is inside furniture the distance is zero, and no check succeeds.
#[test]
fn what_meets_is_at_no_distance() {
    let watch = Watch::none();
    let room = Room::from_toml(ROOM).unwrap();
    let run = run_in(&room, "rh0", start_of(&room), Destination::Place(goal(2.6, 1.4))).unwrap();
    let robot = robots::robot("rh0").unwrap();
    let biped = &run.pilot().walker().biped;
    let posture = run.walk().motion.postures.last().unwrap().clone();
    let on_it = room.with_moved("box", Point2::new(0.6, 0.6), 0.0).unwrap();
    let links = Links::of(&robot, biped, &Meshes::default()).unwrap();
    let found = links.clearances(biped, &[posture], 7, &on_it, &watch).unwrap();
    assert!(found[0].distance == 0.0 && found[0].thing.to_string() == "box" && found[0].sample == 7);
    // The box is 0.3 m high: the arms are above it.
    assert!(found.iter().any(|own| own.thing.to_string() == "box" && own.distance > 0.1));
}
