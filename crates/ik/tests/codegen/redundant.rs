//! Printed solvers of redundant arms: compiled, run, and compared with the library, to the last bit.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use groebot_ik::Watch;
use groebot_ik::codegen::c99::Pair;
use groebot_ik::codegen::{ikfast, rust, single_file};
use groebot_ik::derive::{Derivation, Source};
use groebot_ik::solver::Program;
use groebot_robot::kinematics::Chain;
use groebot_runtime::Error;
use groebot_runtime::redundant::{Arc, Best, Criterion, Limits, Members, Q, SolveRedundant, Target, Within};
use serde_json::Value;

use super::harness::{build, c_runtime, compile_c, feed, rustc, write_pair};
use super::{random, stored};

include!("drivers/arcs.rs.txt");

const C_DRIVER: &str = include_str!("drivers/arcs.c.txt");

/// The objects of the run time that a redundant arm needs.
const RUN_TIME: [&str; 3] = ["groebot.c", "groebot_six_axes.c", "groebot_redundant.c"];

/// An arm of `tests/corpus/redundant`.
pub(super) struct Arm {
    pub(super) chain: Chain,
    pub(super) program: Program,
}

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus/redundant")
}

fn derived(name: &str) -> Arm {
    let mut source = Source::read(&corpus().join(format!("arms/{name}.urdf"))).unwrap();
    let chain = source.chain.clone().unwrap();
    source.choose_given(&Watch::none()).unwrap();
    let derivation = Derivation::of(&source, &Watch::none()).unwrap();
    Arm { chain, program: derivation.program().clone() }
}

/// A Panda: with joints 1 to 3 given, six joints are solved together, and joints 2 and 3 are between them.
pub(super) fn panda() -> &'static Arm {
    static ARM: OnceLock<Arm> = OnceLock::new();
    ARM.get_or_init(|| derived("panda"))
}

/// An iiwa 14: closed forms, and a constant joint.
fn iiwa() -> &'static Arm {
    static ARM: OnceLock<Arm> = OnceLock::new();
    ARM.get_or_init(|| derived("iiwa14"))
}

/// The targets of joint values, each followed by other joint values.
fn rows(arm: &Arm, count: usize) -> Vec<[f64; 19]> {
    let mut between = random();
    let limits: Vec<(f64, f64)> = arm.chain.joints().iter().map(|joint| joint.limits.unwrap()).collect();
    let mut vector = |k: usize| -> Vec<f64> {
        let round = |value: f64| if k % 4 == 1 { (value * 12.0 / std::f64::consts::PI).round() / 12.0 } else { value };
        limits.iter().map(|(low, high)| round(between(*low, *high)).clamp(*low, *high)).collect()
    };
    let mut rows = Vec::new();
    for k in 0..count {
        let mut target = stored::reached(&arm.chain, &vector(k));
        match k % 10 {
            3 => target[0] += 2.0,
            4 => target[5] += 0.5,
            5 => target[2] = f64::NAN,
            _ => {}
        }
        rows.push(std::array::from_fn(|i| if i < 12 { target[i] } else { 0.0 }));
        rows[k][12..].copy_from_slice(&vector(k));
    }
    rows
}

/// What the library prints for the rows.
fn expected(arm: &Arm, rows: &[[f64; 19]]) -> String {
    let solver = arm.program.redundant_solver().unwrap();
    let limits = solver.arm_data().limits;
    let of = |row: &[f64; 19]| {
        let target = std::array::from_fn(|i| row[i]);
        report(&solver, &target, &limits, &std::array::from_fn(|i| row[12 + i]))
    };
    rows.iter().map(of).collect()
}

/// The rows as the input of a driver.
fn input(rows: &[[f64; 19]]) -> String {
    let mut text = String::new();
    for number in rows.iter().flatten() {
        writeln!(text, "{number:e}").unwrap();
    }
    text
}

fn write_c(arm: &Arm, folder: &Path) {
    write_pair(folder, &Pair::new(&arm.program, "5_solver"));
    fs::write(folder.join("main.c"), C_DRIVER.replace("HEADER", "5_solver.h").replace("NAME", &arm.program.name))
        .unwrap();
}

/// The two C files with the run time, by one compiler. `None` if it is not installed.
fn compile(compiler: &str, folder: &Path, options: &[&str], files: &[&str]) -> Option<()> {
    let mut command = Command::new(compiler);
    command.args("-std=c99 -Wall -Wextra -pedantic -Werror".split(' ')).arg(format!("-I{}", c_runtime().display()));
    command.args(options).args(files).args(RUN_TIME.map(|name| c_runtime().join(name)));
    build(command.args(["-lm", "-o", "c99"]).current_dir(folder))
}

/// Panics with the first line in which two texts differ.
fn assert_equal(found: &str, expected: &str, place: &str) {
    if found == expected {
        return;
    }
    let differs = found.lines().zip(expected.lines()).position(|(a, b)| a != b);
    let line = differs.unwrap_or_else(|| found.lines().count().min(expected.lines().count()));
    let of = |text: &str| text.lines().nth(line).unwrap_or_default().to_owned();
    panic!("{place}: line {line}: {} instead of {}", of(found), of(expected));
}

/// The Rust file in a program that reads rows.
fn rust_driver(import: &str) -> String {
    let types = "Arc, Best, Criterion, Error, Limits, Members, Q, SolveRedundant, Target, Within, RedundantSolver, ARM";
    format!(
        "{import}\nuse solver::{{{types}}};\n{}\nfn main() {{\n    let text = std::io::read_to_string(std::io::stdin()).unwrap();\n    \
         let values: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();\n    for row in values.chunks(19) {{\n        \
         let target = std::array::from_fn(|i| row[i]);\n        let q0 = std::array::from_fn(|i| row[12 + i]);\n        \
         print!(\"{{}}\", report(&RedundantSolver, &target, &ARM.limits, &q0));\n    }}\n}}\n",
        include_str!("drivers/arcs.rs.txt")
    )
}

fn prints_equal_arcs(arm: &Arm, count: usize) {
    let rows = rows(arm, count);
    let (expected, input) = (expected(arm, &rows), input(&rows));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write_c(arm, path);
    for (compiler, optimised) in [("gcc", "-O1"), ("clang", "-O0")] {
        if compile(compiler, path, &[optimised], &["main.c", "5_solver.c"]).is_some() {
            assert_equal(&feed(&path.join("c99"), input.clone()), &expected, compiler);
        }
    }
    fs::write(path.join("5_solver.rs"), rust::emit(&arm.program)).unwrap();
    fs::write(path.join("module.rs"), rust_driver("#[path = \"5_solver.rs\"]\nmod solver;")).unwrap();
    if rustc(path, &["module.rs"]).is_some() {
        assert_equal(&feed(&path.join("module"), input), &expected, "Rust");
    }
    assert!(expected.lines().filter(|line| line.starts_with("arc ")).count() > count, "{}", arm.program.name);
}

#[test]
fn a_printed_panda_has_the_arcs_of_the_library() {
    prints_equal_arcs(panda(), 30);
}

#[test]
#[ignore = "two minutes: the largest printed file"]
fn a_printed_iiwa_has_the_arcs_of_the_library() {
    prints_equal_arcs(iiwa(), 30);
}

/// The numbers of lines `NAME word ...` of a driver's output.
fn numbers(text: &str, name: &str) -> Vec<Vec<f64>> {
    let number = |word: &str| f64::from_bits(u64::from_str_radix(word, 16).unwrap());
    let lines = text.lines().filter_map(|line| line.strip_prefix(name)?.strip_prefix(' '));
    lines.map(|line| line.split(' ').map(number).collect()).collect()
}

/// The ready pose of a Panda has three arcs with six end points, which `scripts/redundant` computed without this library.
#[test]
fn a_printed_panda_has_the_witnessed_arcs_of_its_ready_pose() {
    let page: Value = serde_json::from_str(&fs::read_to_string(corpus().join("panda.json")).unwrap()).unwrap();
    let pose = &page["poses"][0];
    let list = |value: &Value| -> Vec<f64> { value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect() };
    let (arm, q) = (panda(), list(&pose["q"]));
    let target = stored::reached(&arm.chain, &q);
    let row = std::array::from_fn(|i| if i < 12 { target[i] } else { q[i - 12] });
    let folder = tempfile::tempdir().unwrap();
    write_c(arm, folder.path());
    if compile("gcc", folder.path(), &["-O0"], &["main.c", "5_solver.c"]).is_none() {
        return;
    }
    let output = feed(&folder.path().join("c99"), input(&[row]));
    let arcs: Vec<&Value> = pose["arcs"].as_array().unwrap().iter().collect();
    let mut lengths: Vec<f64> = numbers(&output, "length").concat();
    lengths.sort_by(|a, b| b.total_cmp(a));
    assert_eq!(lengths.len(), 3, "{output}");
    for (length, arc) in lengths.iter().zip(&arcs) {
        assert!((length - arc[0].as_f64().unwrap()).abs() < 1e-5, "{lengths:?}");
    }
    let ends: Vec<&str> = output.split("end ").skip(1).collect();
    assert_eq!(ends.len(), 6, "{output}");
    for (at, q) in arcs.iter().flat_map(|arc| [(&arc[2], &arc[3]), (&arc[4], &arc[5])]) {
        let (joint, side) = at.as_str().unwrap().split_at(1);
        let head = format!("{} {}\n", joint.parse::<i32>().unwrap() - 1, u8::from(side == "+"));
        let is_same = |end: &&str| {
            let near = |found: &[f64]| found.iter().zip(list(q)).all(|(a, b)| (a - b).abs() < 1e-5);
            end.starts_with(&head) && near(&numbers(end, "q")[0])
        };
        assert!(ends.iter().any(is_same), "{at} {q}\n{output}");
    }
}

/// In C++, in single precision, where only the main solver is left, and in one file. Constants may be too small for single precision.
#[test]
fn a_printed_redundant_arm_compiles_in_every_form() {
    let arm = panda();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write_c(arm, path);
    let write = |file: &str, text: &str| fs::write(path.join(file), text).unwrap();
    let own = arm.program.name.to_ascii_uppercase();
    write("single.c", &single_file::c(&arm.program, "single.c", false));
    write("float.c", &single_file::c(&arm.program, "float.c", true));
    let driver = C_DRIVER.replace("HEADER", "single.c").replace("NAME", &arm.program.name);
    write("one.c", &format!("#define {own}_DECLARATIONS_ONLY\n{driver}"));
    let runtime = format!("-I{}", c_runtime().display());
    let plus = "-x c++ -std=c++11 -Wall -Wextra -Werror -pedantic -fsyntax-only 5_solver.c";
    let compiled = build(Command::new("g++").arg(runtime).args(plus.split(' ')).current_dir(path))
        .and_then(|()| compile_c(path, &["-DGB_FLOAT", "-Wno-overflow", "-fsyntax-only", "5_solver.c"]))
        .and_then(|()| compile_c(path, &["-DGB_LANES=1", "-fsyntax-only", "5_solver.c"]))
        .and_then(|()| compile_c(path, &["-Wno-overflow", "-fsyntax-only", "float.c"]))
        .and_then(|()| compile_c(path, &["one.c", "single.c", "-lm", "-o", "one"]));
    if compiled.is_none() {
        return;
    }
    let rows = rows(arm, 6);
    assert_equal(&feed(&path.join("one"), input(&rows)), &expected(arm, &rows), "one file");
    write("single.rs", &single_file::rust(&arm.program));
    write("root.rs", "#![no_std]\n#[path = \"single.rs\"]\npub mod solver;\n");
    write("crate.rs", &rust_driver("use no_std_root::solver;"));
    let library = ["--crate-type=lib", "--crate-name=no_std_root", "--cfg=feature=\"libm\"", "root.rs"];
    if rustc(path, &library).is_none()
        || rustc(path, &["--extern=no_std_root=libno_std_root.rlib", "crate.rs"]).is_none()
    {
        return;
    }
    assert_equal(&feed(&path.join("crate"), input(&rows)), &expected(arm, &rows), "one Rust file");
}

/// The file for IKFast's callers has one free joint, and no arcs.
#[test]
fn the_file_for_ikfast_has_only_the_main_solver() {
    let program = &panda().program;
    let alone = Program { redundancy: None, ..program.clone() };
    let [text, expected] = [program, &alone].map(|program| ikfast::emit(program, &Default::default()).unwrap());
    assert!(text == expected && !text.contains("gb_arm"));
}
