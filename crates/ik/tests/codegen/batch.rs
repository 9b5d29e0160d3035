//! Batches in printed Rust and in the library: each solution is bitwise equal to that of a single target.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;
use std::fs;

use groebot_ik::codegen::rust;
use groebot_ik::solver::Program;

use super::harness::{feed, rustc};
use super::stored::named;
use super::{odd, random};

/// Poses of random joints, some at or next to singular configurations. Some targets are out of reach, have numbers that are zero, or are invalid.
fn targets(program: &Program, count: usize) -> Vec<Vec<f64>> {
    let solver = program.solver();
    let mut next = random();
    let mut targets = odd(program.inputs.len());
    for k in 0..count {
        // Only a few singular ones: they take a thousand times as long.
        let kind = if k % 10 == 0 { k / 10 % 20 } else { 20 + k % 10 };
        let joint = |_| if kind == 1 { next(-2.0, 2.0).round() * FRAC_PI_2 } else { next(-3.2, 3.2) };
        let mut q: Vec<f64> = (0..program.joints.len()).map(joint).collect();
        let place = k / 200 % q.len();
        match kind {
            3 => q[place] = 0.0,
            5 => q[place] = 1e-3 * next(-1.0, 1.0),
            _ => {}
        }
        let mut target = solver.reached(&q).unwrap();
        match kind {
            2 | 22 => target[k / 10 % 3 % program.inputs.len()] *= 1.0 + next(0.0, 2.0),
            4 => target[k / 200 % 2] = 0.0,
            7 | 27 => target[k / 10 % program.inputs.len()] += 1e-8 * next(-1.0, 1.0),
            _ => {}
        }
        targets.push(target);
    }
    targets
}

/// Compares the printed file's batches in lanes of every width with its single targets, and the printed solutions bitwise with those of the program. `None`
/// when the compiler is missing.
pub fn check(program: &Program, count: usize) -> Option<()> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("5_solver.rs", &rust::emit(program));
    write("module.rs", &format!("#[path = \"5_solver.rs\"]\nmod solver;\n{DRIVER}"));
    rustc(folder.path(), &["-Copt-level=1", "module.rs"])?;
    let targets = targets(program, count);
    let mut text = String::new();
    for number in targets.iter().flatten() {
        write!(text, "{number:e} ").unwrap();
    }
    let output = feed(&folder.path().join("module"), text);
    let mut lines = output.lines();
    let (solver, mut answers) = (program.solver(), 0);
    for target in &targets {
        let mut expected = Vec::new();
        for solution in solver.solve_numbers(target).unwrap_or_default() {
            let numbers = solution.q.iter().chain([&solution.residual]);
            let free = solution.free.iter().fold(0, |free, joint| free | 1 << joint);
            expected.extend(numbers.map(|number| number.to_bits()).chain([solution.branch as u64, free]));
            answers += 1;
        }
        let line = lines.next().unwrap();
        let printed: Vec<u64> = line.split_whitespace().map(|word| word.parse().unwrap()).collect();
        assert_eq!(printed, expected, "{}: {target:?}", program.name);
    }
    assert!(answers > count, "{}: {answers} answers of {} targets", program.name, targets.len());
    let batch = solver.solve_batch(&targets.concat()).unwrap();
    for (index, target) in targets.iter().enumerate() {
        let alone = solver.solve_numbers(target).unwrap_or_default();
        let range = batch.of_target(index);
        assert_eq!(range.len(), alone.len(), "{}: {target:?}", program.name);
        for (at, solution) in range.zip(&alone) {
            let q: Vec<f64> = (0..solution.q.len()).map(|joint| batch.joint(joint)[at]).collect();
            assert_eq!(
                (q, batch.residuals()[at]),
                (solution.q.clone(), solution.residual),
                "{}: {target:?}",
                program.name
            );
        }
    }
    Some(())
}

fn check_all(names: &[&str], count: usize) {
    let stored = named(names);
    assert_eq!(stored.len(), names.len());
    let is_checked = stored.iter().all(|stored| check(&stored.program, count).is_some());
    assert!(is_checked || std::env::var("GROEBOT_REQUIRE_TOOLS").is_err(), "a compiler is missing");
}

#[test]
fn batches_are_single_targets_to_the_last_bit() {
    check_all(&["puma", "general_6r", "spherical_wrist"], 300);
}

#[test]
#[ignore = "minutes: thousands of targets of each robot"]
fn batches_of_more_robots_are_single_targets_to_the_last_bit() {
    check_all(&["puma", "ur5", "stanford", "nao_left_leg", "irb4600_rounded", "iiwa14"], 10_000);
    check_all(&["scara", "polar", "wrist_rotation", "planar_2r", "rh0_arm", "nao_left_arm", "general_6r"], 1000);
}

/// Reads targets; compares batches with little room and much with single targets; prints the bits of each target's solutions.
const DRIVER: &str = r#"
use solver::{EMPTY, Error, INPUTS, Pairs, Solve, Solver};
use std::io::Read;

type Count = Result<usize, Error>;
type Batch<A> = fn(&[[f64; INPUTS]], &mut [A], &mut [Count]) -> usize;

/// How many targets are solved, which must be all that there is room for, with the answers of `singles`.
fn check<A: Copy + PartialEq + std::fmt::Debug>(
    none: A, batch: Batch<A>, targets: &[[f64; INPUTS]], singles: &[(Count, Vec<A>)], room: usize,
) {
    let mut out = vec![none; room];
    let mut counts = vec![Err(Error::NotFinite); targets.len()];
    let done = batch(targets, &mut out, &mut counts);
    let mut filled = 0;
    for (i, (count, answers)) in singles.iter().enumerate().take(targets.len()) {
        if filled + answers.len() > room {
            assert_eq!(done, i, "{room}");
            return;
        }
        assert_eq!(counts[i], *count, "{:?}", targets[i]);
        assert_eq!(out[filled..filled + answers.len()], answers[..], "{:?}", targets[i]);
        filled += answers.len();
    }
    assert_eq!(done, targets.len());
}

fn check_all<A: Copy + PartialEq + std::fmt::Debug>(
    none: A, single: fn(&[f64; INPUTS], &mut [A]) -> Count, batch: Batch<A>, targets: &[[f64; INPUTS]],
) {
    let alone = |target: &[f64; INPUTS]| {
        let mut out = [none; solver::CAPACITY];
        let count = single(target, &mut out);
        (count, out[..count.unwrap_or(0)].to_vec())
    };
    let singles: Vec<(Count, Vec<A>)> = targets.iter().map(alone).collect();
    let answers: usize = singles.iter().map(|(_, answers)| answers.len()).sum();
    check(none, batch, targets, &singles, answers);
    let (some, singles) = (&targets[100..], &singles[100..]);
    for count in 0..20 {
        check(none, batch, &some[..count], singles, 200);
        check(none, batch, &some[..20], singles, count);
        assert_eq!(batch(&some[..20], &mut vec![none; 1000], &mut vec![Ok(0); count]), count);
    }
}

fn main() {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).unwrap();
    let numbers: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    let targets: Vec<[f64; INPUTS]> = numbers.chunks(INPUTS).map(|target| target.try_into().unwrap()).collect();
    check_all(EMPTY, |t, out| Solver.solve(t, out), |t, out, counts| Solver.solve_batch(t, out, counts), &targets);
    let none = Pairs::empty(&Solver);
    check_all(none, |t, out| Solver.solve_pairs(t, out), |t, out, n| Solver.solve_pairs_batch(t, out, n), &targets);
    for target in &targets {
        let mut out = [EMPTY; solver::CAPACITY];
        let count = Solver.solve(target, &mut out).unwrap_or(0);
        for answer in &out[..count] {
            answer.q.iter().chain([&answer.residual]).for_each(|number| print!("{} ", number.to_bits()));
            print!("{} {} ", answer.branch, answer.free);
        }
        println!();
    }
}
"#;
