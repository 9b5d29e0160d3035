use groebot::Watch;
use groebot::gait::*;

#[test]
fn try_it() {
    let (nao, legs) = nao(Outline::Measured).unwrap();
    let regular = Regular { steps: 8, length: 0.04, turn: 0.0, half_width: 0.05, first: Side::Left };
    let style = Style { lift: 0.025, amplitude: 0.05, half_width: 0.05, ahead: 0.015, torso_height: 0.225 + 0.085 };
    for (gait, turn, d) in [
        (Gait::Seed, 0.0, Durations { rest: 0.5, shift: 0.8, swing: 0.5 }),
        (Gait::Seed, 0.7, Durations { rest: 0.5, shift: 0.8, swing: 0.5 }),
        (Gait::Preview, 0.0, Durations { rest: 1.5, shift: 0.2, swing: 0.5 }),
        (Gait::Seed, 0.0, Durations { rest: 0.5, shift: 0.3, swing: 0.2 }),
    ] {
        let request = Request {
            route: Route::regular(&Regular { turn, ..regular }).unwrap(),
            gait,
            style,
            durations: d,
            margin: 0.005,
            speed_share: 0.9,
        };
        let start = std::time::Instant::now();
        match plan(&nao, &legs, &request, &Watch::none()) {
            Ok(walk) => {
                let worst = walk.balances.iter().map(|b| b.margin).fold(f64::INFINITY, f64::min);
                let gap = walk.balances.iter().map(|b| (b.zmp - b.pendulum).norm()).fold(0.0, f64::max);
                println!(
                    "{gait:?} {turn}: {} samples, margin {worst:.4}, zmp-lipm {gap:.4} in {:?}",
                    walk.balances.len(),
                    start.elapsed()
                );
                println!(
                    "{:?}",
                    walk.schedule.phases.iter().map(|p| (p.slowed * 100.0).round() / 100.0).collect::<Vec<_>>()
                );
            }
            Err(error) => println!("{gait:?} {turn} {error}"),
        }
    }
}
