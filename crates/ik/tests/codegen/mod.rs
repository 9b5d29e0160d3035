//! Printed solvers: compiled, run, and compared with the evaluator of the same program.

mod batch;
pub mod builder;
mod coupled;
mod derivations;
mod described;
mod dynamics;
mod forward;
mod frames;
mod freestanding;
pub mod harness;
pub mod ikfast;
mod moveit;
mod names;
mod pairs;
mod redundant;
pub mod samples;
mod single;
mod six_axes;
pub mod stored;
mod text;
mod turns;

use std::f64::consts::{FRAC_PI_2, PI};

use harness::compare;
use proptest::test_runner::{RngAlgorithm, TestRng};
use samples::{arm, leg, pan_tilt, polar, quartic, wrist};

/// Random numbers that are equal in every run.
pub fn random() -> impl FnMut(f64, f64) -> f64 {
    use proptest::prelude::Rng;
    let mut source = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    move |low, high| low + (high - low) * (source.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Targets with invalid numbers, and the zero target.
pub fn odd(inputs: usize) -> Vec<Vec<f64>> {
    let mut targets = vec![vec![0.0; inputs], vec![-0.0; inputs], vec![1e300; inputs], vec![1e-300; inputs]];
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        targets.extend((0..inputs).map(|place| (0..inputs).map(|i| if i == place { value } else { 0.1 }).collect()));
    }
    targets
}

#[test]
fn leg_in_every_language_equals_the_evaluator() {
    let mut between = random();
    let mut targets = odd(2);
    for _ in 0..1500 {
        let [hip, knee] = [between(-3.2, 3.2), between(-3.2, 3.2)];
        targets.push(leg::foot(hip, knee).to_vec());
        targets.push(leg::foot(hip, knee * 1e-7).to_vec());
        targets.push(vec![between(-0.3, 0.3), between(-0.3, 0.3)]);
    }
    let report = compare(&leg::program(), &targets);
    assert!(report.is_none_or(|report| report.answers > 4000), "most targets are in reach");
}

#[test]
fn arm_with_cases_and_nested_roots_in_every_language_equals_the_evaluator() {
    let mut between = random();
    let mut targets = odd(3);
    for k in 0..800 {
        let q = [between(-3.2, 3.2), between(-3.2, 3.2), between(-3.2, 3.2)];
        targets.push(arm::tool(q).to_vec());
        let small = 10f64.powi(-(k % 17));
        let height = between(-0.9, 0.9);
        targets.push(vec![small * between(-1.0, 1.0), small * between(-1.0, 1.0), height]);
        targets.push(vec![small * between(-1.0, 1.0), 0.0, height]);
        targets.push(vec![0.0, 0.0, height]);
        targets.push(vec![between(-2.0, 2.0), between(-2.0, 2.0), between(-2.0, 2.0)]);
    }
    let report = compare(&arm::program(), &targets);
    assert!(report.is_none_or(|report| report.answers > 4000 && report.self_motions > 400 && report.refused > 10));
}

#[test]
fn polar_arm_with_more_equations_than_joints_in_every_language_equals_the_evaluator() {
    let mut between = random();
    let mut targets = odd(3);
    for k in 0..1000 {
        let small = 10f64.powi(-(k % 17));
        targets.push(vec![between(-1.0, 1.0), between(-7.0, 7.0), between(-1.0, 1.0)]);
        targets.push(vec![small * between(-1.0, 1.0), between(-7.0, 7.0), small * between(-1.0, 1.0)]);
        targets.push(vec![between(-1.0, 1.0), 0.0, 0.0]);
        targets.push(vec![0.0, between(-7.0, 7.0), 0.0]);
    }
    let report = compare(&polar::program(), &targets);
    assert!(report.is_none_or(|report| report.answers > 4000 && report.self_motions > 900));
}

#[test]
fn quartic_with_choices_of_polynomials_in_every_language_equals_the_evaluator() {
    let mut between = random();
    let mut targets = odd(5);
    for k in 0..1000 {
        let small = 10f64.powi(-(k % 17));
        let roots = [between(-2.0, 2.0), between(-2.0, 2.0), between(-2.0, 2.0), between(-2.0, 2.0)];
        targets.push(quartic::with_roots(roots).to_vec());
        targets.push(quartic::with_roots([roots[0], roots[0] + small, roots[1], roots[1]]).to_vec());
        let line: Vec<f64> = (0..5).map(|_| between(-1.0, 1.0)).collect();
        targets.push(vec![line[0], line[1], line[2], line[3], line[4] * small]);
        targets.push(vec![line[0], line[1], line[2], line[3] * small, 0.0]);
    }
    let report = compare(&quartic::program(), &targets);
    assert!(report.is_none_or(|report| report.answers > 6000));
}

#[test]
fn two_blocks_and_samples_in_every_language_equal_the_evaluator() {
    let mut between = random();
    let mut targets = odd(3);
    for k in 0..1000 {
        let small = 10f64.powi(-(k % 17));
        targets.push(pan_tilt::direction(between(-3.2, 3.2), between(-3.2, 3.2)).to_vec());
        targets.push(pan_tilt::direction(between(-3.2, 3.2), FRAC_PI_2 - small).to_vec());
        targets.push(vec![0.0, 0.0, 1.0 - 1e-10]);
        targets.push(vec![between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)]);
    }
    let report = compare(&pan_tilt::program(), &targets);
    assert!(report.is_none_or(|report| report.answers > 4000 && report.self_motions > 1000 && report.refused > 900));
}

#[test]
fn a_wrist_with_pivots_in_every_language_equals_the_evaluator() {
    let mut between = random();
    let mut targets = odd(9);
    for k in 0..170 {
        let small = 10f64.powi(-(k % 17));
        let mut angle = || between(-3.2, 3.2);
        targets.push(wrist::rotation([angle(), angle(), angle()]).to_vec());
        targets.push(wrist::rotation([angle(), small, angle()]).to_vec());
        targets.push(wrist::rotation([angle(), 0.0, angle()]).to_vec());
        targets.push(wrist::rotation([angle(), PI, angle()]).map(|value| value + 1e-3 * small * angle()).to_vec());
    }
    for gap in [false, true] {
        let report = compare(&wrist::program(gap), &targets);
        assert!(report.is_none_or(|report| report.answers > 560 && report.self_motions > 170));
    }
}

#[test]
fn a_gantry_with_a_wrist_in_every_language_equals_the_evaluator() {
    let mut between = random();
    let mut targets = odd(12);
    for k in 0..160 {
        let mut angle = || between(-3.2, 3.2);
        let middle = [angle(), 0.0, PI, 1e-8 * angle()][k % 4];
        let rotation = wrist::rotation([angle(), middle, angle()]);
        targets.push([angle(), angle(), angle()].into_iter().chain(rotation).collect());
    }
    let report = compare(&wrist::carried(), &targets);
    assert!(report.is_none_or(|report| report.answers > 220 && report.self_motions > 60));
}
