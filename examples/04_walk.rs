//! NAO walks eight steps: a request becomes joint angles whose zero moment point is proved to stay over the feet.
//!
//!     cargo run --release --example 04_walk

use groebot::gait::{Durations, Gait, Outline, Regular, Request, Route, Side, Style, Summary, nao, plan};
use groebot::{Result, Watch};

fn main() -> Result<()> {
    let (robot, legs) = nao(Outline::Measured)?;
    let route = Route::regular(&Regular { steps: 8, length: 0.04, turn: 0.0, half_width: 0.05, first: Side::Left })?;
    let request = Request {
        route,
        gait: Gait::Seed,
        style: Style { lift: 0.02, amplitude: 0.05, half_width: 0.05, ahead: 0.005, torso_height: 0.313 },
        durations: Durations { rest: 0.5, shift: 1.056, swing: 0.544 },
        margin: 0.01,
        speed_share: 0.9,
    };
    let walk = plan(&robot, &legs, &request, &Watch::none())?;
    print!("{}", Summary::of(&robot, &walk));
    assert!(walk.balances.iter().all(|balance| balance.support.signed_distance(&balance.zmp) >= request.margin));

    // Hips that are too high do not reach the floor: the walk is refused, with the time and the reason.
    let stilted = Request { style: Style { torso_height: 0.35, ..request.style }, ..request };
    println!("refused: {}", plan(&robot, &legs, &stilted, &Watch::none()).unwrap_err());
    Ok(())
}
