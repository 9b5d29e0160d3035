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
    let names = ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"];
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
    // Arcs are counted from 1, as in text.
    let number = page["best"]["arc"].as_u64().unwrap();
    assert!((1..=arcs.len() as u64).contains(&number), "{number}");
    let text = solve(&[]);
    assert!(text.contains(&format!("largest margin to the limits on arc {number}: ")), "{text}");
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
    assert!(error(&["--closest", "--length=-1"]).contains("give a positive number"));
    let planar = text(&root("derivations/planar_2r")).to_owned();
    assert!(refused(&["solve", &planar, "--target", "0.6,0.3", "--limits", "Shoulder=0,1"]).contains("redundant"));
}

/// Shoulder and wrist of an iiwa 14 are 0.82 m apart when it is stretched, and the flange is 0.126 m beyond the wrist. The shoulder is at a height of 0.36 m.
#[test]
fn closest_joint_values_of_a_target_out_of_reach() {
    let folder = text(arm().folder.path());
    let solve = |more: &[&str]| succeed(&[&["solve", folder, "--target", "0,0,2.5,0,0,0,1"], more].concat());
    let page: Value = serde_json::from_str(&solve(&["--closest", "--json"])).unwrap();
    let closest = &page["closest"];
    let (distance, angle) = (closest["distance"].as_f64().unwrap(), closest["angle"].as_f64().unwrap());
    assert!((distance - (2.5 - 0.36 - 0.82 - 0.126)).abs() < 1e-6 && angle < 1e-6, "{closest}");
    assert!((closest["is_minimum"] == true) && closest["outside_limits"].as_array().unwrap().is_empty(), "{closest}");
    assert!(solve(&["--closest"]).contains(" from the target; a local minimum, found from "));
    assert!(serde_json::from_str::<Value>(&solve(&["--json"])).unwrap().get("closest").is_none());
    // Reachable targets, and limits that exclude all solutions.
    assert!(json(&["--closest"]).get("closest").is_none());
    let narrow = json(&["--closest", "--limits", "A4=0,1"]);
    let elbow = narrow["closest"]["q"][3].as_f64().unwrap();
    assert!(
        (-1e-9..=1.0 + 1e-9).contains(&elbow) && narrow["closest"]["distance"].as_f64().unwrap() > 1e-3,
        "{narrow}"
    );
}

/// Poses within limits need no value of the given joint; other measures do.
#[test]
fn a_map_counts_poses_within_limits() {
    let folder = text(arm().folder.path());
    let grid = ["--x", "0.4", "--y", "0.1:0.2:2", "--z", "0.5", "--orientations", "20"];
    let map = |more: &[&'static str]| [&["reach", folder], &grid[..], more].concat();
    let reported = succeed(&map(&["--measure", "limits"]));
    assert!(reported.contains("reached within limits: 2 points") && !reported.contains("answers"), "{reported}");
    assert!(refused(&map(&[])).contains("the measure `limits` is allowed"));
    assert!(refused(&map(&["--measure", "manipulability", "--limits"])).contains("the measure `limits` is allowed"));
    assert!(succeed(&map(&["--given", "0.4"])).contains("answers"));
}

/// The input files in the examples of the help exist in a clone.
#[test]
fn the_example_of_the_help_derives_an_arm_first() {
    let help = succeed(&["solve", "--help"]);
    let words: Vec<&str> = help.split_whitespace().collect();
    let derive = words.windows(2).find(|pair| pair[0] == "derive" && pair[1].starts_with("tests/corpus/redundant/"));
    assert!(root(derive.expect("an example that derives a redundant arm")[1]).is_file(), "{help}");
}

/// A table of poses of joint values that move slowly, and the poses.
fn slow_poses() -> (String, Vec<groebot::spatial::Pose>) {
    let text = fs::read_to_string(root("derivations/iiwa14/0_chain.toml")).unwrap();
    let chain = groebot::kinematics::Chain::from_toml(&text.replace("given = [\"A3\"]\n", "")).unwrap();
    let pose = |k: u32| {
        let step = 0.05 * f64::from(k);
        chain.forward(&[0.3 + step, -0.6, 0.4 - step, 1.1, -0.2, 0.7 + step, 0.5]).unwrap()
    };
    let poses: Vec<_> = (0..10).map(pose).collect();
    let row = |pose: &groebot::spatial::Pose| {
        let (p, q) = (pose.translation.vector, pose.rotation.coords);
        format!("{},{},{},{},{},{},{}\n", p.x, p.y, p.z, q.x, q.y, q.z, q.w)
    };
    ("x,y,z,qx,qy,qz,qw\n".to_owned() + &poses.iter().map(row).collect::<String>(), poses)
}

/// Poses of joint values that move slowly have a path without a jump, from the folder of the derivation and from the description alone.
/// A path is unsure if the arcs of one of its poses are unsure.
#[test]
fn follow_uses_arcs() {
    let (table, poses) = slow_poses();
    let solver = groebot::folder::program(arm().folder.path()).unwrap().redundant_solver().unwrap();
    let is_unsure = |pose: &groebot::spatial::Pose| {
        let target = solver.target(*pose).unwrap();
        solver.arcs(&target, &solver.limits()).unwrap().is_unsure
    };
    let doubt = if poses.iter().any(is_unsure) {
        "  Unsure: other solutions within limits may exist at some poses.\n"
    } else {
        ""
    };
    let folder = tempdir().unwrap();
    let [input, csv, alone] = ["poses.csv", "path.csv", "iiwa14.toml"].map(|name| folder.path().join(name));
    fs::write(&input, table).unwrap();
    fs::copy(arm().folder.path().join("0_chain.toml"), &alone).unwrap();
    for source in [arm().folder.path(), &alone] {
        let reported = succeed(&["follow", text(source), "--poses", text(&input), "--force", "-o", text(&csv)]);
        assert_eq!(reported, format!("iiwa14: 10 poses, without a jump\n{doubt}"));
        let path = groebot::motion::Trajectory::read_csv(&csv).unwrap();
        assert_eq!(path.q.len(), 10);
    }
}

/// With `--given`, only the solver with this joint given is requested. A pose lacks the value of the joint.
#[test]
fn follow_with_a_given_joint_is_refused() {
    let (table, _) = slow_poses();
    let folder = tempdir().unwrap();
    let input = folder.path().join("poses.csv");
    fs::write(&input, table).unwrap();
    let error = refused(&["follow", text(arm().folder.path()), "--given", "A3", "--poses", text(&input)]);
    assert!(error.contains("without given joints"), "{error}");
}
