//! The fuzz targets of `fuzz/` with the stable compiler. Their lists are equal. Seeds, inputs that failed in the past and damaged seeds are accepted or refused
//! without a fault.

mod damage;
mod lists;
#[path = "../../fuzz/src/lib.rs"]
mod targets;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use damage::Damage;
use targets::Target;

/// Maximum duration for an input, in an unoptimised build on a very busy machine. An input that exceeds it is a hang.
const SLOWEST: Duration = Duration::from_secs(300);

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn all() -> impl Iterator<Item = &'static Target> {
    targets::TARGETS.into_iter().flatten()
}

/// The files of a folder sorted by name, with their bytes; empty if there is no folder.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), fs::read(&path).unwrap())).collect()
}

fn seeds(target: &Target) -> Vec<(PathBuf, Vec<u8>)> {
    files(&root().join("fuzz/seeds").join(target.name))
}

/// Inputs for which the target failed in the past.
fn regressions(target: &Target) -> Vec<(PathBuf, Vec<u8>)> {
    files(&root().join("tests/regressions/fuzz").join(target.name))
}

/// Runs a target with `bytes`. Returns its fault, if there is one.
fn fault(target: &Target, bytes: &[u8]) -> Option<String> {
    let begun = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| targets::run(target.name, bytes)));
    let input = String::from_utf8_lossy(bytes);
    match outcome {
        Err(_) => Some(format!("{} panics (see above) on {input:?}", target.name)),
        Ok(()) if begun.elapsed() > SLOWEST => {
            Some(format!("{} takes {:?} on {input:?}", target.name, begun.elapsed()))
        }
        Ok(()) => None,
    }
}

/// The faults of a target for these inputs.
fn faults(target: &Target, inputs: impl Iterator<Item = Vec<u8>>) -> Vec<String> {
    let begun = Instant::now();
    let faults = inputs.filter_map(|bytes| fault(target, &bytes)).collect();
    println!("{:>8.0?}  {}", begun.elapsed(), target.name);
    faults
}

/// Fails if there are faults, and prints all of them.
fn refuse(faults: &[String]) {
    let (count, text) = (faults.len(), faults.join("\n"));
    assert!(faults.is_empty(), "{count} faults; keep each input in tests/regressions/fuzz:\n{text}");
}

#[test]
fn seeds_and_inputs_that_once_failed_are_answered_or_refused() {
    let inputs = |target| seeds(target).into_iter().chain(regressions(target)).map(|(_, bytes)| bytes);
    refuse(&all().flat_map(|target| faults(target, inputs(target))).collect::<Vec<_>>());
}

#[test]
fn damaged_seeds_are_answered_or_refused() {
    let found = |target: &Target| {
        let seeds: Vec<Vec<u8>> = seeds(target).into_iter().map(|(_, bytes)| bytes).collect();
        faults(target, Damage::of(&seeds).take(target.damaged))
    };
    refuse(&all().flat_map(found).collect::<Vec<_>>());
}
