//! Time and memory budgets and Ctrl-C work also in steps that do not check them. Options that multiply the work are
//! bounded.

use std::fs;
use std::time::{Duration, Instant};

use tempfile::tempdir;

use super::{content, refused, root, run, succeed, text};

/// A polynomial whose expansion takes minutes and gigabytes.
const POWER: &str = "variables: x, y\n(x + y + 1)^1000\n";

#[test]
#[cfg(target_os = "linux")]
fn an_expansion_keeps_the_budgets() {
    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("power"), folder.path().join("out"));
    fs::write(&file, POWER).unwrap();
    for (option, value, word) in
        [("--time", "0.5", "time budget of 0.5 s"), ("--memory", "60", "the budget allows 60.0")]
    {
        let begun = Instant::now();
        let error = refused(&["basis", text(&file), "-o", text(&out), option, value]);
        assert!(error.contains(word), "{error}");
        assert!(begun.elapsed() < Duration::from_secs(60), "{:?}", begun.elapsed());
        assert_eq!(content(folder.path()).len(), 1, "nothing is written");
    }
}

/// The budget ends the derivation of legs, and the planning of a walk.
#[test]
fn a_walk_keeps_its_time_budget() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("walk.csv");
    for robot in ["nao", "teo"] {
        let error = refused(&["walk", robot, "--steps", "800", "--time", "0.01", "-o", text(&out)]);
        assert!(error.contains("time budget"), "{error}");
        assert!(content(folder.path()).is_empty(), "nothing is written");
    }
    let reported = succeed(&["walk", "nao", "--steps", "2", "--time", "600", "-o", text(&out)]);
    assert!(reported.contains("2 steps") && out.exists(), "{reported}");
}

/// Every command ends when it is interrupted: in a step without checks, and while it reads standard input.
#[test]
#[cfg(target_os = "linux")]
fn control_c_ends_every_command() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("power");
    fs::write(&file, POWER).unwrap();
    let leg = root("derivations/nao_leg_sagittal");
    let (ur5, out) = (root("derivations/ur5"), folder.path().join("out"));
    let out = text(&out);
    for arguments in [
        &["basis", text(&file), "-o", out][..],
        &["solve", text(&leg)],
        &["fk", text(&leg)],
        &["check", text(&ur5)],
        &["explain", text(&root("derivations/general_6r/0_chain.toml")), "-o", out],
        &["reach", text(&ur5), "--orientations", "100000", "-o", &format!("{out}.json")],
        &["walk", "teo", "--steps", "800", "-o", out],
    ] {
        let mut child = super::groebot(arguments).spawn().unwrap();
        let begun = Instant::now();
        while !super::interrupted::catches_interrupts(child.id()) && begun.elapsed() < Duration::from_secs(20) {
            std::thread::sleep(Duration::from_millis(5));
        }
        // An explanation takes 150 ms on an idle machine.
        std::thread::sleep(Duration::from_millis(if arguments[0] == "explain" { 10 } else { 200 }));
        assert_eq!(child.try_wait().unwrap(), None, "{arguments:?}: it should still be at work");
        let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        // Standard input stays open until the process has ended.
        let stdin = child.stdin.take();
        let output = child.wait_with_output().unwrap();
        drop(stdin);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            (output.status.code(), error.as_str()),
            (Some(130), "error: interrupted; nothing was written\n"),
            "{arguments:?}"
        );
        assert_eq!(content(folder.path()).len(), 1, "nothing is written");
    }
}

#[test]
fn options_that_multiply_work_are_bounded() {
    let folder = tempdir().unwrap();
    let at = |name: &str, content: &str| {
        let path = folder.path().join(name);
        fs::write(&path, content).unwrap();
        text(&path).to_owned()
    };
    let arm = text(&root("tests/corpus/dynamics/rrp.urdf")).to_owned();
    let path = at("t.csv", "t,q0,q1,q2\n0,0,0,0\n1,0.1,0.1,0.1\n");
    for step in ["1e-300", "1e-9"] {
        let error = refused(&["track", &arm, "--law", "open-loop", "--trajectory", &path, "--step", step]);
        assert!(error.contains("steps of the law are too many; give at most 1000000"), "{error}");
    }
    let late = ["track", &arm, "--law", "open-loop", "--trajectory", &path, "--delay", "1000001"];
    assert!(refused(&late).contains("1000001 steps of delay are too many; give at most 1000000"));
    let ur5 = text(&root("derivations/ur5")).to_owned();
    let places = ["--x", "0:1:100", "--y", "0:1:100", "--z", "0:1:100", "--orientations", "1000000"];
    let error = refused(&[&["reach", &ur5][..], &places].concat());
    assert!(error.contains("1000000000000 targets") && error.contains("at most 4000000000"), "{error}");
    let cells = at("cells.txt", "..\n..\n");
    for side in ["1e-300", "1e300", "0", "nan"] {
        let error = refused(&["path", &cells, "--resolution", side, "--start", "0,0", "--goal", "1,1"]);
        assert!(error.contains("give the side of a cell, 1e-6 to 1e6 m"), "{error}");
    }
    let error = refused(&["walk", "nao", "--steps", "4", "--tick", "1e-9"]);
    assert!(error.contains("samples of 1e-9 s; at most 180000 are allowed") && error.contains("--tick"), "{error}");
    let log = at("log.csv", "q0,q1,q2,v0,v1,v2,a0,a1,a2,tau0,tau1,tau2\n0,0,0,0,0,1e160,0,0,0,0,0,0\n");
    let error = refused(&["identify", &arm, &log]);
    assert!(error.contains("line 2: column `v2`: `1e160` is too large; give at most 1e15"), "{error}");
    let long: String = (1..600).map(|n| format!("<link name='l{n}'/><joint name='j{n}' type='revolute'><parent link='l{}'/><child link='l{n}'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>", n - 1)).collect();
    let long = at("long.urdf", &format!("<robot name='long'><link name='l0'/>{long}</robot>"));
    assert!(refused(&["dynamics", &long, "--lang", "rust"]).contains("599 joints are too many; give at most 500"));
    let bare = at(
        "bare.urdf",
        "<robot name='bare'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint></robot>",
    );
    assert!(refused(&["dynamics", &bare, "--lang", "rust"]).contains("no link has a mass"));
    let one = at("one.csv", "q0\n0.1\n");
    let seven = at("seven.csv", "q0,q1,q2,q3,q4,q5,q6\n0,0,0,-1,0,1,0\n");
    for (robot, states) in [(bare.as_str(), &one), ("franka_panda", &seven)] {
        assert!(refused(&["dynamics", robot, "--states", states]).contains("no link has a mass"));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn endless_files_are_refused() {
    for arguments in [
        &["follow", text(&root("derivations/ur5")), "--poses", "/dev/zero"][..],
        &["walk", "nao", "--footsteps", "/dev/zero"],
        &["path", "/dev/zero", "--start", "0,0", "--goal", "1,1"],
        &["derive", "/dev/zero", "--out", "x"],
        &["basis", "/dev/zero"],
    ] {
        let ran = run(arguments);
        assert!(ran.code == 1 && ran.err.lines().count() == 1, "{arguments:?}: {}", ran.err);
    }
}
