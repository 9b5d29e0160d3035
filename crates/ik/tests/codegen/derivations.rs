//! The committed mechanisms: their files are up to date with derivations, and their printed solvers agree with the program.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fs;
use std::path::{Path, PathBuf};

use groebot_ik::Watch;
use groebot_ik::codegen;
use groebot_ik::derive::{Derivation, Source};
use groebot_ik::solver::Program;

use super::harness::{compare, compare_hosted, compile_c, rustc};
use super::random;
use super::stored::{all, joint_values, named};

const MECHANISMS: [&str; 2] = ["nao_leg_sagittal", "nao_arm_planar"];

fn folder(name: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name)
}

#[test]
fn a_program_names_its_source() {
    for (name, task) in [("planar_2r", "planar_position in xy"), ("nao_head", "direction of [1, 0, 0]")] {
        let mut source = Source::read(&folder(name)).unwrap();
        let about = |source: &Source| {
            let program = Derivation::of(source, &Watch::none()).unwrap().about(source).program().clone();
            (program.task_text(), program.about.unwrap())
        };
        let (asked, about_source) = about(&source);
        assert_eq!((asked.as_str(), about_source.base.as_deref()), (task, None), "{name}");
        let limits: Vec<_> = source.chain.as_ref().unwrap().joints().iter().map(|joint| joint.limits).collect();
        assert!(
            about_source.limits == limits || limits.iter().all(Option::is_none) && about_source.limits.is_empty(),
            "{about_source:?}"
        );
        assert!(
            about_source.hash.len() == 16 && about_source.hash.bytes().all(|byte| byte.is_ascii_hexdigit()),
            "{about_source:?}"
        );
        source.text.push(' ');
        source.links = Some(["torso".into(), "hand".into()]);
        let (_, other) = about(&source);
        let links = (other.base.as_deref(), other.tip.as_deref());
        assert!(other.hash != about_source.hash && links == (Some("torso"), Some("hand")), "{other:?}");
    }
    // From the root of a URDF to its only leaf, without names in the input.
    for text in ["5_solver.h", "5_solver.rs", "5_ikfast.cpp"]
        .map(|file| fs::read_to_string(folder("irb4600_rounded").join(file)))
    {
        let text = text.unwrap();
        assert!(text.contains("Base link: base_link\n") && text.contains("Tip link: tool0\n"), "{text}");
    }
}

/// Reachable, unreachable, boundary, degenerate and invalid targets.
fn targets(reach: f64) -> Vec<Vec<f64>> {
    let mut targets = Vec::new();
    for k in 0..2500 {
        let angle = f64::from(k) * 2.399_963;
        let radius = reach * (f64::from(k) / 2300.0);
        targets.push(vec![radius * angle.cos(), radius * angle.sin()]);
    }
    for k in 0..=18 {
        let small = 10f64.powi(-k);
        for sign in [-1.0, 1.0] {
            let edge = reach * (1.0 + sign * small);
            targets.extend([vec![0.7 * reach, sign * small], vec![sign * small, 0.7 * reach], vec![edge, 0.0]]);
            targets.extend([vec![0.0, -edge], vec![sign * small, small], vec![0.6 * edge, 0.8 * edge]]);
        }
    }
    targets.extend([vec![0.0, 0.0], vec![reach, 0.0], vec![0.0, reach], vec![f64::NAN, 1.0], vec![1.0, f64::INFINITY]]);
    targets
}

#[test]
fn printed_solvers_answer_like_the_program() {
    for (name, reach) in MECHANISMS.into_iter().zip([202.9, 218.7]) {
        let text = fs::read_to_string(folder(name).join("5_program.json")).unwrap();
        let program = Program::from_json(&text).unwrap();
        let targets = targets(reach);
        if let Some(report) = compare_hosted(&program, &targets) {
            assert!(report.answers > 4000 && report.refused == 2, "{report:?}");
        }
    }
}

/// The C file of every stored program conforms strictly to C99, and its Rust file is a module of a crate. Warnings are errors.
#[test]
fn every_stored_solver_compiles() {
    let folder = tempfile::tempdir().unwrap();
    let mut crate_root = "#![deny(warnings)]\n".to_owned();
    let mut names = Vec::new();
    for stored in all() {
        let module = format!("solver_{}", stored.name);
        let pair = codegen::c99::Pair::new(&stored.program, &module);
        fs::write(folder.path().join(format!("{module}.c")), pair.source).unwrap();
        fs::write(folder.path().join(format!("{module}.h")), pair.header).unwrap();
        fs::write(folder.path().join(format!("{module}.rs")), codegen::rust::emit(&stored.program)).unwrap();
        crate_root += &format!("pub mod {module};\n");
        names.push(format!("{module}.c"));
    }
    assert!(names.len() >= 26, "{names:?}");
    fs::write(folder.path().join("root.rs"), crate_root).unwrap();
    let files: Vec<&str> = names.iter().map(String::as_str).collect();
    if compile_c(folder.path(), &[&["-fsyntax-only"], files.as_slice()].concat()).is_some() {
        let small = ["-ffreestanding", "-O1", "-c", "solver_puma.c", "-o", "puma.o"];
        compile_c(folder.path(), &small);
    }
    let library = ["--crate-type=lib", "--emit=metadata", "-Amissing_docs", "root.rs"];
    rustc(folder.path(), &library);
}

/// Targets that a chain reaches, some of them singular, and some that are out of reach or invalid.
pub fn targets_of(program: &Program, count: usize) -> Vec<Vec<f64>> {
    let mut targets: Vec<Vec<f64>> =
        joint_values(program, count, random()).iter().filter_map(|q| program.reached(q)).collect();
    for k in 0..targets.len() / 10 {
        let mut far = targets[k].clone();
        far[0] += 3.0 * program.scale;
        let mut bad = targets[k].clone();
        let place = k % bad.len();
        bad[place] = [f64::NAN, f64::INFINITY, 1e300, -4.0][k % 4];
        targets.extend([far, bad]);
    }
    targets
}

/// Solvers of chains: poses, a given joint, a free one in the middle of the wrist.
#[test]
fn printed_solvers_of_chains_answer_like_the_program() {
    for stored in named(&["puma", "nao_left_leg", "iiwa14", "rrp"]) {
        if let Some(report) = compare_hosted(&stored.program, &targets_of(&stored.program, 200)) {
            assert!(report.answers > 200 && report.refused >= 10, "{report:?}");
        }
    }
}

/// A UR5 with a stretched elbow and wrist and the wrist's offset in line, and poses next to that. The last polishing step differs most there.
#[test]
fn printed_solvers_answer_poses_that_are_singular_twice() {
    let [ur5] = &named(&["ur5"])[..] else { panic!("it is stored") };
    let mut between = random();
    let mut joints = |k: usize| {
        let off = [0.0, 1e-8, 1e-6, 1e-4][k % 4];
        let mut q = [0.0; 6].map(|_| between(-PI, PI));
        (q[2], q[3], q[4]) = (off, -FRAC_PI_2, [0.0, PI][k / 4 % 2]);
        ur5.program.reached(&q).unwrap()
    };
    let targets: Vec<_> = (0..16).map(&mut joints).collect();
    if let Some(report) = compare_hosted(&ur5.program, &targets) {
        assert!(report.answers >= 16, "{report:?}");
    }
}

#[test]
#[ignore = "minutes: every stored chain, ten thousand targets each"]
fn every_printed_solver_answers_like_the_program() {
    for stored in all().iter().filter(|stored| stored.program.forward().is_some()) {
        if let Some(report) = compare(&stored.program, &targets_of(&stored.program, 10_000)) {
            assert!(report.answers >= 10_000 && report.refused > 100, "{report:?}");
        }
    }
}
