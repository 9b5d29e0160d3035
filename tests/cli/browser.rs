//! Tests of pages and scenes in Chromium, in `viewer/tests`. They spend most of their time waiting.

use std::process::Command;

use super::root;

/// Runs tests of `viewer/tests` in Node and Chromium. A missing tool, also one of `tools`, is reported with a remedy.
fn node_tests(names: &[&str], tools: &[(&str, &str)]) {
    let viewer = root("viewer");
    let usual = [
        ("/usr/bin/chromium", "install Debian's chromium"),
        ("node_modules/playwright-core", "run `npm ci` in viewer/"),
    ];
    let missing = usual.iter().chain(tools).filter(|(file, _)| !viewer.join(file).exists());
    let mut missing: Vec<String> = missing.map(|(file, cure)| format!("{file}: {cure}")).collect();
    if Command::new("node").arg("--version").output().is_err() {
        missing.push("node: install nodejs".to_owned());
    }
    if !missing.is_empty() {
        let required = std::env::var("GROEBOT_REQUIRE_TOOLS").is_ok_and(|value| value == "1");
        assert!(!required, "{}", missing.join("; "));
        return println!("skipped, a tool is missing: {}", missing.join("; "));
    }
    let mut command = Command::new("node");
    command.args(["--test", "--test-concurrency=1"]).current_dir(&viewer).env("GROEBOT", env!("CARGO_BIN_EXE_groebot"));
    command.args(names.iter().map(|name| format!("tests/{name}.test.mjs")));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn pages_work_in_chromium() {
    node_tests(&["walk", "robot", "trouble", "solutions", "redundant", "reach", "run", "task"], &[]);
}

#[test]
fn scenes_are_read_by_other_programs() {
    let tools = [
        ("/usr/bin/tovrmlx3d", "install Debian's view3dscene"),
        ("node_modules/three", "run `npm ci` in viewer/"),
        ("node_modules/gltf-validator", "run `npm ci` in viewer/"),
        ("node_modules/@gltf-transform/core", "run `npm ci` in viewer/"),
        ("node_modules/x_ite", "run `npm ci` in viewer/"),
    ];
    node_tests(&["export"], &tools);
}
