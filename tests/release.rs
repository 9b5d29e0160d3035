//! The scripts of a release, on small copies.

use std::process::Command;

/// The output of a command with Python. `None` without `python3`, with a message (an error with `GROEBOT_REQUIRE_TOOLS=1`).
fn run(command: &mut Command) -> Option<(bool, String)> {
    let python = Command::new("python3").args(["-c", "import tomllib"]).output();
    if !python.is_ok_and(|output| output.status.success()) {
        let required = std::env::var("GROEBOT_REQUIRE_TOOLS").is_ok_and(|value| value == "1");
        assert!(!required, "python3 3.11 is missing");
        println!("skipped: there is no python3 3.11");
        return None;
    }
    let output = command.current_dir(env!("CARGO_MANIFEST_DIR")).env("PYTHONDONTWRITEBYTECODE", "1").output().unwrap();
    Some((output.status.success(), String::from_utf8(output.stderr).unwrap()))
}

#[test]
fn the_changelog_is_cut_and_versions_are_set() {
    let tests = ["-m", "unittest", "discover", "scripts/release"];
    let Some((passed, report)) = run(Command::new("python3").args(tests)) else { return };
    assert!(passed, "{report}");
}

#[cfg(unix)]
#[test]
fn a_wrong_option_of_the_release_is_refused() {
    for (arguments, message) in [(&["0.2.0", "--upload"][..], "`--upload` is no option"), (&[], "give the version")] {
        let Some((passed, report)) = run(Command::new("scripts/release/run").args(arguments)) else { return };
        assert!(!passed && report.contains(message), "{arguments:?}: {report}");
    }
}
