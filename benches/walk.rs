//! How long planning, inverse kinematics and checks of a walk of eight steps take at 100 samples a second.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::Watch;
use groebot::gait::{Biped, Regular, Request, Route, Side, Usual, Walker, plan};
use groebot::robots::{NAO_PREVIEW, NAO_SEED, Outline, nao_walker};

fn request(usual: &Usual, robot: &Biped, length: f64, turn: f64) -> Request {
    let regular = Regular { steps: 8, length, aside: 0.0, turn, half_width: robot.half_width(), first: Side::Left };
    usual.request(robot, Route::regular(&regular).expect("eight steps"), usual.hip_heights[0])
}

fn walk(c: &mut Criterion) {
    let mut group = c.benchmark_group("walk");
    let Walker { biped: robot, legs, .. } = nao_walker(Outline::Measured).expect("the crate's own data");
    let cases = [
        ("nao_8_steps_seed", request(&NAO_SEED, &robot, 0.04, 0.0)),
        ("nao_8_steps_seed_turning", request(&NAO_SEED, &robot, 0.0, 0.7)),
        ("nao_8_steps_preview", request(&NAO_PREVIEW, &robot, 0.05, 0.0)),
        ("nao_8_steps_preview_turning", request(&NAO_PREVIEW, &robot, 0.03, 0.7)),
    ];
    for (name, request) in cases {
        group.bench_function(name, |b| b.iter(|| plan(&robot, &legs, black_box(&request), &Watch::none())));
    }
    group.finish();
}

criterion_group!(benches, walk);
criterion_main!(benches);
