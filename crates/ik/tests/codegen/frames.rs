//! Base and tool frames given at run time, in C and Rust, compared with products of isometries.

use std::fmt::Write as _;
use std::fs;

use groebot_ik::codegen::rust;
use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::harness::{compile_solver, feed, rustc, write_c};
use super::random;
use super::stored::named;

fn numbers(pose: &Isometry3<f64>) -> Vec<f64> {
    let rotation = pose.rotation.to_rotation_matrix();
    pose.translation.vector.iter().copied().chain((0..9).map(|i| rotation[(i / 3, i % 3)])).collect()
}

#[test]
fn a_base_and_a_tool_are_taken_off_a_pose() {
    let program = named(&["puma"]).remove(0).program;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write_c(&program, path);
    fs::write(path.join("5_solver.rs"), rust::emit(&program)).unwrap();
    fs::write(path.join("main.c"), C_DRIVER).unwrap();
    fs::write(path.join("module.rs"), RUST_DRIVER).unwrap();
    if compile_solver(&program, path, &[], "c99").is_none() || rustc(path, &["module.rs"]).is_none() {
        return;
    }
    let mut between = random();
    let mut pose = || {
        let [x, y, z, roll, pitch, yaw] = std::array::from_fn(|_| between(-3.0, 3.0));
        Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
    };
    let cases: Vec<[Isometry3<f64>; 3]> = (0..20).map(|_| [pose(), pose(), pose()]).collect();
    let mut text = String::new();
    for case in &cases {
        case.iter().flat_map(numbers).for_each(|value| write!(text, "{value:e} ").unwrap());
        text.push('\n');
    }
    for executable in ["c99", "module"] {
        let output = feed(&path.join(executable), text.clone());
        let mut words = output.split_whitespace().map(|word| word.parse::<f64>().unwrap());
        for [base, tool, pose] in &cases {
            for expected in numbers(&(base.inverse() * pose * tool.inverse())) {
                let value = words.next().unwrap();
                assert!((value - expected).abs() < 1e-14 * 20.0, "{executable}: {value} {expected}");
            }
        }
        assert_eq!(words.next(), None);
    }
}

const C_DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>

int main(void)
{
    double given[36], target[12];
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
    }
}
"#;

const RUST_DRIVER: &str = r#"
#[allow(dead_code, unused_imports)]
#[path = "5_solver.rs"]
mod solver;

fn main() {
    let text = std::io::read_to_string(std::io::stdin()).unwrap();
    let numbers: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    for case in numbers.chunks(36) {
        let [base, tool, pose] = [0, 12, 24].map(|start| case[start..start + 12].try_into().unwrap());
        groebot_runtime::target_of(&base, &tool, &pose).iter().for_each(|value| print!("{value:e} "));
    }
}
"#;
