//! The checks of derived programs: correct programs pass, damaged ones fail.

mod chain;
mod chains;
mod corners;
mod derived;
mod mounted;
mod rail;
mod round;
mod screws;
mod self_motions;

use groebot_ik::Watch;
use groebot_ik::derive::{Derivation, Source};
use groebot_ik::solver::Program;
use groebot_ik::witness::{Options, Report, check_equations};
use std::path::Path;

pub fn read(folder: &str) -> Source {
    Source::read(&Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(folder)).unwrap()
}

pub fn from_text(text: &str) -> Source {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("input.toml");
    std::fs::write(&file, text).unwrap();
    Source::read(&file).unwrap()
}

pub fn derive(source: &Source) -> Derivation {
    Derivation::of_problem(source.system.clone().unwrap(), &Watch::none()).unwrap()
}

pub fn check(source: &Source, program: &Program, targets: usize) -> Report {
    let options = Options { targets, oracle: 10, exact: 40, ..Options::default() };
    check_equations(source, program, &options, &Watch::none()).unwrap()
}

pub fn assert_passes(source: &Source, program: &Program, targets: usize) -> Report {
    let report = check(source, program, targets);
    let failures: Vec<String> = report.failures().map(|row| row.to_string()).collect();
    assert!(
        failures.is_empty(),
        "{}: {}\n{}",
        source.system.clone().unwrap().name,
        report.summary(),
        failures.join("\n")
    );
    report
}

/// Two links along z with axes along y, in millimetres. `knee` and `tip` are the heights of the knee and the tip.
pub fn two_link_text(knee: &str, tip: &str) -> String {
    format!(
        r#"
name = "two_links"
length_unit = "mm"
[task]
kind = "planar_position"
plane = "xz"
[[joint]]
name = "hip"
type = "revolute"
axis = [0, 1, 0]
point = [0, 0, 0]
[[joint]]
name = "knee"
type = "revolute"
axis = [0, 1, 0]
point = [0, 0, "{knee}"]
[tip]
point = [0, 0, "{tip}"]
"#
    )
}
