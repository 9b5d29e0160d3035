//! The polar robot by exponentials and by Denavit-Hartenberg parameters: the table RH0 Fig. 2-8, measured again.

use std::f64::consts::PI;
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::Point3;

#[path = "polar/denavit_hartenberg.rs"]
mod denavit_hartenberg;
#[path = "polar/exponentials.rs"]
mod exponentials;

use exponentials::Polar;

/// One thousand joint vectors, as many as in the thesis, by Halton's sequence: angles on the circle, lengths of 0.1 to 1 m.
fn inputs() -> Vec<[f64; 3]> {
    (1..=1000)
        .map(|n| [halton(n, 2, -PI, PI), halton(n, 3, -PI, PI), halton(n, 5, 0.1, 1.0) - denavit_hartenberg::LENGTH])
        .collect()
}

fn halton(mut n: u32, base: u32, low: f64, high: f64) -> f64 {
    let (mut value, mut digit) = (0.0, 1.0);
    while n > 0 {
        digit /= f64::from(base);
        value += digit * f64::from(n % base);
        n /= base;
    }
    low + (high - low) * value
}

/// Measures `work` over `inputs`, one after the other.
fn measure<T, R>(c: &mut Criterion, name: &str, inputs: &[T], work: impl Fn(&T) -> R) {
    let mut next = inputs.iter().cycle();
    c.bench_function(name, |b| b.iter(|| next.next().map(|input| work(black_box(input)))));
}

fn forward(c: &mut Criterion) {
    let (robot, inputs) = (Polar::new(), inputs());
    measure(c, "polar/forward/exponentials", &inputs, |q| robot.forward(q));
    measure(c, "polar/forward/Denavit-Hartenberg", &inputs, denavit_hartenberg::forward);
    measure(c, "polar/forward/by hand", &inputs, denavit_hartenberg::forward_by_hand);
}

fn inverse(c: &mut Criterion) {
    let robot = Polar::new();
    let poses: Vec<_> = inputs().iter().map(denavit_hartenberg::forward).collect();
    let points: Vec<_> = poses.iter().map(|pose| Point3::new(pose[(0, 3)], pose[(1, 3)], pose[(2, 3)])).collect();
    measure(c, "polar/inverse/exponentials, all four", &points, |point| robot.inverse(point));
    measure(c, "polar/inverse/Denavit-Hartenberg, one of four", &poses, denavit_hartenberg::inverse);
}

fn jacobian(c: &mut Criterion) {
    let (robot, inputs) = (Polar::new(), inputs());
    measure(c, "polar/Jacobian/exponentials", &inputs, |q| robot.jacobian(q));
    measure(c, "polar/Jacobian/Denavit-Hartenberg", &inputs, denavit_hartenberg::jacobian);
}

criterion_group!(benches, forward, inverse, jacobian);
criterion_main!(benches);
