//! Targets next to a self-motion, whose isolated solutions are anywhere along the curve of the self-motion.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use groebot_ik::solver::Program;

use super::{Random, distance};

fn arm() -> Program {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations/crx_like/5_program.json");
    Program::from_json(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Joints with the forearm folded onto the upper arm, up to `off` (rad): axes 1, 2, 4 and 5 nearly meet in a point.
fn folded(random: &mut Random, off: f64) -> [f64; 6] {
    let mut q = random.angles();
    q[2] = FRAC_PI_2 + off;
    q
}

/// The number of targets whose generating joints are not found. The tolerance is the uncertainty at this distance from the self-motion, of which the least
/// singular value is at most a tenth.
fn lost(off: f64, targets: usize) -> usize {
    let (program, mut random) = (arm(), Random::new(24));
    let is_lost = |q: &[f64; 6]| {
        let answers = program.solve_numbers(&program.reached(q).unwrap()).unwrap();
        let distance_to = |found: &[f64]| distance(&found.try_into().unwrap(), q);
        !answers.iter().any(|answer| distance_to(&answer.q) <= f64::max(1e-7, 1e-12 / off.abs()))
    };
    (0..targets).filter(|_| is_lost(&folded(&mut random, off))).count()
}

#[test]
fn answers_beside_a_self_motion_are_found() {
    for off in [1e-3, -1e-4, 1e-6, -1e-7, 1e-9] {
        assert_eq!(lost(off, 40), 0, "{off:e} beside");
    }
}

#[test]
fn a_self_motion_is_reported() {
    let (program, mut random) = (arm(), Random::new(25));
    let solver = program.solver();
    for _ in 0..40 {
        let q = folded(&mut random, 0.0);
        let answers = solver.solve_numbers(&solver.reached(&q).unwrap()).unwrap();
        let members = answers.iter().filter(|answer| !answer.free.is_empty());
        assert!(
            members.clone().count() > 0 && members.clone().all(|answer| (answer.q[5] - q[5]).abs() < 1e-6),
            "{q:?}"
        );
    }
}

/// Prints the figures of `docs/six_axes.md`: `cargo test --release beside_a_self_motion -- --ignored --nocapture`.
#[test]
#[ignore = "thousands of targets beside a self-motion"]
fn beside_a_self_motion() {
    for (off, most) in [(1e-2, 0), (1e-3, 0), (1e-4, 0), (1e-5, 1), (1e-6, 1), (1e-7, 2), (1e-8, 4)] {
        let lost = lost(off, 1000);
        println!("{off:e} beside: {lost} of 1000 lost");
        assert!(lost <= most);
    }
}

/// A first attempt with untrusted pivots or candidates is followed by others, which hide another joint or halve another angle. They find the solutions that it
/// loses.
#[test]
fn ill_conditioned_runs_are_followed_by_others() {
    let text = std::fs::read_to_string(
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations/ur5_calibrated/0_chain.toml"),
    );
    let chain = groebot_robot::kinematics::Chain::from_toml(&text.unwrap()).unwrap();
    let solver = groebot_ik::derive::eigenvalue::solver(&chain).unwrap();
    let hidden: Vec<usize> = solver.formulations.as_slice().iter().map(|formulation| formulation.hidden).collect();
    assert!(hidden.iter().any(|joint| *joint != hidden[0]), "{hidden:?}");
    let (mut random, mut switched, mut lost) = (Random::new(26), 0, 0);
    for _ in 0..400 {
        let mut q = random.angles();
        q[4] = 1e-4 * random.number();
        let target = solver.forward(&q);
        let (first, all) = (solver.attempt(&target), solver.solve(&target));
        switched += usize::from(first.accuracy.is_none() && all.runs > 1);
        lost += usize::from(super::nearest(&first, &q) > 1e-6);
        assert!(super::nearest(&all, &q) <= 1e-6, "{q:?}");
    }
    println!("{switched} of 400 runs followed by others, {lost} of them lost their joints");
    assert!(switched > 0 && lost > 0);
}
