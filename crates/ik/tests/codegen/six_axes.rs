//! Printed solvers for six axes by one eigenvalue problem: compiled, run, and compared with the evaluator.

use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::{Chain, Task, along_z};

use super::derivations::targets_of;
use super::harness::{SANITIZERS, compare, compile_solver, feed, has_sanitizers, write_c};
use super::single;
use super::stored::{Stored, named};

const FOLDERS: [&str; 9] = [
    "booster_leg_like",
    "crx_like",
    "gen3_like",
    "general_4r2p",
    "general_5r1p",
    "general_6r",
    "jaco_like",
    "ur5_calibrated",
    "xarm6_like",
];

fn folders() -> Vec<Stored> {
    let stored = named(&FOLDERS);
    assert_eq!(stored.len(), FOLDERS.len());
    stored
}

/// The arithmetic is equal in all languages, so that all joint values are bitwise equal.
#[test]
fn printed_eigenvalue_problems_answer_like_the_program() {
    for stored in named(&["gen3_like", "general_6r"]) {
        if let Some(report) = compare(&stored.program, &targets_of(&stored.program, 120)) {
            assert!(report.answers > 150 && report.refused > 10, "{report:?}");
            assert_eq!(report.unequal, 0, "{}: {report:?}", stored.name);
        }
    }
}

/// A joint between the six is given: the axes after it are moved at run time.
#[test]
fn printed_given_joints_between_the_six_answer_like_the_program() {
    let text = include_str!("../../../../derivations/gen3_like/0_chain.toml");
    let chain = Chain::from_toml(text).unwrap().with_task(Task::Pose, along_z(), vec!["Joint4".to_owned()]).unwrap();
    let derived = Derivation::by_eigenvalues(&chain, None).unwrap();
    if let Some(report) = compare(derived.program(), &targets_of(derived.program(), 120)) {
        assert!(report.answers > 150 && report.refused > 10, "{report:?}");
        assert_eq!(report.unequal, 0, "{report:?}");
    }
}

/// Also next to self-motions, where solutions are found along curves: the targets of the derivation's check.
#[test]
fn printed_walks_along_curves_answer_like_the_program() {
    for stored in named(&["jaco_like", "general_5r1p"]) {
        let singular = |row: &csv::StringRecord| row[0].contains("singular");
        let numbers = |row: csv::StringRecord| row.iter().skip(1).take(12).map(|word| word.parse().unwrap()).collect();
        let path = format!("{}/derivations/{}/6_check.csv", concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), stored.name);
        let mut file = csv::Reader::from_path(path).unwrap();
        let targets: Vec<Vec<f64>> =
            file.records().map(Result::unwrap).filter(singular).step_by(2).map(numbers).collect();
        if let Some(report) = compare(&stored.program, &targets) {
            assert!(report.answers > 75 && report.unequal == 0, "{}: {report:?}", stored.name);
        }
    }
}

#[test]
#[ignore = "minutes: ten thousand targets of each folder"]
fn every_printed_eigenvalue_problem_answers_like_the_program() {
    for stored in folders() {
        if let Some(report) = compare(&stored.program, &targets_of(&stored.program, 10_000)) {
            assert!(report.answers >= 10_000 && report.unequal == 0, "{}: {report:?}", stored.name);
        }
    }
}

/// There is no access out of bounds and no undefined operation, also for invalid targets.
#[test]
fn the_c_file_runs_under_sanitizers() {
    for stored in named(&["crx_like"]) {
        let folder = tempfile::tempdir().unwrap();
        write_c(&stored.program, folder.path());
        let checked = [&SANITIZERS[..], &["-O1", "-g"]].concat();
        if !has_sanitizers(folder.path()) || compile_solver(&stored.program, folder.path(), &[], "c99").is_none() {
            return;
        }
        compile_solver(&stored.program, folder.path(), &checked, "checked");
        let targets = targets_of(&stored.program, 100);
        let lines = targets.iter().map(|target| {
            let words: Vec<String> = target.iter().map(|value| format!("{value:e}")).collect();
            words.join(" ")
        });
        let text = format!("{}\n{}\n", targets.len(), lines.collect::<Vec<_>>().join("\n"));
        assert_eq!(feed(&folder.path().join("checked"), text.clone()), feed(&folder.path().join("c99"), text));
    }
}

/// In single precision eigenvalues have errors of about a thousandth: some solutions are lost, none is wrong.
#[test]
fn single_precision_finds_most_answers() {
    for stored in named(&["general_6r", "xarm6_like"]) {
        let Some(seen) = single::compare(&stored.program, 600) else { return };
        println!("{}: {seen:?}", stored.name);
        assert!(seen.farthest <= 1e-4, "{}: {seen:?}", stored.name);
        assert!(seen.found * 100 >= seen.expected * 95, "{}: {seen:?}", stored.name);
    }
}
