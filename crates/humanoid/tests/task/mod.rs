//! The whole task: from a map to joint angles. Every walk is verified independently: sample points of soles and bodies against the cells of the original map,
//! soles by forward kinematics, and the balance (ZMP) of the walk as a whole.

mod blended;
mod changes;
mod journeys;
mod living_room;
mod refused;

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Footprint, Side, Walk, balance};
use groebot_humanoid::nav::{Map, Room};
use groebot_humanoid::task::{Body, Floor, Goal, Method, Pilot, Plan};
use groebot_humanoid::walkers::{self, Outline};
use groebot_robot::model::{Meshes, Robot, Solid};
use groebot_robot::robots::{self};
use nalgebra::{Point2, Point3};

/// Two walls between start and goal.
const ROOM: &str = r#"
size = [3.6, 2.6]
wall = 0.05
[[furniture]]
name = "wall"
box = [0.1, 1.5]
at = [1.6, 0.8]
"#;

/// The least distance of bodies from obstacles \[m\].
const APART: f64 = 0.02;

fn room(text: &str) -> Map {
    Room::from_toml(text).unwrap().map().unwrap()
}

fn pilot(name: &str) -> (Robot, Pilot) {
    let robot = robots::robot(name).unwrap();
    let walker = walkers::walker(name, Outline::Measured).unwrap().unwrap();
    let defaults = walker.gaits.iter().find(|(_, defaults)| defaults.gait.is_one_step()).unwrap().1.clone();
    let body = Body::new(&robot, &walker.biped, &Meshes::default()).unwrap();
    (robot, Pilot::new(walker, defaults, body, true, &Watch::none()).unwrap())
}

fn goal(x: f64, y: f64, heading: Option<f64>) -> Goal {
    Goal { place: Point2::new(x, y), heading }
}

fn plan(pilot: &Pilot, map: &Map, start: Footprint, goal: Goal, method: Method) -> Plan {
    let floor = Floor::new(map, APART).unwrap();
    let feet = start.feet(pilot.half_width());
    Plan::find(pilot, &floor, feet, goal.by(method), &Watch::none()).unwrap().unwrap()
}

/// The walk ends with its feet side by side at the goal.
fn arrives(pilot: &Pilot, walk: &Walk, goal: &Goal) {
    let [left, right] = walk.schedule.route.end();
    let middle = left.middle(&right);
    assert!((middle.point() - goal.place).norm() < 2e-3, "{middle:?}");
    if let Some(heading) = goal.heading {
        assert!((middle.yaw - heading).sin().abs() < 1e-5 && (middle.yaw - heading).cos() > 0.0, "{middle:?}");
    }
    assert!(((left.point() - right.point()).norm() - 2.0 * pilot.half_width()).abs() < 1e-9);
    assert!((left.yaw - right.yaw).abs() < 1e-9);
}

/// Joints are within their limits and rates, soles agree with forward kinematics, and the zero moment point of the whole walk is within its margin.
fn is_walked(pilot: &Pilot, walk: &Walk) {
    let biped = &pilot.walker().biped;
    let tick = walk.schedule.tick;
    assert_eq!(walk.references.len(), walk.schedule.samples());
    assert_eq!(walk.motion.postures.len(), walk.schedule.samples());
    for (sample, posture) in walk.motion.postures.iter().enumerate() {
        let before = &walk.motion.postures[sample.saturating_sub(1)].q;
        for ((value, before), range) in posture.q.iter().zip(before).zip(&biped.joints) {
            assert!(range.limits.0 - 1e-9 <= *value && *value <= range.limits.1 + 1e-9, "{} {value}", range.name);
            assert!((value - before).abs() <= range.speed * tick * (1.0 + 1e-9), "{} at {sample}", range.name);
        }
        let placed = biped.model.place(&posture.world_from_torso, &posture.q).unwrap();
        for side in [Side::Left, Side::Right] {
            let foot = &biped.feet[side as usize];
            let sole = placed.motion(foot.body) * foot.torso_from_sole;
            let reference = walk.references[sample].world_from_soles[side as usize];
            assert!((sole.to_homogeneous() - reference.to_homogeneous()).norm() < 1e-6, "{sample}");
        }
    }
    let again = balance(biped, &walk.references, &walk.motion, tick).unwrap();
    let least = again.iter().map(|own| own.margin).fold(f64::INFINITY, f64::min);
    assert!(least >= walk.request.margin - 1e-4, "{least}");
    for pair in walk.schedule.route.rests.windows(2) {
        // A turn also moves the middle of the feet.
        let most = pilot.reach().ahead + pilot.half_width() * pilot.reach().turn;
        assert!((pair[1].point() - pair[0].point()).norm() <= most + 1e-9);
    }
}

/// Sample points of soles and bodies keep their distance from cells that are not free, at every fourth sample of a range.
fn keeps_away(robot: &Robot, pilot: &Pilot, walk: &Walk, map: &Map, samples: std::ops::Range<usize>) {
    let biped = &pilot.walker().biped;
    let soles = [biped.feet[0].body, biped.feet[1].body];
    let capsules: Vec<(usize, [Point3<f64>; 2], f64)> = capsules(robot, pilot, &soles);
    assert!(!capsules.is_empty());
    for sample in samples.step_by(4) {
        let (reference, posture) = (&walk.references[sample], &walk.motion.postures[sample]);
        for side in [Side::Left, Side::Right] {
            let corners = &biped.feet[side as usize].corners;
            let middle =
                corners.iter().fold(Point2::origin(), |sum, corner| sum + corner.coords / corners.len() as f64);
            for (corner, share) in corners.iter().flat_map(|corner| [0.0, 0.5, 0.999].map(|share| (corner, share))) {
                let at = middle + (corner - middle) * share;
                let at = reference.world_from_soles[side as usize] * Point3::new(at.x, at.y, 0.0);
                let cell = map.cell_at(&at.xy()).unwrap();
                assert!(map.is_free(cell), "sample {sample}: the {} sole is at ({}, {})", side.name(), at.x, at.y);
            }
        }
        let placed = biped.model.place(&posture.world_from_torso, &posture.q).unwrap();
        for (body, ends, radius) in &capsules {
            for share in [0.0, 0.5, 1.0] {
                let at = (placed.motion(*body) * (ends[0] + (ends[1] - ends[0]) * share)).xy();
                let away = nearest(map, &at, radius + APART);
                assert!(away >= radius + APART - 1e-9, "sample {sample}: {away} at {at}");
            }
        }
    }
}

fn capsules(robot: &Robot, pilot: &Pilot, soles: &[usize; 2]) -> Vec<(usize, [Point3<f64>; 2], f64)> {
    let biped = &pilot.walker().biped;
    let links = robot.links().iter().enumerate();
    let shapes = links.flat_map(|(link, described)| described.collisions.iter().map(move |shape| (link, shape)));
    let capsule = |(link, shape): (usize, &groebot_robot::model::Shape)| {
        let (body, torso_from_link) = biped.model.link(link);
        let (half, radius) = match shape.solid {
            Solid::Capsule { radius, length } => (length / 2.0, radius),
            Solid::Sphere { radius } => (0.0, radius),
            _ => return None,
        };
        let ends = [-half, half].map(|z| torso_from_link * shape.pose() * Point3::new(0.0, 0.0, z));
        (!soles.contains(&body)).then_some((body, ends, radius))
    };
    shapes.filter_map(capsule).collect()
}

/// The distance of a place from the nearest cell that is not free, at most `most`.
fn nearest(map: &Map, at: &Point2<f64>, most: f64) -> f64 {
    let own = map.in_map(at);
    let reach = most / map.resolution() + 1.0;
    let range = |value: f64, count: usize| {
        ((value - reach).floor().max(0.0) as usize).min(count)..((value + reach).ceil().max(0.0) as usize).min(count)
    };
    let mut least = most;
    for row in range(own.y, map.rows()) {
        for column in range(own.x, map.columns()) {
            if !map.is_free(row * map.columns() + column) {
                let beyond = |value: f64, low: usize| (low as f64 - value).max(value - low as f64 - 1.0).max(0.0);
                least = least.min(beyond(own.x, column).hypot(beyond(own.y, row)) * map.resolution());
            }
        }
    }
    least
}
