//! Robots told by rounded numbers, for tasks that ask for more than their joints can do: printed solvers against the evaluator.

use super::{batch, harness, single, stored, turns};
use crate::derive::described::programs;

#[test]
fn every_language_gives_the_same_bits() {
    for program in programs() {
        let solver = program.solver();
        let joints = stored::joint_values(&program, 90, super::random());
        let mut targets: Vec<Vec<f64>> = joints.iter().map(|q| solver.reached(q).unwrap()).collect();
        let off = |(k, target): (usize, &Vec<f64>)| {
            let mut target = target.clone();
            target[k % 2] += 10f64.powi(-(k as i32 % 12));
            target
        };
        let aside: Vec<Vec<f64>> = targets.iter().enumerate().map(off).collect();
        targets.extend(aside);
        targets.extend(super::odd(program.inputs.len()));
        let Some(report) = harness::compare(&program, &targets) else { return };
        assert!(report.answers > 300 && report.unequal == 0, "{report:?}");
        assert!(batch::check(&program, 120).is_some());
        assert!(turns::check_program(&program).is_some());
    }
}

#[test]
fn single_precision_finds_them_too() {
    for program in programs() {
        let Some(seen) = single::compare(&program, 150) else { return };
        assert!(seen.farthest <= 1e-4 && seen.found * 100 >= seen.expected * 99, "{}: {seen:?}", program.name);
        assert!(seen.answers <= seen.expected + 3, "{}: {seen:?}", program.name);
    }
}
