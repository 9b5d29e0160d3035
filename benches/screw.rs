//! How long the screw solver takes for all answers to one pose of each known robot, and to find its plan.

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::kinematics::Chain;
use groebot::kinematics::screw::{ScrewSolver, Target};
use groebot::robots;

/// Poses that `chain` reaches, spread evenly over its joints (a Kronecker sequence).
fn targets(chain: &Chain, count: usize) -> Vec<Target> {
    let share = |seed: usize, joint: usize| {
        ((seed as f64 + 0.5) * 1.220_744_084_605_759_5_f64.powi(-(joint as i32) - 1)).fract()
    };
    let value = |seed: usize, joint: usize| match chain.screws()[joint].axis() {
        Some(_) => PI * (2.0 * share(seed, joint) - 1.0),
        None => chain.reach() * share(seed, joint),
    };
    let configuration = |seed: usize| (0..chain.joints().len()).map(|joint| value(seed, joint)).collect::<Vec<_>>();
    (0..count).map(|seed| Target::reached(chain, &configuration(seed)).expect("finite values")).collect()
}

fn solve(c: &mut Criterion) {
    let mut group = c.benchmark_group("screw_solve");
    for robot in robots::ALL {
        let chain = robot.chain();
        let solver = ScrewSolver::new(&chain).expect("a chain that it solves");
        let targets = targets(&chain, 256);
        let mut next = targets.iter().cycle();
        group.bench_function(robot.name(), |b| b.iter(|| solver.solve(black_box(next.next().expect("a cycle")))));
    }
    group.finish();
}

fn plan(c: &mut Criterion) {
    let mut group = c.benchmark_group("screw_plan");
    group.sample_size(20);
    for robot in robots::ALL {
        let chain = robot.chain();
        group.bench_function(robot.name(), |b| b.iter(|| ScrewSolver::new(black_box(&chain))));
    }
    group.finish();
}

criterion_group!(benches, solve, plan);
criterion_main!(benches);
