//! The folders of `derivations/`: each is what a derivation writes today, byte for byte, and passes `groebot check`.
//! `UPDATE_GOLDEN=1` derives them again instead, and the diff is then to be read.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use groebot::Watch;
use groebot::codegen::{c99::Pair, ikfast, rust};
use groebot::derive::{Derivation, Source};

use super::{run, text};

/// All folders, those that take longest first.
fn folders() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations");
    let mut folders: Vec<PathBuf> = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    let slowest = ["nao_legs_yaw", "nao_legs", "nao_legs_poses", "ur5_calibrated", "general_6r"];
    folders.sort_by_key(|folder| slowest.iter().position(|name| folder.ends_with(name)).unwrap_or(slowest.len()));
    folders
}

/// The direction of gravity of the equations of motion in a folder that has such.
fn gravity_of(folder: &Path) -> Option<String> {
    let certificate = fs::read_to_string(folder.join("7_dynamics.json")).ok()?;
    let certificate: serde_json::Value = serde_json::from_str(&certificate).unwrap();
    let entries: Vec<String> = serde_json::from_value(certificate["claims"]["gravity"].clone()).unwrap();
    Some(entries.join(","))
}

/// What is wrong with a folder: a stage that a derivation writes otherwise, a file that none writes, a failing check.
fn fault(folder: &Path) -> Option<String> {
    let source = Source::read(folder).unwrap();
    let proved = match Derivation::of(&source, &Watch::none()) {
        Ok(proved) => proved.about(&source),
        Err(error) => return Some(error.to_string()),
    };
    let program = proved.program();
    let mut files = proved.stage_files().unwrap();
    let Pair { header, source } = Pair::new(program, "5_solver");
    let printed = [("5_solver.rs", rust::emit(program)), ("5_solver.c", source), ("5_solver.h", header)];
    let plugin =
        ikfast::emit_beside(program, &ikfast::Options::default(), "5_solver").ok().map(|text| ("5_ikfast.cpp", text));
    files.extend(printed.into_iter().chain(plugin).map(|(name, text)| (name.to_owned(), text.into_bytes())));
    for (name, bytes) in &files {
        let Ok(stored) = fs::read(folder.join(name)) else { return Some(format!("{name} is missing")) };
        // What is told of the numeric check comes last; `groebot check` repeats that.
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
        let told = run(&["dynamics", "--symbolic", text(folder), "--gravity", &gravity]);
        if told.code != 0 || fs::read_to_string(folder.join("7_dynamics.txt")).ok().as_ref() != Some(&told.out) {
            return Some("7_dynamics.txt is out of date".to_owned());
        }
    }
    let ran = run(&["check", text(folder)]);
    (ran.code != 0).then_some(ran.out + &ran.err)
}

#[test]
fn every_folder_is_what_a_derivation_writes_and_passes_its_check() {
    let folders = folders();
    assert!(folders.len() >= 44, "{}", folders.len());
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        for folder in &folders {
            super::succeed(&["derive", text(folder), "--quiet"]);
            if let Some(gravity) = gravity_of(folder) {
                super::succeed(&["dynamics", "--symbolic", text(folder), "-o", text(folder), "--gravity", &gravity]);
            }
        }
        return;
    }
    let (next, workers) = (AtomicUsize::new(0), std::thread::available_parallelism().map_or(1, usize::from));
    let work = || -> Vec<String> {
        std::iter::from_fn(|| folders.get(next.fetch_add(1, Ordering::Relaxed)))
            .filter_map(|folder| Some(format!("{}: {}", folder.display(), fault(folder)?)))
            .collect()
    };
    let faults: Vec<String> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(faults.is_empty(), "UPDATE_GOLDEN=1 derives them again:\n{}", faults.join("\n"));
}
