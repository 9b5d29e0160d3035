//! Targets and systems that need tolerances of `tolerances.rs`, here or of the run time, and more than a stored solver.
//!
//! "Without" is a value of zero. Each target was found and checked with a run time whose tolerances can be changed.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};
use std::process::Command;

use groebot_ik::Watch;
use groebot_ik::codegen::ikfast::Options;
use groebot_ik::derive::{Derivation, System};
use groebot_ik::solver::{Checks, Described};
use groebot_robot::kinematics::Target;

use crate::codegen::ikfast::{compile, folder};
use crate::codegen::stored::{named, reached};
use crate::derive::described;

/// The target of NAO's left arm, rounded to single precision, has the self-motion through these joint values, as the arm's solver with a tolerance of 1e-6.
///
/// The forearm is folded back onto the upper arm, so that the axes of ElbowYaw and WristYaw coincide in opposite directions: these joints turn together by
/// any angle, and the hand does not move. Without the tolerance there are eight isolated solutions and no self-motion.
#[test]
fn polishing_freeing_of_self_motions() {
    const Q: [f64; 5] = [-105.0 * PI / 180.0, FRAC_PI_2, 2.0 * PI / 3.0, PI, 2.0 * PI / 3.0];
    const ELBOW_YAW: usize = 2;
    const WITHIN: f64 = 1e-6;
    let stored = named(&["nao_left_arm"]).remove(0);
    let (mut program, chain) = (stored.program, stored.chain.unwrap());
    let Checks { code, residuals, .. } = program.checks.clone();
    program.described = Some(Described { code, residuals, within: WITHIN });
    program.validate().unwrap();
    let target: Vec<f64> = reached(&chain, &Q).iter().map(|&value| f64::from(value as f32)).collect();
    let answers = program.solve_numbers(&target).unwrap();
    let differs = |a: f64, b: f64| (a - b - 2.0 * PI * ((a - b) / (2.0 * PI)).round()).abs() > WITHIN;
    let is_folded = |q: &[f64]| ![0, 1, 3].iter().any(|&joint| differs(q[joint], Q[joint]));
    let member = answers.iter().find(|answer| answer.free == [ELBOW_YAW] && is_folded(&answer.q));
    let member = member.unwrap_or_else(|| panic!("{answers:?}"));
    for turn in [0.0, 1.0, 2.0, 3.0, 4.0, 5.0] {
        let mut q = member.q.clone();
        (q[ELBOW_YAW], q[4]) = (q[ELBOW_YAW] + turn, q[4] + turn);
        let off = reached(&chain, &q).iter().zip(&target).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off <= WITHIN, "{turn}: {off:e}");
    }
}

/// The elbow of the SCARA is folded, so that both configurations of the elbow are one solution, and the tool is at the least distance from the first axis.
/// Rounding to single precision decreases this distance by 5e-10 m. Without the tolerance there is no solution.
#[test]
fn ikfast_single() {
    const Q: [f64; 4] = [2.0 * PI / 3.0, PI, -0.1, FRAC_PI_6];
    let stored = named(&["scara"]).remove(0);
    let folder = folder(&stored.program, &Options { single: true, ..Options::default() });
    if compile(folder.path(), &["-std=c++11", "5_ikfast.cpp", "-o", "alone"]).is_none() {
        return;
    }
    let target: Vec<f32> = reached(stored.chain.as_ref().unwrap(), &Q).iter().map(|&value| value as f32).collect();
    let distance = f64::from(target[0]).hypot(f64::from(target[1]));
    assert!(distance < 0.325 - 0.275, "{distance}");
    let words: Vec<String> = target.iter().map(f32::to_string).collect();
    let output = Command::new(folder.path().join("alone")).args(&words).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.lines().count() == 1, "{text}");
    let off = |a: f64, b: f64| (a - b - 2.0 * PI * ((a - b) / (2.0 * PI)).round()).abs();
    let q: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    assert!(q.len() == 4 && q.iter().zip(Q).all(|(&a, b)| off(a, b) < 1e-4), "{text}");
}

/// The forearm is parallel to the first axis, so that the position alone determines the first joint, with two solutions. The orientation then says nothing
/// about it, but rounding errors of it happen to give one of the two, and without the tolerance the case of the stratum did not run: one solution.
#[test]
fn strata_beside() {
    let degrees: [f64; 4] = [-150.0, 165.0, -15.0, 90.0];
    let chain = described::robot(&described::MICO, described::EXACT);
    let q = degrees.map(f64::to_radians);
    let target = Target::reached(&chain, &q).unwrap();
    let answers = groebot_ik::derive(&chain).unwrap().program().solver().solve(target).unwrap();
    assert_eq!(answers.len(), 2, "{answers:?}");
    for answer in &answers {
        let [position, rotation] = target.missed(&chain, &answer.q);
        assert!(position < 1e-12 && rotation < 1e-12, "{answer:?}");
    }
}

/// The line through the origin and (b, a) has two opposite directions. Its equation contains no constant, and a program with the scale zero is refused.
#[test]
fn derived_strata_least_scale() {
    let text = "name = \"direction\"\nequations = [\"a*s = b*c\"]\n[[parameter]]\nname = \"a\"\n[[parameter]]\nname = \"b\"\n\
                [[joint]]\nname = \"q\"\ncosine = \"c\"\nsine = \"s\"\n";
    let derivation = Derivation::of_problem(System::from_toml(text).unwrap(), &Watch::none()).unwrap();
    let program = derivation.program();
    program.validate().unwrap();
    let mut found: Vec<f64> = program.solve_numbers(&[0.6, 0.8]).unwrap().iter().map(|answer| answer.q[0]).collect();
    found.sort_by(f64::total_cmp);
    let ahead = 0.8_f64.atan2(0.6);
    let expected = [ahead - PI, ahead];
    assert_eq!(found.len(), expected.len(), "{found:?}");
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
}
