//! Times of planning, inverse kinematics and checks of a walk of eight steps at 100 samples per second, and of everything from a map to joint angles.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::Watch;
use groebot::control::{SoleForce, Stabilizer, State};
use groebot::gait::{Biped, Footprint, GaitDefaults, Regular, Request, Route, Side, Walker, plan};
use groebot::model::Meshes;
use groebot::nav::Room;
use groebot::robots::{NAO_PREVIEW, NAO_SINE, Outline, nao_walker, rh0, rh0_walker, walker};
use groebot::task::{Body, Floor, Goal, Pilot, Plan};
use nalgebra::{Point2, Vector3};

fn request(defaults: &GaitDefaults, robot: &Biped, length: f64, turn: f64) -> Request {
    let regular = Regular { steps: 8, length, aside: 0.0, turn, half_width: robot.half_width(), first: Side::Left };
    defaults.request(robot, Route::regular(&regular).expect("eight steps"), defaults.hip_heights[0])
}

fn walk(c: &mut Criterion) {
    let mut group = c.benchmark_group("walk");
    let Walker { biped: robot, legs, .. } = nao_walker(Outline::Measured).expect("the crate's own data");
    let cases = [
        ("nao_8_steps_seed", request(&NAO_SINE, &robot, 0.04, 0.0)),
        ("nao_8_steps_seed_turning", request(&NAO_SINE, &robot, 0.0, 0.7)),
        ("nao_8_steps_preview", request(&NAO_PREVIEW, &robot, 0.05, 0.0)),
        ("nao_8_steps_preview_turning", request(&NAO_PREVIEW, &robot, 0.03, 0.7)),
    ];
    for (name, request) in cases {
        group.bench_function(name, |b| b.iter(|| plan(&robot, &legs, black_box(&request), &Watch::none())));
    }
    group.finish();
}

/// One step of the stabiliser, for a robot that stands on both feet as planned.
fn stabilizer(c: &mut Criterion) {
    let mut group = c.benchmark_group("stabilizer");
    for name in ["nao", "rh0", "teo"] {
        let walker = walker(name, Outline::Measured).expect("a robot of the crate").expect("the crate's own data");
        let (biped, defaults) = (&walker.biped, &walker.gaits[0].1);
        let half_width = biped.half_width();
        let regular = Regular { steps: 2, length: 0.04, aside: 0.0, turn: 0.0, half_width, first: Side::Left };
        let route = Route::regular(&regular).expect("two steps");
        let height =
            |height: &f64| plan(biped, &walker.legs, &defaults.request(biped, route.clone(), *height), None).ok();
        let walk = defaults.hip_heights.iter().find_map(height).expect("a walk").trajectory(biped);
        let force = SoleForce { force: Vector3::new(0.0, 0.0, 4.9 * biped.model.mass()), moment: Vector3::zeros() };
        let mut state = State {
            time: 0.0,
            q: walk.q[0].clone(),
            orientation: walk.base[0].rotation,
            angular_velocity: Vector3::zeros(),
            soles: [force; 2],
        };
        let mut stabilizer = Stabilizer::new(walker.clone(), &walk).expect("its walk").stiffness(1e3);
        group.bench_function(format!("{name}_step"), |b| {
            b.iter(|| {
                state.time += 1e-7;
                stabilizer.step(black_box(&state))
            });
        });
    }
    group.finish();
}

/// RH0 through a room: the map with its clearances, the path, the steps, joint angles at 81 samples per step, and all checks.
fn navigate(c: &mut Criterion) {
    let mut group = c.benchmark_group("navigate");
    group.sample_size(20);
    let walker = rh0_walker().expect("the crate's own data");
    let body = Body::new(&rh0(), &walker.biped, &Meshes::default()).expect("its shapes");
    let defaults = walker.gaits[0].1.clone();
    let pilot = Pilot::new(walker, defaults, body, true, &Watch::none()).expect("it walks");
    let room = |size: f64| {
        let wall = |name: &str, x: f64, y: f64| {
            format!("[[furniture]]\nname = \"{name}\"\nbox = [0.2, 1.2]\nat = [{x}, {y}]\n")
        };
        let text = format!("size = [{size}, 2.4]\nwall = 0.05\n{}", wall("a", 0.5 * size, 0.6));
        Room::from_toml(&text).and_then(|room| room.map()).expect("a room")
    };
    for (name, size) in [("rh0_5_m", 5.8), ("rh0_10_m", 10.8)] {
        let (map, goal) = (room(size), Point2::new(size - 0.5, 0.7));
        let feet = Footprint { x: 0.5, y: 0.7, yaw: 0.2 }.feet(pilot.half_width());
        let find = || {
            let floor = Floor::new(black_box(&map), 0.02).expect("a floor");
            Plan::find(&pilot, &floor, feet, Goal { place: goal, heading: None }, &Watch::none())
        };
        let steps = find().expect("a walk").expect("a way").walk.schedule.route.steps.len();
        group.bench_function(format!("{name}_{steps}_steps"), |b| b.iter(find));
    }
    group.finish();
}

criterion_group!(benches, walk, navigate, stabilizer);
criterion_main!(benches);
