//! Walking: polygons and zero moment points (ZMP) against their definitions, walks against forward kinematics and against the source documents.

mod any;
mod drawing;
mod errata;
mod footing;
mod forces;
mod goals;
mod long;
mod nao;
mod one_step;
mod polygon;
mod preview;
mod refused;
mod rh0;
mod route;
mod sine;
mod tables;
mod zmp;

use std::sync::OnceLock;

use groebot_humanoid::Watch;
// `stabilizer/descent.rs` of the sources, which is compiled into these tests, finds it here.
pub(crate) use groebot_humanoid::gait::GRAVITY;
use groebot_humanoid::gait::{Biped, Durations, Gait, Legs, Regular, Request, Route, Side, Style, TICK, Walk, plan};
use groebot_humanoid::walkers::Outline;

/// A robot with its measured soles, and its legs.
pub fn built(name: &str) -> (Biped, Legs) {
    let walker = groebot_humanoid::walkers::walker(name, Outline::Measured).unwrap().unwrap();
    (walker.biped, walker.legs)
}

/// NAO with its measured soles.
fn robot() -> &'static (Biped, Legs) {
    static ROBOT: OnceLock<(Biped, Legs)> = OnceLock::new();
    ROBOT.get_or_init(|| built("nao"))
}

fn regular() -> Regular {
    Regular { steps: 4, length: 0.04, turn: 0.0, aside: 0.0, half_width: 0.05, first: Side::Left }
}

fn style() -> Style {
    Style { lift: 0.02, amplitude: 0.05, half_width: 0.05, ahead: 0.005, torso_height: 0.313 }
}

/// The sine gait on a regular route.
fn request(regular: &Regular) -> Request {
    Request {
        route: Route::regular(regular).unwrap(),
        gait: Gait::Sine,
        style: style(),
        durations: Durations { rest: 0.3, shift: 0.96, swing: 0.54, lower: None },
        margin: 0.01,
        speed_share: 0.9,
        tick: TICK,
        slowest: 12.0,
    }
}

fn walk(request: &Request) -> groebot_humanoid::Result<Walk> {
    let (humanoid, legs) = robot();
    plan(humanoid, legs, request, &Watch::none())
}
