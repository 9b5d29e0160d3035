//! An interrupted derivation leaves the folder unchanged.

use std::fs;

use tempfile::tempdir;

use super::{content, folder_with, leg_copy, refused, text};

/// Cyclic 6 with two of its constants as targets, which takes hours.
#[cfg(target_os = "linux")]
fn endless() -> String {
    let mut system = "name = \"endless\"\n".to_owned();
    for name in ["p", "r"] {
        system += &format!("[[parameter]]\nname = \"{name}\"\n");
    }
    for index in 0..6 {
        system += &format!("[[joint]]\nname = \"j{index}\"\nunknown = \"x{index}\"\n");
    }
    for degree in 1..=6 {
        let product = |start| (0..degree).map(|k| format!("x{}", (start + k) % 6)).collect::<Vec<_>>().join("*");
        let starts = if degree == 6 { 1 } else { 6 };
        let sum = (0..starts).map(product).collect::<Vec<_>>().join(" + ");
        let constant = ["r", "p", "r", "p*r", "1", "p"][degree - 1];
        system += &format!("[[equation]]\nequation = \"{sum} = {constant}\"\n");
    }
    system
}

#[test]
fn a_budget_ends_it() {
    for (limit, value, word) in [("--time", "0.000001", "time budget"), ("--terms", "1", "terms")] {
        let fresh = folder_with("nao_leg_sagittal", "0_chain.toml");
        let derived = leg_copy();
        for folder in [&fresh, &derived] {
            let before = content(folder.path());
            let error = refused(&["derive", text(folder.path()), limit, value]);
            assert!(error.contains(word), "{error}");
            assert_eq!(content(folder.path()), before);
        }
    }
    let folder = folder_with("nao_leg_sagittal", "0_chain.toml");
    let out = folder.path().join("new/folder");
    refused(&["derive", text(folder.path()), "--out", text(&out), "--time", "1e-6"]);
    assert!(!folder.path().join("new").exists());
}

/// Whether the process already handles SIGINT.
#[cfg(target_os = "linux")]
pub fn catches_interrupts(process: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(mask.trim(), 16).unwrap() & 0b10 != 0
}

#[test]
#[cfg(target_os = "linux")]
fn control_c_ends_it() {
    use std::process::Command;
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    let folder = tempdir().unwrap();
    fs::write(folder.path().join("0_system.toml"), endless()).unwrap();
    let before = content(folder.path());
    let mut child = super::groebot(&["derive", text(folder.path()), "--time", "100"]).spawn().unwrap();
    let start = Instant::now();
    while !catches_interrupts(child.id()) && start.elapsed() < Duration::from_secs(20) {
        sleep(Duration::from_millis(5));
    }
    sleep(Duration::from_millis(100));
    assert_eq!(child.try_wait().unwrap(), None, "it should still be at work");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), error.as_str()), (Some(130), "error: interrupted; nothing was written\n"));
    assert!(output.stdout.is_empty());
    assert_eq!(content(folder.path()), before);
}
