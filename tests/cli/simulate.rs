//! `groebot simulate`, run as by a user. MuJoCo is imported by `GROEBOT_PYTHON` or python3.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{Ran, groebot, refused, root, succeed, text};

/// A folder with walks, and the path of the file.
fn walked(arguments: &[&str]) -> (TempDir, String) {
    let folder = tempdir().unwrap();
    let file = text(&folder.path().join("walk.csv")).to_owned();
    succeed(&[&["walk"], arguments, &["--torques", "--quiet", "-o", &file]].concat());
    (folder, file)
}

/// Runs a command that needs MuJoCo, with another Python if one is given.
pub(super) fn with_python(arguments: &[&str], python: Option<&Path>) -> Ran {
    let mut command = groebot(arguments);
    if let Some(python) = python {
        command.env("GROEBOT_PYTHON", python);
    }
    let output = command.output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(!err.contains("panicked"), "{err}");
    super::schema::validate(arguments, &out);
    Ran { code: output.status.code().unwrap(), out, err }
}

fn simulated(arguments: &[&str], python: Option<&Path>) -> Ran {
    with_python(&[&["simulate"], arguments].concat(), python)
}

/// Whether a run ended because there is no MuJoCo: reported, or an error with `GROEBOT_REQUIRE_TOOLS=1`.
pub(super) fn is_skipped(ran: &Ran) -> bool {
    if ran.code != 1 || !ran.err.contains("cannot run MuJoCo") {
        return false;
    }
    let required = std::env::var("GROEBOT_REQUIRE_TOOLS").is_ok_and(|value| value == "1");
    assert!(!required, "{}", ran.err);
    println!("skipped: {}", ran.err);
    true
}

/// The JSON output of a run. Without MuJoCo it is `None`, with a message, or an error with `GROEBOT_REQUIRE_TOOLS=1`.
pub(super) fn reported(arguments: &[&str], code: i32) -> Option<Value> {
    let ran = simulated(&[arguments, &["--json"]].concat(), None);
    if is_skipped(&ran) {
        return None;
    }
    assert_eq!((ran.code, ran.err.as_str()), (code, ""));
    Some(serde_json::from_str(&ran.out).unwrap())
}

pub(super) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[test]
fn what_is_no_walk_is_refused() {
    let (folder, walk) = walked(&["nao", "--steps", "2"]);
    let arm = folder.path().join("arm.csv");
    fs::write(&arm, "# groebot trajectory 1\n# robot: ur5\ntime [s],q:a [rad]\n0,0\n1,1\n").unwrap();
    let cases: [(&[&str], &str); 13] = [
        (&["walk.txt"], "the file name is not that of a walk"),
        (&["/nowhere/walk.csv"], "No such file"),
        (&[text(&arm)], "the contacts `left` and `right`"),
        (&[&walk, "--model", "teapot"], "give a file, nao, rh0 or teo by --model"),
        (&[&walk, "--model", "rh0"], "which rh0 does not have"),
        (&[&walk, "--left", "l_shoe"], "l_shoe"),
        (&[&walk, "--slope", "3"], "--slope takes two numbers"),
        (&[&walk, "--slope", "50,0"], "less than 45 degrees"),
        (&[&walk, "--servo", "1,2"], "three positive numbers"),
        (&[&walk, "--mass", "0"], "--mass is 0; give a positive number"),
        (&[&walk, "--noise=-1"], "--noise is -1; give 0 or more"),
        (&[&walk, "--push", "1,2"], "--push takes four numbers"),
        (&[&walk, "--push", "1,2,0,90"], "--push takes four numbers"),
    ];
    for (arguments, reason) in cases {
        let error = refused(&[&["simulate"], arguments].concat());
        assert!(error.contains(reason), "{arguments:?}: {error}");
    }
}

#[test]
fn without_mujoco_it_reports_how_to_get_it() {
    let (folder, walk) = walked(&["nao", "--steps", "2"]);
    let nowhere = folder.path().join("no_python");
    let ran = simulated(&[&walk], Some(&nowhere));
    assert!(ran.code == 1 && ran.err.contains("pip install mujoco") && ran.err.contains("no_python"), "{}", ran.err);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let script = |text: &str| {
            fs::write(&nowhere, format!("#!/bin/sh\n{text}\n")).unwrap();
            fs::set_permissions(&nowhere, fs::Permissions::from_mode(0o755)).unwrap();
            simulated(&[&walk, "--time", "1"], Some(&nowhere)).err
        };
        let missing = script("echo \"No module named 'mujoco'\" >&2; exit 7");
        assert!(missing.contains("No module named 'mujoco'") && missing.contains("GROEBOT_PYTHON="), "{missing}");
        assert!(script("echo odd >&2; exit 1").contains("MuJoCo cannot simulate this: odd"));
        assert!(script("echo odd").contains("is not understood"));
        assert!(script("exec sleep 60").contains("the time budget of 1.0 s"));
    }
}

/// A robot that falls at 1.5 s where the friction is 0.4, in the place of MuJoCo: seconds are a number or an empty cell in CSV, and null in JSON.
#[cfg(unix)]
#[test]
fn the_time_of_a_fall_is_a_number_or_empty() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, walk) = walked(&["nao", "--steps", "2"]);
    let [python, answer] = ["python", "answer.csv"].map(|name| folder.path().join(name));
    // The simulated motion is the planned one, with the columns of a simulation.
    let rows = fs::read_to_string(&walk).unwrap();
    let simulated_rows = rows.lines().enumerate().map(|(place, row)| match place {
        0 | 1 => format!("{row}\n"),
        2 => format!("{row},pressed [N],left_clearance [m],right_clearance [m]\n"),
        _ => format!("{row},50,0,0\n"),
    });
    fs::write(&answer, simulated_rows.collect::<String>()).unwrap();
    let output = r#"{"mujoco": "0", "fell": FELL, "motors": [], "unused_stiffness": null, "mass": 5, "points": []}"#;
    let [falls, stands] = ["1.5", "null"].map(|fell| format!("echo '{}'", output.replace("FELL", fell)));
    let copied = format!("cp '{}' answer.csv", text(&answer));
    let script = format!("#!/bin/sh\n{copied}\ncase \"$*\" in *friction=0.4*) {falls} ;; *) {stands} ;; esac\n");
    fs::write(&python, script).unwrap();
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).unwrap();
    let table = simulated(&[&walk, "--open-loop", "--vary"], Some(&python));
    assert_eq!((table.code, table.err.as_str()), (5, ""));
    let mut rows = table.out.lines().map(|row| row.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let column = |name: &str| header.iter().position(|own| *own == name).unwrap();
    let (friction, time) = (column("friction"), column("fall_time_s"));
    let times: Vec<(bool, String)> = rows.map(|row| (row[friction] == "0.4", row[time].to_owned())).collect();
    assert_eq!((times.len(), times.iter().filter(|(falls, _)| *falls).count()), (38, 9));
    for (falls, time) in &times {
        assert_eq!(time, if *falls { "1.50" } else { "" });
    }
    let json = simulated(&[&walk, "--open-loop", "--vary", "--json"], Some(&python));
    let reported: Value = serde_json::from_str(&json.out).unwrap();
    for run in reported["runs"].as_array().unwrap() {
        let falls = run["case"]["friction"] == 0.4;
        assert_eq!(run["run"]["fall_time"].as_f64(), falls.then_some(1.5));
    }
}

#[test]
fn nao_stands() {
    let (_folder, walk) = walked(&["nao", "--steps", "4"]);
    let Some(reported) = reported(&[&walk], 0) else { return };
    let compared = &reported["comparison"];
    assert_eq!((&reported["run"]["fall_time"], &compared["landings"]), (&Value::Null, &serde_json::json!([4, 4])));
    assert!((number(&reported["run"]["mass"]) - 5.30575).abs() < 1e-4);
    let [planned, walked] = ["planned", "simulated"].map(|route| number(&compared[route]["forward"]));
    assert!((planned - 0.12).abs() < 1e-6 && (walked - planned).abs() < 0.02, "{planned} {walked}");
    assert!(number(&compared["tilt"]) < 3f64.to_radians());
}

/// With 1 N m/rad at all joints, less than the m g l of NAO (10 N m/rad), the described gains are not used; with 400 N m/rad they are.
#[test]
fn described_gains_are_used_where_they_can_hold_the_robot() {
    let (folder, walk) = walked(&["nao", "--steps", "2"]);
    let plain = succeed(&["export", "nao", "--to", "mjcf"]);
    for (stiffness, is_used) in [(1.0, false), (400.0, true)] {
        let model = folder.path().join("described.xml");
        let described = plain.replace("kp=\"100\"", &format!("kp=\"{stiffness}\"")).replace(" 0\"/>", " 1\"/>");
        assert_eq!(described.matches(&format!("kp=\"{stiffness}\"")).count(), 24);
        fs::write(&model, described).unwrap();
        let Some(reported) = reported(&[&walk, "--model", text(&model)], 0) else { return };
        let run = &reported["run"];
        assert!(run["fall_time"].is_null());
        assert_eq!(run["unused_stiffness"].as_f64(), (!is_used).then_some(stiffness));
        let motors = run["motors"].as_array().unwrap();
        assert!(motors.iter().all(|motor| motor["described"] == is_used));
        assert!(motors.iter().all(|motor| is_used == (number(&motor["stiffness"]) == stiffness)));
        // `--verify` reports it too.
        let out = folder.path().join("verified.csv");
        let verified =
            with_python(&["walk", text(&model), "--steps", "2", "--verify", "--json", "-o", text(&out)], None);
        assert_eq!(verified.code, 0, "{}", verified.err);
        let report: Value = serde_json::from_str(&verified.out).unwrap();
        let notes: Vec<&str> = report["notes"].as_array().unwrap().iter().map(|note| note.as_str().unwrap()).collect();
        let unused =
            "simulated: the gains of the description are not used: at most 1.0 N m/rad do not hold the robot upright";
        assert!(notes.contains(&"simulated: the robot stands"), "{notes:?}");
        assert_eq!(notes.contains(&unused), !is_used, "{notes:?}");
    }
}

/// RH0 6.2 with two steps. The ZMP from contact forces is within 8 mm rms of the plan (of 30 mm that RA_AS permits). The roll error of a hip equals the planned
/// torque divided by the stiffness within 10 %.
#[test]
fn rh0_sags_as_its_motor_stiffness_predicts() {
    let (folder, walk) = walked(&["rh0", "--gait", "rh0-real", "--crouched", "--plan", "out right, in left"]);
    let at = |name: &str| folder.path().join(name);
    let (out, plot) = (at("answer.csv"), at("joints.svg"));
    let Some(reported) = reported(&[&walk, "--open-loop", "-o", text(&out), "--plot", text(&plot)], 0) else { return };
    let compared = &reported["comparison"];
    assert_eq!((&reported["run"]["fall_time"], &compared["landings"]), (&Value::Null, &serde_json::json!([2, 2])));
    assert_eq!(reported["run"]["points"], serde_json::json!(["Trunk"]), "its moments are assumed");
    assert!(number(&compared["zmp"][1]) < 0.008, "{}", compared["zmp"]);
    let joints = compared["joints"].as_array().unwrap();
    let roll = joints.iter().find(|joint| joint["joint"] == "RHipRoll").or(joints.first()).unwrap();
    let (greatest, sag) = (number(&roll["greatest"]), number(&roll["predicted"]));
    assert!(sag.abs() > 5e-3 && (greatest / sag - 1.0).abs() < 0.1, "{roll}");
    let answer = fs::read_to_string(&out).unwrap();
    assert!(answer.starts_with("# groebot trajectory 1\n# robot: rh0\n"));
    assert_eq!(answer.lines().count(), 3 + 1 + 2 * 323, "as many samples as the walk");
    let picture = fs::read_to_string(&plot).unwrap();
    assert_eq!(picture.matches("class=\"title\"").count(), 12);
    // The circle of 30 mm at a height of 0.67 m permits at most 3.4 degrees.
    let Some(fallen) = self::reported(&[&walk, "--open-loop", "--slope", "5,0"], 5) else { return };
    assert!(number(&fallen["run"]["fall_time"]) < 46.0);
}

/// Walks that fall in open loop stand with feedback.
#[test]
fn feedback_keeps_walks_upright() {
    let walks: [(&[&str], &[&str]); 2] = [
        (&["rh0", "--plan", "out right, stride left, in right"], &[]),
        (&["nao", "--steps", "4"], &["--push", "2.5,11,0.1,270"]),
    ];
    for (walk, options) in walks {
        let (_folder, file) = walked(walk);
        let run = |code: i32, more: &[&str]| reported(&[&[&file[..]], options, more].concat(), code);
        let (Some(open), Some(stands)) = (run(5, &["--open-loop"]), run(0, &[])) else { return };
        assert!(open["run"]["fall_time"].is_f64() && !open["feedback"].as_bool().unwrap());
        assert!(stands["run"]["fall_time"].is_null() && stands["feedback"].as_bool().unwrap());
        let compared = &stands["comparison"];
        let [planned, walked] = ["planned", "simulated"].map(|route| number(&compared[route]["forward"]));
        assert!((walked - planned).abs() < 0.05, "{planned} {walked}");
        assert!(number(&stands["usage"]["margin"][0]) > -0.005, "contact forces are within the soles: {stands}");
    }
}

/// The swinging foot lands on the slope that the standing soles have. TEO falls where it lands level.
#[test]
fn feet_land_on_a_slope() {
    let (_folder, file) = walked(&["teo", "--steps", "3", "--crouched"]);
    for slope in ["3,0", "-3,0", "0,3", "0,-3"] {
        let Some(stands) = reported(&[&file, "--slope", slope], 0) else { return };
        assert!(stands["run"]["fall_time"].is_null(), "{slope}: {stands}");
    }
}

/// RH0 Fig. 6-5: the speeds of the descent of 271 intervals, from the 268th on, within 0.001 rpm.
#[test]
fn the_rates_of_figure_6_5_come_out() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("joints.csv");
    let plan = ["walk", "rh0", "--gait", "rh0-real", "--plan", "turn left 10", "--descent-intervals", "271", "--quiet"];
    succeed(&[&plan[..], &["--thesis", text(&file)]].concat());
    let table = |path: &Path| -> Vec<Vec<String>> {
        fs::read_to_string(path).unwrap().lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let (printed, ours) = (table(&root("tests/corpus/rh0/fig_6_5_rates.csv")), table(&file));
    for (row, rates) in printed[1..].iter().enumerate() {
        for (name, rate) in printed[0].iter().zip(rates) {
            let column = ours[0].iter().position(|own| own == name).unwrap();
            let angle = |sample: usize| ours[1 + sample][column].parse::<f64>().unwrap();
            // Converts degrees in 0.072 s to turns per minute.
            let rpm = (angle(269 + row) - angle(268 + row)) / 0.072 / 6.0;
            assert!((rpm - rate.parse::<f64>().unwrap()).abs() < 1e-3, "row {row}, {name}: {rpm} for {rate}");
        }
    }
    assert!(refused(&["walk", "nao", "--descent-intervals", "9"]).contains("for one step goal"));
}
