//! Tests of the program `groebot`, run as by a user or a script.

mod basis;
mod browser;
mod budgets;
mod check;
mod closest;
mod codegen;
mod colours;
mod committed;
mod coupled;
mod derive;
mod dynamics;
mod dynamics_faults;
mod explain;
mod export;
mod faults;
mod fk;
mod follow;
mod formats;
mod identify;
mod ik;
mod info;
mod interrupted;
mod named;
mod navigate;
mod output;
mod pipes;
mod plan;
mod reach;
mod redundant;
mod refused;
mod schema;
mod shown;
mod simulate;
mod solve;
mod stands;
mod task;
mod task_options;
mod thin;
mod track;
mod view;
mod walk;

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use tempfile::{TempDir, tempdir};

/// Result of a run.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

fn groebot(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_groebot"));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn run(arguments: &[&str]) -> Ran {
    run_on(arguments, b"")
}

/// Runs with `input` on standard input. A panic fails the test, and so does JSON that docs/cli_schema.json does not describe.
fn run_on(arguments: &[&str], input: &[u8]) -> Ran {
    let mut child = groebot(arguments).spawn().unwrap();
    let (mut stdin, input) = (child.stdin.take().unwrap(), input.to_vec());
    // The program may end before it has read all input, so a broken pipe is not a failure here.
    let feeder = std::thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().unwrap();
    let _ = feeder.join().unwrap();
    let ran = Ran {
        code: output.status.code().expect("no signal ended it"),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(!ran.err.contains("panicked"), "{}", ran.err);
    schema::validate(arguments, &ran.out);
    ran
}

fn succeed(arguments: &[&str]) -> String {
    let ran = run(arguments);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{arguments:?}");
    ran.out
}

/// Runs a command that must be refused with status 1 and one error line, which is returned.
fn refused(arguments: &[&str]) -> String {
    let ran = run(arguments);
    assert_eq!(ran.code, 1, "{arguments:?}: {}{}", ran.out, ran.err);
    assert!(ran.err.starts_with("error: ") && ran.err.lines().count() == 1, "{}", ran.err);
    ran.err
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// All entries of `folder`, including hidden ones, with their content.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entry = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry.unwrap();
        (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap_or_default())
    };
    fs::read_dir(folder).unwrap().map(entry).collect()
}

/// A folder with only the input of a derivation of this repository.
fn folder_with(derivation: &str, name: &str) -> TempDir {
    let folder = tempdir().unwrap();
    fs::copy(root("derivations").join(derivation).join(name), folder.path().join(name)).unwrap();
    folder
}

/// A derived mechanism and the output of `derive`.
struct Derived {
    folder: TempDir,
    report: String,
}

impl Derived {
    fn new(derivation: &str, name: &str) -> Self {
        let folder = folder_with(derivation, name);
        let report = succeed(&["derive", text(folder.path())]);
        Derived { folder, report }
    }

    fn path(&self) -> &str {
        text(self.folder.path())
    }
}

/// The NAO leg, derived once for all tests, which only read it.
fn leg() -> &'static Derived {
    static LEG: OnceLock<Derived> = OnceLock::new();
    LEG.get_or_init(|| Derived::new("nao_leg_sagittal", "0_chain.toml"))
}

/// A copy of the derived leg that a test may modify.
fn leg_copy() -> TempDir {
    copy_of(leg().folder.path())
}

/// A copy of a folder's files.
fn copy_of(folder: &Path) -> TempDir {
    let copy = tempdir().unwrap();
    for (name, bytes) in content(folder) {
        fs::write(copy.path().join(name), bytes).unwrap();
    }
    copy
}

/// Checks a folder whose check must fail for these files only.
fn fails_at(folder: &Path, names: &[&str]) {
    let ran = run(&["check", text(folder)]);
    let failed = ran.out.lines().filter_map(|line| line.strip_prefix("\u{2717} "));
    let failed: Vec<&str> = failed.filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!((ran.code, failed), (1, names.to_vec()), "{}", ran.out);
    assert!(ran.err.contains(names[0]), "{}", ran.err);
}

#[test]
fn usage_and_version() {
    assert_eq!(succeed(&["--version"]).trim(), concat!("groebot ", env!("CARGO_PKG_VERSION")));
    let help = succeed(&["--help"]);
    let words = [
        "Kinematics:",
        "Algebra:",
        "Dynamics and control:",
        "Walking and navigation:",
        "Pictures and exchange:",
        "derive",
        "solve",
        "check",
        "codegen",
        "info",
        "fk",
        "basis",
        "Options:",
        "Examples:",
        "Exit status",
    ];
    for word in words {
        assert!(help.contains(word), "{word}");
    }
    for wrong in [&["dance"][..], &[], &["derive"], &["derive", ".", "--time", "-1"], &["derive", ".", "--time", "nan"]]
    {
        let ran = run(wrong);
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{wrong:?}");
        assert!(!ran.err.is_empty());
    }
}

#[test]
fn info_describes_chains_and_systems() {
    let chain = succeed(&["info", text(&root("derivations/nao_leg_sagittal"))]);
    assert!(chain.contains("KneePitch") && chain.contains("turns about") && chain.contains("c4 > c3 > s4 > s3"));
    let system = succeed(&["info", text(&root("derivations/nao_arm_planar/0_system.toml"))]);
    assert!(system.contains("(6.7.1)  f1 = 105*c2 + 113.7*s4 - pz = 0"), "{system}");
}
