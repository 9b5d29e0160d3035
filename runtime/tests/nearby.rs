//! Solvers of robots described in rounded numbers, whose formulas are those of a nearby robot.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::TAU;

use groebot_runtime::{Mechanism, Solution, Solve};

#[rustfmt::skip]
#[path = "../../derivations/irb4600_rounded/5_solver.rs"]
mod irb4600;

use irb4600::{CAPACITY, EMPTY, Solver};

/// The joint values at which two of the four candidates miss the described robot most.
const NEAR: [f64; 6] = [
    -1.1574905997267422,
    0.22468450350688896,
    -1.3915150992706793,
    2.8325809440093583,
    -2.6048401351736263,
    0.24387500039140875,
];

/// Joint values on a self-motion of the ideal robot that crosses another one, or is next to it: the wrist is straight, and its centre is next to the first axis or
/// the arm is stretched. The formulas propose only solutions on the other self-motion, or on a part of this one.
#[rustfmt::skip]
const ON_CROSSING_CURVES: [[f64; 6]; 10] = [
    [-1.3843641378845428, 2.991625004565745, 1.7503237644185843, -2.567449247065704, 6.989998854252685e-5, 1.0741787865181829],
    [-0.6074042854841988, 2.05709967989098, 1.331898071862586, -2.293971853249113, -0.001, -0.52898211272709],
    [0.23910386161455754, 1.090784550366556, 2.2225636683011967, 0.9982505670510582, -0.0001, -1.2209948340360395],
    [2.018371758190008, 2.0529212041449316, 1.3002679361380416, -0.5846587320395784, 1e-5, -1.924084563695328],
    [2.6655160214541516, 1.0276906947654867, 2.5489046940135456, 2.123494452757475, 1e-7, 2.4555112153986913],
    [2.125394636738805, 2.633859349938602, 1.75033512090301, -2.243981494993195, -0.0, 1.552045297762592],
    [-1.0471975511965976, 2.0943951023931953, 1.0471975511965976, -1.0471975511965976, 0.0, 2.6179938779914944],
    [-2.0943951023931953, 1.0471975511965976, 2.0943951023931953, -2.6179938779914944, 0.0, 2.0943951023931953],
    [-1.2217304763960306, 0.3490658503988659, 1.9198621771937625, -0.3490658503988659, 0.0, 0.6981317007977318],
    [-2.705260340591211, 0.2617993877991494, 1.9198621771937625, -0.08726646259971647, 0.0, 2.792526803190927],
];

/// Random joint values, of which the fifth is within `beside` of zero.
fn poses(beside: f64) -> Vec<[f64; 12]> {
    let mut random = crate::random();
    let mut pose = || {
        let mut q: [f64; 6] = core::array::from_fn(|_| TAU * random() - 0.5 * TAU);
        if beside < 1.0 {
            q[4] *= beside;
        }
        Solver.forward(&q).unwrap()
    };
    (0..60).map(|_| pose()).collect()
}

/// The numbers of a solution, bitwise.
fn bits(solution: &Solution<Solver>) -> (Vec<u64>, [u64; 2], usize, u32) {
    let Solution { q, residual, relative, branch, free, .. } = solution;
    (q.iter().map(|value| value.to_bits()).collect(), [residual.to_bits(), relative.to_bits()], *branch, *free)
}

/// Two Newton steps with the derivatives of the first lead to the described robot, without polishing steps.
#[test]
fn candidates_are_led_without_polishing() {
    let mut out = [EMPTY; CAPACITY];
    let target = Solver.forward(&NEAR).unwrap();
    assert_eq!(Solver.solve_bounded(&target, 0, &mut out), Ok(2));
}

#[test]
fn batches_have_the_solutions_of_single_calls() {
    for beside in [1.0, 1e-2, 1e-4, 1e-6, 1e-9] {
        let targets = poses(beside);
        let mut batch = vec![EMPTY; targets.len() * CAPACITY];
        let mut counts = vec![Ok(0); targets.len()];
        assert_eq!(Solver.solve_batch(&targets, &mut batch, &mut counts), targets.len());
        let mut rest = batch.iter();
        for (target, count) in targets.iter().zip(&counts) {
            let mut out = [EMPTY; CAPACITY];
            assert_eq!(Solver.solve(target, &mut out), *count);
            for solution in &out[..count.unwrap()] {
                assert_eq!(bits(solution), bits(rest.next().unwrap()), "{beside} {target:?}");
            }
        }
    }
}

/// The solutions hold on the described robot, and the joint values that made a target are among them. The fifth joint is at least fifty times farther from
/// zero than the axes are from those of the ideal robot.
#[test]
fn no_solution_is_lost() {
    let mut random = crate::random();
    for beside in [1.0, 1e-2, 1e-3] {
        for _ in 0..200 {
            let mut q: [f64; 6] = core::array::from_fn(|_| TAU * random() - 0.5 * TAU);
            if beside < 1.0 {
                q[4] = beside * (0.5 + random());
            }
            let target = Solver.forward(&q).unwrap();
            let mut out = [EMPTY; CAPACITY];
            let count = Solver.solve(&target, &mut out).unwrap();
            let is_same = |a: &Solution<Solver>| {
                a.q.iter().zip(&q).all(|(a, b)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() < 1e-7)
            };
            assert!(out[..count].iter().any(is_same), "{beside} {q:?}");
            assert!(out[..count].iter().all(|a| Solver.residual(&target, &a.q) < 1e-12));
        }
    }
    assert!(Solver.facts().nearby.is_some());
}

/// All solutions are found where the curves that remain of two self-motions cross.
#[test]
fn no_solution_on_a_crossing_curve_is_lost() {
    let distance = |a: &[f64; 6], b: &[f64; 6]| {
        a.iter().zip(b).map(|(a, b)| (a - b).sin().abs().max(1.0 - (a - b).cos())).fold(0.0, f64::max)
    };
    for q in ON_CROSSING_CURVES {
        let target = Solver.forward(&q).unwrap();
        let mut out = [EMPTY; CAPACITY];
        let count = Solver.solve(&target, &mut out).unwrap();
        let found = &out[..count];
        assert!(found.iter().any(|a| distance(&a.q, &q) < 1e-5), "{q:?}");
        assert!(found.iter().all(|a| a.free == 0 && Solver.residual(&target, &a.q) < 1e-12), "{q:?}");
        let mut pairs = (0..count).flat_map(|i| found[..i].iter().map(move |b| (&found[i], b)));
        assert!(pairs.all(|(a, b)| distance(&a.q, &b.q) > 1e-4), "{q:?}");
    }
}
