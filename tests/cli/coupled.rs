//! Chains that share actuators on the command line: two planar arms with a common shoulder are derived, checked, solved and explained. NAO's legs are tested as
//! committed.

use std::fs;
use std::sync::OnceLock;

use groebot::kinematics::Chain;
use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{content, refused, root, succeed, text};

/// A planar arm with links of length one, except the last one of 1.25.
fn arm(name: &str, joints: usize) -> String {
    let joint =
        |k: usize| format!("[[joint]]\nname = \"j{k}\"\ntype = \"revolute\"\naxis = [0, 0, 1]\npoint = [{k}, 0, 0]\n");
    let joints_text: String = (0..joints).map(joint).collect();
    format!(
        "name = \"{name}\"\ntask = {{ kind = \"planar_position\", plane = \"xy\" }}\n{joints_text}[tip]\npoint = [{joints}.25, 0, 0]\n"
    )
}

const ARMS: &str = "name = \"arms\"
description = \"two arms on one shoulder\"
shared = [[\"a.j0\", \"b.j0\"]]
[[chain]]
name = \"a\"
chain = \"a.toml\"
[[chain]]
name = \"b\"
chain = \"b.toml\"
";

/// A folder with the description of both arms.
fn folder() -> TempDir {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("0_coupled.toml"), ARMS).unwrap();
    fs::write(folder.path().join("a.toml"), arm("first", 2)).unwrap();
    fs::write(folder.path().join("b.toml"), arm("second", 3)).unwrap();
    folder
}

/// The arms, derived once, and the output of `derive`.
fn arms() -> &'static (TempDir, String) {
    static DERIVED: OnceLock<(TempDir, String)> = OnceLock::new();
    DERIVED.get_or_init(|| {
        let folder = folder();
        let report = succeed(&["derive", text(folder.path())]);
        (folder, report)
    })
}

fn has(page: &str, words: &[&str]) {
    for word in words {
        assert!(page.contains(word), "`{word}` is not in:\n{page}");
    }
}

#[test]
fn derive_writes_every_stage_and_reports_each_chain() {
    let (folder, report) = arms();
    has(
        report,
        &["arms: 4 solutions at most", "chain 1: a", "chain 2: b, with j0 where the chains before it have put it"],
    );
    has(report, &["of them: the screw solver", "Written to"]);
    let files = content(folder.path());
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "0_coupled.toml",
            "1_equations.txt",
            "2_plan.txt",
            "3_basis.txt",
            "4_triangular.txt",
            "5_program.json",
            "5_solver.c",
            "5_solver.h",
            "5_solver.rs",
            "6_check.csv",
            "README.md",
            "a.toml",
            "b.toml",
            "certificate.json"
        ]
    );
    let page = String::from_utf8(files["README.md"].clone()).unwrap();
    has(
        &page,
        &["# arms", "two arms on one shoulder", "## Chain 2: b", "## Accuracy, measured", "a_px, a_py, b_px, b_py"],
    );
    let rows = String::from_utf8(files["6_check.csv"].clone()).unwrap();
    assert!(rows.lines().skip(1).all(|row| row.ends_with(",pass")), "{rows}");
    assert!(
        rows.lines().any(|row| row.starts_with("rational,")) && rows.lines().any(|row| row.starts_with("singular,"))
    );
}

#[test]
fn another_folder_gets_the_chains_too() {
    let (folder, _) = arms();
    let elsewhere = tempdir().unwrap();
    let out = elsewhere.path().join("out");
    succeed(&["derive", text(&folder.path().join("0_coupled.toml")), "--quiet", "--out", text(&out)]);
    assert_eq!(content(&out), content(folder.path()));
}

#[test]
fn check_proves_it_again_and_finds_what_was_changed() {
    let (folder, _) = arms();
    let page = succeed(&["check", text(folder.path())]);
    assert!(page.lines().all(|line| line.starts_with('\u{2713}')), "{page}");
    has(&page, &["2 chains on 4 actuators", "a: 2 steps proved again", "targets solved again, all correct"]);
    let copy = tempdir().unwrap();
    for (name, bytes) in content(folder.path()) {
        fs::write(copy.path().join(name), bytes).unwrap();
    }
    let chain = fs::read_to_string(copy.path().join("b.toml")).unwrap();
    fs::write(copy.path().join("b.toml"), chain.replace("point = [3.25, 0, 0]", "point = [3.25, 1, 0]")).unwrap();
    has(&refused(&["check", text(copy.path())]), &["certificate"]);
}

/// The tip of the first arm is at (1, 1.25). Its elbow is at (1, 0), or mirrored at the line to the tip. From both, the second arm, with links of 1 and 1.25,
/// reaches (1, 1.2) with two solutions.
#[test]
fn solve_finds_all_solutions_and_names_the_failing_chain() {
    let (folder, _) = arms();
    let answer: Value =
        serde_json::from_str(&succeed(&["solve", text(folder.path()), "--json", "--target", "1,1.25,1,1.2"])).unwrap();
    assert_eq!(answer["joints"], serde_json::json!(["j0", "a_j1", "b_j1", "b_j2"]));
    assert_eq!(answer["solutions"].as_array().unwrap().len(), 4, "{answer}");
    assert_eq!(answer.get("reason"), None);
    let far = succeed(&["solve", text(folder.path()), "--target", "1,1.25,9,1", "--target", "5,1,1,1"]);
    has(
        &far,
        &[
            "no solution: the equations of chain `b` fail for each of the 2 solutions",
            "the equations of chain `a` fail;",
        ],
    );
    let far: Value =
        serde_json::from_str(&succeed(&["solve", text(folder.path()), "--json", "--target", "1,1.25,9,1"])).unwrap();
    assert!(far["reason"].as_str().unwrap().contains("chain `b`"), "{far}");
}

#[test]
fn info_and_explain_report_actuators_and_chains() {
    let (folder, _) = arms();
    let page = succeed(&["info", text(folder.path())]);
    has(&page, &["arms: 2 chains on 4 actuators", "j0    a.j0, b.j0", "chain b", "second: 3 joints"]);
    let reported: Value = serde_json::from_str(&succeed(&["info", "--json", text(folder.path())])).unwrap();
    assert_eq!((&reported["format"], &reported["chains"][1]["chain"]["joints"][2]["name"]), (&2.into(), &"j2".into()));
    assert_eq!(reported["actuators"][0]["joints"], serde_json::json!(["a.j0", "b.j0"]));
    let system = succeed(&["info", "--json", "derivations/nao_arm_planar"]);
    let system: Value = serde_json::from_str(&system).unwrap();
    assert_eq!((&system["format"], system["equations"].as_array().unwrap().len()), (&2.into(), 4));
    let reported = succeed(&["explain", text(folder.path())]);
    has(
        &reported,
        &["## The chains and their actuators", "has 4 complex solutions", "The user gives the value of joint 1"],
    );
    has(&refused(&["fk", text(folder.path()), "--q", "0,0,0,0"]), &["needs a chain"]);
    has(&refused(&["plan", text(folder.path())]), &["needs a chain"]);
}

#[test]
fn mistakes_name_file_and_line_and_write_nothing() {
    let cases = [
        ("0_coupled.toml", "\"a.j0\"", "\"a.j9\"", &["0_coupled.toml: line 3:", "there is no `j9`"][..]),
        ("0_coupled.toml", "chain = \"b.toml\"", "chain = \"c.toml\"", &["c.toml", "No such file"]),
        ("0_coupled.toml", "shared", "shered", &["0_coupled.toml: line 3:", "did you mean `shared`"]),
        ("b.toml", "axis = [0, 0, 1]", "axis = [0, 0, 0]", &["b.toml: line 6:", "chain `b`"]),
        ("b.toml", "name = \"j2\"", "name = \"j1\"", &["b.toml: line", "`j1`"]),
    ];
    for (file, from, to, words) in cases {
        let folder = folder();
        let path = folder.path().join(file);
        let before = fs::read_to_string(&path).unwrap();
        assert!(before.contains(from), "{from}");
        fs::write(&path, before.replacen(from, to, 1)).unwrap();
        let previous = content(folder.path());
        has(&refused(&["derive", text(folder.path())]), words);
        assert_eq!(content(folder.path()), previous);
    }
    let (folder, _) = arms();
    has(&refused(&["derive", text(folder.path()), "--task", "pose"]), &["each chain has its own"]);
    has(&refused(&["info", text(folder.path()), "--tip", "x"]), &["only a URDF has links"]);
}

/// Targets of NAO's feet whose hip angles differ by 0.01 rad: each foot can be reached, but not both together.
#[test]
fn poses_that_disagree_on_the_hip_are_refused_by_name() {
    let folder = root("derivations/nao_legs_poses");
    let [left, right] = ["left.toml", "right.toml"].map(|file| Chain::read(&folder.join(file)).unwrap());
    let pose = |leg: &Chain, hip: f64| {
        let tip = leg.forward(&[hip, -0.2, 0.3, 0.7, -0.4, 0.1]).unwrap();
        let (p, r) = (tip.translation, tip.rotation.to_rotation_matrix());
        let rows = (0..9).map(|k| r[(k / 3, k % 3)]);
        [p.x, p.y, p.z].into_iter().chain(rows).map(|number| format!("{number:e}")).collect::<Vec<_>>().join(",")
    };
    let target = |hips: [f64; 2]| format!("{},{}", pose(&left, hips[0]), pose(&right, hips[1]));
    let agreeing = succeed(&["solve", text(&folder), "--target", &target([-0.3, -0.3])]);
    has(&agreeing, &[" solutions"]);
    let reported = succeed(&["solve", text(&folder), "--target", &target([-0.3, -0.29])]);
    has(
        &reported,
        &["no solution: the chains' targets contradict each other: chain `right` needs `HipYawPitch` at", "rad off"],
    );
}
