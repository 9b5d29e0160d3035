//! From a room to the joint angles of RH0: it is almost enclosed by furniture, RH0 Fig. 5-27, and walks around it.
//!
//!     cargo run --release --example 09_navigation > docs/navigation.svg

use groebot::Result;
use groebot::gait::Footprint;
use groebot::model::Meshes;
use groebot::nav::Room;
use groebot::robots::{Outline, rh0, walker};
use groebot::task::{Body, Floor, Goal, Pilot, Plan};
use nalgebra::Point2;

const PLACES: [(&str, f64, f64); 7] = [
    ("sofa", 3.0, 1.6),
    ("billiard table", 3.0, 4.25),
    ("piano", 4.8, 2.85),
    ("armchair", 1.45, 2.3),
    ("chair", 1.6, 3.75),
    ("lamp", 7.0, 5.3),
    ("planetary ball", 6.6, 1.2),
];

fn main() -> Result<()> {
    let mut room = Room::from_toml(include_str!("living_room.toml"))?;
    for (name, x, y) in PLACES {
        room = room.with_moved(name, Point2::new(x, y), 0.0)?;
    }
    let walker = walker("rh0", Outline::Measured).expect("RH0 is one of groebot's robots")?;
    let body = Body::new(&rh0(), &walker.biped, &Meshes::default())?;
    let defaults = walker.gaits[0].1.clone();
    let pilot = Pilot::new(walker, defaults, body, true, None)?;
    let floor = Floor::new(&room.map()?, 0.02)?;
    let start = Footprint { x: 3.0, y: 3.0, yaw: 0.0 }.feet(pilot.half_width());
    let goal = Goal { place: Point2::new(7.0, 3.0), heading: Some(0.0) };
    match Plan::find(&pilot, &floor, start, goal, None)? {
        Ok(plan) => print!("{}", plan.to_svg(&pilot, &floor)),
        Err(blocked) => eprintln!("{blocked}"),
    }
    Ok(())
}
