//! `groebot check`: what was derived passes, what was tampered with does not.

use std::fs;
use std::path::Path;

use super::{Derived, leg, leg_copy, refused, run, succeed, text};

/// Replaces the first `from` behind `mark` in a file.
fn edit(path: &Path, mark: &str, from: &str, to: &str) {
    let before = fs::read_to_string(path).unwrap();
    let start = before.find(mark).expect("the mark is there");
    let (head, tail) = before.split_at(start);
    assert!(tail.contains(from), "`{from}` is not there");
    fs::write(path, head.to_owned() + &tail.replacen(from, to, 1)).unwrap();
}

#[test]
fn what_was_derived_passes() {
    for folder in [leg().path(), Derived::new("nao_arm_planar", "0_system.toml").path()] {
        let out = succeed(&["check", folder]);
        assert!(out.lines().all(|line| line.starts_with('\u{2713}')), "{out}");
        for name in ["certificate.json", "1_equations.txt", "3_basis.txt", "5_program.json"] {
            assert!(out.contains(name), "{out}");
        }
    }
}

#[test]
fn a_forged_certificate_names_the_stratum() {
    let forgeries = [
        ("\"basis\"", "px", "pz", "generic"),
        ("\"cofactors\"", "px", "pz", "generic"),
        ("\"stratum\": \"pz = 0\"", "\"pz = 0\"", "\"pz = 1\"", "pz = 0"),
    ];
    for (mark, from, to, place) in forgeries {
        let folder = leg_copy();
        edit(&folder.path().join("certificate.json"), mark, from, to);
        let ran = run(&["check", text(folder.path())]);
        assert_eq!(ran.code, 1, "{from}");
        assert!(ran.out.contains("\u{2717} certificate.json"), "{}", ran.out);
        assert!(ran.err.contains("certificate.json") && ran.err.contains(&format!("`{place}`")), "{}", ran.err);
    }
}

#[test]
fn a_damaged_or_missing_certificate() {
    let folder = leg_copy();
    let path = folder.path().join("certificate.json");
    let whole = fs::read_to_string(&path).unwrap();
    fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    assert!(refused(&["check", text(folder.path())]).contains("line "));
    fs::remove_file(&path).unwrap();
    assert!(refused(&["check", text(folder.path())]).contains("certificate.json"));
}

#[test]
fn a_changed_input_is_not_what_was_proved() {
    let folder = leg_copy();
    edit(&folder.path().join("0_chain.toml"), "[tip]", "202.9", "202.8");
    assert!(refused(&["check", text(folder.path())]).contains("`generic`"));
}

#[test]
fn a_changed_stage_names_the_file_and_its_line() {
    let all = [
        ("3_basis.txt", "generic", "px", "py"),
        ("4_triangular.txt", "generic", "px", "py"),
        ("5_program.json", "\"cases\"", "58841", "58842"),
        ("5_solver.c", "block_1", "58841", "58842"),
        ("5_solver.rs", "block_1", "58841", "58842"),
        ("6_check.csv", "far,", "pass", "fail"),
    ];
    let [capacity, boundary] =
        [("5_program.json", "\"capacity\"", "2", "3"), ("6_check.csv", "boundary,", "2,2,2", "2,1,2")];
    for changes in [&all[..], &[capacity], &[boundary]] {
        let folder = leg_copy();
        changes.iter().for_each(|(name, mark, from, to)| edit(&folder.path().join(name), mark, from, to));
        let ran = run(&["check", text(folder.path())]);
        assert_eq!(ran.code, 1, "{changes:?}");
        for (name, ..) in changes {
            assert!(ran.out.contains(&format!("\u{2717} {name}")), "{}", ran.out);
        }
        assert!(ran.out.contains("\u{2713} certificate.json"), "{}", ran.out);
        assert!(ran.err.contains(changes[0].0), "{}", ran.err);
    }
    let folder = leg_copy();
    fs::remove_file(folder.path().join("5_program.json")).unwrap();
    assert!(refused(&["check", text(folder.path())]).contains("5_program.json"));
}
