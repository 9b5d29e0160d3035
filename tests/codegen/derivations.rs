//! The committed mechanisms: their files are what a derivation writes today, and their printed solvers answer like the program.

use std::fs;
use std::path::{Path, PathBuf};

use groebot::Watch;
use groebot::codegen;
use groebot::derive::{Derivation, Source};
use groebot::solver::Program;

use super::harness::compare;

const MECHANISMS: [&str; 2] = ["nao_leg_sagittal", "nao_arm_planar"];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations").join(name)
}

/// Every committed stage is written again, byte for byte. `UPDATE_GOLDEN=1` rewrites them instead, and the diff is then to be read.
#[test]
fn committed_files_are_what_a_derivation_writes() {
    for name in MECHANISMS {
        let source = Source::read(&folder(name)).unwrap();
        let derivation = Derivation::new(source.system.clone().unwrap(), &Watch::none()).unwrap();
        let mut files = derivation.stage_files().unwrap();
        files.push(("5_solver.rs".to_owned(), codegen::rust::emit(&derivation.program).into_bytes()));
        files.push(("5_solver.c".to_owned(), codegen::c99::emit(&derivation.program).into_bytes()));
        for (file, bytes) in files {
            let path = folder(name).join(file);
            if std::env::var_os("UPDATE_GOLDEN").is_some() {
                fs::write(&path, &bytes).unwrap();
            }
            let stored = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(stored == bytes, "{} is out of date: UPDATE_GOLDEN=1 cargo test rewrites it", path.display());
        }
    }
}

/// Reachable, unreachable, boundary and degenerate targets, and what is no target.
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
        if let Some(report) = compare(&program, &targets) {
            assert!(report.answers > 4000 && report.refused == 2, "{report:?}");
        }
    }
}
