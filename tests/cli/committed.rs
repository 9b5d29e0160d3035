//! The folders of `derivations/`: each is equal to the output of `groebot derive`, byte for byte, and passes `groebot check` (those of `SLOW_CHECKS` with
//! `--ignored`). A folder whose outputs no other file reads is thin: it has hashes of the outputs. `UPDATE_GOLDEN=1` derives all folders again. Review the diff
//! afterwards.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use groebot::Watch;
use groebot::codegen::{c99::Pair, ikfast, rust};
use groebot::derive::{Derivation, Source};
use groebot_ik::folder::{OUTPUTS, Outputs, PROGRAM, Written};

use super::{root, run, text};

/// The folders with all outputs, each with a file that reads one of them. All other folders are thin.
const FULL: [(&str, &str); 25] = [
    ("crx_like", "crates/ik/tests/eigenvalue/curve.rs"),
    ("general_5r1p", "crates/ik/tests/codegen/six_axes.rs"),
    ("general_6r", "viewer/wasm/compare.mjs"),
    ("iiwa14", "python/src/known.rs"),
    ("irb120", "python/src/known.rs"),
    ("irb4600_rounded", "benches/singular/build.rs"),
    ("jaco_like", "crates/ik/tests/codegen/six_axes.rs"),
    ("nao_arm_planar", "crates/ik/tests/folder/records.rs"),
    ("nao_head", "python/src/known.rs"),
    ("nao_left_arm", "python/src/known.rs"),
    ("nao_left_leg", "python/src/known.rs"),
    ("nao_leg_sagittal", "README.md"),
    ("nao_right_arm", "python/src/known.rs"),
    ("nao_right_leg", "python/src/known.rs"),
    ("planar_2r", "tests/cli/check.rs"),
    ("polar", "tests/cli/check.rs"),
    ("puma", "python/src/known.rs"),
    ("puma560", "python/src/known.rs"),
    ("rh0_left_leg", "python/src/known.rs"),
    ("rh0_right_leg", "python/src/known.rs"),
    ("scara", "python/src/known.rs"),
    ("spherical_wrist", "benches/peers/src/by_print.rs"),
    ("stanford", "python/src/known.rs"),
    ("teo_leg", "python/src/known.rs"),
    ("ur5", "python/src/known.rs"),
];

/// Folders whose check takes long, each with a folder of its kind that is checked instead. The `--ignored` test also checks these.
const SLOW_CHECKS: [(&str, &str); 4] = [
    ("general_6r", "gen3_like"),
    ("jaco_like", "crx_like"),
    ("nao_legs", "nao_legs_yaw"),
    ("ur5_calibrated", "irb4600_rounded"),
];

/// Whether a folder must have all outputs.
fn is_full(folder: &Path) -> bool {
    FULL.iter().any(|(name, _)| folder.ends_with(name))
}

/// All folders, slowest first.
fn folders() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations");
    let mut folders: Vec<PathBuf> = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let slowest = ["nao_legs_yaw", "nao_legs", "nao_legs_poses", "ur5_calibrated", "general_6r"];
    folders.sort_by_key(|folder| slowest.iter().position(|name| folder.ends_with(name)).unwrap_or(slowest.len()));
    folders
}

/// The direction of gravity in a folder with equations of motion.
fn gravity_of(folder: &Path) -> Option<String> {
    let certificate = fs::read_to_string(folder.join("7_dynamics.json")).ok()?;
    let certificate: serde_json::Value = serde_json::from_str(&certificate).unwrap();
    let entries: Vec<String> = serde_json::from_value(certificate["claims"]["gravity"].clone()).unwrap();
    Some(entries.join(","))
}

/// The fault of a folder: a stage that differs from the derivation's output, a file that no derivation writes, or, if `is_checked`, a failed check.
fn fault(folder: &Path, is_checked: bool) -> Option<String> {
    let source = Source::read(folder).unwrap();
    let proved = match Derivation::of(&source, &Watch::none()) {
        Ok(proved) => proved.about(&source),
        Err(error) => return Some(error.to_string()),
    };
    let program = proved.program();
    let mut files = proved.stage_files().unwrap();
    let Pair { header, source, .. } = Pair::new(program, "5_solver");
    let printed = [("5_solver.rs", rust::emit(program)), ("5_solver.c", source), ("5_solver.h", header)];
    let plugin =
        ikfast::emit_beside(program, &ikfast::Options::default(), "5_solver").ok().map(|text| ("5_ikfast.cpp", text));
    files.extend(printed.into_iter().chain(plugin).map(|(name, text)| (name.to_owned(), text.into_bytes())));
    let hashes = fs::read_to_string(folder.join(OUTPUTS)).ok().map(|text| Outputs::read(&text).unwrap());
    let written = files.iter().cloned().map(|(name, bytes)| Written { name, proved: bytes.len(), bytes });
    let proved_hashes = Outputs::of(&written.collect::<Vec<_>>());
    for (name, bytes) in &files {
        if let (Some(hashes), Some(hash)) = (&hashes, proved_hashes.get(name)) {
            if hashes.get(name) != Some(hash) {
                return Some(format!("{OUTPUTS} has another hash of {name}"));
            }
            continue;
        }
        let Ok(stored) = fs::read(folder.join(name)) else { return Some(format!("{name} is missing")) };
        // The results of the numeric check are last; `groebot check` tests them.
        let own = if name == "README.md" { &stored[..bytes.len().min(stored.len())] } else { &stored };
        if own != bytes {
            return Some(format!("{name} is out of date"));
        }
    }
    let is_known = |name: &str| {
        files.iter().any(|(known, _)| known == name)
            || name == "6_check.csv"
            || !name.starts_with(['1', '2', '3', '4', '5', '6'])
    };
    let unknown = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    assert_eq!(folder.join("7_dynamics.txt").exists(), folder.join("7_dynamics.json").exists());
    if let Some(name) = unknown.into_iter().find(|name| !is_known(name)) {
        return Some(format!("no derivation writes {name}"));
    }
    if let Some(gravity) = gravity_of(folder) {
        let reported = run(&["dynamics", "--symbolic", text(folder), "--gravity", &gravity]);
        if reported.code != 0 || fs::read_to_string(folder.join("7_dynamics.txt")).ok().as_ref() != Some(&reported.out)
        {
            return Some("7_dynamics.txt is out of date".to_owned());
        }
    }
    is_checked.then(|| check_fault(folder)).flatten()
}

fn check_fault(folder: &Path) -> Option<String> {
    let ran = run(&["check", text(folder)]);
    (ran.code != 0).then_some(ran.out + &ran.err)
}

#[test]
#[ignore = "a minute: the checks that take longest"]
fn folders_whose_check_takes_long_pass_it() {
    for (name, _) in SLOW_CHECKS {
        assert_eq!(check_fault(&root("derivations").join(name)), None);
    }
}

#[test]
fn every_folder_is_what_a_derivation_writes_and_passes_its_check() {
    let folders = folders();
    assert!(folders.len() >= 44, "{}", folders.len());
    for (slow, instead) in SLOW_CHECKS {
        assert!([slow, instead].iter().all(|name| folders.iter().any(|folder| folder.ends_with(name))), "{slow}");
    }
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        for folder in &folders {
            let layout = if is_full(folder) { "--full" } else { "--thin" };
            super::succeed(&["derive", text(folder), "--quiet", layout]);
            if let Some(gravity) = gravity_of(folder) {
                super::succeed(&["dynamics", "--symbolic", text(folder), "-o", text(folder), "--gravity", &gravity]);
            }
        }
        return;
    }
    let (next, workers) = (AtomicUsize::new(0), std::thread::available_parallelism().map_or(1, usize::from));
    let work = || -> Vec<String> {
        std::iter::from_fn(|| folders.get(next.fetch_add(1, Ordering::Relaxed)))
            .filter_map(|folder| {
                let is_checked = !SLOW_CHECKS.iter().any(|(name, _)| folder.ends_with(name));
                Some(format!("{}: {}", folder.display(), fault(folder, is_checked)?))
            })
            .collect()
    };
    let faults: Vec<String> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(faults.is_empty(), "UPDATE_GOLDEN=1 derives them again:\n{}", faults.join("\n"));
}

/// Outputs are committed if some file reads them, and not otherwise.
#[test]
fn folders_have_outputs_where_something_reads_them() {
    for (name, reader) in FULL {
        let text = fs::read_to_string(root(reader)).unwrap();
        assert!(text.contains(name), "{reader} does not read {name}");
    }
    for folder in folders() {
        let has = [PROGRAM, OUTPUTS].map(|file| folder.join(file).exists());
        let full = is_full(&folder);
        assert_eq!(has, [full, !full], "{}: [{PROGRAM}, {OUTPUTS}]", folder.display());
    }
}

/// The lines that a reviewer of a change reads: outputs and certificates.
#[test]
fn outputs_and_certificates_have_fewer_than_60_000_lines() {
    let is_counted =
        |name: &str| name.starts_with(|first: char| ('1'..='9').contains(&first)) || name == "certificate.json";
    let entries = folders().into_iter().flat_map(|folder| fs::read_dir(folder).unwrap());
    let files = entries.map(|entry| entry.unwrap().path());
    let counted = files.filter(|path| is_counted(path.file_name().unwrap().to_str().unwrap()));
    let lines: usize = counted.map(|path| fs::read_to_string(path).unwrap().lines().count()).sum();
    assert!(lines < 60_000, "{lines}");
}
