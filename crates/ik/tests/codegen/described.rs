//! Robots described with rounded numbers, for tasks with more conditions than joints: printed solvers against the evaluator.

use std::f64::consts::FRAC_PI_2;

use super::{batch, harness, single, stored, turns};
use crate::derive::described::programs;

#[test]
fn every_language_gives_the_same_bits() {
    let mut self_motions = 0;
    for program in programs() {
        let solver = program.solver();
        let joints = stored::joint_values(&program, 90, super::random());
        let quarters =
            |q: &Vec<f64>| q.iter().map(|value| (value / FRAC_PI_2).round() * FRAC_PI_2).collect::<Vec<f64>>();
        let round: Vec<Vec<f64>> = joints.iter().take(45).map(quarters).collect();
        let mut targets: Vec<Vec<f64>> = joints.iter().chain(&round).map(|q| solver.reached(q).unwrap()).collect();
        let off = |(k, target): (usize, &Vec<f64>)| {
            let mut target = target.clone();
            target[k % 2] += 10f64.powi(-(k as i32 % 12));
            target
        };
        let aside: Vec<Vec<f64>> = targets.iter().enumerate().map(off).collect();
        targets.extend(aside);
        targets.extend(super::odd(program.inputs.len()));
        let Some(report) = harness::compare_hosted(&program, &targets) else { return };
        assert!(report.answers > 300 && report.unequal == 0, "{report:?}");
        self_motions += report.self_motions;
        assert!(batch::check(&program, 120).is_some());
        assert!(turns::check_program(&program).is_some());
    }
    assert!(self_motions >= 10, "{self_motions}");
}

#[test]
fn single_precision_finds_them_too() {
    for program in programs() {
        let Some(seen) = single::compare(&program, 150) else { return };
        assert!(seen.farthest <= 1e-4 && seen.found * 100 >= seen.expected * 99, "{}: {seen:?}", program.name);
        assert!(seen.answers <= seen.expected + 3, "{}: {seen:?}", program.name);
    }
}
