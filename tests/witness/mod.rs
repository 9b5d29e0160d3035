//! The checks of derived programs: right programs pass, damaged ones do not.

mod chains;
mod screws;

use groebot::Watch;
use groebot::derive::{Derivation, Source};
use groebot::solver::Program;
use groebot::witness::{Check, Options, Report};
use std::path::Path;

pub fn read(folder: &str) -> Source {
    Source::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations").join(folder)).unwrap()
}

pub fn from_text(text: &str) -> Source {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("input.toml");
    std::fs::write(&file, text).unwrap();
    Source::read(&file).unwrap()
}

pub fn derive(source: &Source) -> Derivation {
    Derivation::new(source.system.clone(), &Watch::none()).unwrap()
}

pub fn check(source: &Source, program: &Program, targets: usize) -> Report {
    let options = Options { targets, oracle: 10, exact: 40, ..Options::default() };
    Check::run(source, program, &options, &Watch::none()).unwrap()
}

pub fn assert_passes(source: &Source, program: &Program, targets: usize) -> Report {
    let report = check(source, program, targets);
    let failures: Vec<String> = report.failures().map(|row| row.to_string()).collect();
    assert!(failures.is_empty(), "{}: {}\n{}", source.system.name, report.summary(), failures.join("\n"));
    report
}
