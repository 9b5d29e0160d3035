//! A chain with one joint more than its task determines: `groebot derive` without a given joint, and all solutions within limits.

use std::fs;
use std::sync::OnceLock;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{copy_of, refused, root, succeed, text};

/// An iiwa without given joint, derived once for all tests.
struct Arm {
    folder: TempDir,
    report: String,
}

fn arm() -> &'static Arm {
    static ARM: OnceLock<Arm> = OnceLock::new();
    ARM.get_or_init(|| {
        let folder = tempdir().unwrap();
        let chain = fs::read_to_string(root("derivations/iiwa14/0_chain.toml")).unwrap();
        let input = folder.path().join("0_chain.toml");
        fs::write(&input, chain.replace("given = [\"A3\"]\n", "")).unwrap();
        let report = succeed(&["derive", text(folder.path())]);
        Arm { folder, report }
    })
}

/// The pose of these joint values, as numbers of a target, and the joint values.
fn pose() -> (String, [f64; 7]) {
    let q = [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5];
    let table = format!("{}\n", q.map(|value: f64| value.to_string()).join(","));
    let ran = super::run_on(&["fk", text(&root("derivations/iiwa14"))], table.as_bytes());
    let rows: Vec<Vec<&str>> = ran.out.lines().map(|line| line.split(',').collect()).collect();
    let cell = |name: &str| rows[1][rows[0].iter().position(|own| *own == name).unwrap()];
    let names = ["px", "py", "pz", "r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"];
    (names.map(cell).join(","), q)
}

fn solve(more: &[&str]) -> String {
    let (target, _) = pose();
    succeed(&[&["solve", text(arm().folder.path()), "--target", &target], more].concat())
}

fn json(more: &[&str]) -> Value {
    serde_json::from_str(&solve(&[more, &["--json"]].concat())).unwrap()
}

#[test]
fn derive_lists_the_solver_of_each_joint() {
    let report = &arm().report;
    assert!(report.contains("one joint more than its task determines"), "{report}");
    assert_eq!(report.lines().filter(|line| line.contains(": closed form, up to 8 solutions")).count(), 6, "{report}");
    assert!(report.contains("A4: the target determines it"), "{report}");
    let task = fs::read_to_string(arm().folder.path().join("0_task.toml")).unwrap();
    assert!(task.contains("redundant = true"), "{task}");
    let page = fs::read_to_string(arm().folder.path().join("README.md")).unwrap();
    assert!(page.contains("## All solutions within limits"), "{page}");
}

#[test]
fn check_proves_the_solver_of_each_joint() {
    let found = succeed(&["check", text(arm().folder.path())]);
    assert!(found.contains("A1 given: ") && found.contains("A7 given: "), "{found}");
    let folder = copy_of(arm().folder.path());
    let file = folder.path().join("certificate.json");
    let mut certificate: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    certificate["claims"]["given"][0]["joint"] = "A2".into();
    fs::write(&file, certificate.to_string()).unwrap();
    assert!(super::run(&["check", text(folder.path())]).code == 1);
}

#[test]
fn solve_prints_arcs_and_the_best_solution() {
    let text = solve(&[]);
    assert!(text.contains("arcs of solutions within limits\n"), "{text}");
    assert!(text.contains("at its lower limit") && text.contains("at its upper limit"), "{text}");
    assert!(text.contains("largest margin to the limits on arc "), "{text}");
    let near = solve(&["--closest-to", "0.3,-0.6,0.4,1.1,-0.2,0.7,0.5"]);
    assert!(near.contains("distance 0.000000\n"), "{near}");
}

#[test]
fn json_has_the_arcs() {
    let page = json(&[]);
    let arcs = page["arcs"].as_array().unwrap();
    assert!(!arcs.is_empty() && page.get("reason").is_none());
    for arc in arcs {
        assert!(arc["length"].as_f64().unwrap() >= 0.0 && arc["start"]["q"].as_array().unwrap().len() == 7);
        if arc["closed"] == false {
            let (joint, limit) = (arc["end"]["joint"].as_str().unwrap(), arc["end"]["limit"].as_str().unwrap());
            let place = page["joints"].as_array().unwrap().iter().position(|own| own == joint).unwrap();
            let value = arc["end"]["q"][place].as_f64().unwrap().to_degrees();
            let expected = [170.0, 120.0, 170.0, 120.0, 170.0, 120.0, 175.0][place];
            assert!((value - if limit == "upper" { expected } else { -expected }).abs() < 1e-6, "{arc}");
        }
    }
    assert_eq!(page["best"]["criterion"], "margin");
    assert!(page["best"]["arc"].as_u64().unwrap() < arcs.len() as u64);
}

/// The elbow is at 1.1 rad or at -1.1.
#[test]
fn limits_exclude_all_solutions() {
    let text = solve(&["--limits", "A4=0,1"]);
    assert!(text.ends_with(": no solution within limits: reachable, but beyond the limits of A4\n"), "{text}");
    let page = json(&["--limits", "A4=0,57", "--degrees"]);
    assert_eq!((&page["arcs"], &page["best"]), (&Value::Array(Vec::new()), &Value::Null));
    assert_eq!(page["reason"], "reachable, but beyond the limits of A4");
    let far = succeed(&["solve", super::text(arm().folder.path()), "--target", "3,0,0,0,0,0,1"]);
    assert!(far.ends_with(": no solution within limits: unreachable\n"), "{far}");
}

#[test]
fn a_target_with_the_value_of_the_given_joint_has_its_solutions() {
    let (target, q) = pose();
    let task = fs::read_to_string(arm().folder.path().join("0_task.toml")).unwrap();
    let joint = (1..=7).find(|joint| task.contains(&format!("given = [\"A{joint}\"]"))).unwrap();
    let target = format!("{target},{}", q[joint - 1]);
    let page = succeed(&["solve", text(arm().folder.path()), "--target", &target, "--json"]);
    let page: Value = serde_json::from_str(&page).unwrap();
    let is_same =
        |solution: &Value| (0..7).all(|joint| (solution["q"][joint].as_f64().unwrap() - q[joint]).abs() < 1e-9);
    assert!(page["solutions"].as_array().unwrap().iter().any(is_same), "{page}");
    let error = refused(&["solve", text(arm().folder.path()), "--target", &target, "--limits", "A4=0,1"]);
    assert!(error.contains("--limits and --closest-to"), "{error}");
}

#[test]
fn wrong_options_are_refused() {
    let (target, _) = pose();
    let folder = text(arm().folder.path());
    let error = |more: &[&str]| refused(&[&["solve", folder, "--target", &target], more].concat());
    assert!(error(&["--limits", "A4=1,0"]).contains("give the lower one first"));
    assert!(error(&["--limits", "A8=0,1"]).contains("there is no joint `A8`"));
    assert!(error(&["--limits", "A4"]).contains("JOINT=LOW,HIGH"));
    assert!(error(&["--limits", "A4=nan,1"]).contains("NaN"));
    assert!(error(&["--closest-to", "1,2,3"]).contains("3 values"));
    let planar = text(&root("derivations/planar_2r")).to_owned();
    assert!(refused(&["solve", &planar, "--target", "0.6,0.3", "--limits", "Shoulder=0,1"]).contains("redundant"));
}

/// Poses of joint values that move slowly have a path without a jump.
#[test]
fn follow_uses_arcs() {
    let chain = groebot::kinematics::Chain::from_toml(
        &fs::read_to_string(root("derivations/iiwa14/0_chain.toml")).unwrap().replace("given = [\"A3\"]\n", ""),
    );
    let chain = chain.unwrap();
    let mut table = "x,y,z,qx,qy,qz,qw\n".to_owned();
    for k in 0..10 {
        let step = 0.05 * f64::from(k);
        let pose = chain.forward(&[0.3 + step, -0.6, 0.4 - step, 1.1, -0.2, 0.7 + step, 0.5]).unwrap();
        let (p, q) = (pose.translation.vector, pose.rotation.coords);
        table += &format!("{},{},{},{},{},{},{}\n", p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    }
    let folder = tempdir().unwrap();
    let [input, csv, arm] = ["poses.csv", "path.csv", "iiwa14.toml"].map(|name| folder.path().join(name));
    fs::write(&input, table).unwrap();
    fs::write(&arm, fs::read_to_string(super::redundant::arm().folder.path().join("0_chain.toml")).unwrap()).unwrap();
    let reported = succeed(&["follow", text(&arm), "--poses", text(&input), "-o", text(&csv)]);
    assert_eq!(reported, "iiwa14: 10 poses, without a jump\n");
    let path = groebot::motion::Trajectory::read_csv(&csv).unwrap();
    assert_eq!(path.q.len(), 10);
}
