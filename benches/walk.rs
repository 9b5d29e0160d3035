//! How long planning, inverse kinematics and checks of a walk of eight steps take at 100 samples a second.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::Watch;
use groebot::gait::{Durations, Gait, Outline, Regular, Request, Route, Side, Style, nao, plan};

fn request(gait: Gait, length: f64, turn: f64) -> Request {
    let regular = Regular { steps: 8, length, turn, half_width: 0.05, first: Side::Left };
    let (lift, durations) = match gait {
        Gait::Seed => (0.02, Durations { rest: 0.5, shift: 1.056, swing: 0.544 }),
        Gait::Preview => (0.03, Durations { rest: 1.5, shift: 0.24, swing: 0.56 }),
    };
    Request {
        route: Route::regular(&regular).expect("eight steps"),
        gait,
        style: Style { lift, amplitude: 0.05, half_width: 0.05, ahead: 0.005, torso_height: 0.313 },
        durations,
        margin: 0.01,
        speed_share: 0.9,
    }
}

fn walk(c: &mut Criterion) {
    let mut group = c.benchmark_group("walk");
    let (robot, legs) = nao(Outline::Measured).expect("the crate's own data");
    let cases = [
        ("nao_8_steps_seed", request(Gait::Seed, 0.04, 0.0)),
        ("nao_8_steps_seed_turning", request(Gait::Seed, 0.0, 0.7)),
        ("nao_8_steps_preview", request(Gait::Preview, 0.05, 0.0)),
    ];
    for (name, request) in cases {
        group.bench_function(name, |b| b.iter(|| plan(&robot, &legs, black_box(&request), &Watch::none())));
    }
    group.finish();
}

criterion_group!(benches, walk);
criterion_main!(benches);
