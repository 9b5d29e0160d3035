//! Faults outside a chain: commands that use the chain report them, and commands that use the whole robot refuse them.

use std::fs;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{refused, run, run_on, text};

/// A planar arm of two joints of 0.3 m, and a camera whose limits are inverted.
const ROBOT: &str = "<robot name=\"arm\"><xacro:property name=\"width\" value=\".2\"/>\n\
    <link name=\"base\"/><link name=\"upper\"/><link name=\"fore\"/><link name=\"tip\"/><link name=\"cam\"/>\n\
    <joint name=\"j1\" type=\"continuous\"><parent link=\"base\"/><child link=\"upper\"/><axis xyz=\"0 0 1\"/></joint>\n\
    <joint name=\"j2\" type=\"continuous\"><parent link=\"upper\"/><child link=\"fore\"/><origin xyz=\"0.3 0 0\"/><axis xyz=\"0 0 1\"/></joint>\n\
    <joint name=\"jt\" type=\"fixed\"><parent link=\"fore\"/><child link=\"tip\"/><origin xyz=\"0.3 0 0\"/></joint>\n\
    <joint name=\"pan\" type=\"revolute\"><parent link=\"base\"/><child link=\"cam\"/><axis xyz=\"0 0 1\"/><limit lower=\"2\" upper=\"-2\"/></joint>\n\
    </robot>\n";
const FAULT: &str = "line 6: joint `pan`: the limits 2..-2 are inverted";
const XACRO: &str = "line 1: unused definitions of xacro are ignored: `width`";

fn robot() -> (TempDir, String) {
    robot_of(ROBOT)
}

fn robot_of(urdf: &str) -> (TempDir, String) {
    let folder = tempdir().unwrap();
    let file = folder.path().join("arm.urdf");
    fs::write(&file, urdf).unwrap();
    let name = text(&file).to_owned();
    (folder, name)
}

fn notes(page: &str) -> Vec<String> {
    let value: Value = serde_json::from_str(page).unwrap();
    value["notes"].as_array().unwrap().iter().map(|note| note.as_str().unwrap().to_owned()).collect()
}

#[test]
fn derive_reports_them_as_text_and_json() {
    let (folder, file) = robot();
    let out = folder.path().join("out");
    let requested =
        ["derive", &file, "--tip", "tip", "--task", "planar_position", "--plane", "xy", "--out", text(&out)];
    let ran = run(&requested);
    let words = ran.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(ran.code == 0 && words.contains(FAULT) && words.contains(XACRO), "{}{}", ran.out, ran.err);
    let reported = notes(&run(&[&requested[..], &["--json"]].concat()).out);
    assert!(reported.len() == 2 && reported[0] == XACRO && reported[1].contains(FAULT), "{reported:?}");
    // The folder is an ordinary derivation. Links of 0.3 m reach (0.3, 0.3) with a right angle at the elbow.
    let solved = run(&["solve", text(&out), "--target", "0.3,0.3", "--json"]);
    let solved: Value = serde_json::from_str(&solved.out).unwrap();
    let mut elbows: Vec<f64> =
        solved["solutions"].as_array().unwrap().iter().map(|own| own["q"][1].as_f64().unwrap()).collect();
    elbows.sort_by(f64::total_cmp);
    let quarter = std::f64::consts::FRAC_PI_2;
    assert!(
        elbows.len() == 2 && (elbows[0] + quarter).abs() < 1e-9 && (elbows[1] - quarter).abs() < 1e-9,
        "{elbows:?}"
    );
    let checked = run(&["check", text(&out), "--json"]);
    assert_eq!((checked.code, notes(&checked.out)), (0, reported));
    let checked = run(&["check", text(&out)]);
    assert!(checked.code == 0 && checked.err.contains(FAULT), "{}", checked.err);
}

#[test]
fn commands_on_a_chain_report_them() {
    let (_folder, file) = robot();
    let reported = notes(&run(&["info", &file, "--tip", "tip", "--json"]).out);
    assert!(reported.len() == 2 && reported[1].contains(FAULT), "{reported:?}");
    let task = ["--tip", "tip", "--task", "planar_position", "--plane", "xy"];
    let ik = [&["ik", &file, "--target", "0.3,0.3"], &task[..]].concat();
    let fk = ["fk", &file, "--tip", "tip", "--q", "0,0"];
    let plan = [&["plan", &file], &task[..]].concat();
    for arguments in [&ik[..], &fk, &plan] {
        let ran = run(&[arguments, &["--json"]].concat());
        let reported = notes(&ran.out);
        assert!(
            reported.len() == 2 && reported[0] == XACRO && reported[1].contains(FAULT),
            "{arguments:?}: {reported:?}"
        );
        assert_eq!(ran.err, "", "{arguments:?}");
    }
    let explain = [&["explain", &file], &task[..]].concat();
    for arguments in [&ik[..], &fk, &plan, &explain, &["dynamics", "--symbolic", &file, "--tip", "tip"]] {
        let ran = run(arguments);
        assert_eq!(ran.code, 0, "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(&format!("note: {XACRO}\n")) && ran.err.contains(FAULT), "{}", ran.err);
    }
    // Standard output has the results only.
    let table = run_on(&["fk", &file, "--tip", "tip"], b"0,0\n");
    assert!(table.out.starts_with("j1,j2,x_m") && table.out.lines().count() == 2, "{}", table.out);
}

#[test]
fn a_chain_through_them_and_the_whole_robot_are_refused() {
    let (folder, file) = robot();
    let states = folder.path().join("states.csv");
    fs::write(&states, "q0,q1,q2\n0,0,0\n").unwrap();
    for arguments in [
        &["derive", &file, "--tip", "cam"][..],
        &["fk", &file, "--tip", "cam", "--q", "0"],
        &["export", &file, "--to", "urdf"],
        &["export", &file, "--to", "mjcf"],
        &["export", &file, "--to", "x3d"],
        &["dynamics", &file, "--states", text(&states)],
        &["walk", &file, "--left", "tip", "--right", "cam"],
        &["view", &file, "-o", text(&folder.path().join("view.html"))],
        &["info", &file, "--q", "0,0,0"],
    ] {
        let error = refused(arguments);
        assert!(error.contains(FAULT) && error.contains("the type `continuous`"), "{arguments:?}: {error}");
    }
}

/// The same robot without a fault, with rods of 1 kg as links.
fn sound() -> String {
    let mass = "<inertial><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>";
    let heavy = |text: String, name: &str| {
        text.replace(&format!("<link name=\"{name}\"/>"), &format!("<link name=\"{name}\">{mass}"))
    };
    let text = ROBOT.replace("lower=\"2\" upper=\"-2\"", "lower=\"-2\" upper=\"2\"");
    ["upper", "fore", "cam"].into_iter().fold(text, heavy)
}

#[test]
fn commands_on_the_whole_robot_report_what_was_ignored() {
    let (folder, file) = robot_of(&sound());
    let table = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let states = table("states.csv", "q0,q1,q2\n0,0,0\n");
    let trajectory = table("trajectory.csv", "t,q0,q1,q2\n0,0,0,0\n0.01,0,0,0\n");
    let row = |k: i32| {
        let x = f64::from(k);
        let numbers = (0..12).map(|i| ((1.0 + x) * (2.0 + f64::from(i))).sin().to_string());
        numbers.collect::<Vec<_>>().join(",")
    };
    let log = (0..60).map(row).collect::<Vec<_>>().join("\n");
    let log = table("log.csv", &format!("q0,q1,q2,v0,v1,v2,a0,a1,a2,tau0,tau1,tau2\n{log}\n"));
    // Torques that no physically consistent bodies explain end the identification with status 3.
    for (code, arguments) in [
        (0, &["dynamics", &file, "--states", &states][..]),
        (0, &["track", &file, "--law", "computed-torque", "--trajectory", &trajectory]),
        (3, &["identify", &file, &log]),
    ] {
        let ran = run(&[arguments, &["--json"]].concat());
        assert_eq!((ran.code, ran.err.as_str()), (code, ""), "{arguments:?}");
        assert_eq!(notes(&ran.out), [XACRO], "{arguments:?}");
        let ran = run(arguments);
        assert_eq!((ran.code, ran.err), (code, format!("note: {XACRO}\n")), "{arguments:?}");
    }
}

#[test]
fn info_shows_the_robot_all_the_same() {
    let (_folder, file) = robot();
    let ran = run(&["info", &file]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    for words in ["5 links, 3 joints that move", "mass\n  not computed: see the faults", "faults", FAULT, XACRO] {
        assert!(ran.out.contains(words), "{words}: {}", ran.out);
    }
    let value: Value = serde_json::from_str(&run(&["info", &file, "--json"]).out).unwrap();
    assert!(value["faults"][0].as_str().unwrap().contains(FAULT) && value["mass"].is_null(), "{value}");
}
