//! NAO walks eight steps: a request is converted to joint angles, and the zero moment point is proved to stay inside
//! the support polygon.
//!
//!     cargo run --release --example 05_walk

use groebot::gait::{Regular, Request, Route, Side, Style, Summary, Walker, plan};
use groebot::robots::{NAO_SINE, Outline, nao_walker};
use groebot::{Result, Watch};

fn main() -> Result<()> {
    let Walker { biped: robot, legs, .. } = nao_walker(Outline::Measured)?;
    let route = Route::regular(&Regular {
        steps: 8,
        length: 0.04,
        turn: 0.0,
        aside: 0.0,
        half_width: 0.05,
        first: Side::Left,
    })?;
    let request = NAO_SINE.request(&robot, route, NAO_SINE.hip_heights[0]);
    let walk = plan(&robot, &legs, &request, &Watch::none())?;
    print!("{}", Summary::of(&robot, &walk));
    assert!(walk.balances.iter().all(|balance| balance.support.signed_distance(&balance.zmp) >= request.margin));

    // At this hip height the legs do not reach the floor: the walk is refused, with the time and the reason.
    let stilted = Request { style: Style { torso_height: 0.35, ..request.style }, ..request };
    println!("refused: {}", plan(&robot, &legs, &stilted, &Watch::none()).unwrap_err());
    Ok(())
}
