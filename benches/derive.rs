//! Times of a derivation from equations and from a chain's description, of a repeated proof, and of solving.

use std::hint::black_box;
use std::path::{Path, PathBuf};

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::Watch;
use groebot::derive::{Derivation, Ends, InputFile, Source};
use groebot::kinematics::Chain;

const MECHANISMS: [&str; 2] = ["nao_leg_sagittal", "nao_arm_planar"];

/// Arms and legs of every kind in `derivations/`.
const CHAINS: [&str; 7] = ["puma", "stanford", "nao_left_leg", "rh0_right_leg", "nao_left_arm", "ur5", "iiwa14"];

/// Joint values at which no chain is singular.
const ORDINARY: [f64; 7] = [0.31, -0.42, 0.53, 0.64, 0.75, -0.86, 0.47];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations").join(name)
}

fn source(name: &str) -> Source {
    Source::read(&folder(name)).expect("a committed input")
}

fn chain(name: &str) -> Chain {
    let input = InputFile::read(&folder(name)).expect("a committed input");
    input.chain(&Ends::default()).expect("it states its task").expect("it is a chain")
}

/// From a committed description to a planned, derived and proved program.
fn derive_chain(c: &mut Criterion) {
    let mut group = c.benchmark_group("derive_chain");
    group.sample_size(10);
    for name in CHAINS {
        group.bench_function(name, |b| b.iter(|| Derivation::sequentially(black_box(&chain(name)), &Watch::none())));
    }
    group.finish();
}

fn prove_chain(c: &mut Criterion) {
    let mut group = c.benchmark_group("prove_chain");
    group.sample_size(10);
    for name in CHAINS {
        let chain = chain(name);
        let derived = Derivation::sequentially(&chain, &Watch::none()).expect("it derives");
        let text = derived.certificate().expect("it prints");
        group.bench_function(name, |b| b.iter(|| Derivation::prove(black_box(&chain), &text)));
    }
    group.finish();
}

fn derive(c: &mut Criterion) {
    let mut group = c.benchmark_group("derive");
    group.sample_size(10);
    for name in MECHANISMS {
        let system = source(name).system.unwrap();
        group.bench_function(name, |b| b.iter(|| Derivation::of_problem(black_box(system.clone()), &Watch::none())));
    }
    group.finish();
}

fn prove(c: &mut Criterion) {
    let mut group = c.benchmark_group("prove");
    group.sample_size(10);
    for name in MECHANISMS {
        let system = source(name).system.unwrap();
        let derivation = Derivation::of_problem(system.clone(), &Watch::none()).expect("it derives");
        let text = derivation.certificate().expect("it prints");
        group.bench_function(name, |b| b.iter(|| Derivation::prove(black_box(system.clone()), &text)));
    }
    group.finish();
}

fn solve(c: &mut Criterion) {
    let mut group = c.benchmark_group("solve");
    for name in MECHANISMS {
        let derivation = Derivation::of_problem(source(name).system.unwrap(), &Watch::none()).expect("it derives");
        let program = derivation.program();
        group.bench_function(name, |b| b.iter(|| program.solve_numbers(black_box(&[60.0, 150.0]))));
    }
    group.finish();
}

/// All solutions of one pose, each measured by forward kinematics.
fn solve_chain(c: &mut Criterion) {
    let mut group = c.benchmark_group("solve_chain");
    for name in CHAINS {
        let chain = chain(name);
        let derived = Derivation::sequentially(&chain, &Watch::none()).expect("it derives");
        let target = derived.reached(&ORDINARY[..chain.joints().len()]).expect("as many values as joints");
        group.bench_function(name, |b| b.iter(|| derived.program().solve_numbers(black_box(&target))));
    }
    group.finish();
}

criterion_group!(benches, derive, prove, derive_chain, prove_chain, solve, solve_chain);
criterion_main!(benches);
