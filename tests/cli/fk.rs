//! `groebot fk`: text, JSON and CSV contain the same, correct pose.

use std::f64::consts::PI;
use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::{refused, root, run_on, succeed, text};

fn file(name: &str) -> String {
    text(&root("tests/corpus/urdf").join(name)).to_owned()
}

fn leg() -> String {
    text(&root("derivations/nao_leg_sagittal")).to_owned()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&succeed(&[&["fk", "--json"], arguments].concat())).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
}

/// NAO's leg from its drawing: thigh 100 mm, tibia 102.9 mm, both with pitch joints about y.
#[test]
fn the_pose_of_a_leg() {
    let (hip, knee) = (0.3f64, 0.6f64);
    let answer = json(&[&leg(), "--q", "0.3,0.6"]);
    let wanted = [100.0 * hip.sin() + 102.9 * (hip + knee).sin(), 0.0, 100.0 * hip.cos() + 102.9 * (hip + knee).cos()];
    assert!(near(&numbers(&answer["position"]), &wanted), "{answer}");
    let half = (hip + knee) / 2.0;
    assert!(near(&numbers(&answer["quaternion_xyzw"]), &[0.0, half.sin(), 0.0, half.cos()]));
    assert!(near(&numbers(&answer["rpy"]), &[0.0, 0.9, 0.0]));
    assert!(near(&numbers(&answer["matrix"][0]), &[0.9f64.cos(), 0.0, 0.9f64.sin(), wanted[0]]));
    assert!(near(&numbers(&answer["matrix"][3]), &[0.0, 0.0, 0.0, 1.0]));
    assert_eq!((&answer["unit"]["position"], &answer["unit"]["joints"][0]), (&"mm".into(), &"rad".into()));
    let degrees = json(&[&leg(), "--degrees", "--q", &format!("{},{}", hip * 180.0 / PI, knee * 180.0 / PI)]);
    assert!(near(&numbers(&degrees["position"]), &wanted));
    assert!(near(&numbers(&degrees["rpy"]), &[0.0, 0.9 * 180.0 / PI, 0.0]));
    assert_eq!(degrees["unit"]["rpy"], "deg");
}

/// The UR5 stretched out and upright, from the sums of the manufacturer's lengths.
#[test]
fn the_same_robot_from_four_files() {
    // The URDF has 1.5708 for a quarter turn, and the poses are those for this value.
    for (name, off) in
        [("ur5.urdf", 1e-5), ("ur5_standard.toml", 0.0), ("ur5_modified.toml", 0.0), ("ur5_axes.toml", 0.0)]
    {
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= off) || near(a, b);
        let stretched = json(&[&file(name), "--q", "0,0,0,0,0,0"]);
        assert!(near(&numbers(&stretched["position"]), &[-0.81725, -0.10915 - 0.0823, 0.089159 - 0.09465]), "{name}");
        let upright = json(&[&file(name), "--degrees", "--q", "0,-90,0,-90,0,0"]);
        assert!(near(&numbers(&upright["position"]), &[0.0, -0.19145, 0.089159 + 0.81725 + 0.09465]), "{name}");
    }
}

#[test]
fn links_choose_the_chain() {
    let nao = file("nao.urdf");
    let head = json(&[&nao, "--tip", "Head", "--q", "0,0"]);
    assert!(near(&numbers(&head["position"]), &[0.0, 0.0, 0.1265]));
    let between = json(&[&nao, "--base", "LTibia", "--tip", "l_sole", "--q", "0,0"]);
    assert!(near(&numbers(&between["position"]), &[0.0, 0.0, -0.1029 - 0.04519]));
    let up = json(&[&nao, "--base", "l_sole", "--tip", "LTibia", "--q", "0,0"]);
    assert!(near(&numbers(&up["position"]), &[0.0, 0.0, 0.1029 + 0.04519]));
}

#[test]
fn text_shows_units_and_limits() {
    let page = succeed(&["fk", &file("nao.urdf"), "--tip", "Head", "--degrees", "--q", "0,-45", "--q", "10,0"]);
    for words in ["HeadPitch", "-45.000000 deg", "outside -38.50..29.50 deg", "(x y z w)", "position", "matrix", " m\n"]
    {
        assert!(page.contains(words), "{words}: {page}");
    }
    assert!(!page.contains("-0.000000000 ") && page.matches("tip in the base frame").count() == 2, "{page}");
    let answer = json(&[&file("nao.urdf"), "--tip", "Head", "--degrees", "--q", "0,-45"]);
    assert_eq!(answer["outside_limits"], Value::from(vec!["HeadPitch"]));
}

/// An angle of -162.8 degrees is as wide as its column.
#[test]
fn columns_of_text_are_separated() {
    let text = succeed(&["fk", "ur10e", "--q", "0,-0.4,0.3,2,1,-2"]);
    let rows = text.lines().skip_while(|line| !line.contains("position")).filter(|line| !line.trim().is_empty());
    for row in rows {
        assert!(row.split_whitespace().all(|word| word.matches('.').count() <= 1), "{text}");
    }
    assert!(text.lines().any(|line| line.trim_start().starts_with("roll") && line.ends_with(" rad")), "{text}");
}

#[test]
fn csv_reports_what_json_reports_and_reads_its_own_output() {
    let ran = run_on(&["fk", &leg()], b"0,0\n 0.3, 0.6\n\n");
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let rows: Vec<Vec<&str>> = ran.out.lines().map(|line| line.split(',').collect()).collect();
    let header = "HipPitch,KneePitch,x_mm,y_mm,z_mm,qx,qy,qz,qw,roll_rad,pitch_rad,yaw_rad,outside_limits";
    assert_eq!(rows[0].join(","), header);
    assert_eq!(rows.len(), 3);
    let answer = json(&[&leg(), "--q", "0.3,0.6"]);
    let cells: Vec<f64> = rows[2][..12].iter().map(|cell| cell.parse().unwrap()).collect();
    assert_eq!(cells[2..5], numbers(&answer["position"]));
    assert_eq!(cells[5..9], numbers(&answer["quaternion_xyzw"]));
    assert_eq!(run_on(&["fk", &leg()], ran.out.as_bytes()).out, ran.out);
    let swapped = run_on(&["fk", &leg()], b"KneePitch,HipPitch\n0.6,0.3\n");
    assert_eq!(swapped.out.lines().nth(1), ran.out.lines().nth(2));
    let lines = run_on(&["fk", &leg(), "--json", "--q", "-"], b"0,0\n0.3,0.6\n").out;
    assert_eq!(lines.lines().count(), 2);
    assert_eq!(serde_json::from_str::<Value>(lines.lines().nth(1).unwrap()).unwrap(), answer);
}

#[test]
fn mistakes_are_reported_in_one_line() {
    let nao = file("nao.urdf");
    for (arguments, words) in [
        (vec!["--q", "1"], vec!["1 joint values", "2 joints"]),
        (vec!["--q", "1,x"], vec!["cell 2 (`KneePitch`) is `x`"]),
        (vec!["--q", "1,inf"], vec!["joint `KneePitch`", "not finite"]),
        (vec!["--q", "1,2", "--tip", "foot"], vec!["only a URDF has links"]),
    ] {
        let error = refused(&[&["fk", &leg()], arguments.as_slice()].concat());
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
    for (arguments, words) in [
        (vec!["--q", "0"], "choose a tip link, such as `Head`"),
        (vec!["--q", "0", "--tip", "l_sol"], "did you mean `l_sole`?"),
        (vec!["--q", "0", "--tip", "torso"], "no joint moves between `base_link` and `torso`"),
    ] {
        let error = refused(&[&["fk", nao.as_str()], arguments.as_slice()].concat());
        assert!(error.contains(words) && error.contains("nao.urdf"), "{error}");
    }
    let system = refused(&["fk", text(&root("derivations/nao_arm_planar")), "--q", "1"]);
    assert!(system.contains("system of equations"), "{system}");
    let ran = run_on(&["fk", &leg()], b"0,0\n0,nan\n");
    assert!(
        ran.code == 1 && ran.err.starts_with("error: <stdin>: line 2: ") && ran.out.lines().count() == 2,
        "{}",
        ran.err
    );
}

/// A planar arm as a DH table: derived, proved, solved. Forward kinematics of the solutions is the target.
#[test]
fn a_dh_table_is_derived_like_a_chain() {
    let folder = tempdir().unwrap();
    let (table, out) = (folder.path().join("arm.toml"), folder.path().join("out"));
    let arm = "name = 'arm'\ntask = { kind = 'planar_position', plane = 'xy' }\n[dh]\nconvention = 'standard'\n\
               [[joint]]\nname = 'a'\ntype = 'revolute'\na = 0.4\n[[joint]]\nname = 'b'\ntype = 'revolute'\na = 0.3\n";
    fs::write(&table, arm).unwrap();
    succeed(&["derive", text(&table), "--out", text(&out), "--quiet"]);
    succeed(&["check", text(&out)]);
    let answer: Value =
        serde_json::from_str(&succeed(&["solve", text(&out), "--json", "--target", "0.3,-0.2"])).unwrap();
    let solutions = answer["solutions"].as_array().unwrap();
    assert_eq!(solutions.len(), 2);
    for solution in solutions {
        let q: Vec<String> = numbers(&solution["q"]).iter().map(f64::to_string).collect();
        assert!(near(&numbers(&json(&[text(&out), "--q", &q.join(",")])["position"]), &[0.3, -0.2, 0.0]));
    }
}
