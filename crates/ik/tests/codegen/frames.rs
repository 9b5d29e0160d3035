//! Base and tool frames given at run time, in C and Rust, compared with products of isometries and the library's placed solver.

use std::fmt::Write as _;
use std::fs;

use groebot_ik::codegen::{rust, single_file};
use groebot_ik::solver::Placement;
use groebot_robot::kinematics::{Target, Task};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::harness::{compile_solver, feed, rustc, write_c};
use super::random;
use super::stored::named;

fn numbers(pose: &Isometry3<f64>) -> Vec<f64> {
    let rotation = pose.rotation.to_rotation_matrix();
    pose.translation.vector.iter().copied().chain((0..9).map(|i| rotation[(i / 3, i % 3)])).collect()
}

/// base, tool, and the pose of the tool in the world: every fourth is out of reach.
fn cases(reached: impl Fn(&[f64]) -> Vec<f64>) -> Vec<[Isometry3<f64>; 3]> {
    let mut between = random();
    let case = |index: usize| {
        let mut pose = |size: f64| {
            let [x, y, z, roll, pitch, yaw] = std::array::from_fn(|_| between(-3.0, 3.0));
            Isometry3::from_parts(
                Translation3::new(size * x, size * y, size * z),
                UnitQuaternion::from_euler_angles(roll, pitch, yaw),
            )
        };
        let (base, tool, far) = (pose(1.0), pose(0.1), pose(1.0));
        let q: Vec<f64> = (0..6).map(|_| between(-3.0, 3.0)).collect();
        let Ok(Target::Pose(tip)) = Task::Pose.layout().target(&reached(&q)) else { unreachable!() };
        [base, tool, if index.is_multiple_of(4) { far } else { base * tip * tool }]
    };
    (0..40).map(case).collect()
}

#[test]
fn a_base_and_a_tool_are_taken_off_a_pose() {
    let program = named(&["puma"]).remove(0).program;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write_c(&program, path);
    fs::write(path.join("5_solver.rs"), rust::emit(&program)).unwrap();
    fs::write(path.join("single_solver.rs"), single_file::rust(&program)).unwrap();
    fs::write(path.join("main.c"), C_DRIVER).unwrap();
    fs::write(path.join("module.rs"), RUST_DRIVER).unwrap();
    let alone = RUST_DRIVER.replace("5_solver", "single_solver").replace("groebot_runtime::", "solver::");
    fs::write(path.join("alone.rs"), alone).unwrap();
    if compile_solver(&program, path, &[], "c99").is_none()
        || ["module.rs", "alone.rs"].iter().any(|file| rustc(path, &[file]).is_none())
    {
        return;
    }
    let solver = program.solver();
    let cases = cases(|q| solver.reached(q).unwrap());
    let mut text = String::new();
    for case in &cases {
        case.iter().flat_map(numbers).for_each(|value| write!(text, "{value:e} ").unwrap());
        text.push('\n');
    }
    for executable in ["c99", "module", "alone"] {
        let output = feed(&path.join(executable), text.clone());
        let mut words = output.split_whitespace().map(|word| word.parse::<f64>().unwrap());
        let mut solutions = 0;
        for [base, tool, pose] in &cases {
            let placed = solver.placed(&Placement::default().base(*base).tool(*tool)).unwrap();
            let target: Vec<f64> = words.by_ref().take(12).collect();
            assert_eq!(target, placed.base_from_tip(&numbers(pose)), "{executable}");
            for (value, expected) in target.iter().zip(numbers(&(base.inverse() * pose * tool.inverse()))) {
                assert!((value - expected).abs() < 1e-14 * 20.0, "{executable}: {value} {expected}");
            }
            let expected = placed.solve_numbers(&numbers(pose)).unwrap();
            assert_eq!(words.next().unwrap() as usize, expected.len(), "{executable}");
            for solution in &expected {
                assert_eq!(words.by_ref().take(6).collect::<Vec<f64>>(), solution.q, "{executable}");
            }
            solutions += expected.len();
        }
        assert_eq!(words.next(), None);
        assert!(solutions > 100, "{executable}: {solutions}");
    }
}

/// No base and no tool are the identity in C, and tasks without a pose have neither.
#[test]
fn c_without_base_and_tool_is_the_plain_solver() {
    for (name, driver) in [("puma", PLAIN_DRIVER), ("polar", REFUSED_DRIVER)] {
        let program = named(&[name]).remove(0).program;
        let folder = tempfile::tempdir().unwrap();
        write_c(&program, folder.path());
        fs::write(folder.path().join("main.c"), driver).unwrap();
        if compile_solver(&program, folder.path(), &[], "c99").is_none() {
            return;
        }
        assert_eq!(feed(&folder.path().join("c99"), String::new()), "as it must be\n", "{name}");
    }
}

const C_DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>

int main(void)
{
    double given[36], target[12];
    puma_solution list[PUMA_CAPACITY];
    for (;;) {
        for (int i = 0; i < 36; i++) {
            if (scanf("%lf", &given[i]) != 1) {
                return 0;
            }
        }
        puma_target_of(given, given + 12, given + 24, target);
        for (int i = 0; i < 12; i++) {
            printf("%.17g ", target[i]);
        }
        const int count = puma_solve_placed(given, given + 12, given + 24, list);
        printf("%d ", count);
        for (int i = 0; i < count; i++) {
            for (int joint = 0; joint < 6; joint++) {
                printf("%.17g ", list[i].q[joint]);
            }
        }
    }
}
"#;

const PLAIN_DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>
#include <string.h>

int main(void)
{
    const double q[6] = {0.3, -0.7, 0.9, 0.4, 0.8, -1.1};
    double target[12];
    puma_solution a[PUMA_CAPACITY], b[PUMA_CAPACITY];
    puma_forward(q, target);
    const int count = puma_solve(target, a), same = puma_solve_placed(NULL, NULL, target, b);
    int equal = count == same && count == 8;
    for (int i = 0; i < count && equal; i++) {
        equal = !memcmp(a[i].q, b[i].q, sizeof a[i].q);
    }
    puts(equal ? "as it must be" : "different");
    return 0;
}
"#;

const REFUSED_DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>

int main(void)
{
    const double target[POLAR_INPUTS] = {0};
    polar_solution out[POLAR_CAPACITY];
    puts(polar_solve_placed(NULL, NULL, target, out) == GB_NOT_POSE ? "as it must be" : "solved");
    return 0;
}
"#;

const RUST_DRIVER: &str = r#"//! Prints the target of a placed tool, and its solutions.
#[allow(dead_code, unused_imports)]
#[path = "5_solver.rs"]
mod solver;
use solver::{CAPACITY, EMPTY, Solve, Solver};

fn main() {
    let text = std::io::read_to_string(std::io::stdin()).unwrap();
    let values: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    for case in values.chunks(36) {
        let [base, tool, pose] = [0, 12, 24].map(|start| case[start..start + 12].try_into().unwrap());
        groebot_runtime::target_of(&base, &tool, &pose).iter().for_each(|value| print!("{value:e} "));
        let mut list = [EMPTY; CAPACITY];
        let placement = groebot_runtime::Placement { base, tool };
        let count = Solver.solve_placed(&placement, &pose, &mut list).unwrap();
        print!("{count} ");
        list[..count].iter().flat_map(|one| one.q).for_each(|value| print!("{value:e} "));
    }
}
"#;
