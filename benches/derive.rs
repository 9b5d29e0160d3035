//! How long a mechanism takes from its equations to a proved program, to its proof again, and to its answers.

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use groebot::Watch;
use groebot::derive::{Derivation, Source, certificate};

const MECHANISMS: [&str; 2] = ["nao_leg_sagittal", "nao_arm_planar"];

fn source(name: &str) -> Source {
    Source::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations").join(name)).expect("a committed input")
}

fn derive(c: &mut Criterion) {
    let mut group = c.benchmark_group("derive");
    group.sample_size(10);
    for name in MECHANISMS {
        let system = source(name).system.unwrap();
        group.bench_function(name, |b| b.iter(|| Derivation::new(black_box(system.clone()), &Watch::none())));
    }
    group.finish();
}

fn prove(c: &mut Criterion) {
    let mut group = c.benchmark_group("prove");
    group.sample_size(10);
    for name in MECHANISMS {
        let system = source(name).system.unwrap();
        let derivation = Derivation::new(system.clone(), &Watch::none()).expect("it derives");
        let text = certificate::write(&derivation).expect("it prints");
        group.bench_function(name, |b| b.iter(|| certificate::prove(black_box(&system), &text)));
    }
    group.finish();
}

fn solve(c: &mut Criterion) {
    let mut group = c.benchmark_group("solve");
    for name in MECHANISMS {
        let program = Derivation::new(source(name).system.unwrap(), &Watch::none()).expect("it derives").program;
        group.bench_function(name, |b| b.iter(|| program.solve(black_box(&[60.0, 150.0]))));
    }
    group.finish();
}

criterion_group!(benches, derive, prove, solve);
criterion_main!(benches);
