//! Thin folders: `derive --thin`, and the commands that read them.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use tempfile::{TempDir, tempdir};

use super::{content, copy_of, fails_at, folder_with, leg, leg_copy, refused, run, succeed, text};

/// The files of a thin folder of a chain.
const FILES: [&str; 4] = ["0_chain.toml", "README.md", "certificate.json", "outputs.sha256"];

/// The leg in a thin folder, derived once. Each test may modify its copy.
fn thin_leg() -> TempDir {
    static THIN: LazyLock<TempDir> = LazyLock::new(|| {
        let folder = folder_with("nao_leg_sagittal", "0_chain.toml");
        succeed(&["derive", text(folder.path()), "--thin", "--quiet"]);
        folder
    });
    copy_of(THIN.path())
}

fn names(folder: &Path) -> Vec<String> {
    content(folder).into_keys().collect()
}

/// Replaces the hash of a file.
fn forge(folder: &Path, name: &str, change: impl Fn(&str) -> String) {
    let path = folder.join("outputs.sha256");
    let stored = fs::read_to_string(&path).unwrap();
    let forged: String = stored
        .lines()
        .map(|line| if line.ends_with(&format!("  {name}")) { change(line) } else { format!("{line}\n") })
        .collect();
    assert_ne!(stored, forged);
    fs::write(path, forged).unwrap();
}

#[test]
fn a_thin_folder_passes_its_check_and_stays_thin() {
    let folder = thin_leg();
    assert_eq!(names(folder.path()), FILES);
    let written = content(folder.path());
    let page = succeed(&["check", text(folder.path())]);
    assert!(
        page.contains("\u{2713} outputs.sha256    9 outputs printed again from the proof: all hashes are equal"),
        "{page}"
    );
    assert!(page.contains("\u{2713} 5_program.json    printed again, and has the stored hash"), "{page}");
    assert!(
        page.contains("500 targets solved again, all correct; its words and counts have the stored hash"),
        "{page}"
    );
    succeed(&["derive", text(folder.path()), "--quiet"]);
    assert_eq!(content(folder.path()), written);
    // Writes all files of the full folder, and removes them again.
    succeed(&["derive", text(folder.path()), "--quiet", "--full"]);
    assert_eq!(content(folder.path()), content(leg().folder.path()));
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    succeed(&["derive", text(folder.path()), "--quiet", "--thin"]);
    fs::remove_file(folder.path().join("notes.txt")).unwrap();
    assert_eq!(content(folder.path()), written);
    assert_eq!(run(&["derive", text(folder.path()), "--full", "--thin"]).code, 2);
}

#[test]
fn a_wrong_or_missing_hash_names_its_file() {
    for name in ["1_equations.txt", "5_program.json", "5_solver.rs", "6_check.csv"] {
        let folder = thin_leg();
        let other = |digit: char| if digit == '0' { '1' } else { '0' };
        forge(folder.path(), name, |line| format!("{}{}\n", other(line.chars().next().unwrap()), &line[1..]));
        fails_at(folder.path(), &[name, "outputs.sha256"]);
        let folder = thin_leg();
        forge(folder.path(), name, |_| String::new());
        fails_at(folder.path(), &[name, "outputs.sha256"]);
    }
    let folder = thin_leg();
    forge(folder.path(), "5_solver.c", |line| format!("{line}\n{}  5_solver.py\n", "0".repeat(64)));
    fails_at(folder.path(), &["outputs.sha256"]);
    let ran = run(&["check", text(folder.path())]);
    assert!(ran.err.contains("`5_solver.py`"), "{}", ran.err);
}

/// An output that is in a thin folder is checked.
#[test]
fn an_output_in_a_thin_folder_is_compared() {
    let folder = thin_leg();
    let program = fs::read(leg().folder.path().join("5_program.json")).unwrap();
    let file = folder.path().join("5_program.json");
    fs::write(&file, &program).unwrap();
    assert!(succeed(&["check", text(folder.path())]).contains("\u{2713} 5_program.json    follows from the proof"));
    fs::write(&file, &program[1..]).unwrap();
    fails_at(folder.path(), &["5_program.json"]);
}

#[test]
fn commands_use_the_solver_that_the_certificate_proves() {
    let (thin, full, work) = (thin_leg(), leg().path(), tempdir().unwrap());
    let thin = text(thin.path());
    let at = |name: &str| text(&work.path().join(name)).to_owned();
    for arguments in [
        &["solve", "DIR", "--target", "60,150"][..],
        &["solve", "DIR", "--target", "60,150", "--json"],
        &["codegen", "DIR", "--lang", "c"],
        &["codegen", "DIR", "--lang", "rust"],
        &["codegen", "DIR", "--lang", "latex"],
        &["explain", "DIR"],
        &["fk", "DIR", "--q", "0.3,0.6"],
    ] {
        let of = |folder: &str| {
            let words: Vec<&str> = arguments.iter().map(|word| if *word == "DIR" { folder } else { word }).collect();
            succeed(&words)
        };
        assert_eq!(of(thin), of(full), "{arguments:?}");
    }
    // The path of the program selects a thin folder's program, although the file is absent.
    let program = format!("{thin}/5_program.json");
    assert_eq!(succeed(&["solve", &program, "--target", "60,150"]), succeed(&["solve", full, "--target", "60,150"]));
    let pages = [thin, full].map(|folder| {
        let (map, page) = (at("map.json"), at("page.html"));
        succeed(&["reach", folder, "--orientations", "4", "--quiet", "-o", &map]);
        succeed(&["view", folder, "--reach", &map, "-o", &page]);
        [fs::read_to_string(map).unwrap(), fs::read_to_string(page).unwrap()]
    });
    assert_eq!(pages[0], pages[1]);
}

#[test]
fn a_folder_with_neither_program_nor_certificate_is_refused() {
    let folder = leg_copy();
    fs::remove_file(folder.path().join("5_program.json")).unwrap();
    fs::remove_file(folder.path().join("certificate.json")).unwrap();
    let reported = refused(&["solve", text(folder.path()), "--target", "60,150"]);
    assert!(reported.contains("no `5_program.json` and no `certificate.json`"), "{reported}");
    let thin = thin_leg();
    fs::write(thin.path().join("certificate.json"), "{}").unwrap();
    assert!(refused(&["solve", text(thin.path()), "--target", "60,150"]).contains("certificate.json"));
}

/// A user's file with the name of the file of hashes.
#[test]
fn hashes_that_groebot_did_not_write_are_left_alone() {
    let folder = leg_copy();
    let file = folder.path().join("outputs.sha256");
    fs::write(&file, "my own hashes\n").unwrap();
    succeed(&["derive", text(folder.path()), "--quiet"]);
    assert!(folder.path().join("5_program.json").exists());
    assert_eq!(fs::read_to_string(&file).unwrap(), "my own hashes\n");
    let reported = refused(&["derive", text(folder.path()), "--quiet", "--thin"]);
    assert!(reported.contains("`outputs.sha256`") && reported.contains("--force"), "{reported}");
    assert!(folder.path().join("5_program.json").exists());
    succeed(&["derive", text(folder.path()), "--quiet", "--thin", "--force"]);
    assert_eq!(names(folder.path()), FILES);
}
