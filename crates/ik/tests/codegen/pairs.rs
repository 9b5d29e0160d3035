//! Cosines and sines of solutions: bitwise equal to those of the evaluator, and consistent with its angles.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;
use std::fs;

use groebot_ik::codegen;
use groebot_ik::solver::{JointValue, Program};

use super::harness::{compile_solver, feed, rustc, write_c};
use super::stored::named;
use super::{odd, random};

/// Poses of random joints, and of joints at multiples of a quarter turn.
fn targets(program: &Program) -> Vec<Vec<f64>> {
    let mut next = random();
    let mut targets = odd(program.inputs.len());
    let solver = program.solver();
    for count in 0..400 {
        let joint = |_| if count < 300 { next(-3.0, 3.0) } else { next(-2.0, 2.0).round() * FRAC_PI_2 };
        let q: Vec<f64> = (0..program.joints.len()).map(joint).collect();
        targets.push(solver.reached(&q).unwrap());
    }
    targets
}

/// Output of the printed solvers for all targets: the number of solutions, and for each its branch, residual and pairs.
fn printed(program: &Program, targets: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(folder.path().join(name), text).unwrap();
    let upper = program.name.to_ascii_uppercase();
    write("solver.rs", codegen::rust::emit(program));
    write("main.rs", format!("mod solver;\n{RUST_DRIVER}"));
    write_c(program, folder.path());
    write("main.c", C_DRIVER.replace("NAME", &program.name).replace("UPPER", &upper));
    rustc(folder.path(), &["-Amissing_docs", "main.rs", "-o", "rust"])?;
    compile_solver(program, folder.path(), &[], "c99")?;
    let mut text = format!("{}\n", targets.len());
    for number in targets.iter().flatten() {
        write!(text, "{number:e} ").unwrap();
    }
    let run = |name: &str| feed(&folder.path().join(name), text.clone());
    let numbers = |output: String| output.split_whitespace().map(|word| word.parse().unwrap()).collect();
    Some(["rust", "c99"].into_iter().map(run).map(numbers).collect())
}

fn check(program: &Program) {
    let targets = targets(program);
    let Some(outputs) = printed(program, &targets) else { return };
    let expected: Vec<_> = targets.iter().map(|target| program.solve_pairs(target)).collect();
    for output in outputs {
        let mut next = output.into_iter();
        for (target, expected) in targets.iter().zip(&expected) {
            let count = next.next().unwrap();
            let Ok(expected) = expected else {
                assert!(count < 0.0, "{}: {target:?}", program.name);
                continue;
            };
            assert_eq!(count, expected.len() as f64, "{}: {target:?}", program.name);
            for pairs in expected {
                assert_eq!(next.next(), Some(pairs.branch as f64), "{}: {target:?}", program.name);
                assert_eq!(
                    next.next().map(f64::to_bits),
                    Some(pairs.residual.to_bits()),
                    "{}: {target:?}",
                    program.name
                );
                let numbers: Vec<f64> = next.by_ref().take(2 * pairs.joints.len()).collect();
                assert_eq!(numbers, pairs.joints.concat(), "{}: {target:?}", program.name);
            }
        }
    }
    for target in &targets {
        let Ok(pairs) = program.solve_pairs(target) else { continue };
        let solutions = program.solve_numbers(target).unwrap();
        assert_eq!(pairs.len(), solutions.len());
        for (pairs, solution) in pairs.iter().zip(&solutions) {
            assert_eq!((pairs.branch, &pairs.free), (solution.branch, &solution.free));
            for ((joint, [c, s]), q) in program.joints.iter().zip(&pairs.joints).zip(&solution.q) {
                match joint.value {
                    JointValue::Angle { .. } => assert!((q.cos() - c).abs().max((q.sin() - s).abs()) < 1e-14),
                    JointValue::Plain(_) => assert_eq!(q, c),
                }
            }
        }
    }
}

#[test]
fn pairs_are_those_of_the_evaluator() {
    let names = ["puma", "stanford", "planar_3r"];
    let stored = named(&names);
    assert_eq!(stored.len(), names.len());
    stored.iter().for_each(|stored| check(&stored.program));
}

const RUST_DRIVER: &str = r#"
use solver::{Solve, Solver};
use std::io::Read;

fn main() {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).unwrap();
    let mut words = text.split_whitespace();
    let count: usize = words.next().unwrap().parse().unwrap();
    let mut out = [solver::Pairs::empty(&Solver); solver::CAPACITY];
    for _ in 0..count {
        let mut target = [0.0; solver::INPUTS];
        target.fill_with(|| words.next().unwrap().parse().unwrap());
        let Ok(count) = Solver.solve_pairs(&target, &mut out) else {
            println!("-1");
            continue;
        };
        println!("{count}");
        for pairs in &out[..count] {
            print!("{} {:e}", pairs.branch, pairs.residual);
            pairs.joints.iter().flatten().for_each(|number| print!(" {number:e}"));
            println!();
        }
    }
}
"#;

const C_DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>

int main(void)
{
    int targets;
    double target[UPPER_INPUTS];
    static NAME_pairs out[UPPER_CAPACITY];
    if (scanf("%d", &targets) != 1) {
        return 1;
    }
    for (int line = 0; line < targets; line++) {
        for (int i = 0; i < UPPER_INPUTS; i++) {
            if (scanf("%lf", &target[i]) != 1) {
                return 1;
            }
        }
        const int count = NAME_solve_pairs(target, out);
        printf("%d\n", count < 0 ? -1 : count);
        for (int k = 0; k < count; k++) {
            printf("%zu %.17g", out[k].branch, out[k].residual);
            for (int i = 0; i < UPPER_JOINTS; i++) {
                printf(" %.17g %.17g", out[k].joints[i][0], out[k].joints[i][1]);
            }
            printf("\n");
        }
    }
    return 0;
}
"#;
