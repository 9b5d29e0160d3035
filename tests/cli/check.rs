//! `groebot check` accepts derived folders and refuses modified ones.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{Derived, content, fails_at, leg, leg_copy, refused, root, run, succeed, text};

/// Replaces the first `from` after `mark` in a file.
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
        ("3_basis.txt", "lexicographic", "px", "py"),
        ("4_triangular.txt", "lexicographic", "px", "py"),
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

/// A copy of a committed derivation.
fn copy_of(derivation: &str) -> TempDir {
    let copy = tempdir().unwrap();
    for (name, bytes) in content(&root("derivations").join(derivation)) {
        fs::write(copy.path().join(name), bytes).unwrap();
    }
    copy
}

/// Equations of motion are an addition to a certificate and replace no file.
#[test]
fn equations_of_motion_prove_no_solver() {
    let folder = copy_of("planar_2r");
    fs::remove_file(folder.path().join("certificate.json")).unwrap();
    edit(&folder.path().join("5_program.json"), "\"name\"", "planar_2r", "planar_3r");
    let ran = run(&["check", text(folder.path())]);
    assert!(
        ran.code == 1 && ran.err.contains("certificate.json") && ran.err.contains("certificate is missing"),
        "{}",
        ran.err
    );
    for name in [
        "certificate.json",
        "1_equations.txt",
        "3_basis.txt",
        "5_program.json",
        "5_solver.c",
        "6_check.csv",
        "README.md",
    ] {
        assert!(ran.out.contains(&format!("\u{2717} {name} ")), "{name}: {}", ran.out);
    }
    assert!(ran.out.contains("\u{2713} 7_dynamics.json"), "{}", ran.out);
    // Without the files of a derivation, the remaining files are independent.
    for name in content(folder.path()).into_keys().filter(|name| !name.starts_with(['0', '7'])) {
        fs::remove_file(folder.path().join(name)).unwrap();
    }
    assert_eq!(succeed(&["check", text(folder.path())]).lines().count(), 3);
    fs::remove_file(folder.path().join("7_dynamics.json")).unwrap();
    let ran = run(&["check", text(folder.path())]);
    assert!(ran.code == 1 && ran.out.contains("\u{2717} 7_dynamics.txt"), "{}", ran.out);
}

#[test]
fn forged_equations_of_motion_and_an_empty_page_are_named() {
    let folder = copy_of("planar_2r");
    let file = |name: &str| folder.path().join(name);
    edit(&file("7_dynamics.txt"), "# Joint 1", "axis", "line");
    fs::write(file("README.md"), "").unwrap();
    fails_at(folder.path(), &["README.md", "7_dynamics.txt"]);
    edit(&file("7_dynamics.txt"), "# Joint 1", "line", "axis");
    edit(&file("7_dynamics.json"), "\"gravity\"", "981/100", "981/200");
    fs::write(file("README.md"), "# My own page\n").unwrap();
    fails_at(folder.path(), &["7_dynamics.txt"]);
}

/// Files that another kind of derivation writes belong to none in this folder. Files that groebot did not write are
/// named.
#[test]
fn every_file_of_a_folder_is_accounted_for() {
    let folder = leg_copy();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let read =
        |derivation: &str, name: &str| fs::read_to_string(root("derivations").join(derivation).join(name)).unwrap();
    write("notes.txt", "mine\n");
    write("main.c", "int main(void) { return 0; }\n");
    fs::create_dir(folder.path().join("meshes")).unwrap();
    write("leg.rs", &fs::read_to_string(folder.path().join("5_solver.rs")).unwrap());
    let page = succeed(&["check", text(folder.path())]);
    for name in ["notes.txt", "main.c", "meshes"] {
        assert!(
            page.lines().any(|line| line.starts_with(&format!("- {name} ")) && line.contains("not checked")),
            "{page}"
        );
    }
    assert!(page.contains("\u{2713} leg.rs"), "{page}");
    let reported: Value = serde_json::from_str(&succeed(&["check", text(folder.path()), "--json"])).unwrap();
    let findings = reported["findings"].as_array().unwrap();
    let of = |name: &str| findings.iter().find(|finding| finding["item"] == name).unwrap()["passed"].clone();
    assert_eq!((reported["passed"].clone(), of("notes.txt"), of("leg.rs")), (true.into(), Value::Null, true.into()));
    write("5_ikfast.cpp", &read("polar", "5_ikfast.cpp"));
    write("arm.c", &read("polar", "5_solver.c"));
    write("7_dynamics.txt", &read("polar", "7_dynamics.txt"));
    fails_at(folder.path(), &["7_dynamics.txt", "5_ikfast.cpp", "arm.c"]);
}

/// A certificate that claims less: the proof holds, but the number of solutions differs.
#[test]
fn a_lower_number_of_solutions_is_refused() {
    let folder = copy_of("planar_2r");
    edit(&folder.path().join("certificate.json"), "\"evidence\"", "\"dimension\": 2", "\"dimension\": 1");
    let ran = run(&["check", text(folder.path())]);
    assert!(ran.code == 1 && ran.err.contains("certificate.json") && ran.err.contains("solutions"), "{}", ran.err);
}
