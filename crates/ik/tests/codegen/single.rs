//! C in single precision: compiled without implicit promotion, run, and compared with the program in double precision.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use groebot_ik::codegen::c99::Pair;
use groebot_ik::solver::Program;

use super::harness::{compile_solver, feed, write_pair};
use super::random;
use super::stored::{joint_values, named};

/// Results of a comparison.
#[derive(Debug, Default)]
pub struct Seen {
    /// Number of solutions of the program with a solution in single precision near them.
    pub found: usize,
    /// Number of solutions of the program.
    pub expected: usize,
    /// Number of solutions in single precision.
    pub answers: usize,
    /// The largest distance between a solution's target and the requested one, relative to the scale.
    pub farthest: f64,
}

fn build(program: &Program, folder: &Path) -> Option<()> {
    let upper = program.name.to_ascii_uppercase();
    write_pair(folder, &Pair::new(program, "5_solver"));
    fs::write(folder.join("main.c"), DRIVER.replace("NAME", &program.name).replace("UPPER", &upper)).unwrap();
    compile_solver(program, folder, &["-DGB_FLOAT"], "single")
}

pub fn compare(program: &Program, count: usize) -> Option<Seen> {
    let folder = tempfile::tempdir().unwrap();
    build(program, folder.path())?;
    let (solver, joints) = (program.solver(), joint_values(program, count, random()));
    let targets: Vec<Vec<f64>> =
        joints.iter().enumerate().filter(|(k, _)| k % 3 < 2).map(|(_, q)| solver.reached(q).unwrap()).collect();
    let mut text = format!("{}\n", targets.len());
    for target in &targets {
        let words: Vec<String> = target.iter().map(|value| format!("{value:e}")).collect();
        writeln!(text, "{}", words.join(" ")).unwrap();
    }
    let output = feed(&folder.path().join("single"), text);
    let mut numbers = output.split_whitespace().map(|word| word.parse::<f64>().unwrap());
    let mut seen = Seen::default();
    for target in &targets {
        let count = numbers.next().unwrap() as usize;
        let answers: Vec<Vec<f64>> =
            (0..count).map(|_| program.joints.iter().map(|_| numbers.next().unwrap()).collect()).collect();
        let expected = solver.solve_numbers(target).unwrap();
        let turn = |a: f64, b: f64| (a - b - std::f64::consts::TAU * ((a - b) / std::f64::consts::TAU).round()).abs();
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| turn(*a, *b) <= 2e-2);
        seen.answers += answers.len();
        seen.expected += expected.len();
        seen.found += expected.iter().filter(|e| answers.iter().any(|answer| near(answer, &e.q))).count();
        for answer in &answers {
            let reached = solver.reached(answer).unwrap();
            let off = reached.iter().zip(target).map(|(a, b)| turn(*a, *b)).fold(0.0, f64::max);
            seen.farthest = seen.farthest.max(off / program.scale.max(1.0));
        }
    }
    assert_eq!(numbers.next(), None);
    Some(seen)
}

#[test]
fn answers_of_single_precision_are_near_those_of_double_precision() {
    for stored in named(&["puma", "nao_left_leg", "offset_wrist", "spherical_wrist", "scara", "iiwa14"]) {
        let Some(seen) = compare(&stored.program, 900) else { return };
        println!("{}: {seen:?}", stored.name);
        assert!(seen.farthest <= 1e-4, "{}: {seen:?}", stored.name);
        assert!(seen.found * 1000 >= seen.expected * 998, "{}: {seen:?}", stored.name);
        assert!(seen.answers <= seen.expected + 5, "{}: {seen:?}", stored.name);
    }
}

const DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>

int main(void)
{
    int targets;
    float target[UPPER_INPUTS];
    NAME_solution out[UPPER_CAPACITY];
    if (scanf("%d", &targets) != 1) {
        return 1;
    }
    for (int line = 0; line < targets; line++) {
        for (int i = 0; i < UPPER_INPUTS; i++) {
            if (scanf("%f", &target[i]) != 1) {
                return 1;
            }
        }
        const int count = NAME_solve(target, out);
        printf("%d\n", count);
        for (int k = 0; k < count; k++) {
            for (int i = 0; i < UPPER_JOINTS; i++) {
                printf("%.9g ", (double)out[k].q[i]);
            }
            printf("\n");
        }
    }
    return 0;
}
"#;
